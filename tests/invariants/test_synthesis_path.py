"""Paths of hidden four-bars are found again, compiled and in arrays, and no other optimiser comes lower."""

from collections.abc import Iterator

import numpy as np
import pytest
from scipy.optimize import least_squares
from tests.invariants.hidden_paths import KINDS, hidden

import linkwright as lw


def relative(best: lw.Candidate, points: np.ndarray) -> float:
    return float(np.sqrt(best.error / len(points)) / np.std(points))


def cases() -> Iterator[tuple[str, bool, int, float]]:
    for kind in KINDS:
        yield kind, True, 36, 1.0 if kind in KINDS[:2] else 0.7
        yield kind, True, 9, 0.5
        yield kind, False, 14, 0.5


@pytest.mark.rotating
@pytest.mark.parametrize(("kind", "timed", "count", "share"), list(cases()))
def test_hidden_four_bars_are_found_again(kind: str, timed: bool, count: int, share: float) -> None:
    rng = np.random.default_rng(11)
    for seed in range(1 + timed):
        points, theta = hidden(rng, kind, count, share)
        angles = {"angles": theta} if timed else {}
        best = lw.path_generation(points, turning=kind in KINDS[:2], seed=seed, **angles).best
        assert relative(best, points) < (1e-9 if timed else 1e-3)


@pytest.mark.rotating
def test_noise_leaves_the_least_that_other_descents_find() -> None:
    """From the hidden four-bar itself, and from the solution, SciPy's least squares goes no lower."""
    rng = np.random.default_rng(4)
    points, theta = hidden(rng, "crank_rocker", 20, 1.0)
    points = points + 0.03 * np.std(points) * (rng.normal(size=20) + 1j * rng.normal(size=20))
    found = [lw.path_generation(points, angles=theta, seed=seed).best.error for seed in range(3)]
    assert found == pytest.approx([found[0]] * 3, rel=1e-9)

    def off(x: np.ndarray) -> np.ndarray:
        b, c, d = np.exp(x[:3])
        pin = np.exp(1j * (theta + x[3]))
        square = np.abs(d - pin) ** 2
        t = square + b * b - c * c
        turn = (d - pin) * (t + 1j * x[10] * np.sqrt(np.maximum(4 * b * b * square - t * t, 0))) / (2 * b * square)
        z = x[4] + 1j * x[5] + (x[6] + 1j * x[7]) * pin + (x[8] + 1j * x[9]) * turn - points
        return np.concatenate([z.real, z.imag])

    for _ in range(10):
        start = np.concatenate([rng.normal(1, 0.5, 3), rng.uniform(0, 7, 1), rng.normal(0, 1, 6)])
        side = rng.choice([-1.0, 1.0])
        tried = least_squares(lambda x, side=side: off(np.append(x, side)), start, max_nfev=200)
        assert 2 * tried.cost > found[0] * (1 - 1e-9) or not _turns(np.exp(tried.x[:3]))


def _turns(lengths: np.ndarray) -> bool:
    b, c, d = lengths
    return bool(b + c > d + 1 and abs(b - c) < abs(d - 1))
