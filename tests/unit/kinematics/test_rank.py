"""Mobility by the rank of the Jacobian: special lengths, passive constraints, special positions."""

from __future__ import annotations

from dataclasses import replace
from math import cos, hypot, radians, sin

import numpy as np
import pytest
from tests.invariants.passive_constraints import TWO_GUIDES_DRAWN
from tests.refusals import refused
from tests.store import machine, names
from tests.store import motion as moved

import linkwright as lw
from linkwright.kinematics.constraint_equations import ConstraintEquations
from linkwright.kinematics.rank import rank_from_dimensions, rank_from_drawing
from linkwright.kinematics.rank_of_motion import coordinates, jacobian_rank

PARALLEL_CRANKS = """
format: 1
name: three parallel cranks
frame: {{points: {{O1: [0 m, 0 m], O2: [2 m, 0 m], O3: [{o3} m, 0 m]}}}}
links:
  crank_1: {{points: [O1, A], length: 1 m}}
  bar: {{points: [A, B], length: 2 m, also: {{C: [1 m, 0 m]}}}}
  crank_2: {{points: [O2, B], length: 1 m}}
  crank_3: {{points: [O3, C], length: {length} m}}
drawing: {{A: [{x} m, {y} m], B: [{bx} m, {y} m], C: [{cx} m, {y} m]}}
driver: {{turn: crank_1, about: O1, speed: 1 rad/s, start: 70 deg}}
"""


def parallel_cranks(o3: float = 1.0, length: float = 1.0, angle: float = 70.0, error: float = 0.0) -> str:
    x, y = cos(radians(angle)) + error, sin(radians(angle))
    return PARALLEL_CRANKS.format(o3=o3, length=length, x=x, y=y, bx=2 + x - 2 * error, cx=1 + x)


@pytest.mark.rotating
@pytest.mark.parametrize("name", names())
def test_gallery_rank_is_the_mobility_of_the_structure(name: str) -> None:
    mechanism, motion = machine(name), moved(name, 7)
    for index in range(0, motion.steps, 3):
        report = jacobian_rank(motion, index)
        assert report.mobility == lw.structure(mechanism).mobility == mechanism.expected["mobility"]
        assert report.rank + report.mobility == report.freedoms == 3 * len(mechanism.links)
        assert len(report.redundant) == report.mobility - report.grubler


@pytest.mark.rotating
@pytest.mark.parametrize("name", names())
def test_solved_positions_satisfy_the_joints(name: str) -> None:
    """The equations are built here from the joints alone, not from the groups that solved them."""
    motion = moved(name, 7)
    system = ConstraintEquations(motion.mechanism)
    for index in range(motion.steps):
        assert np.abs(system.residual(coordinates(motion, index))).max(initial=0.0) < 1e-13


@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", "oldham_coupling", "dyad_rpp", "excavator", "wedge"])
def test_jacobian_is_the_derivative(name: str) -> None:
    motion = moved(name, 7)
    system = ConstraintEquations(motion.mechanism)
    x = coordinates(motion, 2)
    for column, unit in zip(system.jacobian(x).T, np.eye(len(x)), strict=True):
        near, far = (system.residual(x + h * unit) - system.residual(x - h * unit) for h in (1e-3, 2e-3))
        assert np.allclose(column, (8.0 * near - far) / 12e-3, rtol=0, atol=1e-10)


def test_wedge_has_a_passive_rotation() -> None:
    report = jacobian_rank(moved("wedge", 5))
    assert (report.grubler, report.mobility, report.special) == (0, 1, False)
    assert report.redundant == ("rotation at column",)
    assert report.sentence.code == "rank.differs"


@pytest.mark.parametrize("error", [0.0, 0.003])
def test_third_parallel_crank_is_redundant(error: float) -> None:
    """Also with a drawing that is only nearly right."""
    report = rank_from_drawing(lw.loads(parallel_cranks(error=error)))
    assert report is not None
    assert (report.grubler, report.mobility, report.links, report.special) == (0, 1, ("crank_3",), False)
    assert report.sentence.code == "rank.differs_drawn"


def test_third_crank_that_is_not_parallel() -> None:
    """Of another length, but reaching its pin in the drawing: the chain is rigid."""
    length = hypot(1 + cos(radians(70)) - 1.3, sin(radians(70)))
    report = rank_from_drawing(lw.loads(parallel_cranks(o3=1.3, length=length)))
    assert report is not None
    assert report.mobility == 0
    assert report.sentence.code == "rank.confirmed_drawn"


def test_links_that_do_not_fit_the_drawing() -> None:
    report = rank_from_drawing(lw.loads(parallel_cranks(o3=9.0)))
    assert report is not None
    assert report.sentence.code == "rank.gaping"
    assert report.links == ()


def test_special_position_is_told_from_a_special_geometry() -> None:
    """Three bars in one line from wall to wall shake at rest, though they form a truss."""
    text = """
format: 1
name: bars in line
frame: {points: {O1: [0 m, 0 m], O2: [2 m, 0 m]}}
links:
  left: {points: [O1, A], length: 1 m}
  right: {points: [O2, A], length: 1 m}
drawing: {A: [1 m, 0 m]}
"""
    report = rank_from_drawing(lw.loads(text))
    assert report is not None
    assert (report.grubler, report.mobility, report.special) == (0, 1, True)
    assert report.sentence.code == "rank.differs_drawn"


def test_change_point_in_a_drawing_is_a_special_position() -> None:
    flat = replace(lw.load("gallery:parallelogram"), drawing={"A": (1.0, 0.0), "B": (3.0, 0.0)})
    report = rank_from_drawing(flat)
    assert report is not None
    assert (report.mobility, report.special) == (2, True)


def test_without_a_drawing_there_is_nothing_to_say() -> None:
    assert rank_from_drawing(lw.load("gallery:crank_rocker")) is None


def test_driven_more_than_once_has_nothing_passive() -> None:
    twice = lw.loads(
        """
format: 1
name: driven twice
frame: {points: {A: [0 m, 0 m], D: [1 m, 0 m]}}
links:
  crank: {points: [A, B], length: 0.3 m}
  coupler: {points: [B, C], length: 0.9 m}
  rocker: {points: [D, C], length: 0.7 m}
drivers:
  one: {turn: crank, about: A, speed: 60 rpm}
  two: {turn: rocker, about: D, speed: 60 rpm}
"""
    )
    assert rank_from_dimensions(twice) is None


def test_position_that_is_not_solved() -> None:
    motion = lw.solve_motion(lw.load("gallery:change_point_fourbar"), at=[1.0, np.pi], failures="mark")
    with refused("motion.no_rank"):
        jacobian_rank(motion, 1)


def test_a_second_guide_beside_the_first_is_named() -> None:
    """3·3 - 2·5 = -1; parallel guides leave the slider-crank's one freedom, inclined ones hold the piston."""
    report = rank_from_drawing(lw.loads(TWO_GUIDES_DRAWN.replace("SIZE", "10 deg")))
    assert report is not None and report.mobility == 0 and "'lower'" not in report.translate()
