"""Paths of four-bars that are to be found again."""

import numpy as np

KINDS = ("crank_rocker", "double_crank", "double_rocker", "triple_rocker")


def hidden(rng: np.random.Generator, kind: str, count: int, share: float) -> tuple[np.ndarray, np.ndarray]:
    """Points and crank angles of a random four-bar of a kind, over a share of its input's range."""
    while True:
        lengths = a, b, c, d = np.exp(rng.normal(0, 0.5, 4))
        s, p, q, m = np.sort(lengths)
        grashof = s + m < 0.97 * (p + q)
        turning = {0: "crank_rocker", 1: "double_rocker", 3: "double_crank"}
        if m < 0.95 * (s + p + q) and kind == (turning.get(int(np.argmin(lengths))) if grashof else "triple_rocker"):
            break
    low, high = ((a * a + d * d - (b + side * c) ** 2) / (2 * a * d) for side in (1, -1))
    first, last = np.arccos(np.clip([high, low], -1, 1))
    if kind in KINDS[:2]:
        first, last = rng.uniform(0, 2 * np.pi) + np.array([0, 2 * np.pi])
    theta = first + (last - first) * ((1 - share) / 2 + share * np.arange(count) / count)
    pin = a * np.exp(1j * theta)
    square = np.abs(d - pin) ** 2
    t = square + b * b - c * c
    turn = (d - pin) * (t + 1j * rng.choice([-1, 1]) * np.sqrt(4 * b * b * square - t * t)) / (2 * b * square)
    path = pin + complex(*rng.normal(0, b, 2)) * turn
    return path * np.exp(1j * rng.uniform(0, 7)) * rng.uniform(0.5, 2) + complex(*rng.uniform(-3, 3, 2)), theta
