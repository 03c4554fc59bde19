"""Descriptions, fits and capability of samples by hand."""

import math

import numpy as np
import pytest

from linkwright.parts.statistics.methods import capability, described, fitted


def test_description_by_hand() -> None:
    d = described(np.array([2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0]))
    assert (d.mean, d.deviation) == pytest.approx((5.0, math.sqrt(32 / 7)))
    assert d.quartiles == pytest.approx((4.0, 4.5, 5.5))
    assert d.skewness == pytest.approx(5.25 / 8) and d.kurtosis == pytest.approx(44.5 / 16 - 3.0)


def test_fits_by_closed_forms_of_maximum_likelihood() -> None:
    x = np.array([1.2, 0.7, 3.1, 2.2, 0.9, 1.8, 1.1, 2.7, 1.5])
    assert fitted(x, "exponential").parameters["mean"] == pytest.approx(x.mean(), rel=1e-6)
    normal, log = fitted(x, "normal").parameters, fitted(x, "lognormal").parameters
    assert (normal["μ"], normal["σ"]) == pytest.approx((x.mean(), x.std()), rel=1e-9)
    assert (log["μ(ln)"], log["σ(ln)"]) == pytest.approx((np.log(x).mean(), np.log(x).std()), rel=1e-12)
    k, scale = fitted(x, "weibull").parameters.values()
    assert scale == pytest.approx(float((x**k).mean() ** (1 / k)), rel=1e-12)
    assert 1 / k == pytest.approx(float((x**k * np.log(x)).sum() / (x**k).sum() - np.log(x).mean()), rel=1e-12)


def test_capability_by_hand() -> None:
    x = np.array([9.0, 11.0, 10.0, 12.0, 8.0, 10.0])
    c = capability(x, 4.0, 18.0, None, 0.95)
    s = math.sqrt(2.0)
    assert c.cp == pytest.approx(14 / (6 * s)) and c.cpk == pytest.approx(6 / (3 * s))
    within = capability(x, 4.0, 18.0, 2, 0.95)
    assert within.deviation == pytest.approx(math.sqrt((2.0 + 2.0 + 2.0) / 3))
