"""Closed forms of cross sections against numbers by hand, and put back into the stress that they keep."""

import math

import numpy as np
import pytest

from linkwright.sizing.sections import (
    buckling_stress,
    eye_width,
    gross_width,
    limit_slenderness,
    net_stress,
    net_width,
    slenderness,
)

E, RE = 210e9, 235e6


def test_width_of_a_beam() -> None:
    """M = 40 N·m, t = 6 mm, σ = 100 MPa: w² = 6 M/(t σ) = 240/600 000, w = 20 mm."""
    assert gross_width(np.array([0.0]), np.array([40.0]), 0.006, 100e6)[0] == pytest.approx(0.020)


def test_width_of_a_bar() -> None:
    """N = 6 kN, t = 6 mm, σ = 100 MPa: w = 10 mm."""
    assert gross_width(np.array([6000.0]), np.array([0.0]), 0.006, 100e6)[0] == pytest.approx(0.010)


def test_widths_keep_the_stress() -> None:
    normal, moment = np.array([0.0, 3000.0, 500.0]), np.array([20.0, 0.0, 50.0])
    gross = gross_width(normal, moment, 0.005, 80e6)
    assert normal / (0.005 * gross) + 6.0 * moment / (0.005 * gross**2) == pytest.approx(80e6)
    net = net_width(normal, moment, 0.012, 0.005, 80e6)
    area, modulus = 0.005 * (net - 0.012), 0.005 * (net**3 - 0.012**3) / (6.0 * net)
    assert normal / area + moment / modulus == pytest.approx(80e6)
    assert net_stress(normal, moment, 0.012, net, 0.005) == pytest.approx(80e6)


def test_a_bored_bar_is_wider_by_its_hole() -> None:
    """Pulled: w − d = 10 mm as above."""
    assert net_width(np.array([6000.0]), np.array([0.0]), 0.008, 0.006, 100e6)[0] == pytest.approx(0.018)


def test_eye_by_hand() -> None:
    """F = 6 kN, d = 12 mm, t = 6 mm, σ = 100 MPa: a = 6000/(2·600 000) + 8 mm = 13 mm, w = 2 a + d = 38 mm."""
    assert eye_width(6000.0, 0.012, 0.006, 100e6) == pytest.approx(0.038)


def test_euler_load_of_a_strut() -> None:
    """6 mm × 20 mm, 0.5 m, pinned: F = π² E I/L² with I = 20·6³/12 = 360 mm⁴: 2 984 N."""
    stress = buckling_stress(slenderness(0.5, 0.006), RE, E)
    assert stress * 0.006 * 0.020 == pytest.approx(math.pi**2 * 210e3 * 360.0 / 500.0**2)


def test_johnson_meets_euler_at_half_of_the_strength() -> None:
    limit = limit_slenderness(RE, E)
    assert buckling_stress(limit, RE, E) == pytest.approx(0.5 * RE)
    assert buckling_stress(limit * (1.0 - 1e-9), RE, E) == pytest.approx(0.5 * RE)
    assert buckling_stress(0.0, RE, E) == RE
