"""One-sided limits of signals beside a place where they may jump, bend or grow without bound."""

from math import inf

import numpy as np
import pytest

from linkwright.core.piecewise import NODES
from linkwright.metrics.one_sided_limits import between, limit, sides


def test_limits_of_what_is_smooth_kinked_and_unbounded() -> None:
    x = 0.3 * NODES  # a piece of 0.6 rad
    for signal, before, after in (
        (np.cos(x + 0.3), np.cos(0.3), np.cos(0.3)),
        (np.abs(np.sin(x)), 0.0, 0.0),
        (np.where(x < 0, 2.0 + x, np.exp(x)), 2.0, 1.0),
        (1.0 / x + np.cos(x), -inf, inf),
        (1.0 / x**2, inf, inf),
        (np.hypot(1.0 / np.sin(x), 3.0), inf, inf),
    ):
        assert [limit(side) for side in sides(signal)] == pytest.approx([before, after], abs=1e-7)
    jumping = np.random.default_rng(3).normal(size=len(x))
    assert all(np.isnan(limit(side)) for side in sides(jumping))


def test_values_between_follow_each_side() -> None:
    share = np.linspace(-1.0, 1.0, 41)
    kinked = np.abs(np.sin(0.4 * NODES)) + NODES
    np.testing.assert_allclose(between(kinked, share), np.abs(np.sin(0.4 * share)) + share, atol=1e-10)
