"""Limits between which loads act, of many designs at once."""

import numpy as np
import pytest
from tests.invariants.loaded_presses import MODEL

import linkwright as lw
from linkwright.applied_loads.phases import MovingPhase, SwingPhase
from linkwright.applied_loads.strokes import Amount, StrokePart
from linkwright.core.outputs import Output
from linkwright.cycle.load_limits import LoadLimits, NearLimits
from linkwright.cycle.machine import Machine
from linkwright.kinetostatics.load_site import limit_name, value_name


def test_outputs_that_turn_more_than_twice_are_doubted() -> None:
    """Points of a coupler plane, whose paths have two or more limits across: beside turns counted point by point."""
    fourbar = lw.load("gallery:crank_rocker")
    x, y = (each.ravel() for each in np.meshgrid(np.linspace(-3.5, 0.5, 7), np.linspace(-9.0, 3.0, 7)))
    columns = {"coupler.P.x": x, "coupler.P.y": y}
    output = Output("position", "coupler.P", "y")
    machine = Machine(fourbar, lw.solve_motion(fourbar, steps=360), columns)
    found = LoadLimits(machine, [MovingPhase(output, "increasing")]).solve(columns)
    turns = []
    for k in range(len(x)):
        design = fourbar.with_dimensions({a: float(c[k]) for a, c in columns.items()})
        rising = lw.solve_motion(design, steps=360).point("coupler.P").velocity[:, 1] > 0.0
        turns.append(int((rising != np.roll(rising, 1)).sum()))
    assert found.certain.tolist() == [count == 2 for count in turns]
    assert {2, 4} <= set(turns)


def test_limits_are_those_of_the_closed_form_from_far_and_from_near() -> None:
    """Crank and rod in one line: sin θ = e/(l + r), and e/(l - r) half a turn on; the pin at √((l ± r)² - e²)."""
    machine = lw.loads(MODEL.split("loads:", maxsplit=1)[0])
    assert machine.dimension("driver.speed") == pytest.approx(4 * np.pi)
    output, rod = Output("position", "piston.B", "x"), machine.dimension("rod.length")
    phase = SwingPhase(output, "max", "min", StrokePart("first", (Amount(0.5, share=True),)))
    sought = LoadLimits(Machine(machine, lw.solve_motion(machine), ["rod.length"]), [phase])
    near = NearLimits.of(sought, {"rod.length": rod})
    assert near is not None
    for length in (rod, 1.03 * rod):
        inputs = [np.arcsin(0.05 / (length + 0.2)), np.pi + np.arcsin(0.05 / (length - 0.2))]
        places = [np.sqrt((length + r) ** 2 - 0.0025) for r in (0.2, -0.2)]
        far = {n: float(v[0]) for n, v in sought.solve({"rod.length": np.array([length])}).numbers.items()}
        for found in (far, near.numbers({"rod.length": length})):
            assert found is not None
            for k, at, place in zip(("max", "min"), inputs, places, strict=True):
                apart = found[limit_name(output, k)] - at
                assert apart - 2 * np.pi * round(apart / (2 * np.pi)) == pytest.approx(0.0, abs=1e-12)
                assert found[value_name(output, k)] == pytest.approx(place, rel=1e-12)
