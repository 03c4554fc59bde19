"""Small vibrations from matrices whose modes are known."""

import numpy as np
import pytest

from linkwright.dynamics.vibration import small_vibrations, stability


def test_two_masses_between_three_springs() -> None:
    """Equal masses and springs: ω² = k/m and 3k/m, in phase and against each other (Meirovitch, chapter 6)."""
    k, m, c = 200.0, 2.0, 3.0
    stiffness, mass = np.array([[2 * k, -k], [-k, 2 * k]]), m * np.eye(2)
    found = small_vibrations(mass, stiffness, c * np.eye(2))
    assert found is not None
    assert found.squares == pytest.approx([k / m, 3 * k / m])
    assert found.shapes[:, 0] == pytest.approx([1, 1])
    assert found.shapes[:, 1] == pytest.approx([1, -1])
    assert found.damping_ratios == pytest.approx([c / (2 * m * np.sqrt(k / m)), c / (2 * m * np.sqrt(3 * k / m))])
    assert sorted(np.abs(found.eigenvalues)) == pytest.approx(np.sqrt(np.repeat([k / m, 3 * k / m], 2)))
    assert stability(stiffness / k, found) == "stable"


def test_directions_without_stiffness_and_against_it() -> None:
    free = np.array([[1.0, -1.0], [-1.0, 1.0]])
    assert stability(free, small_vibrations(np.eye(2), free, np.zeros((2, 2)))) == "neutral"
    saddle = np.diag([1.0, -4.0])
    found = small_vibrations(np.eye(2), saddle, np.zeros((2, 2)))
    assert found is not None
    assert stability(saddle, found) == "unstable"
    assert found.growth_rates == pytest.approx([2.0, 0.0])
    assert np.isnan(found.frequencies).tolist() == [True, False]


def test_a_following_force_makes_it_flutter() -> None:
    """An unsymmetric stiffness with complex ω² is unstable though nothing diverges (Ziegler's rods)."""
    stiffness = np.array([[1.0, 2.0], [-2.0, 1.0]])
    found = small_vibrations(np.eye(2), stiffness, np.zeros((2, 2)))
    assert stability(stiffness, found) == "unstable"
    assert found is not None and np.isnan(found.frequencies).all()


def test_without_inertia_nothing_vibrates() -> None:
    assert small_vibrations(np.zeros((1, 1)), np.ones((1, 1)), np.zeros((1, 1))) is None
