"""Inputs that were asked for in no order: what lies between positions is found along the motion all the same."""

from __future__ import annotations

from math import acos, pi

import numpy as np
import pytest

import linkwright as lw
from linkwright.analysis import metrics


def shuffled(values: np.ndarray) -> np.ndarray:
    return np.random.default_rng(7).permutation(values)


def test_limits_of_a_rocker_lie_where_crank_and_coupler_are_in_line() -> None:
    """Rocker 2.5 m on a frame of 4 m, its pin 3.5 m ± 1 m from the crank's: by the law of cosines."""
    motion = lw.solve_motion(lw.load("gallery:crank_rocker"), at=shuffled(np.linspace(0.2, 6.0, 40)))
    low, high = lw.limit_positions(motion, "rocker")
    stretched, folded = (pi - acos((4.0**2 + 2.5**2 - r**2) / (2 * 4.0 * 2.5)) for r in (4.5, 2.5))
    assert (low.kind, high.kind) == ("min", "max")
    assert [low.value, high.value] == pytest.approx([stretched, folded], abs=1e-12)
    for limit in (low, high):
        before = motion.input[limit.index]
        assert before <= limit.input
        assert not ((motion.input > before) & (motion.input <= limit.input)).any()


def test_the_range_goes_from_the_smallest_input_to_the_largest() -> None:
    motion = lw.solve_motion(lw.load("gallery:slider_crank_inline"), at=[1.0, 0.2, 2.0, 0.5])
    (way,) = metrics(motion)["range_of_motion"]
    assert (way.value, way.at) == pytest.approx((1.8, 0.2), abs=1e-12)


@pytest.mark.parametrize("name", ["crank_rocker", "jaw_crusher_sixbar", "triad"])
def test_design_numbers_do_not_hang_on_the_order(name: str) -> None:
    at, mechanism = np.linspace(0.3, 2.9, 30), lw.load(f"gallery:{name}")
    straight, mixed = (
        metrics(lw.solve_forces(lw.solve_motion(mechanism, at=values))) for values in (at, shuffled(at))
    )
    assert [(row.metric, row.subject, row.exact) for row in mixed] == [
        (row.metric, row.subject, row.exact) for row in straight
    ]
    values = np.array([[a.value, b.value] for a, b in zip(mixed, straight, strict=True)])
    np.testing.assert_allclose(values[:, 0], values[:, 1], rtol=1e-8, atol=1e-9)


def test_rows_keep_the_order_that_was_asked_for() -> None:
    """Forces and motion stay as asked; in order they follow the crank, which turns backwards."""
    at, mechanism = np.array([2.0, 0.4, 1.1, 3.0]), lw.load("gallery:jaw_crusher_sixbar")
    forces = lw.solve_forces(lw.solve_motion(mechanism, at=at))
    alone = [lw.solve_forces(lw.solve_motion(mechanism, at=[q])).input_torque[0] for q in at]
    np.testing.assert_allclose(forces.input_torque, alone, rtol=1e-12)
    np.testing.assert_allclose(forces.in_order().input_torque, np.array(alone)[[3, 0, 2, 1]], rtol=1e-12)
    np.testing.assert_array_equal(forces.motion.input, at)
