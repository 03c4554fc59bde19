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
    follower = MotionSolver(replace(mechanism, drawing={**mechanism.drawing, **rough})).follower()
    found = lw.solve_motion(mechanism, at=follower.drawn_inputs)
    names = list(shift)

    def place(name: str, x: Floats) -> Floats:
        return np.asarray(x[2 * names.index(name) :][:2] if name in names else true[name])

    bars = [
        (p, q)
        for link in mechanism.links.values()
        for k, p in enumerate(link.points)
        for q in list(link.points)[:k]
    ]
    lengths = [float(np.hypot(*np.subtract(true[p], true[q]))) for p, q in bars]
    nearest = minimize(
        lambda x: 1e4 * sum(((place(name, x) - rough[name]) ** 2).sum() for name in names),
        np.concatenate([rough[name] for name in names]),
        constraints={
            "type": "eq",
            "fun": lambda x: [
                float(np.hypot(*(place(p, x) - place(q, x)))) - r
                for (p, q), r in zip(bars, lengths, strict=True)
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
    exact, rng = MotionSolver(mechanism).follower(), np.random.default_rng([seed, 5])
    drawing = {
        name: (x + rng.normal(0, 0.002), y + rng.normal(0, 0.002))
        for name, (x, y) in mechanism.drawing.items()
    }
    rough = MotionSolver(replace(mechanism, drawing=drawing)).follower()
    goal = rough.drawn_inputs + rough.nearest_drive(exact.drawn_inputs - rough.drawn_inputs)
    branch = rough.between(rough.drawn_inputs, goal, rough.drawn)
    assert branch.complete
    gap = rough.nearest_way(branch.last[: rough.loops.n] - exact.drawn)
    assert np.abs(gap / rough.loops.scale).max() < 1e-9


def test_a_machine_that_is_singular_everywhere_is_not_blamed_on_its_drawing() -> None:
    """Two straight-line linkages of 200 mm with a platform pinned on both, drawn to 0.1 mm: at one input the platform
    may be anywhere along its line (jgerstmayr/EXUDYN, issue 39)."""
    text = """format: 1
frame: {points: {OL: [0 mm, 0 mm], OR: [1000 mm, 0 mm]}}
links:
  crankL: {points: [OL, AL], length: 200 mm}
  barL: {points: [CL, AL, BL], lengths: [200 mm, 400 mm], angle: 0 deg}
  shoeL: {points: [CL]}
  crankR: {points: [OR, AR], length: 200 mm}
  barR: {points: [CR, AR, BR], lengths: [200 mm, 400 mm], angle: 0 deg}
  shoeR: {points: [CR]}
  platform: {points: [BL, BR], length: 1000 mm}
joints:
  floorL: {kind: prismatic, guide: frame, through: OL, direction: 0 deg, block: shoeL, at: CL}
  floorR: {kind: prismatic, guide: frame, through: OR, direction: 0 deg, block: shoeR, at: CR}
drawing: {AL: [-173.2 mm, 100 mm], CL: [-346.4 mm, 0 mm], BL: [0 mm, 200 mm], AR: [1173.2 mm, 100 mm],
  CR: [1346.4 mm, 0 mm], BR: [1000 mm, 200 mm]}
driver: {slide: floorL, position: "-346.4 mm + 10 mm/s*t"}
cycle: {duration: 5 s}
"""
    with pytest.raises(lw.LinkwrightError, match="singular"):
        lw.solve_motion(lw.loads(text), steps=5)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_dyad_drawn_just_out_of_reach_is_on_the_side_on_which_it_is_drawn(side: float) -> None:
    """|A O2| ≤ 0.5 m up to cos θ = (0.3² + 0.7² - 0.5²) / (2 · 0.3 · 0.7), θ = 38.21°; drawn at 38.3°."""
    a = complex(0.3 * np.exp(1j * np.radians(38.3)))
    way = (0.7 - a) / abs(0.7 - a)
    b = complex(a + 0.3 * way * np.exp(0.1j * side))
    text = f"""format: 1
frame: {{points: {{O1: [0 m, 0 m], O2: [0.7 m, 0 m]}}}}
links:
  crank: {{points: [O1, A], length: 0.3 m}}
  coupler: {{points: [A, B], length: 0.3 m}}
  rocker: {{points: [O2, B], length: 0.2 m}}
drawing: {{A: [{a.real!r} m, {a.imag!r} m], B: [{b.real!r} m, {b.imag!r} m]}}
driver: {{turn: crank, about: O1, speed: 1 rad/s}}
cycle: {{from: -30 deg, to: 30 deg}}
"""
    motion = lw.solve_motion(lw.loads(text), steps=12)
    arm = motion.point("B").position - motion.point("A").position
    ray = np.array([0.7, 0.0]) - motion.point("A").position
    assert (side * (ray[:, 0] * arm[:, 1] - ray[:, 1] * arm[:, 0]) > 0.0).all()
