"""Loads of every kind in many designs at once: those of each design alone, with derivatives those of differences."""

import numpy as np
import pytest

import linkwright as lw
from linkwright.core.outputs import Output
from linkwright.cycle_programs.limit_stages import constants, limit_stages, near_limits
from linkwright.cycle_programs.metric_cycle import metric_cycle
from linkwright.cycle_programs.traced_outputs import Traced
from linkwright.engine.cycle import CycleProgram
from linkwright.engine.numpy_backend import NumpyProgram
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.solve import MotionRun
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinetostatics.run import forces_at_once, run_forces
from linkwright.metrics import metrics
from linkwright.metrics.summary import wanted
from linkwright.study.sweep_run import Manner, SweepRun

MODEL = """
format: 1
name: press
parameters: {F0: 900 N, k: 3000 N/m, unused: 1 N}
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.2 m, mass: 1 kg, inertia: 0.01 kg·m²}
  rod: {points: [A, B], length: 0.7 m, mass: 2 kg, inertia: 0.05 kg·m²}
  piston: {points: [B], mass: 3 kg}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B, offset: 0.05 m}}
driver: {turn: crank, about: O, speed: 120 rpm, start: 20 deg}
loads:
  process: {LOAD}
  weight_of_what_is_pressed: {kind: force, on: piston, at: B, direction: -90 deg, magnitude: F0 + k*(0.1 m)}
"""
AT = "kind: force, on: piston, at: B, direction: 180 deg"
LOADS = {
    "while moving": f"{AT}, magnitude: 800 N, phase: {{moving: guide, direction: increasing}}",
    "ramp while moving": f"{AT}, ramp: [100 N, 900 N], phase: {{moving: guide, direction: decreasing}}",
    "between limits": f"{AT}, magnitude: F0, phase: {{of: guide, from: min, to: max}}",
    "last share": f"{AT}, magnitude: 800 N, phase: {{of: guide, from: min, to: max, last: 0.2}}",
    "first way": f"{AT}, ramp: [100 N, 900 N], phase: {{of: guide, from: max, to: min, first: 60 mm}}",
    "whole share": f"{AT}, ramp: [100 N, 900 N], phase: {{of: guide, from: max, to: min, first: 1}}",
    "free ends": f"{AT}, magnitude: 800 N, phase: {{of: guide, from: min, to: max, free: [0.05, 30 mm]}}",
    "free at its end": f"{AT}, magnitude: 800 N, phase: {{of: guide, from: min, to: max, free: [0, 30 mm]}}",
    "input": f"{AT}, magnitude: 800 N, phase: {{input: [150 deg, 30 deg]}}",
    "displacement": f"{AT}, magnitude: F0 + k*guide",
    "angle": f"{AT}, magnitude: F0*(1 + sin(rod)) + 100 N*cos(3*input)",
    "time": f"{AT}, magnitude: F0*t/(1 s)",
    "table": f"{AT}, table: {{over: input, x: [0 deg, 90 deg, 200 deg, 360 deg], y: [0 N, 500 N, 900 N, 0 N]}}",
    "table from within the turn": f"{AT}, table: {{over: input, x: [30 deg, 90 deg, 200 deg, 390 deg], "
    "y: [0 N, 500 N, 900 N, 0 N]}",
    "short ramp": f"{AT}, ramp: [100 N, 900 N], phase: {{input: [-30 deg, 20 deg]}}",
    "table of output": f"{AT}, table: {{over: guide, x: [300 mm, 600 mm, 700 mm, 1 m], y: [0 N, 500 N, 900 N, 0 N]}}",
    "torsion spring": "kind: torsion_spring, links: [frame, rod], stiffness: 30 N·m/rad, free_angle: 10 deg",
}
BY = "rod.length"
OUTPUTS = ("driver.effort rms", "driver.effort max", "reaction A on rod mean")


def machine(load: str) -> lw.Mechanism:
    return lw.loads(MODEL.replace("LOAD", LOADS[load]))


@pytest.mark.parametrize("load", LOADS)
def test_sweeps_equal_single_designs(load: str) -> None:
    mechanism = machine(load)
    lengths = 0.7 * np.array([1.0, 1.013, 0.97])
    run = SweepRun(
        mechanism, {BY: lengths}, wanted(OUTPUTS), over_cycle(mechanism, 360), Manner(backend="numpy")
    )
    assert run._loaded is not None and not len(run._loaded.evaluate({BY: lengths}, 1, "numpy")[1])
    _, _, found = run.swept()
    for index, length in enumerate(lengths):
        forces = lw.solve_forces(mechanism.with_dimensions({BY: float(length)}))
        torque, force = forces.input_torque, np.hypot(*forces.reaction("A", on="rod").T)
        alone = [np.sqrt((torque**2).mean()), torque.max(), force.mean()]
        for summary, value in zip(wanted(OUTPUTS), alone, strict=True):
            assert found[summary][index] == pytest.approx(value, rel=1e-12), summary.name


@pytest.mark.parametrize("load", LOADS)
def test_loads_traced_with_the_motion_are_those_found_from_it(load: str) -> None:
    """One evaluation of motion, limits, loads and forces, beside magnitudes found from the motion on arrays."""
    mechanism = machine(load)
    run = MotionRun(MotionSolver(mechanism), over_cycle(mechanism, 360))
    together, apart = forces_at_once(run, False), run_forces(lw.solve_motion(mechanism), False)
    assert together is not None
    for name, expected in apart.fields.items():
        assert together.fields[name] == pytest.approx(expected, rel=1e-13, abs=1e-13 * np.abs(expected).max())
    torque = apart.input_torque
    assert np.abs(together.input_torque - torque).max() <= 1e-13 * np.abs(torque).max()


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
        with pytest.raises(lw.LinkwrightError, match="has no finite real value at input = "):
            solve({BY: 0.6})


@pytest.mark.parametrize("load", LOADS)
def test_gradients_are_those_of_differences_of_single_designs(load: str) -> None:
    mechanism = machine(load)
    objective = lw.objective(mechanism, {"driver.effort rms": 1.0}, vary=[BY], backend="numpy")
    value, gradient = objective(objective.start)
    step, around = 1e-6, []
    for k in (-2, -1, 1, 2):
        torque = lw.solve_forces(mechanism.with_dimensions({BY: 0.7 + k * step})).input_torque
        around.append(float(np.sqrt((torque**2).mean())))
    difference = (around[0] - 8 * around[1] + 8 * around[2] - around[3]) / (12 * step)
    assert gradient[0] == pytest.approx(difference, rel=1e-6, abs=1e-7 * value)


@pytest.mark.parametrize("load", [load for load in LOADS if load != "table of output"])
def test_design_numbers_equal_single_designs(load: str) -> None:
    """Exact between positions, the moving edges of parts of a stroke among them."""
    mechanism = machine(load)
    cycle = metric_cycle(mechanism, [BY], ["rms_input_torque", "peak_reaction"])
    assert cycle is not None
    found = cycle.evaluate({BY: np.array([0.71])}, backend="numpy")
    assert found.certain.all()
    table = metrics(lw.solve_forces(mechanism.with_dimensions({BY: 0.71})))
    for name in ("rms_input_torque", "peak_reaction"):
        assert found.values[name][0] == pytest.approx(table.value(name), rel=1e-11)


OTHER_WAY = {
    **{
        name: LOADS[name]
        for name in ("while moving", "ramp while moving", "last share", "free ends", "input", "table")
    },
    "limits of an angle": f"{AT}, magnitude: 800 N, phase: {{of: rod, from: max, to: min}}",
    "last degrees": f"{AT}, ramp: [100 N, 900 N], phase: {{of: rod, from: min, to: max, last: 4 deg}}",
    "limits across": f"{AT}, magnitude: 800 N, phase: {{of: rod.A.y, from: min, to: max}}",
    "first way along": f"{AT}, magnitude: 800 N, phase: {{of: rod.B.x, from: min, to: max, first: 90 mm}}",
}


@pytest.mark.parametrize("load", OTHER_WAY)
def test_designs_driven_the_other_way_equal_single_ones(load: str) -> None:
    """Sums over positions, and design numbers between them, of a crank that turns clockwise."""
    mechanism = lw.loads(MODEL.replace("LOAD", OTHER_WAY[load]).replace("120 rpm", "-120 rpm"))
    lengths = np.array([0.7, 0.712])
    run = SweepRun(
        mechanism, {BY: lengths}, wanted(OUTPUTS), over_cycle(mechanism, 120), Manner(backend="numpy")
    )
    assert run._loaded is not None
    _, _, found = run.swept()
    cycle = metric_cycle(mechanism, [BY], ["rms_input_torque", "peak_reaction"])
    assert cycle is not None
    numbers = cycle.evaluate({BY: lengths}, backend="numpy")
    assert numbers.certain.all()
    for k, length in enumerate(lengths):
        forces = lw.solve_forces(mechanism.with_dimensions({BY: float(length)}), steps=120)
        torque = forces.input_torque
        rms, largest, _ = (found[summary][k] for summary in wanted(OUTPUTS))
        assert (rms, largest) == pytest.approx((np.sqrt((torque**2).mean()), torque.max()), rel=1e-11)
        table = metrics(forces, ["rms_input_torque", "peak_reaction"])
        for name in ("rms_input_torque", "peak_reaction"):
            # a phase holds what is within 1e-9 of the cycle from its ends, one machine counts that, many do not
            assert numbers.values[name][k] == pytest.approx(table.value(name), rel=3e-8)


#: A motor without mass that turns the crank through wheels, three times as fast and the other way.
GEARED = (
    MODEL.replace("frame: {points: {", "frame: {points: {M: [-0.4 m, 0 m], ")
    .replace("links:\n", "links:\n  motor: {points: [M]}\n")
    .replace("joints: {", "joints: {gears: {kind: gear, links: [motor, crank], teeth: [20, 60]}, ")
    .replace("{turn: crank, about: O, speed: 120 rpm", "{turn: motor, about: M, speed: 360 rpm")
)
BY_LIMITS = ("ramp while moving", "last share", "free ends")


@pytest.mark.parametrize("load", [*BY_LIMITS, "input", "table"])
def test_cycles_of_three_turns_of_the_motor_go_side_by_side(load: str) -> None:
    """Where limits tell the phase, the motor's torque is a third of that of the crank turned directly."""
    mechanism = lw.loads(GEARED.replace("LOAD", LOADS[load]))
    direct = lw.loads(MODEL.replace("LOAD", LOADS[load]).replace("120 rpm", "-120 rpm"))
    lengths = np.array([0.7, 0.712])
    run = SweepRun(
        mechanism, {BY: lengths}, wanted(OUTPUTS), over_cycle(mechanism, 360), Manner(backend="numpy")
    )
    assert run._loaded is not None and not len(run._loaded.evaluate({BY: lengths}, 1, "numpy")[1])
    _, _, found = run.swept()
    cycle = metric_cycle(mechanism, [BY], ["rms_input_torque", "peak_reaction A"])
    assert cycle is not None and cycle.gauss.turns == 3
    numbers = cycle.evaluate({BY: lengths}, backend="numpy")
    assert numbers.certain.all()
    for k, length in enumerate(lengths):
        forces = lw.solve_forces(mechanism.with_dimensions({BY: float(length)}))
        rms = found[wanted(OUTPUTS)[0]][k]
        assert rms == pytest.approx(np.sqrt((forces.input_torque**2).mean()), rel=1e-12)
        of_crank = metrics(lw.solve_forces(direct.with_dimensions({BY: float(length)})))
        for table, share in ((metrics(forces), 1.0), *([(of_crank, 3.0)] if load in BY_LIMITS else [])):
            torque, force = table.value("rms_input_torque"), table.value("peak_reaction", "A")
            assert share * numbers.values["rms_input_torque"][k] == pytest.approx(torque, rel=3e-8)
            assert numbers.values["peak_reaction A"][k] == pytest.approx(force, rel=3e-8)
    prepared = lw.prepare(mechanism, vary=[BY]).solve({BY: 0.712}).input_torque
    assert prepared == pytest.approx(forces.input_torque, rel=1e-11, abs=1e-9)
    objective, step = lw.objective(mechanism, {"driver.effort rms": 1.0}, vary=[BY]), 1e-6
    values, slopes = objective.many(0.7 + step * np.array([[0.0], [-2.0], [-1.0], [1.0], [2.0]]))
    assert slopes[0, 0] == pytest.approx(
        values[1:] @ [1, -8, 8, -1] / (12 * step), rel=1e-6, abs=1e-7 * values[0]
    )


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
    assert "process" in found.unloaded[1] and "300 mm" not in found.unloaded[1]
    assert np.isnan(found["driver.effort max"]).tolist() == [False, True, False]


@pytest.mark.parametrize("output", ["driver.effort max", "driver.effort rms"])
@pytest.mark.parametrize("size", ["ramp: [100 N, 900 N]", "magnitude: 800 N", "magnitude: F0*(1 + sin(rod))"])
@pytest.mark.parametrize("part", ["first: 401 mm", "last: 401 mm", "free: 200.2 mm"])
def test_a_part_longer_than_the_stroke_of_a_design_is_told(part: str, size: str, output: str) -> None:
    """The stroke is 401.1 mm, of the shorter crank 381.1 mm; no number stands for a load that does not exist."""
    load = f"{AT}, {size}, phase: {{of: guide, from: max, to: min, {part}}}"
    mechanism = lw.loads(MODEL.replace("LOAD", load))
    found = lw.sweep(mechanism, {"crank.length": [0.2, 0.19]}, outputs=[output])
    assert found.ok.tolist() == [True, False]
    assert "too much of the stroke is named" in found.unloaded[1] and np.isnan(found[output][1])


@pytest.mark.parametrize("load", ["last share", "table", "torsion spring"])
def test_prepared_machines_equal_single_designs(load: str) -> None:
    mechanism = machine(load)
    prepared = lw.prepare(mechanism, vary=[BY])
    for length in (0.7, 0.72):
        one, other = prepared.solve({BY: length}), lw.solve_forces(mechanism.with_dimensions({BY: length}))
        assert one.input_torque == pytest.approx(other.input_torque, rel=1e-11, abs=1e-9)
        assert one.load("process").moment == pytest.approx(other.load("process").moment, rel=1e-11, abs=1e-9)
        assert one.shaking_force == pytest.approx(other.shaking_force, rel=1e-11, abs=1e-9)


def test_outputs_that_turn_more_than_twice_are_doubted() -> None:
    """Points of a coupler plane, whose paths have two or more limits across: beside turns counted point by point."""
    fourbar = lw.load("gallery:crank_rocker")
    x, y = (each.ravel() for each in np.meshgrid(np.linspace(-3.5, 0.5, 7), np.linspace(-9.0, 3.0, 7)))
    columns = {"coupler.P.x": x, "coupler.P.y": y}
    traced = Traced(fourbar, columns, over_cycle(fourbar, 360))
    output = Output("position", "coupler.P", "y")
    cycle = CycleProgram(tuple(limit_stages(traced, [output])))
    known = {**traced.solver.nominal.parameters, **constants(traced)}
    table = np.stack([np.broadcast_to(columns.get(a, known[a]), len(x)) for a in cycle.dimensions], axis=1)
    doubted = cycle.evaluate(table, traced.positions.arrays)[f"doubt:{output}"] > 0.0
    turns = []
    for k in range(len(x)):
        design = fourbar.with_dimensions({a: float(c[k]) for a, c in columns.items()})
        rising = lw.solve_motion(design, steps=360).point("coupler.P").velocity[:, 1] > 0.0
        turns.append(int((rising != np.roll(rising, 1)).sum()))
    assert doubted.tolist() == [count > 2 for count in turns]
    assert {2, 4} <= set(turns)


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


def test_limits_are_found_from_inputs_near_them_at_any_speed() -> None:
    """Crank and rod in one line: sin θ = e/(l + r), and e/(l - r) half a turn on; the pin at √((l ± r)² - e²)."""
    machine = lw.loads(MODEL.split("loads:", maxsplit=1)[0])
    assert machine.dimension("driver.speed") == pytest.approx(4 * np.pi)
    near = np.array([np.arcsin(0.05 / 0.9), np.pi + np.arcsin(0.05 / 0.5)])
    traced = Traced(machine, {}, over_cycle(machine, 36))
    output = Output("position", "piston.B", "x")
    program = near_limits(traced, [output], [output])
    known = traced.solver.nominal.parameters
    found = NumpyProgram(program).run(
        [known[name] for name in program.parameters],
        {f"near:{output}": near + np.array([0.03, -0.04])},
        length=2,
    )
    rows = dict(zip(program.output_names, found, strict=True))
    assert rows[f"limit:{output}"] == pytest.approx(near, abs=1e-12)
    assert (rows[f"moved:{output}"] < 1e-12).all()
    assert np.abs(rows[f"value:{output}"]) == pytest.approx(
        np.sqrt([0.81 - 0.0025, 0.25 - 0.0025]), rel=1e-12
    )
