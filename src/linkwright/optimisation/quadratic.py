"""Many small quadratic programs at once, by an interior-point method."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
#: Most steps, the share of the mean product that is aimed at, and how near to the boundary a step goes.
STEPS, AIM, NEAR = 40, 0.1, 0.995
#: Mean product of a row and its multiplier that ends the search.
SMALL = 1e-11
#: What is added to the diagonal, as share of its largest number, against rounding.
STEADY = 1e-13


def quadratic(
    curved: Floats, slope: Floats, rows: Floats, least: Floats, low: Floats, high: Floats, price: Floats
) -> tuple[Floats, Floats]:
    """The u (K, n) between ``low`` and ``high`` that make ½ u·C·u + s·u + Σ p max(l − R·u, 0) least, and the
    multipliers (K, m) of the rows, 0 to p.

    ``curved`` C (K, n, n), positive definite; ``slope`` s (K, n); ``rows`` R (K, m, n); ``least`` l (K, m);
    ``low`` < ``high``; ``price`` p (K, m), exact where it is above the multipliers.
    Source: Nocedal and Wright, *Numerical Optimization*, 2006, ch. 16.6.
    """
    count = 2 * (least.shape[1] + slope.shape[1])
    u, own = 0.5 * (low + high), range(slope.shape[1])
    down, up = u - low, high - u
    lack = np.maximum(least - _times(rows, u), 0.0) + 1.0
    room = _times(rows, u) + lack - least
    force = np.minimum(1.0, 0.5 * price)
    rest = price - force
    below, above = np.ones(u.shape), np.ones(u.shape)
    for _ in range(STEPS):
        products = (force * room + rest * lack).sum(1) + (below * down + above * up).sum(1)
        left = products >= SMALL * count
        if not left.any():
            break
        aim = AIM / count * products[:, None]
        stiff = force / (room + force * lack / rest)
        push = stiff * (aim / force - room - aim / rest + lack)
        matrix = curved + rows.swapaxes(1, 2) @ (stiff[:, :, None] * rows)
        matrix[:, own, own] += below / down + above / up
        matrix[:, own, own] += STEADY * matrix[:, own, own].max(axis=1, keepdims=True)
        wanted = _times(rows.swapaxes(1, 2), force + push) - _times(curved, u) - slope + aim / down - aim / up
        du = np.linalg.solve(matrix, wanted[..., None])[..., 0]
        dforce = push - stiff * _times(rows, du)
        dlack = (aim - rest * lack + lack * dforce) / rest
        droom = _times(rows, du) + dlack
        dbelow, dabove = aim / down - below - below / down * du, aim / up - above + above / up * du
        values = (force, rest, room, lack, below, above, down, up)
        moves = (dforce, -dforce, droom, dlack, dbelow, dabove, du, -du)
        fall = np.max([(-move / value).max(1) for value, move in zip(values, moves, strict=True)], axis=0)
        step = np.where(left, np.minimum(1.0, NEAR / np.maximum(fall, 1e-300)), 0.0)[:, None]
        force, rest, room, lack, below, above, down, up = (
            value + step * move for value, move in zip(values, moves, strict=True)
        )
        u = u + step * du
    return u, force


def _times(matrix: Floats, vector: Floats) -> Floats:
    return np.asarray((matrix @ vector[..., None])[..., 0])
