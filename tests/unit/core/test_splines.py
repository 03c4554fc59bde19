"""Own cubic splines against SciPy's, against polynomials that they must reproduce, and in driver tables."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from linkwright.core.spline import Spline
from linkwright.drivers.table import TableLaw

COUNTS = (2, 3, 4, 5, 6, 25, 400)


def knots(count: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    return np.cumsum(rng.uniform(0.1, 2.0, count)) - 3.0, rng.normal(size=count)


@pytest.mark.rotating
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("count", COUNTS)
def test_it_is_the_spline_of_scipy(count: int, seed: int) -> None:
    x, y = knots(count, seed)
    t = np.linspace(x[0] - 0.3, x[-1] + 0.3, 401)
    reference = CubicSpline(x, y)
    for order, found in enumerate(Spline.not_a_knot(x, y)(t)):
        expected = reference(t, order)
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12 * max(1.0, np.abs(expected).max()))


@pytest.mark.rotating
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("count", COUNTS)
def test_the_periodic_one_is_that_of_scipy(count: int, seed: int) -> None:
    x, y = knots(count, seed)
    y[-1] = y[0]
    t = np.linspace(x[0] - 7.0, x[-1] + 7.0, 401)
    reference = CubicSpline(x, y, bc_type="periodic")
    for order, found in enumerate(Spline.periodic(x, y)(t)):
        expected = reference(t, order)
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12 * max(1.0, np.abs(expected).max()))


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_polynomials_up_to_the_third_degree_come_back(degree: int) -> None:
    x, _ = knots(7, 4)
    curve = np.polynomial.Polynomial([0.3, -1.2, 0.7, 0.4][: degree + 1])
    t = np.linspace(x[0], x[-1], 200)
    for order, found in enumerate(Spline.not_a_knot(x, curve(x))(t)):
        np.testing.assert_allclose(found, curve.deriv(order)(t) if order else curve(t), rtol=0, atol=2e-12)


@pytest.mark.parametrize("first", [0.0, 0.7, -2.5])
def test_a_periodic_table_with_drift_gains_it_every_period(first: float) -> None:
    """A shaft that turns once per period and wobbles: q = 2πt/T + 0.1 sin(2πt/T), known with both rates."""
    period = 0.8
    times = first + np.linspace(0.0, period, 41)
    turn = 2 * np.pi / period

    def shaft(t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        phase = turn * t
        return phase + 0.1 * np.sin(phase), turn * (1 + 0.1 * np.cos(phase)), -0.1 * turn**2 * np.sin(phase)

    law = TableLaw(tuple(times.tolist()), tuple(shaft(times)[0].tolist()), "periodic")
    t = np.linspace(-3.3, 5.1, 500)
    h, fourth = period / 40, 0.1 * turn**4  # bounds of Hall and Meyer (1976)
    bounds = (5 / 384 * h**4 * fourth, h**3 / 24 * fourth, 3 / 8 * h**2 * fourth)
    for found, expected, error in zip(law.coordinate(t), shaft(t), bounds, strict=True):
        np.testing.assert_allclose(found, expected, rtol=0, atol=error)
    before, after = law.coordinate(t), law.coordinate(t + 3 * period)
    np.testing.assert_allclose(after[0] - before[0], 3 * 2 * np.pi, rtol=0, atol=1e-10)
    np.testing.assert_allclose(after[1], before[1], rtol=0, atol=1e-8)
    assert law.span() == (-np.inf, np.inf)
