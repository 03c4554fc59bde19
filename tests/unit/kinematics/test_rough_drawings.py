"""Drawings that do not close, as their coordinates are rounded or sketched: the assembly that they show."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import minimize
from tests.reference.general_case import general_case

import linkwright as lw
from linkwright.kinematics.solver import MotionSolver

Floats = NDArray[np.float64]


def test_a_rough_drawing_shows_the_assembly_nearest_to_its_points() -> None:
    """Against a minimiser that knows the pins and the distances between them only."""
    mechanism = lw.load("gallery:triad")
    shift = {"A": (-0.004, 0.015), "P": (0.012, -0.02), "Q": (-0.015, 0.01), "R": (0.004, 0.018)}
    true = {**mechanism.frame.points, **mechanism.drawing}
    rough = {name: tuple(np.add(true[name], off)) for name, off in shift.items()}
    tracker = MotionSolver(replace(mechanism, drawing={**mechanism.drawing, **rough})).tracker()
    found = lw.solve_motion(mechanism, at=tracker.drawn_inputs)
    names = list(shift)

    def place(name: str, x: Floats) -> Floats:
        return np.asarray(x[2 * names.index(name) :][:2] if name in names else true[name])

    bars = [
        (p, q) for link in mechanism.links.values() for k, p in enumerate(link.points) for q in list(link.points)[:k]
    ]
    lengths = [float(np.hypot(*np.subtract(true[p], true[q]))) for p, q in bars]
    nearest = minimize(
        lambda x: 1e4 * sum(((place(name, x) - rough[name]) ** 2).sum() for name in names),
        np.concatenate([rough[name] for name in names]),
        constraints={
            "type": "eq",
            "fun": lambda x: [
                float(np.hypot(*(place(p, x) - place(q, x)))) - r for (p, q), r in zip(bars, lengths, strict=True)
            ],
        },
        method="SLSQP",
        options={"ftol": 1e-15},
    )
    for name in names:
        assert found.point(name).position[0] == pytest.approx(place(name, nearest.x), abs=1e-6)


@pytest.mark.parametrize("seed", [287, 515, 611])
def test_a_drawing_two_millimetres_off_shows_the_assembly_that_was_drawn(seed: int) -> None:
    """Machines of a metre near limits, where slides and angles found from two points are far off: from the drawing's
    assembly the drivers lead to the one of the exact drawing."""
    mechanism = lw.loads(general_case(seed).text)
    exact, rng = MotionSolver(mechanism).tracker(), np.random.default_rng([seed, 5])
    drawing = {
        name: (x + rng.normal(0, 0.002), y + rng.normal(0, 0.002)) for name, (x, y) in mechanism.drawing.items()
    }
    rough = MotionSolver(replace(mechanism, drawing=drawing)).tracker()
    goal = rough.drawn_inputs + rough.nearest_drive(exact.drawn_inputs - rough.drawn_inputs)
    branch = rough.between(rough.drawn_inputs, goal, rough.drawn)
    assert branch.complete
    assert branch.last is not None
    gap = rough.nearest_way(branch.last - exact.drawn)
    assert np.abs(gap / rough.groups.scale).max() < 1e-9
