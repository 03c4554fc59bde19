"""Paths of groups without closed form, of many designs at once, against every machine solved alone."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.invariants.triad_behind_cam import TEXT
from tests.reference.geared_mechanisms import geared_case
from tests.store import machine as stored
from tests.unit.kinematics.slotted_triad import SLOTTED

import linkwright as lw
from linkwright.curves.pieces import HIGH, LOW
from linkwright.cycle.cycle import Cycle
from linkwright.cycle.gradient import Backward
from linkwright.cycle.machine import Machine
from linkwright.cycle.solved import Solved
from linkwright.cycle.summaries import Summary
from linkwright.events.formula import ROW
from linkwright.events.path_tracker import TrackedStates
from linkwright.events.tracked_groups import ITERATIONS, Paths
from linkwright.kinematics.programs import Manner
from linkwright.kinematics.solver import MotionSolver

Floats = NDArray[np.float64]
FAULTS = Path(__file__).parents[2] / "reference" / "faults"

#: Turns and slides over one turn, laws over time, an open way, turns counted by pairs behind a dyad and within a
#: group, kinks behind a cam.
MACHINES = {
    "triad": lambda: stored("triad"),
    "fourth order": lambda: stored("fourth_order_group"),
    "class four": lambda: stored("class_four_group"),
    "law over time": lambda: stored("stephenson_sixbar_triad"),
    "wedge": lambda: stored("wedge"),
    "counted turns": lambda: stored("rack_and_rocker"),
    "slot": lambda: lw.loads(SLOTTED),
    "gears": lambda: lw.loads(geared_case(145).text),
    "cam": lambda: lw.loads(TEXT.replace("LAW", "simple_harmonic")),
}


def near(machine: lw.Mechanism, names: list[str], count: int = 4) -> dict[str, Floats]:
    """The machine as it is, and designs near it."""
    random = np.random.default_rng(4)
    return {
        name: machine.dimension(name) * (1.0 + np.append(0.0, 0.004 * random.standard_normal(count - 1)))
        for name in names
    }


def varied(machine: lw.Mechanism) -> list[str]:
    known = machine.dimensions().items()
    return [name for name, value in known if value and name.endswith((".length", ".x", ".y"))][:3]


def alone(machine: lw.Mechanism, designs: Mapping[str, Floats], index: int, steps: int) -> lw.Motion:
    changed = machine.with_dimensions({name: float(column[index]) for name, column in designs.items()})
    return lw.solve_motion(changed, steps=steps, failures="mark")


def tracking(machine: lw.Mechanism, designs: Mapping[str, Floats], steps: int = 36) -> TrackedStates:
    motion = lw.solve_motion(machine, steps=steps, failures="mark")
    solver = MotionSolver(machine, Manner(frozenset(designs), iterations=ITERATIONS), motion.solver.assembly)
    return TrackedStates(motion, solver)


def paths_of(machine: lw.Mechanism, designs: Mapping[str, Floats]) -> Paths:
    states, count = tracking(machine, designs), len(next(iter(designs.values())))
    course = states.course
    return states.tracker.track(designs, np.full(count, course.begin), np.full(count, course.duration))


@pytest.mark.parametrize("name", MACHINES)
def test_designs_are_where_each_is_alone(name: str) -> None:
    """Near enough for Newton's method; the turns of rotations that are counted are the same."""
    machine = MACHINES[name]()
    designs = near(machine, varied(machine))
    found, margin = tracking(machine, designs, 90).of(designs)
    assert paths_of(machine, designs).passed.all() and (margin > 0.0).all()
    for index in range(4):
        states = alone(machine, designs, index, 90).states
        for state, rows in found.items():
            lap = 2.0 * np.pi * np.round((rows[index] - states[state]) / (2.0 * np.pi))
            lap = lap[0] if state.endswith(".angle") or state.startswith("turn") else 0.0
            assert rows[index] - lap == pytest.approx(states[state], abs=1e-3), state


def test_a_path_ends_where_its_group_is_singular() -> None:
    machine = lw.load(FAULTS / "valid_position_barred.yaml")
    designs = near(machine, varied(machine), 2)
    found, _ = tracking(machine, designs, 40).of(designs)
    assert not paths_of(machine, designs).passed.any()
    rows = next(iter(found.values()))
    for index in range(2):
        reached = alone(machine, designs, index, 40).ok
        assert np.isfinite(rows[index]).tolist() == reached.tolist() and 8 < reached.sum() < 14


def test_a_design_that_is_not_reached_has_no_path() -> None:
    machine = stored("triad")
    paths = paths_of(machine, {"crank.A.x": np.array([0.03, 0.5])})
    assert paths.passed.tolist() == [True, False] and paths.reached[1] == 0.0


def test_counted_turns_go_on_from_turn_to_turn() -> None:
    machine = stored("rack_and_rocker")
    designs = near(machine, varied(machine), 1)
    paths = paths_of(machine, designs)
    period, step = paths.duration[0], np.array([0.0, 1.0, 2.0])
    columns = {ROW: np.zeros(1), LOW: paths.begin, HIGH: paths.begin + period}
    ((name, gained),) = paths.laps.items()
    assert paths.fields(columns, step)[name][:, 0] == pytest.approx(paths.series[name][0] + step * gained[0])


@pytest.mark.parametrize("name", ["triad", "class four", "law over time"])
def test_the_cycle_of_designs_is_that_of_each_alone(name: str) -> None:
    machine = MACHINES[name]()
    names = varied(machine)
    designs, parts = near(machine, names, 3), ["driver.effort peak", "driver.effort rms", "driver.effort max"]
    cycle = Cycle(Machine(machine, lw.solve_motion(machine), names), map(Summary.of, parts))
    solved = Solved(cycle, designs)
    assert solved.passed.all()
    for index in range(3):
        changed = machine.with_dimensions({each: float(column[index]) for each, column in designs.items()})
        table = lw.metrics(lw.solve_forces(lw.solve_motion(changed)))
        for part, metric in zip(parts, ("peak_input_torque", "rms_input_torque"), strict=False):
            (row,) = (row for row in table.rows if row.metric == metric)
            assert solved.values[part][index] == pytest.approx(row.value, rel=1e-12)
    slopes = Backward(solved).gradient({parts[1]: np.ones(3)})
    for each in names:
        h = 2e-5 * designs[each]
        ends = [Solved(cycle, {**designs, each: designs[each] + k * h}).values[parts[1]] for k in (-2, -1, 1, 2)]
        difference = (ends[0] - 8.0 * ends[1] + 8.0 * ends[2] - ends[3]) / (12.0 * h)
        assert slopes[each] == pytest.approx(difference, rel=1e-8)


def test_one_machine_is_solved_without_machine_code_as_with_it() -> None:
    machine, parts = stored("triad"), ["driver.effort peak", "bar_2.angular_velocity max"]
    motion = lw.solve_motion(machine)
    plain, compiled = Machine(machine, motion), Machine(machine, motion)
    compiled.compiled = True
    one, other = (Solved(Cycle(each, map(Summary.of, parts)), {}).values for each in (plain, compiled))
    for part in parts:
        assert one[part] == pytest.approx(other[part], rel=1e-12)


def test_sweeps_lose_no_design_that_is_tracked() -> None:
    """Also where a design comes so near to a singular position that Newton's method converges slowly."""
    machine, random = stored("triad"), np.random.default_rng(5)
    names = ("crank.A.x", "bar_3.R.x", "plate.R.x")
    designs = {name: machine.dimension(name) * (1.0 + 0.1 * random.standard_normal(200)) for name in names}
    swept = lw.sweep(machine, designs, outputs=["driver.effort rms"])
    assert swept.ok.tolist() == paths_of(machine, designs).passed.tolist() and swept.ok.sum() == 180
    assert swept.branch_margin is not None and (swept.branch_margin[swept.ok] > 0.0).all()
