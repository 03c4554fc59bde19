"""The demands: published paths, and paths of hidden four-bars."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkwright.synthesis.path_generation.nine_points import displacements

Complexes = NDArray[np.complex128]

FIVE = [3 + 3j, 2.759 + 3.363j, 2.372 + 3.663j, 1.89 + 3.862j, 1.355 + 3.943j]
EIGHTEEN = [
    0.5 + 1.1j,
    0.4 + 1.1j,
    0.3 + 1.1j,
    0.2 + 1j,
    0.1 + 0.9j,
    0.05 + 0.75j,
    0.02 + 0.6j,
    0.5j,
    0.4j,
    0.03 + 0.3j,
    0.1 + 0.25j,
    0.15 + 0.2j,
    0.2 + 0.3j,
    0.3 + 0.4j,
    0.4 + 0.5j,
    0.5 + 0.7j,
    0.6 + 0.9j,
    0.6 + 1j,
]
ELLIPSE = [
    20 + 10j,
    17.66 + 15.142j,
    11.736 + 17.878j,
    5 + 16.928j,
    0.60307 + 12.736j,
    0.60307 + 7.2638j,
    5 + 3.0718j,
    11.736 + 2.1215j,
    17.66 + 4.8577j,
    20 + 10j,
]
HALF_CIRCLE = [0j, 1.9098 + 5.8779j, 6.9098 + 9.5106j, 13.09 + 9.5106j, 18.09 + 5.8779j, 20 + 0j]
LINE = [20 + 1j * y for y in range(20, 50, 5)]


@dataclass(frozen=True, eq=False)
class Case:
    """A path, what else is demanded of it, and the best published sum of squares."""

    name: str
    points: Complexes
    demands: dict[str, Any] = field(default_factory=dict)
    best: float = 0.0


def published() -> list[Case]:
    """The five benchmark paths of the literature, one of them with two demands."""
    thirty = np.radians([30, 45, 60, 75, 90])
    half = np.radians(np.arange(1, 7) * 30)
    fixed = {"angles": thirty, "phase": False, "pivot": (0, 0), "direction": 0.0}
    return [
        Case("five timed, frame fixed", np.array(FIVE), fixed, 7.4157513e-7),
        Case("five timed, frame free", np.array(FIVE), {"angles": thirty, "phase": False}, 2.7108919e-7),
        Case("eighteen timed", np.array(EIGHTEEN), {"angles": np.arange(18) * np.pi / 9}, 0.0090288846),
        Case(
            "half circle timed, ±50", np.array(HALF_CIRCLE), {"angles": half, "phase": False, "bound": 50.0}, 1.3893
        ),
        Case("ellipse untimed, ±80", np.array(ELLIPSE), {"bound": 80.0}, 4.02e-4),
        Case("six on a line, untimed", np.array(LINE), {"bound": 60.0}, 1e-20),
    ]


def hidden(seed: int, count: int = 36) -> Case:
    """``count`` timed points of a hidden crank-rocker or drag link, anywhere, of any size."""
    rng = np.random.default_rng(1000 + seed)
    while True:
        a, b, c, d = rng.uniform(0.3, 3, 4)
        if abs(d - a) > abs(b - c) * 1.05 and d + a < 0.95 * (b + c):
            break
    theta = np.arange(count) * 2 * np.pi / count
    pin = a * np.exp(1j * (theta + rng.uniform(0, 2 * np.pi)))
    reach = d - pin
    square = np.abs(reach) ** 2
    t = square + b * b - c * c
    turn = reach * (t + 1j * rng.choice([-1, 1]) * np.sqrt(4 * b * b * square - t * t)) / (2 * square * b)
    path = pin + complex(*rng.uniform(-2, 2, 2)) * turn
    path = path * np.exp(1j * rng.uniform(0, 2 * np.pi)) * rng.uniform(0.5, 2) + complex(*rng.uniform(-3, 3, 2))
    return Case(f"hidden {seed}", path, {"angles": theta})


def nine_in_order(seed: int) -> tuple[Complexes, Complexes]:
    """Nine points of a hidden crank-rocker in order, and its dyads (x, X, w, W, y, Y, v, V) at the first point."""
    rng = np.random.default_rng(2000 + seed)
    while True:
        d, a, b, c = np.exp(rng.normal(size=4) * 0.5)
        lengths = np.sort([a, b, c, d])
        if lengths[0] == a and lengths[0] + lengths[3] < 0.97 * (lengths[1] + lengths[2]):
            break
    pin = a * np.exp(2j * np.pi * (np.arange(9) + 0.6 * rng.random(9)) / 9)
    reach = np.abs(d - pin)
    cosine = (b * b + reach**2 - c * c) / (2 * b * reach)
    turn = (d - pin) / reach * (cosine + 1j * np.sqrt(1 - cosine**2))
    path = pin + b * complex(*rng.normal(size=2)) * turn
    x, y = pin[0] - path[0], pin[0] + b * turn[0] - path[0]
    return path, _with_conjugates(np.array([x, -path[0] - x, y, d - path[0] - y]))


def nine_scattered(seed: int) -> tuple[Complexes, Complexes]:
    """Nine points anywhere on the curve of a hidden four-bar, on either branch, and its dyads."""
    rng = np.random.default_rng(3000 + seed)
    while True:
        dyads = _with_conjugates(rng.normal(size=4) + 1j * rng.normal(size=4))
        g = np.exp(2j * np.pi * rng.random(400)) - 1
        d, e = displacements(dyads, g, rng.choice([-1, 1], 400))
        d = d[np.abs(e - d.conj()) < 1e-9 * (1 + np.abs(d))]
        if len(d) >= 8:
            return np.concatenate([[0], d[:8]]), dyads


def _with_conjugates(z: Complexes) -> Complexes:
    return np.stack([z, z.conj()], 1).ravel()


NINE = {"crank-rockers in order": nine_in_order, "scattered points": nine_scattered}
