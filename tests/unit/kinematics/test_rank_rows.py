"""Equations of cams, racks, wheels and belts in the rank: true along the motion, with exact derivatives anywhere."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from tests.invariants.welded_slider import MODEL as WELDED
from tests.reference.cam_models import GUIDED, SWINGING, model
from tests.reference.geared_mechanisms import geared_case

import linkwright as lw
from linkwright.kinematics.constraint_equations import ConstraintEquations
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.rank import rank_from_drawing
from linkwright.kinematics.rank_of_motion import coordinates, jacobian_rank

ON_AN_ARM = """
format: 1
name: cam and follower on a turning arm
frame: {points: {B: [0 mm, 0 mm]}}
links:
  arm: {points: {B: [0 mm, 0 mm], O: [200 mm, 40 mm], G: [206 mm, 40 mm], A: [360 mm, 40 mm]}}
  cam: {points: {O: [10 mm, -5 mm], X: [30 mm, 0 mm]}}
  FOLLOWER
joints:
  JOINT
  lobe: {kind: cam, cam: cam, follower: rider, at: P, touch: flat, base_radius: 70 mm, phase: 20 deg,
    turn: SENSE, SIDE
    program: [{rise: LIFT, over: 110 deg, law: cycloidal}, {dwell: 60 deg},
      {fall: LIFT, over: 100 deg, law: cycloidal}, {dwell: 90 deg}]}
drivers:
  swing: {turn: arm, about: B, speed: 1 rad/s}
  spin: {turn: cam, about: O, relative_to: arm, speed: 3 rad/s, start: 60 deg}
cycle: {duration: 2 s}
"""
SLIDE = (
    "rider: {points: {P: [4 mm, -7 mm], Q: [4 mm, 33 mm]}}",
    "guide: {kind: prismatic, guide: arm, through: G, direction: 90 deg, block: rider, at: P, block_angle: 90 deg}",
)
SWING = ("rider: {points: [A, P], length: 130 mm}", "")


def on_an_arm(sense: str, side: str) -> str:
    link, joint = SWING if side else SLIDE
    text = ON_AN_ARM.replace("FOLLOWER", link).replace("JOINT", joint).replace("SENSE", sense)
    return text.replace("LIFT", "15 deg" if side else "18 mm").replace("SIDE", f"side: {side}," if side else "")


MODELS = {
    **{f"geared {seed}": geared_case(seed).text for seed in (2, 5, 8, 11)},
    **{
        f"on an arm, {sense}, {side}": on_an_arm(sense, side)
        for sense in ("clockwise", "counterclockwise")
        for side in ("left", "right", "")
    },
    "welded": WELDED.replace("BED", "25").replace("OWN", "70").replace("WELD", "-40"),
    "guided": model(GUIDED, "clockwise", "roller", "18 mm", OFFSET="6 mm"),
    "swinging": model(SWINGING, "counterclockwise", "roller", "15 deg", SIDE="left", MOMENT="3 N·m"),
}


def solved(name: str) -> Motion:
    return lw.solve_motion(lw.loads(MODELS[name]), times=np.linspace(0.0, 0.02, 4))


def slope(value: Callable[[np.ndarray], np.ndarray], x: np.ndarray, way: np.ndarray) -> np.ndarray:
    """A derivative along a direction by differences of fourth order."""
    h = 1e-3
    near, far = (value(x + k * h * way) - value(x - k * h * way) for k in (1, 2))
    return np.asarray((8.0 * near - far) / (12.0 * h))


@pytest.mark.parametrize("name", MODELS)
def test_rows_hold_along_the_motion_and_have_exact_derivatives_away_from_it(name: str) -> None:
    """The motion comes from the groups.

    A cam takes its follower's guide as closed: its derivatives are exact in the directions that the guide leaves.
    """
    motion = solved(name)
    system = ConstraintEquations(motion.mechanism)
    for index in range(motion.steps):
        assert np.abs(system.residual(coordinates(motion, index))).max() < 1e-12
    x = coordinates(motion, 2)
    off = np.random.default_rng(3).uniform(-0.2, 0.2, system.freedoms)
    assert np.abs(system.residual(x + off)).max() > 1e-3
    ways = np.eye(len(x))
    if name == "guided":
        others = system.matrix([row for row in system.rows(x) if row.joint != "lobe"])
        ways = np.linalg.svd(others)[2][len(others) :]
        assert len(ways) == 2
    else:
        x = x + off
    assert {row.joint for row in system.rows(x)} == set(motion.mechanism.joints)
    assert {row.holds for row in system.rows(x)} <= {"place", "rotation", "rolling"}
    drivers = list(motion.mechanism.drivers)
    for way in ways:
        assert system.jacobian(x) @ way == pytest.approx(slope(system.residual, x, way), abs=1e-9)
        for driver in drivers:
            rate = slope(lambda at, name=driver: np.array([system.driver_row(name, at).value]), x, way)
            assert system.matrix([system.driver_row(driver, x)]) @ way == pytest.approx(rate, abs=1e-9)


@pytest.mark.parametrize("name", MODELS)
def test_second_derivatives_are_those_of_the_first(name: str) -> None:
    motion = solved(name)
    system = ConstraintEquations(motion.mechanism)
    x = coordinates(motion, 2)
    v = np.random.default_rng(4).uniform(-1.0, 1.0, system.freedoms)

    def moved(at: np.ndarray) -> np.ndarray:
        rows = [*system.rows(at), *(system.driver_row(each, at) for each in motion.mechanism.drivers)]
        return np.asarray(system.matrix(rows) @ v)

    for column, way in zip(system.second(x, v).T, np.eye(len(x)), strict=True):
        assert column == pytest.approx(slope(moved, x, way), abs=1e-8)


@pytest.mark.parametrize("name", MODELS)
def test_the_rank_is_that_of_the_drawing_and_of_every_position(name: str) -> None:
    motion = solved(name)
    mechanism = motion.mechanism
    for index in (0, 3):
        report = jacobian_rank(motion, index)
        assert (report.mobility, report.special) == (len(mechanism.drivers), False)
        assert report.freedoms == 3 * len(mechanism.links) == report.equations + report.grubler
        assert len(report.redundant) == report.mobility - report.grubler
    drawn = rank_from_drawing(mechanism)
    if drawn is not None:
        assert (drawn.mobility, drawn.special, drawn.links) == (len(mechanism.drivers), False, ())
