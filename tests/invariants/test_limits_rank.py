"""Mobility by the rank of the Jacobian: special lengths, passive constraints, special positions."""

from __future__ import annotations

from dataclasses import replace
from math import cos, hypot, radians, sin
from pathlib import Path

import numpy as np
import pytest

import linkwright as lw
from linkwright.kinematics.constraint_system import ConstraintSystem, coordinates
from linkwright.kinematics.rank import jacobian_rank, rank_from_dimensions, rank_from_drawing

GALLERY = sorted(path.stem for path in (Path(lw.__file__).parent / "gallery").glob("*.yaml"))

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


@pytest.mark.parametrize("name", GALLERY)
def test_gallery_rank_is_the_mobility_of_the_structure(name: str) -> None:
    mechanism = lw.load(f"gallery:{name}")
    motion = lw.solve_motion(mechanism, steps=7)
    for index in range(0, motion.steps, 3):
        report = jacobian_rank(motion, index)
        assert report.mobility == lw.structure(mechanism).mobility == mechanism.expected["mobility"]
        assert report.rank + report.mobility == report.freedoms == 3 * len(mechanism.links)
        assert len(report.redundant) == report.mobility - report.grubler


@pytest.mark.parametrize("name", GALLERY)
def test_solved_positions_satisfy_the_joints(name: str) -> None:
    """The equations are built here from the joints alone, not from the groups that solved them."""
    motion = lw.solve_motion(lw.load(f"gallery:{name}"), steps=7)
    system = ConstraintSystem(motion.mechanism)
    for index in range(motion.steps):
        assert np.abs(system.residual(coordinates(motion, index))).max(initial=0.0) < 1e-13


@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", "oldham_coupling", "dyad_rpp", "excavator", "wedge"])
def test_jacobian_is_the_derivative(name: str) -> None:
    motion = lw.solve_motion(lw.load(f"gallery:{name}"), steps=7)
    system = ConstraintSystem(motion.mechanism)
    x = coordinates(motion, 2)
    for column, unit in zip(system.jacobian(x).T, np.eye(len(x)), strict=True):
        assert np.allclose(column, np.imag(system.residual(x + 1e-30j * unit)) / 1e-30, rtol=0, atol=1e-14)


def test_wedge_has_a_passive_rotation() -> None:
    report = jacobian_rank(lw.solve_motion(lw.load("gallery:wedge"), steps=5))
    assert (report.grubler, report.mobility, report.special) == (0, 1, False)
    assert report.redundant == ("rotation at column",)
    assert report.sentence == (
        "Grübler gives 0, but the rank of the Jacobian gives 1: the guide column closes a loop in which rotation is "
        "already prevented (rotation at column)"
    )


@pytest.mark.parametrize("error", [0.0, 0.003])
def test_third_parallel_crank_is_redundant(error: float) -> None:
    """Also with a drawing that is only nearly right."""
    report = rank_from_drawing(lw.loads(parallel_cranks(error=error)))
    assert report is not None
    assert (report.grubler, report.mobility, report.links, report.special) == (0, 1, ("crank_3",), False)
    assert report.sentence == (
        "Grübler gives 0, but the rank of the Jacobian in the drawing gives 1: "
        "the link 'crank_3' is redundant in this special geometry; remove it"
    )


def test_third_crank_that_is_not_parallel() -> None:
    """Of another length, but reaching its pin in the drawing: the chain is rigid."""
    length = hypot(1 + cos(radians(70)) - 1.3, sin(radians(70)))
    report = rank_from_drawing(lw.loads(parallel_cranks(o3=1.3, length=length)))
    assert report is not None
    assert report.mobility == 0
    assert "confirmed" in report.sentence


def test_links_that_do_not_fit_the_drawing() -> None:
    report = rank_from_drawing(lw.loads(parallel_cranks(o3=9.0)))
    assert report is not None
    assert "do not fit together near the drawing" in report.sentence
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
    assert "special position" in report.sentence and "lost as soon as" in report.sentence


def test_change_point_in_a_drawing_is_a_special_position() -> None:
    flat = replace(lw.load("gallery:parallelogram"), drawing={"A": (1.0, 0.0), "B": (3.0, 0.0)})
    report = rank_from_drawing(flat)
    assert report is not None
    assert (report.mobility, report.special) == (2, True)


def test_without_a_drawing_there_is_nothing_to_say() -> None:
    assert rank_from_drawing(lw.load("gallery:crank_rocker")) is None


TWO_GUIDES = """
format: 1
name: a piston on two guides
frame: {points: {O: [0 m, 0 m], G: [0 m, 0.3 m]}}
links:
  crank: {points: [O, A], length: 0.2 m}
  rod: {points: [A, B], length: 0.7 m}
  piston: {points: {B: [0 m, 0 m], C: [0 m, 0.3 m]}}
joints:
  upper: {kind: prismatic, guide: frame, through: G, direction: SIZE, block: piston, at: C, block_angle: SIZE}
  lower: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B}
driver: {turn: crank, about: O, speed: 3 rad/s}
"""
TWO_GUIDES_DRAWN = f"{TWO_GUIDES}drawing: {{A: [0.2 m, 0 m], B: [0.9 m, 0 m], C: [0.9 m, 0.3 m]}}"
COUPLED_WHEELS = """
format: 1
name: coupled wheels
frame: {points: {A: [0 m, 0 m], B: [1 m, 0 m], C: [2 m, 0 m]}}
links:
  front: {points: [A, D], length: 0.3 m}
  middle: {points: [B, E], length: SIZE}
  rear: {points: [C, F], length: 0.3 m}
  rod: {points: {D: [0 m, 0 m], E: [1 m, 0 m], F: [2 m, 0 m]}}
driver: {turn: front, about: A, speed: 60 rpm}
"""
TRAMMEL_WITH_CRANK = """
format: 1
name: an elliptic trammel with a crank
frame: {points: {O: [0 mm, 0 mm]}}
links:
  crank: {points: [O, C], length: SIZE}
  bar: {points: {C: [0 mm, 0 mm], A: [-50 mm, 0 mm], B: [50 mm, 0 mm]}}
  across: {points: [A]}
  upright: {points: [B]}
joints:
  level: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: across, at: A}
  plumb: {kind: prismatic, guide: frame, through: O, direction: 90 deg, block: upright, at: B}
driver: {turn: crank, about: O, speed: 60 rpm}
"""

PLATFORM = """
format: 1
name: a platform lifted by two bars of one pair of cranks
frame: {points: {A: [0 m, 0 m], B: [0.5 m, 0 m]}}
links:
  left: {points: {A: [0 m, 0 m], C: [0.2 m, 0 m], E: [SIZE, 0 m]}}
  right: {points: {B: [0 m, 0 m], D: [0.2 m, 0 m], F: [0.4 m, 0 m]}}
  lower: {points: [C, D], length: 0.5 m}
  upper: {points: [E, F], length: 0.5 m}
driver: {turn: left, about: A, speed: 60 rpm}
"""


@pytest.mark.parametrize(
    ("text", "fits", "other", "spare"),
    [
        (COUPLED_WHEELS, "0.3 m", "0.31 m", "rear"),
        (TRAMMEL_WITH_CRANK, "50 mm", "51 mm", "upright"),
        (TWO_GUIDES, "0 deg", "10 deg", "lower"),
        (PLATFORM, "0.4 m", "0.42 m", "upper"),
    ],
    ids=["coupled wheels", "trammel", "two guides", "platform"],
)
def test_passive_constraints_are_named_without_a_drawing(
    text: str, fits: str, other: str, spare: str
) -> None:
    """The classical examples: what others demand already by their lengths is told, by other lengths nothing is."""
    with pytest.raises(lw.StructureError, match=rf"the Jacobian where the joints close gives 1: .*'{spare}'"):
        lw.solve_motion(lw.loads(text.replace("SIZE", fits)))
    with pytest.raises(lw.StructureError, match="determined more than once") as refused:
        lw.solve_motion(lw.loads(text.replace("SIZE", other)))
    assert "Jacobian" not in str(refused.value)


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
    with pytest.raises(lw.LinkwrightError, match="position 1 is not solved"):
        jacobian_rank(motion, 1)


def test_a_second_guide_beside_the_first_is_named() -> None:
    """3·3 - 2·5 = -1; parallel guides leave the slider-crank's one freedom, inclined ones hold the piston."""
    with pytest.raises(
        lw.StructureError, match=r"mobility -1 .* gives 1: the joint 'lower' demands only what"
    ):
        lw.solve_motion(lw.loads(TWO_GUIDES_DRAWN.replace("SIZE", "0 deg")))
    report = rank_from_drawing(lw.loads(TWO_GUIDES_DRAWN.replace("SIZE", "10 deg")))
    assert report is not None and report.mobility == 0 and "'lower'" not in report.say()
