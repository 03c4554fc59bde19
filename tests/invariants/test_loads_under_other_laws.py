"""Loads of many designs at once under laws and over cycles of every kind: those of each design alone."""

import numpy as np
import pytest
from tests.invariants.loaded_sliders import (
    BETWEEN_LIMITS,
    LOADS,
    ON_THE_PLATE,
    ONE_WAY,
    SEVERAL_TURNS,
    SLIDER,
    TO_AND_FRO,
    TWO_DRIVERS,
    UNEVEN,
    machine,
    pushed_triad,
)
from tests.refusals import agrees, refused

import linkwright as lw


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


@pytest.mark.rotating
@pytest.mark.parametrize("law", [TO_AND_FRO, UNEVEN, SEVERAL_TURNS])
@pytest.mark.parametrize("load", LOADS)
def test_designs_under_laws_of_every_kind_are_those_alone(load: str, law: str) -> None:
    compare(machine(law, LOADS[load]), "rod.length", "driver")


@pytest.mark.rotating
@pytest.mark.parametrize("law", ONE_WAY)
@pytest.mark.parametrize("load", BETWEEN_LIMITS)
def test_loads_between_limits_of_designs_under_laws_are_those_alone_with_gradients(load: str, law: str) -> None:
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


def test_designs_of_two_drivers_are_those_alone() -> None:
    for driver in ("first", "second"):
        compare(lw.loads(TWO_DRIVERS), "arm.length", driver)


@pytest.mark.rotating
@pytest.mark.parametrize("load", ON_THE_PLATE)
def test_designs_without_closed_form_take_their_loads(load: str) -> None:
    mechanism = pushed_triad(load)
    compare(mechanism, "plate.R.x", "driver")


@pytest.mark.parametrize(
    ("law", "load", "address"),
    [
        (UNEVEN, LOADS["interval"], "loads.work.phase.input.1"),
        (SEVERAL_TURNS, "magnitude: 3 N, phase: {of: B.x, from: max, to: min}", "rod.length"),
        (SEVERAL_TURNS, "ramp: [3 N, 18 N], phase: {input: [200 deg, 30 deg]}", "rod.length"),
    ],
)
def test_what_moves_with_the_cycle_is_that_of_single_designs_as_well(law: str, load: str, address: str) -> None:
    compare(machine(law, load), address, "driver")


@pytest.mark.parametrize("law", [UNEVEN, SEVERAL_TURNS, "speed: -10 rad/s"])
def test_an_interval_longer_than_a_turn_is_refused_of_many_designs_too(law: str) -> None:
    mechanism = machine(law, "magnitude: 5 N, phase: {input: [0 deg, 720 deg]}")
    with refused("loads.phase_too_long", name="work", start="0°", end="720°"):
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
    why = found.unloaded[1].values["cause"]
    agrees(why.values, {"start": "30°", "end": "395°"})
    assert why.code == "loads.phase_too_long"
    objective = lw.objective(mechanism, output, vary=[address], steps=90)
    assert np.isnan(objective.many(ends[:, None])[0]).tolist() == [False, True, False]
    prepared = lw.prepare(mechanism, vary=[address], steps=90)
    with refused("loads.phase_too_long", name="work", start="30°", end="395°"):
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


SWINGING = """
format: 1
name: crank that swings over an interval
frame: {points: {O: [0 m, 0 m]}}
links: {crank: {points: [O, A], length: 0.3 m, mass: 1 kg, inertia: 0.02 kg·m²}}
driver: {turn: crank, about: O, position: "1.8 rad + 3 rad*sin(2*pi*t/(0.5 s))"}
cycle: {duration: 0.5 s}
gravity: [0, -9.81 m/s²]
loads: {work: {kind: torque, on: crank, ramp: [5 N·m, -9 N·m], phase: {input: [120 deg, 395 deg]}}}
"""


def test_an_input_that_swings_enters_an_interval_of_its_turn_from_both_sides() -> None:
    """Means of samples, which miss each jump of the torque by one step of 40 000."""
    machine = lw.loads(SWINGING)
    sampled = lw.solve_forces(machine, steps=40_000).input_torque
    table = lw.metrics(lw.solve_forces(machine), ["rms_input_torque", "peak_input_torque"])
    assert table.value("rms_input_torque") == pytest.approx(float(np.sqrt(np.mean(sampled**2))), rel=1e-4)
    assert table.value("peak_input_torque") == pytest.approx(float(np.abs(sampled).max()), rel=1e-6)
    objective = lw.objective(machine, "rms_input_torque", vary=["loads.work.phase.input.1"])
    beside = [objective(objective.start + k * 1e-3)[0] for k in (-2, -1, 1, 2)]
    expected = (beside[0] - 8.0 * beside[1] + 8.0 * beside[2] - beside[3]) / 12e-3
    assert objective(objective.start)[1][0] == pytest.approx(expected, rel=1e-7)
