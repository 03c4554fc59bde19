"""Smallest gaps between all that takes room in a six-bar, against shapely in many positions."""

from __future__ import annotations

from functools import partial
from itertools import combinations

import numpy as np
import shapely
from numpy.typing import NDArray

import linkwright as lw
from benchmarks.timing import Candidate
from linkwright.collisions.gaps import Gap, Moving, smallest_gaps
from linkwright.kinematics.placement import placements
from linkwright.solids.solids_of import solids

SOLVED, ALL, DENSE = "smallest gaps, motion solved", "the same with solving", "shapely"
#: Positions of the sweep with shapely, and those of its share that is timed.
POSITIONS, FEW = 7200, 720

Lines = list[tuple[NDArray[np.object_], float]]


class SixbarGaps:
    """All pairs of solids of the Watt six-bar whose contact is not meant."""

    def __init__(self) -> None:
        self.mechanism = lw.load("gallery:watt_sixbar")
        found = solids(self.mechanism)
        moving = {name: Moving(each.carrier, each.shape) for name, each in found.by_name.items()}
        names = (each for each in combinations(moving, 2) if (min(each), max(each)) not in found.joined)
        self.pairs = [(moving[first], moving[second]) for first, second in names]
        self.motion = lw.solve_motion(self.mechanism)
        self.moving = list(moving.values())

    def ours(self) -> list[Gap]:
        """The gaps, the motion solved."""
        return smallest_gaps(self.motion, self.pairs)

    def ours_with_motion(self) -> list[Gap]:
        """The gaps of a motion that is solved anew."""
        return smallest_gaps(lw.solve_motion(self.mechanism), self.pairs)

    def dense(self, positions: int) -> NDArray[np.float64]:
        """Smallest distances (pairs,) in so many positions by shapely, 0 where cores overlap."""
        motion = lw.solve_motion(self.mechanism, steps=positions)
        placed = placements(motion)
        drawn = {
            id(each): _drawn(each, placed[each.carrier].origin, placed[each.carrier].direction)
            for each in self.moving
        }
        found = [
            min((shapely.distance(a, b) - ra - rb).min() for a, ra in drawn[id(one)] for b, rb in drawn[id(other)])
            for one, other in self.pairs
        ]
        return np.maximum(found, 0.0)

    def candidates(self) -> list[Candidate]:
        """Ours with and without solving, and shapely's."""
        share, note = FEW / POSITIONS, f"{FEW} of {POSITIONS} positions, scaled"
        return [
            Candidate(SOLVED, self.ours),
            Candidate(ALL, self.ours_with_motion),
            Candidate(DENSE, partial(self.dense, FEW), share, note),
        ]

    def disagreement(self) -> tuple[float, float]:
        """How much larger, and how much smaller, than shapely's our gaps are at most, m."""
        off = np.array([gap.size for gap in self.ours()]) - self.dense(POSITIONS)
        return float(off.max()), float(-off.min())


def _drawn(moving: Moving, origin: NDArray[np.float64], direction: NDArray[np.float64]) -> Lines:
    """Shapely's geometries of a shape at all positions, and their radii."""
    place, turn = (rows[:, 0] + 1j * rows[:, 1] for rows in (origin, direction))
    found: Lines = []
    for piece in moving.shape.pieces:
        corners = place[:, None] + turn[:, None] * piece.rings[0]
        rows = np.stack([corners.real, corners.imag], axis=-1)
        if piece.filled:
            drawn = shapely.polygons(shapely.linearrings(rows))
        else:
            drawn = shapely.linestrings(rows) if len(piece.corners) > 1 else shapely.points(rows[:, 0])
        found.append((drawn, piece.radius))
    return found
