"""Whether cores of shapes overlap at some positions, also where the outline of none comes near that of the other."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from linkwright.collisions.features import PairsOfShapes, spread
from linkwright.collisions.relative_paths import RelativePaths
from linkwright.core.arrays import Complexes, Flags, Floats, Indices
from linkwright.shapes.distance import core_distances
from linkwright.shapes.shape import Shape


class Overlaps:
    """Tells of pairs of shapes whether their cores overlap at places of pieces of their paths.

    Cores overlap where two sides cross, or the first corner of a ring of one lies within the other (by the even-odd
    rule).

    ``circles`` around the shapes: their centres (pairs, 2), m, and both radii together; ``pose``: that of each pair.
    """

    def __init__(self, pairs: PairsOfShapes, shapes: Sequence[tuple[Shape, Shape]], paths: RelativePaths) -> None:
        self._paths, self._outlines, count = paths, pairs.outlines, len(shapes)
        self._shapes = shapes
        self.pose = np.zeros(count, dtype=np.intp)
        crossing: list[list[tuple[int, ...]]] = [[] for _ in shapes]
        inside: list[list[tuple[int, ...]]] = [[] for _ in shapes]
        for pair, pose, one, other in pairs.pieces:
            self.pose[pair] = pose
            if not (one.point or other.point):
                crossing[pair].append((*one.sides, *other.sides))
            for seen, against, own in ((other, one, 0), (one, other, 1)):
                if against.filled:
                    inside[pair] += [(ring, *against.sides, own) for ring in seen.rings]
        self._crossing, self._inside = _Listed(crossing, 4), _Listed(inside, 4)
        circles = [(first.bound, second.bound) for first, second in shapes]
        centres = np.array([[one[0], other[0]] for one, other in circles])
        self.circles = centres, np.array([one[1] + other[1] for one, other in circles])

    def at(self, pair: Indices, piece: Indices, x: Floats) -> Flags:
        """Whether the cores of some pairs overlap at places of pieces, (n,)."""
        found = np.zeros(len(pair), dtype=np.bool_)
        place, turn = self._paths.pose(self.pose[pair], piece, x)
        centres, reach = self.circles
        apart = np.abs(place + turn * centres[pair, 1] - centres[pair, 0])
        near = np.flatnonzero(apart <= reach[pair])
        place, turn = place[near], turn[near]
        found[near] = self._crossed(pair[near], place, turn) | self._within(pair[near], place, turn)
        return found

    def places(self, pair: Indices, piece: Indices, x: Floats) -> Complexes:
        """A place within both cores of each of some pairs that overlap, m, in the axes of the first."""
        place, turn = self._paths.pose(self.pose[pair], piece, x)
        poses = zip(pair.tolist(), place.tolist(), turn.tolist(), strict=True)
        found = [common(self._shapes[k][0], self._shapes[k][1], at, way) for k, at, way in poses]
        return np.array(found, dtype=complex)

    def _crossed(self, pair: Indices, place: Complexes, turn: Complexes) -> Flags:
        """Whether a side of one crosses a side of the other."""
        query, (begin, end, first, last) = self._crossing.of(pair)
        across = last - first
        job, number = spread((end - begin) * across)
        own = self._outlines
        one, other = begin[job] + number // across[job], first[job] + number % across[job]
        query = query[job]
        start, along = place[query] + turn[query] * own.begin[other], turn[query] * own.along[other]
        at, way = own.begin[one], own.along[one]
        opposite = _sides(start - at, start + along - at, way) & _sides(at - start, at + way - start, along)
        return np.bincount(query[opposite], minlength=len(pair)) > 0

    def _within(self, pair: Indices, place: Complexes, turn: Complexes) -> Flags:
        """Whether a ring of one begins within the other."""
        query, (ring, begin, end, back) = self._inside.of(pair)
        own, turned = self._outlines, turn[query]
        corner = own.corner[ring]
        point = np.where(back == 1, turned.conj() * (corner - place[query]), place[query] + turned * corner)
        job, number = spread(end - begin)
        side = begin[job] + number
        away, along = own.begin[side] - point[job], own.along[side]
        low, high = away.imag, away.imag + along.imag
        with np.errstate(divide="ignore", invalid="ignore"):
            right = away.real - low * along.real / along.imag > 0.0
        hit = ((low > 0.0) != (high > 0.0)) & right
        odd = np.bincount(job[hit], minlength=len(query)) % 2 == 1
        return np.bincount(query[odd], minlength=len(pair)) > 0


def common(first: Shape, second: Shape, place: complex, turn: complex) -> complex:
    """A place within the cores of both shapes, m, in the axes of the first; ``place``, ``turn``: of the second there.

    It is a corner of one core within the other, or else where two sides cross.
    """
    sides, others = (np.concatenate([each.sides for each in shape.pieces]) for shape in (first, second))
    others = place + turn * others
    corners = np.concatenate([sides[:, 0], sides[:, 1], others[:, 0], others[:, 1]])
    away = _away(first, corners) + _away(second, np.conj(turn) * (corners - place))
    nearest = int(np.argmin(away))
    if away[nearest] == 0.0:
        return complex(corners[nearest])
    at, way = sides[:, 0, None], (sides[:, 1] - sides[:, 0])[:, None]
    start, along = others[:, 0] - at, others[:, 1] - others[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        shares = [(np.conj(each) * start).imag / (np.conj(along) * way).imag for each in (along, way)]
        crossing = np.argwhere((abs(shares[0] - 0.5) <= 0.5) & (abs(shares[1] - 0.5) <= 0.5))
    if len(crossing):
        one, other = crossing[0]
        return complex(sides[one, 0] + shares[0][one, other] * (sides[one, 1] - sides[one, 0]))
    return complex(corners[nearest])


def _away(shape: Shape, points: Complexes) -> Floats:
    """Distances of points from the cores of a shape, m."""
    return np.asarray(np.min([core_distances(each, points) for each in shape.pieces], axis=0))


class _Listed:
    """Rows of whole numbers of every pair behind each other."""

    def __init__(self, rows: list[list[tuple[int, ...]]], width: int) -> None:
        self._count = np.array([len(each) for each in rows], dtype=np.intp)
        self._first = np.cumsum(self._count) - self._count
        self._rows = np.array([row for each in rows for row in each], dtype=np.intp).reshape(-1, width)

    def of(self, pair: Indices) -> tuple[Indices, Indices]:
        """The rows of some pairs, (width, m), with the number in ``pair`` to which each belongs."""
        query, number = spread(self._count[pair])
        return query, self._rows[self._first[pair[query]] + number].T


def _sides(one: Complexes, other: Complexes, along: Complexes) -> Flags:
    """Whether two points, seen from the beginning of a segment, lie on different sides of its line."""
    return np.asarray((np.conj(along) * one).imag * (np.conj(along) * other).imag < 0.0)
