"""Poses and points: the solutions that there are, counted."""

import numpy as np
import pytest
from tests.invariants.hidden_four_bars import hidden_four_bars

from linkwright.synthesis.motion_generation.burmester import five_poses
from linkwright.synthesis.motion_generation.families import cubic
from linkwright.synthesis.motion_generation.mixed_poses import counted_solutions

pytestmark = pytest.mark.rotating


def test_hidden_four_bars_are_among_the_solutions_of_five_poses() -> None:
    p, phi, a, b = hidden_four_bars(1000, 5, 7)
    z, c, real, _ = five_poses(p, phi)
    for pin, pivot in ((a, 0.0), (b, 1.0)):
        off = np.abs(z - (pin - p[:, 0])[:, None]) + np.abs(c - (pivot - p[:, 0])[:, None])
        assert np.where(real, off, np.inf).min(1).max() < 1e-5


def test_known_pins_lie_on_the_circle_point_curve() -> None:
    p, phi, a, b = hidden_four_bars(20, 4, 11)
    d, e = p - p[:, :1], np.exp(1j * (phi - phi[:, :1]))
    for i in range(20):
        values = cubic(np.array([a[i] - p[i, 0], b[i] - p[i, 0], 0.3 + 0.2j]), d[i], e[i])
        assert np.abs(values[:2]).max() < 1e-9
        assert abs(values[2]) > 1e-6


@pytest.mark.parametrize(("poses", "count"), [(4, 30), (3, 201)])
def test_every_four_bar_of_poses_and_points_is_found(poses: int, count: int) -> None:
    """All of the published number (Brake et al. 2016: 60 and 402 with both orders), the hidden one among them."""
    rng = np.random.default_rng(poses)
    points = 10 - 2 * poses
    theta = np.sort(rng.uniform(0, 6, poses + points))
    a, b, c, d = 1.0, 2.6, 2.2, 2.9
    pin = a * np.exp(1j * theta)
    reach = np.abs(d - pin)
    turn = (d - pin) / reach * np.exp(1j * np.arccos((reach**2 + b * b - c * c) / (2 * reach * b)))
    p, phi = pin + (1.3 + 0.8j) * turn, np.angle(turn)
    given = phi.copy()
    given[rng.permutation(poses + points)[:points]] = np.nan
    found = counted_solutions(p, given)
    assert found is not None
    solutions, reached, known = found
    assert (reached, known) == (count, count)
    off = []
    for angles, pair, _ in solutions:
        far = np.abs(pair.positions - pair.centre[:, None])
        assert np.ptp(far, axis=1) == pytest.approx(0, abs=1e-8 * max(1.0, np.abs(far).max()))
        assert np.exp(1j * angles)[~np.isnan(given)] == pytest.approx(np.exp(1j * given[~np.isnan(given)]))
        off.append(np.abs(np.exp(1j * angles) - np.exp(1j * phi)).max() + np.abs(np.sort(far[:, 0]) - [a, c]).max())
    assert min(off) < 1e-7
