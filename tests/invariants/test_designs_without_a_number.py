"""A design that lacks a number is an outcome of its own: the other designs, and its other numbers, are found."""

import math

import numpy as np
import pytest
from tests.refusals import refused

import linkwright as lw

#: A rocker swings between 90° and about 132°; where the guide lies between, the toggle is straight twice a turn.
TOGGLE = """
format: 1
name: toggle
frame: {points: {O: [0 m, 0 m], Q: [0.4 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.1 m}
  coupler: {points: [A, B], length: 0.4 m}
  rocker: {points: [Q, B], length: 0.3 m}
  rod: {points: [B, C], length: 0.5 m}
  ram: {points: {C: [0 m, 0 m]}}
joints:
  guide: {kind: prismatic, guide: frame, through: Q, direction: DIRECTION, block: ram, at: C, block_angle: 0 deg}
assembly: {B: left, C: forward}
driver: {turn: crank, about: O, speed: 60 rpm}
"""
DIRECTIONS = [60.0, 80.0, 110.0]
NAMES = ["quick_return_ratio guide", "stroke guide", "crank_angle_between_limits guide"]


def swing() -> tuple[float, float]:
    """Crank angles, rad, of the rocker's limits: crank and coupler in one line, by the law of cosines."""
    away, near = (math.acos((c * c + 0.16 - 0.09) / (0.8 * c)) for c in (0.5, 0.3))
    return away, near + math.pi


def ratio() -> float:
    low, high = swing()
    share = (high - low) / (2.0 * math.pi)
    return max(share, 1.0 - share) / min(share, 1.0 - share)


@pytest.mark.parametrize("base", [60, 110])
def test_designs_whose_stroke_has_tied_limits_have_no_ratio_and_the_others_keep_theirs(base: int) -> None:
    machine = lw.loads(TOGGLE.replace("DIRECTION", f"{base} deg"))
    columns = {"guide.direction": np.radians(DIRECTIONS)}
    swept = lw.sweep(machine, columns, outputs=NAMES, steps=72)
    study = lw.study(machine, {"guide.direction": columns["guide.direction"].tolist()}, metrics=NAMES, steps=72)
    for found in (swept, study):
        assert found[NAMES[0]][:2] == pytest.approx(ratio(), rel=1e-9)
        assert np.isnan(found[NAMES[0]][2])
        assert np.isfinite(found[NAMES[1]]).all()
    for failures, code in ((swept.failures(), "metrics.no_value"), (study.failures, "study.no_value_for")):
        (failure,) = failures
        assert failure.designs.tolist() == [2]
        assert failure.example.code == code and failure.example.values["subject"] == "guide"


def test_alternatives_are_compared_although_one_lacks_a_number() -> None:
    machines = [lw.loads(TOGGLE.replace("DIRECTION", f"{each} deg")) for each in (60, 110)]
    found = lw.compare(machines, metrics=NAMES, steps=72)
    first, last = found.rows[0].values
    assert first is not None
    assert first.value == pytest.approx(ratio(), rel=1e-9)
    assert last is None
    assert all(each is not None for each in found.rows[1].values)


def test_a_subject_that_no_design_can_have_is_refused_at_once() -> None:
    machine = lw.loads(TOGGLE.replace("DIRECTION", "60 deg"))
    columns = {"guide.direction": np.radians(DIRECTIONS)}
    with refused("metrics.no_value", name="quick_return_ratio", subject="gide", offer="guide"):
        lw.sweep(machine, columns, outputs=["quick_return_ratio gide"], steps=72)
