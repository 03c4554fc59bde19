"""Equations of cams, racks, wheels and belts in the rank: true along the motion, with exact derivatives anywhere."""

from __future__ import annotations

import numpy as np
import pytest
from tests.invariants.welded_slider import MODEL as WELDED
from tests.reference.cam_models import GUIDED, SWINGING, model
from tests.reference.geared_mechanisms import geared_case

import linkwright as lw
from linkwright.kinematics.constraint_system import ConstraintSystem, coordinates
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.rank import jacobian_rank, rank_from_drawing

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
    return text.replace("LIFT", "15 deg" if side else "18 mm").replace(
        "SIDE", f"side: {side}," if side else ""
    )


MODELS = {
    **{f"geared {seed}": geared_case(seed).text for seed in (2, 5, 8, 11)},
    **{f"on an arm, {sense}, {side}": on_an_arm(sense, side) for sense in ("clockwise", "counterclockwise")
       for side in ("left", "right", "")},
    "welded": WELDED.replace("BED", "25").replace("OWN", "70").replace("WELD", "-40"),
    "guided": model(GUIDED, "clockwise", "roller", "18 mm", OFFSET="6 mm"),
    "swinging": model(SWINGING, "counterclockwise", "roller", "15 deg", SIDE="left", MOMENT="3 N·m"),
}  # fmt: skip


def solved(name: str) -> Motion:
    return lw.solve_motion(lw.loads(MODELS[name]), times=np.linspace(0.0, 0.02, 4))


@pytest.mark.parametrize("name", MODELS)
def test_rows_hold_along_the_motion_and_have_exact_derivatives_away_from_it(name: str) -> None:
    """The motion comes from the groups; the derivatives by complex steps at random places off the motion."""
    motion = solved(name)
    system = ConstraintSystem(motion.mechanism)
    for index in range(motion.steps):
        assert np.abs(system.residual(coordinates(motion, index))).max() < 1e-12
    x = coordinates(motion, 2) + np.random.default_rng(3).uniform(-0.2, 0.2, system.freedoms)
    values, matrix, drivers = system.residual(x), system.jacobian(x), list(motion.mechanism.drivers)
    assert np.abs(values).max() > 1e-3
    assert {row.joint for row in system.rows(x)} == set(motion.mechanism.joints)
    assert {row.holds for row in system.rows(x)} <= {"place", "rotation", "rolling"}
    for column, unit in enumerate(np.eye(len(x))):
        ahead = x + 1e-30j * unit
        assert matrix[:, column] == pytest.approx(np.imag(system.residual(ahead)) / 1e-30, abs=1e-13)
        for driver in drivers:
            rate = np.imag(system.driver_row(driver, ahead).value) / 1e-30
            row = system.matrix([system.driver_row(driver, x)])[0, column]
            assert row == pytest.approx(rate, abs=1e-13)


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
