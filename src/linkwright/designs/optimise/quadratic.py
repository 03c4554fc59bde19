"""Many small quadratic programs at once, by an interior-point method."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Floats

#: Most steps, the share of the mean product that is aimed at, the same after a step of at least this length, and how
#: near to the boundary a step goes.
STEPS, AIM, SOON, GOOD, NEAR = 40, 0.1, 0.01, 0.9, 0.995
#: Mean product of a row and its multiplier that ends the search.
SMALL = 1e-11
#: What is added to the diagonal, as share of its largest number, against rounding.
STEADY = 1e-13


def quadratic(
    curved: Floats, slope: Floats, rows: Floats, bounds: Floats, low: Floats, high: Floats, price: Floats
) -> tuple[Floats, Floats]:
    """The u (K, n) between ``low`` and ``high`` that make ½ u·C·u + s·u + Σ p max(l − R·u, 0) minimal, and the
    multipliers (K, m) of the rows, 0 to p.

    ``curved`` C (K, n, n), positive definite; ``slope`` s (K, n); ``rows`` R (K, m, n); ``bounds`` l (K, m);
    ``low`` < ``high``; ``price`` p (K, m), exact where it is above the multipliers.
    Source: Nocedal and Wright, *Numerical Optimization*, 2006, ch. 16.6.
    """
    (count, m), n = bounds.shape, slope.shape[1]
    own, turned = range(n), np.ascontiguousarray(rows.swapaxes(1, 2))
    u = 0.5 * (low + high)
    lack = np.maximum(bounds - _times(rows, u), 0.0) + 1.0
    force = np.minimum(1.0, 0.5 * price)
    # positive numbers in pairs whose products go to zero: multipliers in the first half, what they hold in the second
    values = np.concatenate(
        [force, price - force, np.ones((count, 2 * n)), _times(rows, u) + lack - bounds, lack, u - low, high - u],
        axis=1,
    )
    half, moves, share = 2 * (m + n), np.empty(values.shape), np.full((count, 1), AIM)
    ends = (m, 2 * m, 2 * m + n)
    force, rest, below, above = np.split(values[:, :half], ends, axis=1)
    room, lack, down, up = np.split(values[:, half:], ends, axis=1)
    for _ in range(STEPS):
        products = np.einsum("ki,ki->k", values[:, :half], values[:, half:])[:, None]
        left = products >= SMALL * half
        if not left.any():
            break
        aim = share / half * products
        stiff = force / (room + force * lack / rest)
        push = stiff * (aim / force - room - aim / rest + lack)
        pulls = np.concatenate([aim / down, aim / up, below / down, above / up], axis=1)
        matrix = curved + turned @ (stiff[:, :, None] * rows)
        matrix[:, own, own] += pulls[:, 2 * n : 3 * n] + pulls[:, 3 * n :]
        matrix[:, own, own] += STEADY * matrix[:, own, own].max(axis=1, keepdims=True)
        wanted = _times(turned, force + push) - _times(curved, u) - slope + pulls[:, :n] - pulls[:, n : 2 * n]
        du = np.linalg.solve(matrix, wanted[..., None])[..., 0]
        dforce = push - stiff * _times(rows, du)
        dlack = (aim - rest * lack + lack * dforce) / rest
        moves[:, :m], moves[:, m : 2 * m] = dforce, -dforce
        moves[:, 2 * m : half] = pulls[:, : 2 * n] - values[:, 2 * m : half]
        moves[:, 2 * m : half] -= pulls[:, 2 * n :] * np.concatenate([du, -du], axis=1)
        moves[:, half : half + m] = _times(rows, du) + dlack
        moves[:, half + m : half + 2 * m] = dlack
        moves[:, half + 2 * m : half + 2 * m + n], moves[:, half + 2 * m + n :] = du, -du
        fall = -(moves / values).min(axis=1, keepdims=True)
        step = np.where(left, np.minimum(1.0, NEAR / np.maximum(fall, 1e-300)), 0.0)
        values += step * moves
        u += step * du
        share = np.where(step > GOOD, SOON, AIM)
    return u, force


def _times(matrix: Floats, vector: Floats) -> Floats:
    return np.asarray((matrix @ vector[..., None])[..., 0])
