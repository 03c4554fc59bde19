"""Spaces of motions, shown by the plainest motions that span them."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Floats


def plain_motions(space: Floats) -> list[Floats]:
    """A basis of the rows' space with as many zeros as can be, by elimination from the last column on."""
    rows = space.copy()
    done = 0
    for column in range(rows.shape[1] - 1, -1, -1):
        if done == len(rows):
            break
        pivot = done + int(np.abs(rows[done:, column]).argmax())
        if abs(rows[pivot, column]) < 1e-8:
            continue
        rows[[done, pivot]] = rows[[pivot, done]]
        rows[done] /= rows[done, column]
        for other in range(len(rows)):
            if other != done:
                rows[other] -= rows[other, column] * rows[done]
        done += 1
    return [np.where(np.abs(row) < 1e-9, 0.0, row) for row in rows]
