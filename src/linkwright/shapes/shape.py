"""Shapes in the plane: unions of polygons, lines and points, each widened by a radius."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Complexes, Floats


@dataclass(frozen=True, eq=False)
class Piece:
    """All places within ``radius`` (m) of a core.

    ``rings``: corners of the core, complex numbers (k,), m; ``filled``: whether the rings bound an area (by the
    even-odd rule, so that inner rings are holes), else one open chain of lines, or one point. A bar with round ends
    is a line with a radius, a plate with round corners a polygon with one, a disc a point with one, a given outline
    a polygon without. Only a piece of radius 0 has inner rings.
    """

    rings: tuple[Complexes, ...]
    radius: float
    filled: bool = False

    @cached_property
    def corners(self) -> Complexes:
        """All corners of the core, (corners,)."""
        return np.concatenate(self.rings)

    @cached_property
    def sides(self) -> Complexes:
        """Both ends of every side of the core, (sides, 2); of a point one side without length."""
        found = []
        for ring in self.rings:
            ends = np.roll(ring, -1) if self.filled else ring[1:]
            starts = ring if self.filled else ring[:-1]
            found.append(np.stack([starts, ends], axis=1) if len(ring) > 1 else np.repeat(ring, 2)[None])
        return np.concatenate(found)


@dataclass(frozen=True, eq=False)
class Shape:
    """The union of ``pieces`` in the axes of what carries it, without ``holes``: discs (centre, radius), m, which
    are bored for pins and do not count in gaps."""

    pieces: tuple[Piece, ...]
    holes: tuple[tuple[complex, float], ...] = ()

    @cached_property
    def bound(self) -> tuple[complex, float]:
        """A circle around the shape: centre and radius, m."""
        corners = np.concatenate([piece.corners for piece in self.pieces])
        box = corners.real.min() + 1j * corners.imag.min(), corners.real.max() + 1j * corners.imag.max()
        centre = complex(0.5 * (box[0] + box[1]))
        reach = (np.abs(piece.corners - centre).max() + piece.radius for piece in self.pieces)
        return centre, float(max(reach))

    def moved(self, turn: complex, origin: complex = 0j) -> Shape:
        """The shape turned about its origin by a unit complex number, then moved by a vector (m)."""
        return Shape(
            tuple(
                Piece(tuple(origin + turn * ring for ring in piece.rings), piece.radius, piece.filled)
                for piece in self.pieces
            ),
            tuple((origin + turn * centre, radius) for centre, radius in self.holes),
        )


def disc(centre: complex, radius: float) -> Shape:
    """A disc."""
    return Shape((Piece((np.array([centre], dtype=complex),), radius),))


def bar(points: Iterable[complex], width: float) -> Shape:
    """A bar of a width (m) with round ends along points in their order, bent where they are not in line."""
    return Shape((Piece((np.array([*points], dtype=complex),), 0.5 * width),))


def polygon(corners: Iterable[complex], holes: Iterable[Iterable[complex]] = ()) -> Shape:
    """The area within a polygon, without those within others."""
    rings = (np.array([*corners], dtype=complex), *(np.array([*each], dtype=complex) for each in holes))
    return Shape((Piece(rings, 0.0, filled=True),))


def rectangle(centre: complex, along: float, length: float, width: float) -> Shape:
    """A rectangle with its ``length`` in the direction ``along`` (rad)."""
    way = np.exp(1j * along)
    half = 0.5 * np.array([length + 1j * width, -length + 1j * width, -length - 1j * width, length - 1j * width])
    return polygon(centre + way * half)


def joined(shapes: Iterable[Shape]) -> Shape:
    """The union of some shapes, with the holes of all."""
    found = [*shapes]
    return Shape(
        tuple(piece for each in found for piece in each.pieces), tuple(hole for each in found for hole in each.holes)
    )


def corners_of(path: Floats) -> Complexes:
    """Points (k, 2) as complex numbers (k,)."""
    return np.asarray(path[:, 0] + 1j * path[:, 1])
