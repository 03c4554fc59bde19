"""Motion laws: derivative chains by the complex step, special cases; peak factors stand in test_published."""

from __future__ import annotations

import numpy as np
import pytest
from tests.refusals import refused

from linkwright.laws.base import MotionLaw
from linkwright.laws.fitting import motion_law


def made(name: str) -> MotionLaw:
    return motion_law(name)


def test_modified_sine_with_constant_velocity_has_the_published_factors() -> None:
    """Makino, Automatic Assembly: 1.28, 8.01, 201.4 for half of constant velocity."""
    peaks = made("modified_sine_cv50").peaks
    assert (peaks.velocity, peaks.acceleration, peaks.jerk) == pytest.approx((1.28, 8.01, 201.4), rel=4e-3)
    for name in ("modified_sine_cv20", "modified_sine_cv33", "modified_sine_cv66"):
        share = {"20": 0.2, "33": 1 / 3, "66": 2 / 3}[name[-2:]]
        u = np.linspace(0.5 * (1 - share), 0.5 * (1 + share), 9)[1:-1]
        assert np.ptp(made(name).curves(u)[1]) < 1e-14


U = np.linspace(0.0, 1.0, 37)


@pytest.mark.parametrize(("shares", "name"), [((0.5, 0.0, 0.5), "cycloidal"), ((0.0, 0.0, 1.0), "simple_harmonic")])
def test_the_family_contains_the_known_laws(shares: tuple[float, float, float], name: str) -> None:
    law = motion_law("sine_constant_cosine", **dict(zip(("sine", "constant", "cosine"), shares, strict=True)))
    inner = U[1:-1]
    assert np.array(law.curves(inner)) == pytest.approx(np.array(made(name).curves(inner)), abs=1e-12)


def test_optimised_splines_reach_the_known_optima() -> None:
    """Least acceleration at a jerk of 200; the least jerk is 32 (bang-bang), the least acceleration 4."""
    fast = motion_law("optimized_spline", minimize="acceleration", jerk=200.0).peaks
    assert 4.0 < fast.acceleration <= 4.4 and fast.jerk <= 200.0 * (1 + 1e-9)
    soft = motion_law("optimized_spline", minimize="jerk").peaks
    assert 32.0 <= soft.jerk < 32.1 and soft.acceleration < 8.0


def residual(law: MotionLaw, ratio: float) -> float:
    """|∫ a e^(2πinu) du| by Gauss's quadrature with twelve points in each of 256 pieces."""
    node, weight = np.polynomial.legendre.leggauss(12)
    u = ((np.arange(256)[:, None] + 0.5 + 0.5 * node) / 256).ravel()
    weights = np.tile(0.5 * weight / 256, 256)
    return float(abs(weights @ (law.curves(u)[2] * np.exp(2j * np.pi * ratio * u))))


@pytest.mark.parametrize("ratio", [1.2, 2.5])
def test_a_polydyne_cam_leaves_nothing_vibrating_at_its_speed(ratio: float) -> None:
    law = motion_law("polydyne", ratio=ratio)
    assert residual(law, ratio) < 1e-9
    assert residual(made("cycloidal"), ratio) > 0.05


def test_the_spline_of_least_residual_vibration_beats_every_other_law() -> None:
    law = motion_law("optimized_spline", minimize="residual", ratios=(1.0, 2.0))
    ratios = np.linspace(1.0, 2.0, 7)
    best = max(residual(law, n) / n for n in ratios)
    for name in ("cycloidal", "modified_sine", "polynomial_4567", "gutman"):
        assert best < 0.5 * max(residual(made(name), n) / n for n in ratios)


def test_a_smoothed_table_keeps_its_tolerance_and_is_smoother_than_the_points() -> None:
    rng = np.random.default_rng(2)
    u = np.linspace(0.02, 0.98, 49)
    exact = np.asarray(made("cycloidal").curves(u)[0])
    noisy = exact + rng.uniform(-1e-3, 1e-3, len(u))
    law = motion_law("smoothed_table", places=tuple(u), values=tuple(noisy), tolerance=1.1e-3)
    s, _, a, _ = law.curves(u)
    assert np.abs(s - noisy).max() <= 1.1e-3 * (1 + 1e-9)
    assert np.abs(a - made("cycloidal").curves(u)[2]).max() < 1.5
    assert law.ends.kinds == ("rest", "rest")
    through = motion_law("spline", places=tuple(u), values=tuple(noisy))
    assert np.abs(through.curves(u)[0] - noisy).max() < 1e-12
    assert through.peaks.jerk > 5 * law.peaks.jerk


CROWDED = {"places": tuple(0.4 + 1e-5 * k for k in range(8)), "values": (0.1, 0.9) * 4, "tolerance": 1e-6}


@pytest.mark.parametrize(
    ("name", "given", "code", "values"),
    [
        ("cycloida", {}, "names.no_such", {"name": "cycloida", "offer": "cycloidal"}),
        ("cycloidal", {"ratio": 2.0}, "laws.unknown_value", {"law": "cycloidal", "names": "ratio"}),
        ("polydyne", {}, "laws.missing_value", {"law": "polydyne", "names": "ratio"}),
        ("polydyne", {"ratio": -1.0}, "laws.polydyne", {}),
        ("sine_constant_cosine", {"sine": 0.7, "constant": 0.3, "cosine": 0.3}, "laws.shares", {"total": 1.3}),
        ("spline", {"places": (0.6, 0.3), "values": (0.1, 0.2)}, "laws.points", {"places": 2, "values": 2}),
        ("modified_sine", {"portion": (0.5, 0.4)}, "laws.portion", {"start": 0.5, "end": 0.4}),
        ("double_harmonic", {"crossover": 0.4}, "laws.crossover", {"crossover": 0.4}),
        ("optimized_spline", {"minimize": "velocity", "acceleration": 3.0}, "laws.limits_too_tight", {}),
        ("smoothed_table", CROWDED, "laws.not_smoothed", {"tolerance": 1e-6}),
    ],
)
def test_what_is_no_law_is_refused_with_a_sentence(
    name: str, given: dict[str, object], code: str, values: dict[str, object]
) -> None:
    with refused(code, **values):
        _ = motion_law(name, **given).peaks  # type: ignore[arg-type]
