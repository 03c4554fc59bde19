"""Motion laws: derivative chains by the complex step, special cases; peak factors stand in test_published."""

from __future__ import annotations

import importlib
import itertools
import math
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import linkwright as lw
from linkwright.errors import LinkwrightError
from linkwright.laws.base import END_KINDS, MOTION_LAWS, Ends, MotionLaw
from linkwright.laws.fitting import laws_for, motion_law
from linkwright.laws.harmonics import HarmonicCombination
from linkwright.laws.polynomial import Polynomial5, Polynomial7
from linkwright.laws.residual import residual as left_over

#: Values that laws without usual ones need.
GIVEN = {
    "sine_constant_cosine": {"sine": 0.2, "constant": 0.3, "cosine": 0.3},
    "polydyne": {"ratio": 1.5, "damping_ratio": 0.05},
    "spline": {"places": (0.3, 0.6), "values": (0.2, 0.7)},
    "smoothed_table": {
        "places": (0.2, 0.4, 0.5, 0.7, 0.9),
        "values": (0.05, 0.3, 0.5, 0.85, 0.99),
        "tolerance": 0.01,
    },
    "optimized_spline": {"minimize": "acceleration"},
}
ENDS = Ends((0.7, -1.2), (3.0, 5.0))


def made(name: str) -> MotionLaw:
    return motion_law(name, **GIVEN.get(name, {}))


def test_modified_sine_with_constant_velocity_has_the_published_factors() -> None:
    """Makino, Automatic Assembly: 1.28, 8.01, 201.4 for half of constant velocity."""
    peaks = made("modified_sine_cv50").peaks
    assert (peaks.velocity, peaks.acceleration, peaks.jerk) == pytest.approx((1.28, 8.01, 201.4), rel=4e-3)
    for name in ("modified_sine_cv20", "modified_sine_cv33", "modified_sine_cv66"):
        share = {"20": 0.2, "33": 1 / 3, "66": 2 / 3}[name[-2:]]
        u = np.linspace(0.5 * (1 - share), 0.5 * (1 + share), 9)[1:-1]
        assert np.ptp(made(name).curves(u)[1]) < 1e-14


LAWS = [pytest.param(made(name), id=name) for name in MOTION_LAWS] + [
    pytest.param(motion_law("modified_sine", crossover=0.4), id="shifted"),
    pytest.param(motion_law("gutman", portion=(0.1, 0.5), backwards=True), id="portion backwards"),
    pytest.param(Polynomial5(ENDS), id="polynomial_5 of ends"),
    pytest.param(Polynomial7(ENDS), id="polynomial_7 of ends"),
    pytest.param(HarmonicCombination(ENDS), id="harmonic_combination of ends"),
]


@pytest.mark.parametrize("law", LAWS)
def test_each_curve_is_the_derivative_of_the_one_before(law: MotionLaw) -> None:
    """By the complex step, which has no cancellation: Im f(u + ih)/h for h = 1e-30."""
    u = np.random.default_rng(5).uniform(0.0, 1.0, 400)
    curves = law.curves(u + 1e-30j)
    for lower, upper in itertools.pairwise(curves):
        size = max(1.0, float(np.abs(upper.real).max()))
        assert np.abs(lower.imag / 1e-30 - upper.real).max() < 1e-12 * size
    plain = np.array(law.curves(u))
    assert plain == pytest.approx(np.array([each.real for each in curves]), rel=1e-13, abs=1e-12)


@pytest.mark.parametrize("law", LAWS)
def test_a_law_goes_from_0_to_1_without_a_jump(law: MotionLaw) -> None:
    s = np.asarray(law.curves(np.array([0.0, 1.0]))[0])
    assert s == pytest.approx([0.0, 1.0], abs=1e-12)
    for place in law.breaks:
        below, above = (np.array(law.curves(np.array([place + d])))[:2, 0] for d in (-1e-12, 1e-12))
        assert above == pytest.approx(below, abs=1e-9)


@pytest.mark.parametrize("start", END_KINDS)
@pytest.mark.parametrize("end", END_KINDS)
def test_every_pair_of_ends_has_laws_that_meet_it(start: str, end: str) -> None:
    """The sixteen pairs of VDI 2143."""
    found = laws_for(start, end)
    assert len([each for each in found if each.any_ends]) == 3
    for each in found:
        if not each.any_ends:
            assert each.law.ends.kinds == (start, end)
    wanted = Ends(
        (0.6 * (start in ("velocity", "motion")), 1.3 * (end in ("velocity", "motion"))),
        (4.0 * (start in ("turn", "motion")), -3.0 * (end in ("turn", "motion"))),
    )
    for kind in (Polynomial5, Polynomial7, HarmonicCombination):
        law = kind(wanted)
        assert law.ends.kinds == (start, end)
        assert [*law.ends.velocity, *law.ends.acceleration] == pytest.approx(
            [*wanted.velocity, *wanted.acceleration], abs=1e-9
        )


U = np.linspace(0.0, 1.0, 37)


@pytest.mark.parametrize(
    ("ends", "name"),
    [
        (Ends(), "cycloidal"),
        (Ends(acceleration=(np.pi**2 / 2, -(np.pi**2) / 2)), "simple_harmonic"),
        (Ends(acceleration=(0.0, -(np.pi**2))), "double_harmonic"),
    ],
)
def test_the_harmonic_combination_contains_the_known_laws(ends: Ends, name: str) -> None:
    assert np.array(HarmonicCombination(ends).curves(U)) == pytest.approx(
        np.array(made(name).curves(U)), abs=1e-11
    )


@pytest.mark.parametrize(
    ("shares", "name"), [((0.5, 0.0, 0.5), "cycloidal"), ((0.0, 0.0, 1.0), "simple_harmonic")]
)
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


@pytest.mark.parametrize(
    ("name", "values", "said"),
    [
        ("cycloida", {}, "did you mean"),
        ("cycloidal", {"ratio": 2.0}, "has no ratio"),
        ("polydyne", {}, "needs ratio"),
        ("polydyne", {"ratio": -1.0}, "above zero"),
        ("sine_constant_cosine", {"sine": 0.7, "constant": 0.3, "cosine": 0.3}, "add up to 1.3"),
        ("spline", {"places": (0.6, 0.3), "values": (0.1, 0.2)}, "increasing"),
        ("modified_sine", {"portion": (0.5, 0.4)}, "no rise"),
        ("double_harmonic", {"crossover": 0.4}, "symmetric"),
        ("optimized_spline", {"minimize": "velocity", "acceleration": 3.0}, "keeps these limits"),
        (
            "smoothed_table",
            {"places": tuple(0.4 + 1e-5 * k for k in range(8)), "values": (0.1, 0.9) * 4, "tolerance": 1e-6},
            "larger tolerance",
        ),
    ],
)
def test_what_is_no_law_is_refused_with_a_sentence(name: str, values: dict[str, object], said: str) -> None:
    with pytest.raises(LinkwrightError, match=said):
        _ = motion_law(name, **values).peaks  # type: ignore[arg-type]


SWIFT = '''
from dataclasses import dataclass
from typing import ClassVar
from linkwright.laws.base import MotionLaw

@dataclass(frozen=True)
class Quartic(MotionLaw):
    """s = 2u² - u⁴."""
    key: ClassVar[str] = "quartic"
    source: ClassVar[str] = "somebody's package"
    def curves(self, u):
        return 2*u**2 - u**4, 4*u - 4*u**3, 4 - 12*u**2, -24*u
'''


def test_an_installed_package_brings_a_law(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "swiftcams.py").write_text(SWIFT, "utf-8")
    info = tmp_path / "swiftcams-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: swiftcams\nVersion: 1.0\n", "utf-8")
    (info / "entry_points.txt").write_text("[linkwright.laws]\nquartic = swiftcams:Quartic\n", "utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    importlib.invalidate_caches()
    monkeypatch.setattr(MOTION_LAWS, "_discovered", False)
    try:
        assert lw.motion_law("quartic").peaks.velocity == pytest.approx(8 / 3 / 3**0.5)
        assert "quartic" in [each.name for each in laws_for("turn", "turn")]
    finally:
        MOTION_LAWS._elements.pop("quartic", None)
        module: ModuleType | None = sys.modules.pop("swiftcams", None)
        assert module is not None


@pytest.mark.parametrize(
    "law", ["constant_velocity", "constant_acceleration", "simple_harmonic", "cycloidal"]
)
def test_residual_vibration_of_very_stiff_followers_in_closed_form(law: str) -> None:
    """|∫ s̈ e^(iωt) dt|/(ωh), steps of the velocity included, over twelve thousand natural periods in a rise."""
    n = np.array([12_345.3, 123_456.3])
    exact = {
        "constant_velocity": np.abs(np.sin(math.pi * n)) / (math.pi * n),
        "constant_acceleration": 4 * np.sin(math.pi * n / 2) ** 2 / (math.pi * n) ** 2,
        "simple_harmonic": np.abs(np.cos(math.pi * n)) / (4 * n**2 - 1),
        "cycloidal": np.abs(np.sin(math.pi * n)) / (math.pi * n * (n**2 - 1)),
    }
    assert left_over(lw.motion_law(law), n) == pytest.approx(exact[law], rel=1e-6)
