"""Bars that are pinned to a rigid part of a machine move and carry as the one link that they make up."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

import linkwright as lw

PLACES = {
    "A": (0.1, 0.0),
    "B": (0.42, 0.16),
    "C": (0.2, 0.25),
    "D": (0.22, -0.12),
    "E": (0.3, 0.3),
    "F": (0.45, -0.05),
    "H": (0.85, 0.1),
    "J": (0.8, 0.35),
}
TRIANGLE = ("AB", "BC", "AC")
#: Two triangles joined by three bars: no pin of it has two bars only, so that no dyad places it.
PRISM = ("AC", "AD", "CD", "BE", "BF", "EF", "AB", "CE", "DF")
TRUSSES = {"triangle": TRIANGLE, "prism": PRISM, "triangles in a row": (*TRIANGLE, "CE", "BE")}


def machine(bars: tuple[str, ...], load: str, rocker: str = "rocker: {points: [O2, B]}") -> lw.Mechanism:
    """A four-bar whose coupler is made of bars, with a force on one of its points."""
    links = ["crank: {points: [O1, A]}", rocker, *(f"{bar}: {{points: [{', '.join(bar)}]}}" for bar in bars)]
    used = {name for bar in bars for name in bar}
    drawn = ", ".join(f"{name}: [{x} m, {y} m]" for name, (x, y) in PLACES.items() if name in used)
    holder = next(bar for bar in bars if load in bar)
    rows = [
        "format: 1",
        "frame: {points: {O1: [0 m, 0 m], O2: [0.5 m, -0.15 m]}}",
        "links:",
        *(f"  {each}" for each in links),
        f"drawing: {{{drawn}}}",
        "driver: {turn: crank, about: O1, speed: 60 rpm}",
        f"loads: {{pull: {{kind: force, on: {holder}, at: {load}, components: [30 N, -50 N]}}}}",
    ]
    return lw.loads("\n".join(rows) + "\n")


@pytest.mark.parametrize("name", TRUSSES)
def test_a_coupler_of_bars_is_a_plate(name: str) -> None:
    bars = TRUSSES[name]
    points = "".join(sorted({p for bar in bars for p in bar}))
    load = points[-1]
    motion = lw.solve_motion(machine(bars, load), steps=24)
    plate = lw.solve_motion(machine((points,), load), steps=24)
    for point in points:
        for kind in ("position", "velocity", "acceleration"):
            ours, theirs = (getattr(each.point(point), kind) for each in (motion, plate))
            assert ours == pytest.approx(theirs, abs=1e-9 * max(1.0, np.abs(theirs).max()))
    for first, second in combinations(points, 2):
        gap = motion.point(first).position - motion.point(second).position
        assert np.ptp(np.hypot(*gap.T)) < 1e-12
    forces, one = lw.solve_forces(motion), lw.solve_forces(plate)
    assert forces.input_torque == pytest.approx(one.input_torque, abs=1e-9)
    for joint, link in (("O1", "crank"), ("O2", "rocker")):
        assert forces.reaction(joint, on=link) == pytest.approx(one.reaction(joint, on=link), abs=1e-9)
    assert np.abs(forces.balance_residual).max() < 1e-11
    lw.metrics(forces)


def test_a_truss_on_the_frame_stands_still() -> None:
    """Bars between pins of the frame beside a machine have no rates, and carry their load."""
    text = """format: 1
frame: {points: {O1: [0 m, 0 m], O2: [0.5 m, 0 m], S: [1 m, 0 m], T: [2 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 0.1 m}
  coupler: {points: [A, B], length: 0.4 m}
  rocker: {points: [O2, B], length: 0.3 m}
  left: {points: [S, V], length: 1 m}
  right: {points: [T, V], length: 1 m}
  brace: {points: [V, B2], length: 0.5 m}
  other: {points: [S, B2], length: 0.8 m}
assembly: {B: left, V: left, B2: left}
driver: {turn: crank, about: O1, speed: 60 rpm}
loads: {weight: {kind: force, on: left, at: V, components: [0 N, -100 N]}}
"""
    motion = lw.solve_motion(lw.loads(text), steps=12)
    assert np.abs(motion.point("V").velocity).max() < 1e-15
    assert motion.point("V").position == pytest.approx(np.tile([1.5, 0.5 * np.sqrt(3)], (12, 1)), abs=1e-12)
    forces = lw.solve_forces(motion)
    push = 100.0 / np.sqrt(3)
    assert np.hypot(*forces.reaction("S", on="left").T) == pytest.approx(push, abs=1e-9)
    assert np.abs(forces.input_torque).max() < 1e-12
