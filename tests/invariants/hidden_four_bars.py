"""Poses of couplers of four-bars that are to be found again."""

import numpy as np


def hidden_four_bars(count: int, poses: int, seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Places and angles of couplers of random four-bars, and their pins A and B at the first pose, pivots 0 and 1."""
    rng = np.random.default_rng(seed)
    places, angles, pins, others = [], [], [], []
    while len(places) < count:
        a, b, c = rng.uniform(0.3, 2.0, 3)
        theta = np.sort(rng.uniform(0, 2 * np.pi, poses))
        pin = a * np.exp(1j * theta)
        reach = np.abs(1 - pin)
        cosine = (reach**2 + b**2 - c**2) / (2 * reach * b)
        if np.abs(cosine).max() > 0.98:
            continue
        turn = (1 - pin) / reach * np.exp(1j * np.arccos(cosine))
        body = complex(*rng.normal(0, 1, 2))
        places.append(pin + body * turn)
        angles.append(np.angle(turn))
        pins.append(pin[0])
        others.append(pin[0] + b * turn[0])
    return np.array(places), np.array(angles), np.array(pins), np.array(others)
