"""Limits of many designs, found in the programs of their cycles."""

import numpy as np
import pytest
from tests.invariants.loaded_presses import MODEL

import linkwright as lw
from linkwright.core.outputs import Output
from linkwright.cycle_programs.limit_stages import constants, limit_stages, near_limits
from linkwright.cycle_programs.traced_outputs import Traced
from linkwright.engine.cycle import CycleProgram
from linkwright.engine.numpy_backend import NumpyProgram
from linkwright.kinematics.cycle import over_cycle


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
