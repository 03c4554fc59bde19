"""Statistics against published numbers (data sets of R; those of NIST StRD in test_published) and closed forms."""

import math
from typing import Any

import numpy as np
import pytest

from linkwright import parts

SLEEP_1 = [0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0]
SLEEP_2 = [1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4]
PLANTS = {
    "control": [4.17, 5.58, 5.18, 6.11, 4.50, 4.61, 5.17, 4.53, 5.33, 5.14],
    "first": [4.81, 4.17, 4.41, 3.59, 5.87, 3.83, 6.03, 4.89, 4.32, 4.69],
    "second": [6.31, 5.12, 5.54, 5.50, 5.37, 5.29, 4.92, 6.15, 5.80, 5.26],
}


def solved(samples: dict, **given: object) -> Any:
    held = {name: parts.Numbers(tuple(values)) for name, values in samples.items()}
    return parts.Samples(held, **given).solve()  # type: ignore[arg-type]


def test_polynomial_through_exact_values() -> None:
    x = np.linspace(0, 3, 9)
    found = solved({"x": x, "y": 2 - x + 0.5 * x**3}, regressions={"r": parts.Fitting("y", ("x",), 3)})
    assert found.regressions["r"].coefficients == pytest.approx([2, -1, 0, 0.5], abs=1e-9)


def test_several_explaining_samples() -> None:
    rng = np.random.default_rng(5)
    a, b = rng.normal(size=(2, 30))
    found = solved({"a": a, "b": b, "y": 1 + 2 * a - 3 * b}, regressions={"r": parts.Fitting("y", ("a", "b"))})
    assert found.regressions["r"].coefficients == pytest.approx([1, 2, -3], abs=1e-12)


def test_students_sleep_data() -> None:
    """t = −4.0621, p = 0.002833 paired; Welch t = −1.8608, df = 17.776, p = 0.07939 (R, ?sleep)."""
    asked = {"pair": parts.TestSpec("paired", ("a", "b")), "welch": parts.TestSpec("two_means", ("a", "b"))}
    found = solved({"a": SLEEP_1, "b": SLEEP_2}, tests=asked).tests
    assert found["pair"].statistic == pytest.approx(-4.0621, abs=5e-5)
    assert found["pair"].p == pytest.approx(0.002833, abs=5e-7)
    assert found["welch"].statistic == pytest.approx(-1.8608, abs=5e-5)
    assert found["welch"].freedom[0] == pytest.approx(17.776, abs=5e-4)
    assert found["welch"].p == pytest.approx(0.07939, abs=5e-6)


def test_plant_growth() -> None:
    """F = 4.846, p = 0.01591 (R, ?PlantGrowth)."""
    found = solved(PLANTS, tests={"all": parts.TestSpec("anova", tuple(PLANTS))}).tests["all"]
    assert found.statistic == pytest.approx(4.846, abs=5e-4)
    assert found.p == pytest.approx(0.01591, abs=5e-6)
    assert found.freedom == (2.0, 27.0)


def test_a_lognormal_fit_is_said_for_values_in_the_unit_of_the_sample() -> None:
    values = [20.012, 19.998, 20.005, 20.021, 19.991, 20.008, 20.003, 20.015]
    text = f"format: 1\nkind: statistics\nfit: [lognormal]\nsamples: {{a: {{unit: mm, values: {values}}}}}\n"
    assert f"μ(ln) = {np.log(values).mean():.6g}," in parts.loads(text).solve().text()


def test_a_coefficient_whose_probability_is_below_rounding_is_not_said_to_be_impossible() -> None:
    x = np.arange(12.0)
    found = solved({"x": x, "y": 2 * x + 1e-4 * np.sin(x)}, regressions={"r": parts.Fitting("y", ("x",))})
    assert found.regressions["r"].p[1] < 1e-12
    assert "p < 1e-12" in found.text() and "p = 0\n" not in found.text()


def test_variance_tests_by_hand() -> None:
    """(n − 1)s²/σ0² = 2.5 with 5 degrees: p = 2 P(χ² < 2.5)."""
    asked = {"v": parts.TestSpec("variance", ("x",), 2.0)}
    found = solved({"x": [9.0, 11.0, 10.0, 12.0, 8.0, 10.0]}, tests=asked).tests["v"]
    assert found.statistic == pytest.approx(2.5)
    tail = math.erf(math.sqrt(1.25)) - math.sqrt(5 / math.pi) * math.exp(-1.25) * (1 + 2.5 / 3)
    assert found.p == pytest.approx(2 * tail, rel=1e-9)
