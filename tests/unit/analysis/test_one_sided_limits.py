"""One-sided limits of signals beside a place where they may jump, bend or grow without bound."""

from math import inf

import numpy as np
import pytest

from linkwright.analysis.reachable_intervals import AWAY, limit, weights


def test_limits_of_what_is_smooth_kinked_and_unbounded() -> None:
    x = 0.3 * np.array([-AWAY, AWAY])  # both sides, the nearest first
    for signal, before, after in (
        (np.cos(x + 0.3), np.cos(0.3), np.cos(0.3)),
        (np.abs(np.sin(x)), 0.0, 0.0),
        (np.where(x < 0, 2.0 + x, np.exp(x)), 2.0, 1.0),
        (1.0 / x + np.cos(x), -inf, inf),
        (1.0 / x**2, inf, inf),
        (np.hypot(1.0 / np.sin(x), 3.0), inf, inf),
    ):
        assert [limit(side) for side in signal] == pytest.approx([before, after], abs=1e-7)
    jumping = np.random.default_rng(3).normal(size=x.shape)
    assert all(np.isnan(limit(side)) for side in jumping)


def test_values_between_follow_each_side() -> None:
    share = np.linspace(0.0, 1.0, 21)
    for sign in (-1.0, 1.0):
        kinked = np.abs(np.sin(0.4 * sign * AWAY)) + sign * AWAY
        expected = np.abs(np.sin(0.4 * share)) + sign * share
        np.testing.assert_allclose(weights(AWAY, share) @ kinked, expected, atol=1e-10)
