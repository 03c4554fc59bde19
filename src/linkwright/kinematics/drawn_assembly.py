"""The assembly that a rough drawing shows: of all that close, the one whose points lie nearest to the drawn ones."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.kinematics.closed_loops import ClosedLoops

#: Largest change of a coordinate in one step, and the change at which it is found: rad, or share of the size.
LARGEST, FOUND = 0.3, 1e-11
STEPS = 40
#: Weight of the changes of coordinates against the squared distances of points, which holds what no point shows.
HOLD = 1e-6


def nearest_assembly(
    loops: ClosedLoops, points: ClosedLoops, rough: Floats, scale: Floats, free: Flags
) -> Floats | None:
    """Coordinates y (n + d,) near ``rough`` that close the loops with the smallest squared distances of ``points``;
    None where none are found. ``scale`` (n + d,): unit of every coordinate; ``free`` (n + d,): which of them may
    change.

    Gauss–Newton with the closed loops as equality constraints (Björck, Numerical Methods for Least Squares Problems,
    ch. 9.3).
    """
    y, unit = rough.copy(), (scale * free)[:, None]
    count, rows = len(y), 2 * loops.K
    matrix = np.zeros((count + rows, count + rows))
    for _ in range(STEPS):
        off, slopes = (each / loops.size for each in points.linear(y))
        gap, closing = (each / loops.size for each in loops.linear(y))
        slopes, closing = slopes * unit, closing * unit
        matrix[:count, :count] = slopes @ slopes.T + HOLD * np.eye(count)
        matrix[:count, count:], matrix[count:, :count] = closing, closing.T
        try:
            step = np.linalg.solve(matrix, -np.concatenate([slopes @ off, gap]))[:count]
        except np.linalg.LinAlgError:
            return None
        size = float(np.abs(step).max())
        if not np.isfinite(size):
            return None
        y += step * min(1.0, LARGEST / max(size, LARGEST)) * unit[:, 0]
        if size < FOUND:
            return y
    return None
