"""Loads of every kind in many designs at once: those of each design alone, with derivatives those of differences."""

import numpy as np
import pytest
from tests.invariants.loaded_presses import AT, BY_LIMITS, GEARED, LOADS, MODEL, OTHER_WAY, machine
from tests.refusals import refused

import linkwright as lw
from linkwright.analysis import metrics

BY = "rod.length"
OUTPUTS = ("driver.effort rms", "driver.effort max", "reaction A on rod mean")


@pytest.mark.parametrize("load", LOADS)
def test_sweeps_equal_single_designs(load: str) -> None:
    mechanism = machine(load)
    lengths = 0.7 * np.array([1.0, 1.013, 0.97])
    found = lw.sweep(mechanism, {BY: lengths}, outputs=OUTPUTS, steps=360, backend="numpy")
    for index, length in enumerate(lengths):
        forces = lw.solve_forces(mechanism.with_dimensions({BY: float(length)}))
        torque, force = forces.input_torque, np.hypot(*forces.reaction("A", on="rod").T)
        alone = [np.sqrt((torque**2).mean()), torque.max(), force.mean()]
        assert [found[each][index] for each in OUTPUTS] == pytest.approx(alone, rel=1e-12)


def test_an_expression_without_a_value_is_refused_alone_prepared_and_in_a_sweep() -> None:
    """The rod's steepest angle has the sine 0.25 m over its length: 3/2 of it is above 0.6 from 0.625 m down."""
    mechanism = lw.loads(MODEL.replace("LOAD", f"{AT}, magnitude: F0*sqrt(0.6 - 1.5*sin(rod))"))
    prepared = lw.prepare(mechanism, vary=[BY])
    lengths = np.array([0.7, 0.63, 0.6])
    swept = lw.sweep(mechanism, {BY: lengths}, outputs=[("driver.effort", "max")])
    assert swept.ok.tolist() == [True, True, False]
    for length in lengths[:2]:
        alone = lw.solve_forces(mechanism.with_dimensions({BY: length})).input_torque
        assert prepared.solve({BY: length}).input_torque == pytest.approx(alone, rel=1e-9, abs=1e-9)
    for solve in (prepared.solve, lambda changes: lw.solve_forces(mechanism.with_dimensions(changes))):
        with refused("loads.formula_fails", name="process"):
            solve({BY: 0.6})


@pytest.mark.parametrize("load", LOADS)
def test_gradients_are_those_of_differences_of_single_designs(load: str) -> None:
    """Of the positions, and of the cycle."""
    mechanism, step = machine(load), 1e-6
    around = [lw.solve_forces(mechanism.with_dimensions({BY: 0.7 + k * step})) for k in (-2, -1, 1, 2)]
    sampled = [float(np.sqrt((each.input_torque**2).mean())) for each in around]
    refined = [metrics(each, ["rms_input_torque"]).value("rms_input_torque") for each in around]
    for steps, values in ((360, sampled), (None, refined)):
        term = {"driver.effort rms": 1.0}
        objective = lw.objective(mechanism, term, vary=[BY], steps=steps, backend="numpy")
        value, gradient = objective(objective.start)
        difference = (values[0] - 8 * values[1] + 8 * values[2] - values[3]) / (12 * step)
        assert gradient[0] == pytest.approx(difference, rel=1e-6, abs=1e-7 * value)


@pytest.mark.rotating
@pytest.mark.parametrize("load", LOADS)
def test_design_numbers_equal_single_designs(load: str) -> None:
    """Exact between positions, the moving edges of parts of a stroke among them."""
    mechanism = machine(load)
    names = ["rms_input_torque", "peak_reaction"]
    found = lw.sweep(mechanism, {BY: np.array([0.71])}, outputs=names, backend="numpy")
    table = metrics(lw.solve_forces(mechanism.with_dimensions({BY: 0.71})))
    for name in names:
        assert found[name][0] == pytest.approx(table.value(name), rel=1e-11)


@pytest.mark.rotating
@pytest.mark.parametrize("load", OTHER_WAY)
def test_designs_driven_the_other_way_equal_single_ones(load: str) -> None:
    """Sums over positions, and metrics between them, of a crank that turns clockwise."""
    mechanism = lw.loads(MODEL.replace("LOAD", OTHER_WAY[load]).replace("120 rpm", "-120 rpm"))
    lengths = np.array([0.7, 0.712])
    names = ["rms_input_torque", "peak_reaction"]
    found = lw.sweep(mechanism, {BY: lengths}, outputs=[*OUTPUTS, *names], steps=120, backend="numpy")
    for k, length in enumerate(lengths):
        forces = lw.solve_forces(mechanism.with_dimensions({BY: float(length)}), steps=120)
        torque = forces.input_torque
        rms, largest = (found[each][k] for each in OUTPUTS[:2])
        assert (rms, largest) == pytest.approx((np.sqrt((torque**2).mean()), torque.max()), rel=1e-11)
        table = metrics(forces, names)
        for name in names:
            # a phase holds what is within 1e-9 of the cycle from its ends, one machine counts that, many do not
            assert found[name][k] == pytest.approx(table.value(name), rel=3e-8)


@pytest.mark.rotating
@pytest.mark.parametrize("load", [*BY_LIMITS, "input", "table"])
def test_cycles_of_three_turns_of_the_motor_go_side_by_side(load: str) -> None:
    """Where limits tell the phase, the motor's torque is a third of that of the crank turned directly."""
    mechanism = lw.loads(GEARED.replace("LOAD", LOADS[load]))
    direct = lw.loads(MODEL.replace("LOAD", LOADS[load]).replace("120 rpm", "-120 rpm"))
    lengths = np.array([0.7, 0.712])
    names = ["rms_input_torque", "peak_reaction A"]
    found = lw.sweep(mechanism, {BY: lengths}, outputs=[*OUTPUTS, *names], steps=360, backend="numpy")
    for k, length in enumerate(lengths):
        forces = lw.solve_forces(mechanism.with_dimensions({BY: float(length)}))
        rms = found[OUTPUTS[0]][k]
        assert rms == pytest.approx(np.sqrt((forces.input_torque**2).mean()), rel=1e-12)
        of_crank = metrics(lw.solve_forces(direct.with_dimensions({BY: float(length)})))
        for table, share in ((metrics(forces), 1.0), *([(of_crank, 3.0)] if load in BY_LIMITS else [])):
            torque, force = table.value("rms_input_torque"), table.value("peak_reaction", "A")
            assert share * found["rms_input_torque"][k] == pytest.approx(torque, rel=3e-8)
            assert found["peak_reaction A"][k] == pytest.approx(force, rel=3e-8)
    prepared = lw.prepare(mechanism, vary=[BY]).solve({BY: 0.712}).input_torque
    assert prepared == pytest.approx(forces.input_torque, rel=1e-11, abs=1e-9)
    objective, step = lw.objective(mechanism, {"driver.effort rms": 1.0}, vary=[BY]), 1e-6
    values, slopes = objective.many(0.7 + step * np.array([[0.0], [-2.0], [-1.0], [1.0], [2.0]]))
    assert slopes[0, 0] == pytest.approx(values[1:] @ [1, -8, 8, -1] / (12 * step), rel=1e-6, abs=1e-7 * values[0])


def test_the_true_speed_of_a_motor_whose_cycle_is_three_turns_is_that_of_its_crank() -> None:
    direct = MODEL.replace("120 rpm", "-120 rpm").replace("inertia: 0.01 kg", "inertia: 3 kg")
    geared = GEARED.replace("inertia: 0.01 kg", "inertia: 3 kg")
    load, names, lengths = LOADS["last share"], ["speed_fluctuation", "slowest_speed"], [0.7, 0.712]
    found = lw.sweep(lw.loads(geared.replace("LOAD", load)), {BY: lengths}, outputs=names)
    alone = lw.sweep(lw.loads(direct.replace("LOAD", load)), {BY: lengths}, outputs=names)
    assert found["speed_fluctuation"] == pytest.approx(alone["speed_fluctuation"], rel=1e-8)
    assert found["slowest_speed"] == pytest.approx(3.0 * alone["slowest_speed"], rel=1e-8)


def test_a_design_whose_load_has_no_value_is_told() -> None:
    """The table ends where the longer rod brings the piston."""
    mechanism = machine("table of output")
    found = lw.sweep(mechanism, {BY: [0.7, 0.85, 0.71]}, outputs=["driver.effort max"])
    assert found.ok.tolist() == [True, False, True]
    why = found.unloaded[1]
    assert why.values["name"] == "process"
    assert why.values["cause"].code == "loads.table_too_short"
    assert np.isnan(found["driver.effort max"]).tolist() == [False, True, False]


@pytest.mark.rotating
@pytest.mark.parametrize("output", ["driver.effort max", "driver.effort rms"])
@pytest.mark.parametrize("size", ["ramp: [100 N, 900 N]", "magnitude: 800 N", "magnitude: F0*(1 + sin(rod))"])
@pytest.mark.parametrize("part", ["first: 401 mm", "last: 401 mm", "free: 200.2 mm"])
def test_a_part_longer_than_the_stroke_of_a_design_is_told(part: str, size: str, output: str) -> None:
    """The stroke is 401.1 mm, of the shorter crank 381.1 mm; no number stands for a load that does not exist."""
    load = f"{AT}, {size}, phase: {{of: guide, from: max, to: min, {part}}}"
    mechanism = lw.loads(MODEL.replace("LOAD", load))
    found = lw.sweep(mechanism, {"crank.length": [0.2, 0.19]}, outputs=[output])
    assert found.ok.tolist() == [True, False]
    assert found.unloaded[1].values["cause"].code == "loads.part_too_long" and np.isnan(found[output][1])


@pytest.mark.parametrize("load", ["last share", "table", "torsion spring"])
def test_prepared_machines_equal_single_designs(load: str) -> None:
    mechanism = machine(load)
    prepared = lw.prepare(mechanism, vary=[BY])
    for length in (0.7, 0.72):
        one, other = prepared.solve({BY: length}), lw.solve_forces(mechanism.with_dimensions({BY: length}))
        assert one.input_torque == pytest.approx(other.input_torque, rel=1e-11, abs=1e-9)
        assert one.load("process").moment == pytest.approx(other.load("process").moment, rel=1e-11, abs=1e-9)
        assert one.shaking_force == pytest.approx(other.shaking_force, rel=1e-11, abs=1e-9)


LEFTWARD = """
format: 1
name: slider-crank with a rod that points to the left
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.1 m}
  rod: {points: {A: [0 m, 0 m], B: [-0.4 m, 0 m]}}
  piston: {points: [B]}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B}}
drawing: {A: [0.1 m, 0 m], B: [0.5 m, 0 m]}
driver: {turn: crank, about: O, speed: 20 rad/s}
loads: {twist: {kind: torsion_spring, links: [frame, rod], stiffness: 5 N·m/rad, free_angle: 90 deg}}
"""


def test_a_spring_is_wound_from_its_free_angle_the_way_of_the_drawing() -> None:
    """The rod stays near 180 deg, its spring is free at 90: power of the crank k (φ - π/2) φ'."""
    angle, lengths = np.arange(24) * np.pi / 12, np.array([0.1, 0.09])
    lean = np.arcsin(lengths[:, None] / 0.4 * np.sin(angle))
    ratio = -lengths[:, None] / 0.4 * np.cos(angle) / np.cos(lean)
    torque = 5.0 * (0.5 * np.pi - lean) * ratio
    expected = np.sqrt(np.mean(torque**2, axis=1))
    machine = lw.loads(LEFTWARD)
    found = lw.sweep(machine, {"crank.length": lengths}, outputs=["input_torque rms"], steps=24)
    assert found["input_torque rms"] == pytest.approx(expected, rel=1e-12)
    alone = lw.solve_forces(machine, steps=24).input_torque
    assert np.abs(alone) == pytest.approx(np.abs(torque[0]), abs=1e-12)
    slope = lw.sensitivity(machine, of=["input_torque rms"], by=["loads.twist.stiffness"], steps=24)
    assert slope.gradient("input_torque rms") == pytest.approx([expected[0] / 5.0], rel=1e-12)
