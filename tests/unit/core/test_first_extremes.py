"""The first of equal extremes of values and polynomials, whatever rounding leaves of the other one."""

import numpy as np
import pytest

from linkwright.core.search import first_largest
from linkwright.curves.curve import Curve


def test_values_that_are_equal_but_for_rounding_are_met_at_the_first() -> None:
    values = np.array([np.nan, 3.0, -5.0, 7.0, 7.0 * (1.0 + 4e-16), 7.0])
    assert first_largest(values) == 3
    assert first_largest(-values) == 2
    assert first_largest(np.array([7.0, 7.00001])) == 1


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("pieces", [7, 24])
def test_polynomials_have_their_extremes_at_the_first_place(seed: int, pieces: int) -> None:
    """cos 2x with rounding of its size has its largest value at 0, its smallest at π/2."""
    noise = np.random.default_rng(seed)

    def function(x: np.ndarray) -> np.ndarray:
        return np.asarray(np.cos(2.0 * x) * (1.0 + 2e-16 * noise.integers(-2, 3, x.shape)))

    curve = Curve.of(function, 0.0, 2.0 * np.pi, pieces=pieces)
    for kind, place in (("max", 0.0), ("min", 0.5 * np.pi)):
        assert curve.extreme(kind).place == pytest.approx(place, abs=1e-7)
    constant = Curve(
        curve.edges, np.ones_like(curve.values) * (1.0 + 2e-16 * noise.integers(-2, 3, curve.values.shape))
    )
    assert constant.extreme("max").place == 0.0
