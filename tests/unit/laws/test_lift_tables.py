"""Lifts of cams from tables of few digits."""

from __future__ import annotations

import numpy as np
import pytest

from linkwright.laws.traced import LiftCurve


@pytest.mark.parametrize("digits", [3, 5, 8])
def test_a_table_of_few_digits_rests_wherever_it_begins(digits: int) -> None:
    """Rise, dwell and fall from the cycloidal law, rounded; the table may begin anywhere in the turn."""
    angles = np.radians(np.arange(0.0, 360.0, 5.0) + 1.0)
    rise = np.clip(angles / 2.0, 0.0, 1.0) - np.clip((angles - 4.0) / 2.0, 0.0, 1.0)
    lifts = np.round(rise - np.sin(2 * np.pi * rise) / (2 * np.pi), digits)
    for shift in range(0, len(angles), 9):
        rolled = np.roll(lifts, shift)
        curve = LiftCurve.through(angles.tolist(), rolled.tolist())
        assert curve.curves(angles)[0] == pytest.approx(rolled, abs=1e-13)
        still = np.roll((angles > 2.1) & (angles < 3.8), shift)
        assert not curve.curves(angles[still] + 0.01)[1].any()
