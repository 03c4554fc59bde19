"""In which order a linkage draws its curve, and how fast."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Complexes, Floats
from linkwright.synthesis.free_curve.linkages import Placed
from linkwright.synthesis.free_curve.target import columns

#: Positions of the drawn part at which order and speed are taken.
POSITIONS = 1440
#: As far as so many rms radii away a stroke counts that another direction would make unlike.
WAY = 0.2
#: Strokes both ways are one where these distances differ less: it tells nothing. Where all but this share of a curve
#: goes both ways, it is drawn as given.
UNLIKE, BOTH = 0.02, 0.02


@dataclass(frozen=True)
class Drawing:
    """How a curve is drawn.

    Args:
        along: share of the curve's length that is drawn in the direction of the given points, without strokes that
            these go both ways; 1: as given, 0: all backwards, between: strokes are drawn in another direction.
        fastest: maximum speed of the drawing point at one turn of the crank per second, m/s.
        unevenness: maximum over mean speed on the drawn part.
    """

    along: float
    fastest: float
    unevenness: float


def drawing(placed: Placed) -> Drawing:
    """Order and speed, from positions at even crank angles."""
    target, closed = placed.target, placed.target.closed
    curve, target_points = placed.curve(POSITIONS) - target.centre, target.radius * target.points
    if closed:
        curve, target_points = np.append(curve, curve[0]), np.append(target_points, target_points[0])
    steps = np.abs(np.diff(curve))
    span = 2 * np.pi if closed else float(placed.design.x[-1])
    speed = steps / (span / len(steps)) * 2 * np.pi
    with_it, against = _either_way(curve, target_points, target.radius)
    forward = steps[with_it < against - UNLIKE].sum()
    backward = steps[against < with_it - UNLIKE].sum()
    along = float(forward / (forward + backward)) if forward + backward > BOTH * steps.sum() else 1.0
    return Drawing(along, float(speed.max()), float(speed.max() / speed.mean()))


def _either_way(curve: Complexes, target_points: Complexes, radius: float) -> tuple[Floats, Floats]:
    """How far each step of the curve is from the nearest stroke that goes its way, and from one that goes against."""
    from scipy.spatial import cKDTree

    places, ways = _pieces(curve, radius)
    tree = cKDTree(np.hstack(_pieces(target_points, radius)))
    with_it, against = (tree.query(np.hstack([places, sign * ways]))[0] for sign in (1, -1))
    return with_it, against


def _pieces(line: Complexes, radius: float) -> tuple[Floats, Floats]:
    """Middles of a line's pieces in radii, and their directions, which weigh ``WAY`` radii."""
    steps = np.diff(line)
    unit = WAY * steps / np.maximum(np.abs(steps), 1e-300)
    return columns((line[1:] + line[:-1]) / (2 * radius)), columns(unit)
