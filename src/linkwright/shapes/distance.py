"""Distances of places and shapes at rest."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Complexes, Flags, Floats
from linkwright.shapes.shape import Piece, Shape

#: Pairs of places and sides that are compared at once.
AT_ONCE = 1 << 20


def contains(shape: Shape, points: Complexes) -> Flags:
    """Whether each of some points (k,), in the shape's axes, lies within the shape or on its edge; bored holes count
    as material."""
    places = np.atleast_1d(np.asarray(points, dtype=complex))
    found = np.zeros(len(places), dtype=np.bool_)
    for piece in shape.pieces:
        rest = np.flatnonzero(~found)
        found[rest] = core_distances(piece, places[rest]) <= piece.radius
    return found


def core_distances(piece: Piece, points: Complexes) -> Floats:
    """Distance of each point (k,) from the core of a piece, m; 0 within a filled one."""
    sides = piece.sides
    start, step = sides[:, 0], sides[:, 1] - sides[:, 0]
    squared = np.maximum(np.abs(step) ** 2, np.finfo(float).tiny)
    found = np.empty(len(points))
    rows = max(AT_ONCE // len(sides), 1)
    for first in range(0, len(points), rows):
        gap = points[first : first + rows, None] - start
        share = np.clip((gap * step.conj()).real / squared, 0.0, 1.0)
        away = np.abs(gap - share * step).min(axis=1)
        if piece.filled:
            # even-odd: sides that a ray to the right crosses
            above = (gap.imag < 0.0) != (gap.imag < step.imag)
            right = (gap.real * step.imag < gap.imag * step.real) == (step.imag > 0.0)
            away[np.count_nonzero(above & right, axis=1) % 2 == 1] = 0.0
        found[first : first + rows] = away
    return found


def gap(a: Shape, b: Shape, pose: tuple[complex, float] = (0j, 0.0)) -> float:
    """Smallest distance (m) of two shapes at rest, negative or 0 where they overlap.

    ``pose``: origin (m) and turn (rad) of b's axes in those of a. The distance of two pieces is that of their cores
    less both radii; cores that overlap, also one within another, have none. Where shapes overlap the number says no
    more than that they do. Bored holes count as material.
    """
    origin, turn = pose
    way = np.exp(1j * turn)
    moved = [
        Piece(tuple(origin + way * ring for ring in piece.rings), piece.radius, piece.filled) for piece in b.pieces
    ]
    return min(_cores(one, other) - one.radius - other.radius for one in a.pieces for other in moved)


def _cores(one: Piece, other: Piece) -> float:
    """Distance of two cores, m."""
    ends = min(core_distances(one, other.corners).min(), core_distances(other, one.corners).min())
    return 0.0 if ends > 0.0 and _cross(one.sides, other.sides) else float(ends)


def _cross(one: Complexes, other: Complexes) -> bool:
    """Whether any side (k, 2) crosses another (m, 2)."""
    step, start = other[:, 1] - other[:, 0], other[:, 0]
    rows = max(AT_ONCE // len(other), 1)
    for first in range(0, len(one), rows):
        a, b = one[first : first + rows, 0, None], one[first : first + rows, 1, None]
        apart = _left(step, a - start) * _left(step, b - start) < 0.0
        if bool((apart & (_left(b - a, start - a) * _left(b - a, start + step - a) < 0.0)).any()):
            return True
    return False


def _left(way: Complexes, place: Complexes) -> Floats:
    """Sign of the side of vectors on which places lie, 1 left."""
    return np.sign((way.conj() * place).imag)
