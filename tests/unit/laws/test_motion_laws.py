"""Every registered motion law: derivative chains by the complex step, ends, residual vibration, laws of packages."""

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
U = np.linspace(0.0, 1.0, 37)


def made(name: str) -> MotionLaw:
    return motion_law(name, **GIVEN.get(name, {}))


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


@pytest.mark.parametrize(
    ("ends", "name"),
    [
        (Ends(), "cycloidal"),
        (Ends(acceleration=(np.pi**2 / 2, -(np.pi**2) / 2)), "simple_harmonic"),
        (Ends(acceleration=(0.0, -(np.pi**2))), "double_harmonic"),
    ],
)
def test_the_harmonic_combination_contains_the_known_laws(ends: Ends, name: str) -> None:
    assert np.array(HarmonicCombination(ends).curves(U)) == pytest.approx(np.array(made(name).curves(U)), abs=1e-11)


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


@pytest.mark.parametrize("law", ["constant_velocity", "constant_acceleration", "simple_harmonic", "cycloidal"])
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
