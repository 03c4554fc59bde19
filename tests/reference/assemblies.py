"""All assemblies of a mechanism at one input that Newton's method finds, with the independent code."""

from __future__ import annotations

import numpy as np
from tests.reference.adapter import driver_values, reference_system, starting_position
from tests.reference.multibody import Array, Unreachable

import linkwright as lw


def other_assemblies(mechanism: lw.Mechanism, tries: int = 150) -> tuple[Array, list[Array]]:
    """The drawn assembly and all others that Newton's method finds at the same input, with the reference code."""
    system = reference_system(mechanism)
    start, u = starting_position(mechanism, system, driver_values(mechanism, np.zeros(1))[0][0])
    weak = np.linalg.svd(system.jacobian(start)[:, 3:])[2][-1].reshape(-1, 3)
    rng = np.random.default_rng(1)
    guesses = [share * weak / np.abs(weak[:, 2]).max() for share in np.linspace(-0.5, 0.5, 51)]
    guesses += [rng.normal(size=weak.shape) for _ in range(tries)]
    found: list[Array] = []
    for guess in guesses:
        q = start.copy()
        q[1:] += guess
        try:
            q = system.assemble(q, u)
        except Unreachable:
            continue
        if all(distance(q, known) > 1e-7 for known in [start, *found]):
            found.append(q)
    return start, found


def distance(a: Array, b: Array) -> float:
    """Largest difference of a link's direction, rad."""
    return float(np.abs(np.angle(np.exp(1j * (a - b)[:, 2]))).max())
