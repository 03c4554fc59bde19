"""Coordinates of links that a drawing gives."""

import numpy as np
import pytest

import linkwright as lw
from linkwright.kinematics.constraint_equations import drawn_coordinates


def test_drawn_coordinates_are_those_of_the_links_origins() -> None:
    """Of links whose named points lie off their origin, drawn where the motion has them: by hand, turned, moved."""
    text = """
format: 1
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 1 m]}}
links:
  crank: {points: {O1: [0.3 m, -0.7 m], A: [1.3 m, -0.7 m]}}
  coupler: {points: {A: [0.2 m, 0.5 m], B: [3.2 m, 1.1 m]}}
  rocker: {points: {O2: [-0.4 m, 0.6 m], B: [-0.1 m, 3.1 m]}}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 1 rad/s, start: 40 deg}
"""
    machine = lw.loads(text)
    motion = lw.solve_motion(machine, at=[np.radians(40.0)])
    places = {name: motion.point(name).position[0] for name in ("A", "B")}
    drawn = ", ".join(
        f"{name}: [{x!r} m, {y!r} m]" for name, (x, y) in ((n, map(float, p)) for n, p in places.items())
    )
    found = drawn_coordinates(lw.loads(text + f"drawing: {{{drawn}}}\n"))
    assert found is not None
    size, rows = machine.size, found.reshape(-1, 3)
    for (name, link), (x, y, angle) in zip(machine.links.items(), rows, strict=True):
        point, local = next(iter(link.points.items()))
        turned = complex(*local) * np.exp(1j * motion.link(name).angle[0])
        origin = complex(*motion.point(f"{name}.{point}").position[0]) - turned
        assert complex(x, y) * size == pytest.approx(origin, abs=1e-12)
        assert np.exp(1j * angle) == pytest.approx(np.exp(1j * motion.link(name).angle[0]), abs=1e-12)
