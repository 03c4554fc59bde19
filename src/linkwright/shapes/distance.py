"""Distances of places and shapes at rest."""

from __future__ import annotations

import cmath

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
    found = np.empty(len(points))
    rows = max(AT_ONCE // len(sides), 1)
    for first in range(0, len(points), rows):
        places = points[first : first + rows, None]
        away = np.abs(from_sides(start, step, places)).min(axis=1)
        if piece.filled:
            # even-odd: sides that a ray to the right crosses
            gap = places - start
            above = (gap.imag < 0.0) != (gap.imag < step.imag)
            right = (gap.real * step.imag < gap.imag * step.real) == (step.imag > 0.0)
            away[np.count_nonzero(above & right, axis=1) % 2 == 1] = 0.0
        found[first : first + rows] = away
    return found


def from_sides(start: Complexes, step: Complexes, places: Complexes) -> Complexes:
    """Vectors (m) to places from the nearest place on each side, which goes from its ``start`` by a ``step``."""
    gap = places - start
    share = np.clip((gap * step.conj()).real / np.maximum(np.abs(step) ** 2, np.finfo(float).tiny), 0.0, 1.0)
    return np.asarray(gap - share * step)


def nearest(one: Piece, other: Piece) -> tuple[complex, complex]:
    """Where the cores of two pieces that do not overlap come nearest to each other: on the one, on the other."""
    found = []
    for a, b in ((one, other), (other, one)):
        places, sides = a.corners[:, None], b.sides
        away = from_sides(sides[:, 0], sides[:, 1] - sides[:, 0], places)
        corner, side = divmod(int(np.abs(away).argmin()), len(sides))
        ends = complex(a.corners[corner]), complex(a.corners[corner] - away[corner, side])
        found.append(ends if a is one else ends[::-1])
    return min(found, key=lambda ends: abs(ends[0] - ends[1]))


def gap(a: Shape, b: Shape, pose: tuple[complex, float] = (0j, 0.0)) -> float:
    """Smallest distance (m) of two shapes at rest, negative or 0 where they overlap.

    ``pose``: origin (m) and turn (rad) of b's axes in those of a. The distance of two pieces is that of their cores
    less both radii; cores that overlap, also one within another, have none. Where shapes overlap the number says no
    more than that they do. Bored holes count as material.
    """
    origin, turn = pose
    moved = b.moved(cmath.exp(1j * turn), origin)
    return min(_cores(one, other) - one.radius - other.radius for one in a.pieces for other in moved.pieces)


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
