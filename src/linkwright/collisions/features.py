"""Corners and sides of shapes, and which corners of one shape may come near to which sides of another."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from linkwright.collisions.columns import Columns
from linkwright.core.arrays import Complexes, Floats, Indices
from linkwright.shapes.shape import Piece, Shape

#: Corners, or sides, that are taken together where shapes have many, and the number of pairs from which they are.
TOGETHER, MANY = 8, 150


def spread(count: Indices) -> tuple[Indices, Indices]:
    """For every one of ``count`` (k,) elements of groups the number of its group and its own in it."""
    group = np.repeat(np.arange(len(count)), count)
    return group, np.arange(len(group)) - np.repeat(np.cumsum(count) - count, count)


@dataclass(frozen=True)
class Part:
    """Numbers of a piece's corners and sides among those of all, and of its groups of these."""

    corners: tuple[int, int]
    sides: tuple[int, int]
    corner_groups: tuple[int, int]
    side_groups: tuple[int, int]
    rings: tuple[int, ...]
    filled: bool
    point: bool


class Outlines:
    """The corners (complex m) and sides of the pieces of some shapes, each once.

    ``corner``, ``corner_radius`` of its piece; ``begin``, ``along`` (end less begin), ``side_radius``. Behind corners
    and sides come groups of them, within ``corner_slack`` (``side_slack``), which is 0 of the former; the members of
    a group are those from ``first_corner`` (``first_side``) on, as many as ``corner_members`` (``side_members``).
    """

    def __init__(self, shapes: Iterable[Shape]) -> None:
        self.parts: dict[int, list[Part]] = {}
        self._shapes = list(shapes)
        corners, sides = _Rows(), _Rows()
        pieces = {id(piece): piece for shape in self._shapes for piece in shape.pieces}
        own = {
            key: (corners.add(piece.corners, piece.radius), sides.add(piece.sides, piece.radius))
            for key, piece in pieces.items()
        }
        self._fine_corners, self._fine_sides = corners.count, sides.count
        found = {key: self._part(piece, *own[key], corners, sides) for key, piece in pieces.items()}
        self.parts = {id(shape): [found[id(piece)] for piece in shape.pieces] for shape in self._shapes}
        self.corner, self.corner_radius, self.corner_slack, self.first_corner, self.corner_members = corners.arrays()
        ends, self.side_radius, self.side_slack, self.first_side, self.side_members = sides.arrays()
        self.begin, self.along = ends[:, 0].copy(), ends[:, 1] - ends[:, 0]
        self.length: Floats = np.abs(self.along)
        with np.errstate(divide="ignore", invalid="ignore"):
            self.way: Complexes = np.where(self.length > 0.0, self.along / self.length, 0.0)

    @staticmethod
    def _part(piece: Piece, corner: tuple[int, int], side: tuple[int, int], corners: _Rows, sides: _Rows) -> Part:
        rings, firsts, corner_groups, side_groups = [], [], [], []
        at, along = corner[0], side[0]
        for ring in piece.rings:
            rings.append(at)
            count = 1 if len(ring) == 1 else len(ring) - (not piece.filled)
            firsts.append((at, len(ring), along, count))
            at, along = at + len(ring), along + count
        for at, count, along, lines in firsts:
            for k in range(0, count, TOGETHER):
                members = min(TOGETHER, count - k)
                some = corners.values(at + k, members)
                centre = 0.5 * (some.real.min() + some.real.max()) + 0.5j * (some.imag.min() + some.imag.max())
                corner_groups.append(corners.group(np.array(centre), np.abs(some - centre).max(), at + k, members))
            for k in range(0, lines, TOGETHER):
                members = min(TOGETHER, lines - k)
                some = sides.values(along + k, members)
                chord = np.array([some[0, 0], some[-1, 1]])
                slack = distances(some.ravel(), chord[0], chord[1] - chord[0]).max()
                side_groups.append(sides.group(chord, slack, along + k, members))
        of_corners, of_sides = ((min(each), max(each) + 1) for each in (corner_groups, side_groups))
        single = len(piece.corners) == 1
        return Part(corner, side, of_corners, of_sides, tuple(rings), piece.filled, single)


class _Rows:
    """Rows that are added one after the other, and groups behind them."""

    def __init__(self) -> None:
        self._rows: list[Complexes] = []
        self._radius: list[float] = []
        self._slack: list[float] = []
        self._first: list[int] = []
        self._members: list[int] = []
        self._joined: Complexes | None = None
        self.count = 0

    def add(self, rows: Complexes, radius: float) -> tuple[int, int]:
        """Adds some; their first number and that behind the last one."""
        first, self.count = self.count, self.count + len(rows)
        self._rows.append(rows)
        self._radius += [radius] * len(rows)
        self._slack += [0.0] * len(rows)
        self._first += range(first, self.count)
        self._members += [1] * len(rows)
        return first, self.count

    def values(self, first: int, count: int) -> Complexes:
        """Some of those that were added."""
        if self._joined is None:
            self._joined = np.concatenate(self._rows)
        return self._joined[first : first + count]

    def group(self, row: Complexes, slack: float, first: int, members: int) -> int:
        """Adds a group; its number."""
        self._rows.append(row[None])
        self._radius.append(self._radius[first])
        self._slack.append(float(slack))
        self._first.append(first)
        self._members.append(members)
        self.count += 1
        return self.count - 1

    def arrays(self) -> tuple[Complexes, Floats, Floats, Indices, Indices]:
        """All rows with their radii, slack, first members and numbers of members."""
        first, members = np.array([self._first, self._members], dtype=np.intp)
        return np.concatenate(self._rows), np.array(self._radius), np.array(self._slack), first, members


def nearest_places(points: Complexes, begin: Complexes, along: Complexes) -> Complexes:
    """The places of segments that are nearest to points."""
    square = np.abs(along) ** 2
    share = ((points - begin) * np.conj(along)).real / np.where(square > 0.0, square, 1.0)
    return np.asarray(begin + np.clip(share, 0.0, 1.0) * along)


def distances(points: Complexes, begin: Complexes, along: Complexes) -> Floats:
    """Distances of points from segments."""
    return np.asarray(np.abs(points - nearest_places(points, begin, along)))


@dataclass(frozen=True, eq=False)
class Meetings(Columns):
    """Corners and sides that may meet: the ``pair`` of shapes, the ``pose`` in which the side sees the corner, and
    the numbers of ``corner`` and ``side``, (n,) each."""

    pair: Indices
    pose: Indices
    corner: Indices
    side: Indices


class PairsOfShapes:
    """Pairs of shapes of ``outlines``, the second of each in the ``pose`` (even numbers) in the axes of the first."""

    def __init__(self, outlines: Outlines, shapes: Sequence[tuple[Shape, Shape]], pose: Sequence[int]) -> None:
        self.outlines = outlines
        pieces = [
            (k, pose[k], one, other)
            for k, (first, second) in enumerate(shapes)
            for one in outlines.parts[id(first)]
            for other in outlines.parts[id(second)]
        ]
        self.pieces = pieces
        self.fine, self.coarse = self._meetings(pieces)

    def _meetings(self, pieces: Sequence[tuple[int, int, Part, Part]]) -> tuple[Meetings, Meetings]:
        fine: list[tuple[int, int, Part, Part]] = []
        coarse: list[tuple[int, int, Part, Part]] = []
        for pair, pose, one, other in pieces:
            if other.point and one.point:
                fine.append((pair, pose, other, one))
                continue
            for seen, against, own in ((other, one, pose), (one, other, pose ^ 1)):
                if not against.point:
                    count = (seen.corners[1] - seen.corners[0]) * (against.sides[1] - against.sides[0])
                    (coarse if count > MANY else fine).append((pair, own, seen, against))
        return _crossed(fine, False), _crossed(coarse, True)

    def expanded(self, coarse: Meetings) -> tuple[Meetings, Indices]:
        """The corners and sides of groups, with the numbers of the groups that they come from."""
        own = self.outlines
        lines = own.side_members[coarse.side]
        group, number = spread(own.corner_members[coarse.corner] * lines)
        across = lines[group]
        corner = own.first_corner[coarse.corner[group]] + number // across
        side = own.first_side[coarse.side[group]] + number % across
        return replace(coarse.taken(group), corner=corner, side=side), group


def _crossed(jobs: Sequence[tuple[int, int, Part, Part]], groups: bool) -> Meetings:
    """All corners against all sides of pairs of pieces."""
    numbers = [
        (
            pair,
            pose,
            *(seen.corner_groups if groups else seen.corners),
            *(against.side_groups if groups else against.sides),
        )
        for pair, pose, seen, against in jobs
    ]
    pair, pose, first, last, begin, end = np.array(numbers, dtype=np.intp).reshape(-1, 6).T
    lines = end - begin
    job, number = spread((last - first) * lines)
    across = lines[job]
    corner, side = first[job] + number // across, begin[job] + number % across
    return Meetings(pair[job], pose[job], corner, side)
