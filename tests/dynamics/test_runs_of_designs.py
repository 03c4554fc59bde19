"""Runs of many designs against closed forms, and against the runs of each by itself."""

import numpy as np
import pytest
from tests.refusals import refused

import linkwright as lw
from linkwright import gallery

WHEEL = """
format: 1
name: Wheel
frame: {points: {O: [0 m, 0 m]}}
links: {wheel: {points: [O, A], length: 1 m, mass: 2 kg, mass_centre: [0 m, 0 m], inertia: 0.5 kg·m²}}
driver: {turn: wheel, about: O, speed: 20 rad/s}
actuators:
  motor: {kind: constant, on: wheel, torque: 3 N·m}
"""
LOSS = "loads:\n  loss: {kind: torsion_damper, links: [frame, wheel], damping: 0.1 N·m·s/rad}\n"
RUBBING = "loads:\n  rubbing: {kind: torque, on: wheel, magnitude: 2 N·m, opposes: velocity}\n"
TORQUES, INERTIAS = np.linspace(2.5, 6.0, 20), np.linspace(0.2, 1.0, 20)
COLUMNS = {"actuators.motor.torque": TORQUES, "wheel.inertia": INERTIAS}


def test_run_ups_against_an_exponential() -> None:
    """w = T/c (1 − exp(−c t/J)); 19 rad/s, where it gets so far, after −J/c ln(1 − 19 c/T)."""
    found = lw.run_designs(lw.loads(WHEEL + LOSS), COLUMNS, duration=4.0, tolerance=1e-12)
    assert found.outcomes == ("ended",) * 20
    assert not found.alone.any()
    rate = TORQUES / 0.1 * (1.0 - np.exp(-0.4 / INERTIAS))
    assert found.rates["driver"] == pytest.approx(rate, rel=1e-11)
    assert found.coordinates["driver"] == pytest.approx(TORQUES / 0.1 * 4.0 - 10.0 * INERTIAS * rate, rel=1e-11)
    assert found.speed == pytest.approx(19.0)
    with np.errstate(invalid="ignore"):
        time = -INERTIAS / 0.1 * np.log(1.0 - 1.9 / TORQUES)
    assert found.time_to_speed == pytest.approx(np.where(time < 4.0, time, np.nan), rel=1e-11, nan_ok=True)
    assert found.peaks["motor"] == pytest.approx(TORQUES, rel=1e-14)
    assert found.rms["motor"] == pytest.approx(TORQUES, rel=1e-14)
    assert found.energy_residual.max() < 1e-11


def test_designs_that_stick_are_run_by_themselves() -> None:
    """From rest against 2 N·m of friction; those with less torque stay where they are."""
    torques = np.array([1.0, 2.5, 4.0])
    found = lw.run_designs(lw.loads(WHEEL + RUBBING), {"actuators.motor.torque": torques}, duration=2.0)
    assert found.outcomes == ("ended",) * 3
    assert found.alone.tolist() == [True, False, False]
    assert found.rates["driver"] == pytest.approx([0.0, 2.0, 8.0], abs=1e-9)
    assert found.peaks["motor"] == pytest.approx(torques)
    coasting = lw.run_designs(
        lw.loads(WHEEL + RUBBING), {"actuators.motor.torque": [0.0], "wheel.inertia": [0.25]}, duration=3.0, speed=8.0
    )
    assert coasting.alone.tolist() == [True]
    assert coasting.coordinates["driver"] == pytest.approx([0.25 * 64.0 / 4.0], rel=1e-8)
    assert coasting.rates["driver"] == pytest.approx([0.0], abs=1e-9)


def test_conditions_hold_for_designs_that_are_run_by_themselves() -> None:
    """Slowed down by 8 rad/s² from 8 rad/s at 0.3 rad: 4 rad in a second, and never a turn."""
    coasting = lw.loads((WHEEL + RUBBING).replace("3 N·m", "0 N·m") + "run: {for: 3 s}\n")
    begin = {"at": 0.3, "speed": 8.0}
    found = lw.run_designs(coasting, {"wheel.inertia": [0.25, 0.25], "run.for": [1.5, 2.5]}, **begin)
    assert found.alone.all()
    assert found.time.tolist() == [1.5, 2.5]
    assert found.coordinates["driver"] == pytest.approx([4.3, 4.3], rel=1e-8)
    late = lw.run_designs(coasting, {"wheel.inertia": [0.25]}, turns=1.0, at_most=3.0, **begin)
    assert late.alone.all()
    assert (late.outcomes, late.time.tolist()) == (("late",), [3.0])


def test_switching_at_times_of_their_own() -> None:
    """Torque from 0.5 s up to a time of each design, against friction all the while, started at 8 rad/s."""
    text = (WHEEL + RUBBING).replace("torque: 3 N·m}", "torque: 3 N·m, from: 0.5 s, until: 1 s}")
    ends = np.array([0.8, 1.0, 1.4])
    found = lw.run_designs(lw.loads(text), {"actuators.motor.until": ends}, duration=1.5, speed=8.0, tolerance=1e-11)
    assert not found.alone.any()
    assert found.rates["driver"] == pytest.approx(8.0 - 2.0 / 0.5 * 1.5 + 3.0 / 0.5 * (ends - 0.5), rel=1e-11)
    assert found.rms["motor"] == pytest.approx(3.0 * np.sqrt((ends - 0.5) / 1.5), rel=1e-9)


def test_numbers_of_turns_and_starts_of_each_design() -> None:
    """n turns at constant torque take √(4 π n J/T) from rest."""
    wheel = lw.loads(WHEEL + "run: {turns: 1, at: 0.3 rad}\n")
    turns, places = np.array([1.0, 2.5, 4.0]), np.array([0.1, 0.2, -3.0])
    found = lw.run_designs(wheel, {"run.turns": turns, "run.at.driver": places}, tolerance=1e-12)
    assert found.outcomes == ("turns",) * 3
    assert found.time == pytest.approx(np.sqrt(4.0 * np.pi * turns * 0.5 / 3.0), rel=1e-11)
    assert found.coordinates["driver"] == pytest.approx(places + 2.0 * np.pi * turns, rel=1e-12)
    late = lw.run_designs(wheel, {"wheel.inertia": [0.5, 500.0]}, at_most=5.0)
    assert late.outcomes == ("turns", "late")
    assert np.isnan(late.rates["driver"]).tolist() == [False, True]
    assert late.time[1] == 5.0


SIXBAR = (
    gallery.content("watt_sixbar").decode()
    + "actuators:\n  motor: {kind: constant, on: crank, torque: 8 N·m}\n"
    + LOSS.replace("wheel", "crank").replace("0.1 N", "0.6 N")
)


@pytest.mark.parametrize("end", [{"duration": 0.7}, {"until": "steady"}])
def test_six_bars_against_runs_by_themselves(end: dict[str, str]) -> None:
    sixbar, masses = lw.loads(SIXBAR), [1.8, 2.2]
    found = lw.run_designs(sixbar, {"coupler.mass": masses}, tolerance=1e-11, **end)  # type: ignore[arg-type]
    assert found.ok.all()
    for number, mass in enumerate(masses):
        alone = lw.run(sixbar.with_dimensions({"coupler.mass": mass}), tolerance=1e-11, **end)  # type: ignore[arg-type]
        assert found.time[number] == pytest.approx(alone.end, rel=1e-8)
        q, w = alone.end_state["driver"]
        assert found.coordinates["driver"][number] == pytest.approx(q, rel=1e-8)
        assert found.rates["driver"][number] == pytest.approx(w, rel=1e-8)


@pytest.mark.parametrize("name", ["triad", "pinion_between_racks"])
def test_machines_against_runs_by_themselves(name: str) -> None:
    """A group without closed form; a load against a velocity that has no direction at rest."""
    _as_by_itself(name, 0.2)


@pytest.mark.rotating
@pytest.mark.parametrize(
    "name", ["change_point_fourbar", "excavator", "geared_fivebar", "planetary_two_inputs", "printing_press", "wedge"]
)
def test_other_machines_against_runs_by_themselves(name: str) -> None:
    _as_by_itself(name, 0.3)


def _as_by_itself(name: str, duration: float) -> None:
    machine = lw.load(f"gallery:{name}")
    address, value = next((a, v) for a, v in machine.dimensions().items() if a.endswith(".mass") and v > 0.0)
    found = lw.run_designs(machine, {address: [1.2 * value]}, duration=duration, tolerance=1e-10)
    assert found.ok.all() and not found.alone.any()
    alone = lw.run(machine.with_dimensions({address: 1.2 * value}), duration=duration)
    for driver, (q, w) in alone.end_state.items():
        assert found.coordinates[driver][0] == pytest.approx(q, rel=1e-8, abs=1e-8)
        assert found.rates[driver][0] == pytest.approx(w, rel=1e-8, abs=1e-8)


def test_designs_that_cannot_be_put_together() -> None:
    found = lw.run_designs(lw.loads(SIXBAR), {"bar_1.length": [0.12, 0.3]}, duration=0.05)
    assert found.outcomes == ("ended", "no_start")
    assert found.ok.tolist() == [True, False]
    for column in (found.rates["driver"], found.peaks["motor"], found.energy_residual):
        assert np.isnan(column).tolist() == [False, True]
    assert "does not start" in found.text()
    assert found.data()["outcomes"] == ["ended", "no_start"]


def test_stops_are_run_one_by_one() -> None:
    """A wheel turned into a stop stays there; a design that no run can have is refused with its reason."""
    text = WHEEL + "stops: {end: {of: wheel, at: 1 rad, side: above, restitution: 0}}\n"
    found = lw.run_designs(lw.loads(text), {"wheel.inertia": [0.5, 0.0]}, duration=2.0)
    assert found.alone.all()
    assert found.outcomes == ("ended", "refused")
    assert found.coordinates["driver"][0] == pytest.approx(1.0, abs=1e-9)
    assert "mass" in found.refusals[1]


def test_threads_change_nothing() -> None:
    wheel = lw.loads(WHEEL + LOSS)
    one, two = (lw.run_designs(wheel, COLUMNS, duration=1.0, threads=threads) for threads in (1, 2))
    assert np.array_equal(one.rates["driver"], two.rates["driver"])


def test_unknown_addresses_are_refused() -> None:
    with refused("study.no_dimension"):
        lw.run_designs(lw.loads(WHEEL), {"wheel.inertai": [1.0]})
