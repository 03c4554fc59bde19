"""The assembly that a rough drawing shows: of all that close, the one whose points lie nearest to the drawn ones."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.kinematics.closed_loops import ClosedLoops

#: Largest change of a coordinate in one step, and the change at which it is found: rad, or share of the size.
LARGEST, FOUND = 0.3, 1e-6
STEPS = 100
#: Below this share of the largest singular value the loops depend on each other.
RANK = 1e-14
#: Weight of the changes of coordinates against the squared distances of points, which holds what no point shows.
HOLD = 1e-6
#: Share of the promised descent that a step must bring (Armijo), and the smallest part of a step that is tried.
DESCENT, SMALLEST = 1e-4, 2.0**-12


def nearest_assembly(
    loops: ClosedLoops, points: ClosedLoops, rough: Floats, scale: Floats, free: Flags
) -> Floats | None:
    """Coordinates y (n + d,) near ``rough`` that close the loops with the smallest squared distances of ``points``;
    None where none are found. ``scale`` (n + d,): unit of every coordinate; ``free`` (n + d,): which of them may
    change.

    Gauss–Newton with the closed loops as equality constraints, along which the exact penalty falls (Björck, Numerical
    Methods for Least Squares Problems, ch. 9.3; Nocedal and Wright, Numerical Optimization, ch. 18.4).
    """
    y, unit, penalty = rough.copy(), scale * free, 0.0
    count, rows = len(y), 2 * loops.K
    matrix = np.zeros((count + rows, count + rows))

    def worth(y: Floats) -> float:
        off, gap = points.linear(y)[0] / loops.size, loops.linear(y)[0] / loops.size
        return float(0.5 * off @ off + penalty * np.abs(gap).sum())

    for _ in range(STEPS):
        off, slopes = (each / loops.size for each in points.linear(y))
        gap, closing = (each / loops.size for each in loops.linear(y))
        slopes, closing = slopes * unit[:, None], closing * unit[:, None]
        matrix[:count, :count] = slopes @ slopes.T + HOLD * np.eye(count)
        matrix[:count, count:], matrix[count:, :count] = closing, closing.T
        solved = np.asarray(np.linalg.lstsq(matrix, -np.concatenate([slopes @ off, gap]), rcond=RANK)[0])
        step, size = solved[:count], float(np.abs(solved[:count]).max())
        if size < FOUND:
            return np.asarray(y + step * unit)
        penalty = max(penalty, 2.0 * float(np.abs(solved[count:]).max(initial=0.0)))
        falls, here = float(slopes @ off @ step) - penalty * float(np.abs(gap).sum()), worth(y)
        share = min(1.0, LARGEST / size)
        while share > SMALLEST and worth(y + share * step * unit) > here + DESCENT * share * falls:
            share *= 0.5
        y += share * step * unit
    return None
