"""Outlines of plates, at a distance where a cut has some width: exact, and fast for teeth with many corners."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from linkwright.core.arrays import Complexes, Floats
from linkwright.shapes.boundary import boundary
from linkwright.shapes.loop import Edge, Loop
from linkwright.shapes.shape import Piece, Shape

#: A polygon with more corners than this is followed corner by corner where it is simple.
MANY = 250
#: Pairs of sides that are compared at once.
ROWS = 256
#: Sides whose directions differ by less than this (sine) go on straight.
STRAIGHT = 1e-9


def outline(shape: Shape, by: float = 0.0) -> tuple[Loop, ...]:
    """The outline of a shape without its bored holes, everywhere at a distance (m) outside: loops around material
    counter-clockwise, then those around slots and openings clockwise."""
    if len(shape.pieces) == 1 and (found := _around_polygon(shape.pieces[0], by)):
        return found
    pieces = tuple(each for piece in shape.pieces for each in _widened(piece, by)) if by else shape.pieces
    return boundary(Shape(pieces))


def _widened(piece: Piece, by: float) -> Iterator[Piece]:
    """Pieces whose union is all within a distance (m) of a piece."""
    if len(piece.rings) == 1:
        yield Piece(piece.rings, piece.radius + by, piece.filled)
        return
    yield piece  # only a core with one ring has a radius: along all rings go bars
    for ring in piece.rings:
        yield Piece((np.append(ring, ring[:1]),), by)


def _around_polygon(piece: Piece, by: float) -> tuple[Loop, ...]:
    """The outline of one polygon with many corners, its openings within; empty for anything else, and where lines at
    the distance would cross."""
    if not piece.filled or piece.radius or len(piece.corners) <= MANY:
        return ()
    rings = [_turned(ring, outer=number == 0) for number, ring in enumerate(piece.rings)]
    found = [_moved(ring, by) for ring in rings]
    corners = [each for each in found if each is not None]
    if len(corners) < len(rings) or not _apart([ends for ends, _bulges in corners]):
        return ()
    return tuple(_loop(ends, bulges) for ends, bulges in corners)


def _turned(ring: Complexes, *, outer: bool) -> Complexes:
    """A ring without corners at one place, counter-clockwise if it is the outer one, else clockwise."""
    ring = ring[np.abs(np.roll(ring, -1) - ring) > 0.0]
    area = float((ring.conj() * np.roll(ring, -1)).imag.sum())
    return ring if (area > 0.0) == outer else ring[::-1]


def _moved(ring: Complexes, by: float) -> tuple[Complexes, Floats] | None:
    """Corners of a ring moved to its right by a distance, and the bulges of the edges behind them: arcs around those
    that point outwards; None where a side is too short for that."""
    step = np.roll(ring, -1) - ring
    length = np.abs(step)
    ahead = step / length
    back = np.roll(ahead, 1)
    turn = np.angle(ahead / back)
    outwards = turn > STRAIGHT
    inwards = np.where(outwards, 0.0, turn)
    trim = by * np.tan(-0.5 * inwards)
    if bool((trim + np.roll(trim, -1) >= length).any()):
        return None
    before = np.where(outwards, ring - 1j * by * back, ring - 1j * by * back - trim * back)
    after = np.where(outwards, ring - 1j * by * ahead, before)
    ends, bulges = np.stack([before, after], axis=1).ravel(), np.zeros(2 * len(ring))
    bulges[::2] = np.where(outwards, np.tan(0.25 * turn), 0.0)
    kept = np.abs(np.roll(ends, -1) - ends) > 0.0
    return ends[kept], bulges[kept]


def _loop(ends: Complexes, bulges: Floats) -> Loop:
    places, following = ends.tolist(), np.roll(ends, -1).tolist()
    return Loop(tuple(map(Edge, places, following, bulges.tolist())))


def _apart(rings: list[Complexes]) -> bool:
    """Whether no two sides of some rings cross or touch but at the corner between them."""
    start = np.concatenate(rings)
    end = np.concatenate([np.roll(ring, -1) for ring in rings])
    low = np.minimum(start.real, end.real) + 1j * np.minimum(start.imag, end.imag)
    high = np.maximum(start.real, end.real) + 1j * np.maximum(start.imag, end.imag)
    for first in range(0, len(start), ROWS):
        rows = slice(first, first + ROWS)
        meet = (low[rows, None].real <= high.real) & (low.real <= high[rows, None].real)
        meet &= (low[rows, None].imag <= high.imag) & (low.imag <= high[rows, None].imag)
        i, j = np.nonzero(meet)
        i += first
        other = (i < j) & (end[i] != start[j]) & (end[j] != start[i])
        if _crossing(start, end, i[other], j[other]):
            return False
    return True


def _crossing(start: Complexes, end: Complexes, one: np.ndarray, other: np.ndarray) -> bool:
    """Whether any of the sides ``one`` meets the side of ``other`` next to it."""

    def side(a: Complexes, b: Complexes, place: Complexes) -> Floats:
        return np.asarray(np.sign(((b - a).conj() * (place - a)).imag))

    a, b, c, d = start[one], end[one], start[other], end[other]
    return bool(((side(a, b, c) * side(a, b, d) <= 0.0) & (side(c, d, a) * side(c, d, b) <= 0.0)).any())
