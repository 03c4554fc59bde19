"""Slots in which blocks slide: the wall around one, and what a slot leaves of a plate."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Complexes
from linkwright.shapes.distance import core_distances, gap, nearest
from linkwright.shapes.shape import Piece, Shape

#: Pieces touch that overlap by more than this share of their radii.
NOTHING = 1e-9


@dataclass(frozen=True)
class Slot:
    """A rectangle along a line, all in the axes of a carrier: ``start`` on its middle line (m), the unit vector
    ``way``, its ends ``low`` and ``high`` along it, half its width, and the ``wall`` around it, m."""

    start: complex
    way: complex
    low: float
    high: float
    half: float
    wall: float

    def at(self, along: float, left: float = 0.0) -> complex:
        """A place by how far along and left of the middle line it is."""
        return self.start + self.way * complex(along, left)

    def local(self, place: complex) -> complex:
        """How far along and left of the middle line a place is."""
        return (place - self.start) * self.way.conjugate()

    def distance(self, place: complex) -> float:
        """From a place to the slot, m; 0 within."""
        local = self.local(place)
        beyond = max(self.low - local.real, local.real - self.high, 0.0)
        return abs(complex(beyond, max(abs(local.imag) - self.half, 0.0)))

    def corners(self, out: float = 0.0) -> list[complex]:
        """Its corners, moved outwards by a distance, counter-clockwise."""
        low, high, half = self.low - out, self.high + out, self.half + out
        return [self.at(low, -half), self.at(high, -half), self.at(high, half), self.at(low, half)]

    @cached_property
    def ring(self) -> Piece:
        """The wall around the slot."""
        corners = self.corners(0.5 * self.wall)
        return Piece((np.array([*corners, corners[0]]),), 0.5 * self.wall)

    def meets(self, other: Slot) -> bool:
        """Whether the walls of two slots cross or touch: no straight line parts them."""
        mine, its = (np.array(each.corners(each.wall)) for each in (self, other))
        for way in (self.way, 1j * self.way, other.way, 1j * other.way):
            a, b = ((each * np.conj(way)).real for each in (mine, its))
            if a.max() < b.min() or b.max() < a.min():
                return False
        return True


def slotted(shape: Shape, slot: Slot, pins: Iterable[complex] = (), width: float = 0.0) -> Shape:
    """A plate with a slot: what lies beyond each of its four sides, with the wall around it, and bars to it from all
    that does not touch it; around ``pins`` as much of the ``width`` (m) as the slot leaves."""
    straight = (each for piece in shape.pieces for each in _straight(piece))
    kept = tuple(piece for each in straight for piece in _beyond(each, slot))
    near = ((pin, slot.distance(pin)) for pin in pins)
    eyes = [Piece((np.array([pin]),), away) for pin, away in near if 0.0 < away < 0.5 * width]
    kept = (*kept, *eyes)
    return Shape((*kept, *_tie(kept, slot), slot.ring), shape.holes)


def _straight(piece: Piece) -> Iterator[Piece]:
    """A bent bar as straight ones; any other piece as it is."""
    (ring, *others) = piece.rings
    if piece.filled or others or len(ring) < 3:
        yield piece
        return
    for side in piece.sides:
        yield Piece((side,), piece.radius)


def _beyond(piece: Piece, slot: Slot) -> Iterator[Piece]:
    """The parts of a piece with a convex core that leave the slot free, with their round edges."""
    corners = np.concatenate(piece.rings)
    local = (corners - slot.start) * np.conj(slot.way)
    out = piece.radius
    limits = (
        (local.real, slot.low - out, 1.0),
        (local.real, slot.high + out, -1.0),
        (local.imag, -slot.half - out, 1.0),
        (local.imag, slot.half + out, -1.0),
    )
    whole = max(float((sign * (values - limit)).max()) * -1.0 for values, limit, sign in limits)
    if whole >= 0.0:
        yield piece
        return
    for values, limit, sign in limits:
        above = sign * (limit - values)
        left = _clipped(corners, above, closed=piece.filled)
        if len(left):
            yield Piece((left,), piece.radius, filled=piece.filled and len(left) > 2)


def _clipped(corners: Complexes, above: Complexes, *, closed: bool) -> Complexes:
    """The part of a chain of lines or of a convex polygon where a linear function is not negative."""
    found: list[complex] = []
    count = len(corners)
    for k in range(count):
        if above[k] >= 0.0:
            found.append(complex(corners[k]))
        if k + 1 < count or (closed and count > 2):
            following = (k + 1) % count
            if above[k] * above[following] < 0.0:
                share = above[k] / (above[k] - above[following])
                found.append(complex(corners[k] + share * (corners[following] - corners[k])))
    return np.array(found, dtype=complex)


def _tie(pieces: tuple[Piece, ...], slot: Slot) -> Iterator[Piece]:
    """Bars from the wall of a slot to the parts of a plate that do not touch it: as wide as the plate there as far as
    they leave the slot free, to the wall as thick as that."""
    for part in connected((slot.ring, *pieces)):
        if slot.ring not in part:
            for bar in between(part, (slot.ring,)):
                yield from _beyond(bar, slot)
                yield Piece(bar.rings, slot.ring.radius)


def connected(pieces: Sequence[Piece]) -> list[list[Piece]]:
    """Pieces in groups that touch each other."""
    groups: list[list[Piece]] = []
    for piece in pieces:
        touching = [each for each in groups if any(_touch(piece, other) for other in each)]
        groups = [each for each in groups if each not in touching]
        groups.append([*(other for each in touching for other in each), piece])
    return groups


def _touch(one: Piece, other: Piece) -> bool:
    return gap(Shape((one,)), Shape((other,))) < -NOTHING * (one.radius + other.radius)


def tied(shape: Shape, other: Shape) -> Shape:
    """The union of two shapes, with a bar between them where they do not overlap."""
    pieces = (*shape.pieces, *other.pieces, *between(shape.pieces, other.pieces))
    return Shape(pieces, (*shape.holes, *other.holes))


def between(pieces: Sequence[Piece], others: Sequence[Piece]) -> Iterator[Piece]:
    """A bar as wide as a piece from there to the nearest of others, none where they touch."""
    if not pieces or not others or any(_reaches_into(one, other) for one in pieces for other in others):
        return
    gaps = [(*nearest(each, other), each, other) for each in pieces for other in others]
    a, b, piece, other = min(gaps, key=lambda each: abs(each[0] - each[1]) - each[2].radius - each[3].radius)
    if abs(a - b) > max(piece.radius, other.radius):
        yield Piece((np.array([a, b]),), piece.radius or other.radius)


def _reaches_into(one: Piece, other: Piece) -> bool:
    """Whether a corner of one core lies within the other."""
    return not all(core_distances(one, other.corners)) or not all(core_distances(other, one.corners))
