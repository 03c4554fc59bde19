"""Loads of many designs at once under laws and over cycles of every kind: those of each design alone."""

from importlib.resources import files

import numpy as np
import pytest
from tests.features.test_load_magnitudes import SLIDER

import linkwright as lw
from linkwright.cycle_programs.one_by_one import OneByOne

GALLERY = files("linkwright.gallery")
TO_AND_FRO, UNEVEN, SEVERAL_TURNS = (
    'position: "2 rad*sin(3*t/(1 s))"',
    'position: "3 rad*t/(1 s) + 0.3 rad*sin(t/(1 s))"',
    "speed: 10 rad/s",
)
LOADS = {
    "interval": "ramp: [3 N, 18 N], phase: {input: [30 deg, 200 deg]}",
    "expression": 'magnitude: "3 N*sin(input) + 2 N/m*B.x + 1 N*t/(1 s) + 2 N*rod/rad"',
    "one way": "magnitude: 7 N, phase: {moving: B.x, direction: decreasing}",
    "table over the input": "table: {over: input, x: [0 deg, 90 deg, 360 deg], y: [1 N, 9 N, 1 N]}",
    "table over the time": "table: {over: time, x: [0 s, 1 s, 4 s], y: [1 N, 9 N, 1 N]}",
    "table over an output": "table: {over: cylinder, x: [1 m, 3 m, 4.5 m], y: [1 N, 9 N, 1 N]}",
    "smooth table over an output": "table: {over: cylinder, x: [1 m, 2.4 m, 3 m, 4.5 m], y: [1 N, 2 N, 9 N, 1 N],"
    " interpolation: cubic}",
    "periodic table over the input": "table: {over: input, x: [0 deg, 90 deg, 200 deg, 360 deg],"
    " y: [1 N, 9 N, 2 N, 1 N], interpolation: periodic}",
}
#: The rod's angle goes once from its smallest value to its largest one; in several turns it does so in every turn.
ONE_WAY = (UNEVEN, SEVERAL_TURNS)
BETWEEN_LIMITS = {
    "stroke": "magnitude: 7 N, phase: {of: rod, from: min, to: max}",
    "ramp": "ramp: [3 N, 18 N], phase: {of: rod, from: min, to: max}",
    "ramp of a velocity": "ramp: [3 N, 18 N], phase: {moving: rod, direction: increasing}",
    "part of a stroke": "magnitude: 7 N, phase: {of: rod, from: min, to: max, first: 10 deg}",
}
TWO_DRIVERS = """
format: 1
name: five-bar with two cranks
frame: {points: {O: [0 m, 0 m], Q: [2 m, 0 m]}}
links:
  left: {points: [O, A], length: 1 m}
  right: {points: [Q, B], length: 0.8 m}
  rod: {points: [A, P], length: 3 m}
  arm: {points: [B, P], length: 2.5 m}
assembly: {P: left}
drivers:
  first: {turn: left, about: O, speed: 10 rad/s}
  second: {turn: right, about: Q, speed: -20 rad/s}
loads:
  work: {kind: force, on: rod, at: P, direction: 0 deg, magnitude: "3 N*sin(input) + 2 N/m*P.y + 1 N*rod/rad"}
"""


def machine(law: str, load: str) -> lw.Mechanism:
    text = SLIDER.replace("loads:", "cycle: {duration: 1.5 s}\nloads:").replace("speed: SPEED", law)
    return lw.loads(text.replace("LOAD", f"{{kind: force, on: piston, at: B, direction: 0 deg, {load}}}"))


def compare(mechanism: lw.Mechanism, address: str, driver: str) -> None:
    values = mechanism.dimension(address) * np.array([1.0, 1.02, 0.97])
    found = lw.sweep(mechanism, {address: values}, outputs=[f"{driver}.effort rms"], steps=90)
    assert found.ok.all()
    for k, value in enumerate(values):
        alone = lw.solve_forces(mechanism.with_dimensions({address: float(value)}), steps=90)
        effort = alone.driver_effort(driver)
        assert np.ptp(effort) > 0.1
        rms = np.sqrt(np.mean(effort**2))
        assert found[f"{driver}.effort", "rms"][k] == pytest.approx(rms, rel=1e-12)


@pytest.mark.parametrize("law", [TO_AND_FRO, UNEVEN, SEVERAL_TURNS])
@pytest.mark.parametrize("load", LOADS)
def test_designs_under_laws_of_every_kind_go_at_once(
    load: str, law: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(OneByOne, "rows", lambda *_, **__: pytest.fail("found one by one"))
    compare(machine(law, LOADS[load]), "rod.length", "driver")


@pytest.mark.parametrize("law", ONE_WAY)
@pytest.mark.parametrize("load", BETWEEN_LIMITS)
def test_loads_between_limits_of_designs_under_laws_go_at_once_with_gradients(
    load: str, law: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(OneByOne, "rows", lambda *_, **__: pytest.fail("found one by one"))
    mechanism = machine(law, BETWEEN_LIMITS[load])
    compare(mechanism, "rod.length", "driver")
    objective = lw.objective(mechanism, "input_torque rms", vary=["rod.length"], steps=90)
    value, (slope,) = objective(objective.start)
    size = 1e-5 * mechanism.dimension("rod.length")
    around = [
        lw.solve_forces(
            mechanism.with_dimensions({"rod.length": mechanism.dimension("rod.length") + shift}), steps=90
        ).input_torque
        for shift in (-size, 0.0, size)
    ]
    low, same, high = (float(np.sqrt(np.mean(torque**2))) for torque in around)
    assert value == pytest.approx(same, rel=1e-12)
    assert slope == pytest.approx((high - low) / (2.0 * size), rel=1e-6)
    found = lw.sensitivity(mechanism, of=["input_torque rms"], by=["rod.length"], steps=90)
    assert found.gradient("input_torque rms") == pytest.approx([slope], rel=1e-11)


def test_designs_of_two_drivers_go_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(OneByOne, "rows", lambda *_, **__: pytest.fail("found one by one"))
    for driver in ("first", "second"):
        compare(lw.loads(TWO_DRIVERS), "arm.length", driver)


@pytest.mark.parametrize(
    "load",
    [
        'at: R, direction: 30 deg, magnitude: "20 N + 400 N/m*R.x + 9 N*sin(plate)"',
        "at: R, direction: 30 deg, ramp: [40 N, 10 N], phase: {input: [330 deg, 130 deg]}",
        "at: R, direction: 30 deg, table: {over: input, x: [0 deg, 90 deg, 360 deg], y: [1 N, 30 N, 1 N]}",
        "at: R, direction: 30 deg, table: {over: time, x: [0 s, 0.2 s, 1 s], y: [1 N, 30 N, 8 N]}",
        "at: R, opposes: velocity, magnitude: 30 N",
        "at: R, direction: 30 deg, magnitude: 30 N, phase: {moving: R.x, direction: increasing}",
    ],
)
def test_designs_without_closed_form_take_their_loads_at_once(
    load: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = GALLERY.joinpath("triad.yaml").read_text(encoding="utf-8")
    mechanism = lw.loads(
        text.replace("gravity:", f"loads: {{work: {{kind: force, on: plate, {load}}}}}\ngravity:")
    )
    monkeypatch.setattr(OneByOne, "rows", lambda *_, **__: pytest.fail("found one by one"))
    compare(mechanism, "plate.R.x", "driver")


@pytest.mark.parametrize(
    ("law", "load", "address"),
    [
        (UNEVEN, LOADS["interval"], "loads.work.phase.input.1"),
        (SEVERAL_TURNS, "magnitude: 3 N, phase: {of: B.x, from: max, to: min}", "rod.length"),
        (SEVERAL_TURNS, "ramp: [3 N, 18 N], phase: {input: [200 deg, 30 deg]}", "rod.length"),
    ],
)
def test_what_moves_with_the_cycle_is_that_of_single_designs_as_well(
    law: str, load: str, address: str
) -> None:
    compare(machine(law, load), address, "driver")


@pytest.mark.parametrize("law", [UNEVEN, SEVERAL_TURNS, "speed: -10 rad/s"])
def test_an_interval_longer_than_a_turn_is_refused_of_many_designs_too(law: str) -> None:
    mechanism = machine(law, "magnitude: 5 N, phase: {input: [0 deg, 720 deg]}")
    with pytest.raises(lw.LinkwrightError, match="from 0° to 720° is longer than one turn"):
        lw.prepare(mechanism, vary=["rod.length"], steps=90).solve({"rod.length": 3.1})
    found = lw.sweep(mechanism, {"rod.length": [3.0, 3.1]}, outputs=["input_torque rms"], steps=90)
    assert not found.ok.any()
    assert np.isnan(found["input_torque", "rms"]).all()


@pytest.mark.parametrize("output", ["input_torque rms", "rms_input_torque"])
def test_designs_whose_own_interval_is_longer_than_a_turn_are_refused(output: str) -> None:
    load = f"{{kind: force, on: piston, at: B, direction: 0 deg, {LOADS['interval']}}}"
    mechanism = lw.loads(SLIDER.replace("SPEED", "10 rad/s").replace("LOAD", load))
    address = "loads.work.phase.input.1"
    ends = np.radians([200.0, 395.0, 389.0])
    found = lw.sweep(mechanism, {address: ends}, outputs=[output], steps=90)
    assert found.ok.tolist() == [True, False, True]
    assert "from 30° to 395° is longer than one turn" in found.unloaded[1]
    objective = lw.objective(mechanism, output, vary=[address], steps=90)
    assert np.isnan(objective.many(ends[:, None])[0]).tolist() == [False, True, False]
    prepared = lw.prepare(mechanism, vary=[address], steps=90)
    with pytest.raises(lw.LinkwrightError, match="from 30° to 395° is longer than one turn"):
        prepared.solve({address: ends[1]})


@pytest.mark.parametrize(("law", "load"), [(UNEVEN, "expression"), (SEVERAL_TURNS, "one way")])
def test_an_objective_under_any_law_has_its_gradient(law: str, load: str) -> None:
    """Central differences of designs solved alone."""
    mechanism = machine(law, LOADS[load])
    objective = lw.objective(mechanism, "input_torque rms", vary=["rod.length", "crank.length"], steps=90)
    value, gradient = objective(objective.start)

    def alone(address: str, factor: float) -> float:
        changed = mechanism.with_dimensions({address: factor * mechanism.dimension(address)})
        return float(np.sqrt(np.mean(lw.solve_forces(changed, steps=90).input_torque ** 2)))

    assert value == pytest.approx(alone("rod.length", 1.0), rel=1e-12)
    for address, slope in zip(("rod.length", "crank.length"), gradient, strict=True):
        size = 2e-5 * mechanism.dimension(address)
        difference = (alone(address, 1.0 + 1e-5) - alone(address, 1.0 - 1e-5)) / size
        assert slope == pytest.approx(difference, rel=1e-7)
