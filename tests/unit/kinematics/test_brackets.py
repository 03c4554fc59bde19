"""First guesses of zeros between two positions."""

import numpy as np
import pytest

from linkwright.kinematics.brackets import zero_between


def test_the_first_guess_of_a_zero_is_the_cubic_of_the_share_over_the_rate() -> None:
    """Exact where the share is a cubic of the rate, whatever its slopes; the straight line where it leaves 0…1."""
    random, inside = np.random.default_rng(7), 0
    for _ in range(60):
        a, b = random.uniform(-3.0, -0.2), random.uniform(0.2, 3.0)
        ramp, width = np.polynomial.Polynomial([-a, 1.0]) / (b - a), b - a
        slopes = random.uniform(0.1, 6.0, 2) / width
        share = ramp**2 * (3.0 - 2.0 * ramp) + width * (
            slopes[0] * ramp * (1.0 - ramp) ** 2 - slopes[1] * ramp**2 * (1.0 - ramp)
        )
        assert (share(a), share(b)) == (pytest.approx(0.0, abs=1e-12), pytest.approx(1.0, abs=1e-12))
        assert share.deriv()(np.array([a, b])) == pytest.approx(slopes)
        exact, straight = float(share(0.0)), -a / width
        good = 0.0 < exact < 1.0
        inside += good
        assert zero_between(a, b, *(1.0 / slopes)) == pytest.approx(exact if good else straight, abs=1e-12)
    assert 30 < inside < 60
    assert zero_between(-1.0, 3.0, 0.0, 1.0) == zero_between(-1.0, 3.0, 1.0, 0.0) == 0.25
