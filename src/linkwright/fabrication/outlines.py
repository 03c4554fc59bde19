"""Outlines of plates at a distance where a cut has some width: exact, and fast for teeth with many corners."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from linkwright.core.arrays import Complexes, Floats
from linkwright.shapes.boundary import NEAR, boundary
from linkwright.shapes.loop import Edge, Loop
from linkwright.shapes.rings import clear_of_each_other
from linkwright.shapes.shape import Piece, Shape

#: Sides whose directions differ by less than this (rad) go on to a common corner.
STRAIGHT = 1e-5


def outline(shape: Shape, by: float = 0.0) -> tuple[Loop, ...]:
    """The outline of a shape without its bored holes, everywhere at a distance (m) outside: loops around material
    counter-clockwise, then those around slots and openings clockwise."""
    if not by:
        return boundary(Shape(shape.pieces))
    if len(shape.pieces) == 1 and (found := _around_polygon(shape, by)):
        return found
    return boundary(Shape(tuple(each for piece in shape.pieces for each in _widened(piece, by))))


def _widened(piece: Piece, by: float) -> Iterator[Piece]:
    """Pieces whose union is all within a distance (m) of a piece."""
    if len(piece.rings) == 1:
        yield Piece(piece.rings, piece.radius + by, piece.filled)
        return
    yield piece  # only a core with one ring has a radius: along all rings go bars
    for ring in piece.rings:
        yield Piece((np.append(ring, ring[:1]),), by)


def _around_polygon(shape: Shape, by: float) -> tuple[Loop, ...]:
    """The outline of one polygon, its openings within; empty for anything else, and where lines at the distance
    would cross."""
    (piece,) = shape.pieces
    if not piece.filled or piece.radius:
        return ()
    near = NEAR * shape.bound[1]
    loops = boundary(Shape(shape.pieces))
    found = [_moved(np.array([each.start for each in loop.edges]), by, near) for loop in loops]
    corners = [each for each in found if each is not None]
    if len(corners) < len(loops) or not clear_of_each_other([ends for ends, _bulges in corners], near):
        return ()
    return tuple(_loop(ends, bulges) for ends, bulges in corners)


def _moved(ring: Complexes, by: float, near: float) -> tuple[Complexes, Floats] | None:
    """Corners of a ring moved to its right by a distance, and the bulges of the edges behind them: arcs around those
    that point outwards; None where a side is too short for that."""
    step = np.roll(ring, -1) - ring
    length = np.abs(step)
    ahead = step / length
    back = np.roll(ahead, 1)
    turn = np.angle(ahead / back)
    outwards = turn > STRAIGHT
    trim = by * np.tan(np.where(outwards, 0.0, -0.5 * turn))
    if bool((trim + np.roll(trim, -1) >= length).any()):
        return None
    before = ring - (1j * by + trim) * back
    after = np.where(outwards, ring - 1j * by * ahead, before)
    ends, bulges = np.stack([before, after], axis=1).ravel(), np.zeros(2 * len(ring))
    bulges[::2] = np.where(outwards, np.tan(0.25 * turn), 0.0)
    kept = np.abs(np.roll(ends, -1) - ends) > near
    return ends[kept], bulges[kept]


def _loop(ends: Complexes, bulges: Floats) -> Loop:
    places, following = ends.tolist(), np.roll(ends, -1).tolist()
    return Loop(tuple(map(Edge, places, following, bulges.tolist())))
