"""In which order a linkage draws its curve, and how fast."""

from __future__ import annotations

import numpy as np

from linkwright.core.dataclass import dataclass
from linkwright.synthesis.free_curve.linkages import Placed

#: Positions of the drawn part at which order and speed are taken.
POSITIONS = 1440


@dataclass(frozen=True)
class Drawing:
    """How a curve is drawn.

    Args:
        along: share of the curve's length that is drawn in the direction of the given points; 1: as given, 0: all
            backwards, between: strokes of the curve are drawn in another order or direction.
        fastest: greatest speed of the drawing point at one turn of the crank per second, m/s.
        unevenness: greatest over mean speed on the drawn part.
    """

    along: float
    fastest: float
    unevenness: float


def drawing(placed: Placed) -> Drawing:
    """Order and speed, from positions at even crank angles."""
    from scipy.spatial import cKDTree

    target, closed = placed.target, placed.target.closed
    given = target.centre + target.radius * target.points
    curve = placed.curve(POSITIONS)
    near = cKDTree(np.column_stack([given.real, given.imag])).query(
        np.column_stack([curve.real, curve.imag])
    )[1]
    if closed:
        curve, near = np.append(curve, curve[0]), np.append(near, near[0])
    steps, moves = np.diff(curve), np.diff(near).astype(float)
    if closed:
        moves = np.mod(moves + len(given) / 2, len(given)) - len(given) / 2
    even = 2 * np.abs(steps).sum() / len(given)
    local = np.abs(moves) * even < 4 * np.abs(steps) + 3 * even  # else the nearest stroke has changed
    forward = np.abs(steps)[local & (moves > 0)].sum()
    backward = np.abs(steps)[local & (moves < 0)].sum()
    span = 2 * np.pi if closed else float(placed.design.x[-1])
    speed = np.abs(steps) / (span / len(steps)) * 2 * np.pi
    along = float(forward / max(forward + backward, 1e-300))
    return Drawing(along, float(speed.max()), float(speed.max() / speed.mean()))
