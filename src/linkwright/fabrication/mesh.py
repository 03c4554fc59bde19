"""Closed surfaces of triangles of bodies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Complexes, Floats, Integers
from linkwright.exporters.export import package
from linkwright.fabrication.body import FLATTENING, Body, Section, corners
from linkwright.words import _


@dataclass(frozen=True, eq=False)
class Mesh:
    """``corners`` (n, 3), m, and ``triangles`` (k, 3) of their numbers, counter-clockwise as seen from outside; every
    side of a triangle is that of one other, in the opposite direction."""

    corners: Floats
    triangles: Integers

    @property
    def volume(self) -> float:
        """What it encloses, m³, by Gauss's theorem: a sixth of the sum of a · (b × c)."""
        a, b, c = (self.corners[self.triangles[:, k]] for k in range(3))
        return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0


def mesh_of(body: Body, tolerance: float = FLATTENING) -> Mesh:
    """The surface of a body in its own axes, with arcs as chords within a tolerance, m."""
    rims: list[_Rims] = []
    places, triangles, count = [], [], 0
    for section in body.sections:
        rims.append(_Rims(section, [corners(loop, tolerance) for loop in section.loops], count))
        plane = np.concatenate(rims[-1].rings)
        for height in (section.low, section.high):
            places.append(np.column_stack([plane.real, plane.imag, np.full(len(plane), height)]))
        triangles.append(_walls(rims[-1]))
        count += 2 * len(plane)
    for below, above in zip((None, *rims), (*rims, None), strict=True):
        triangles.append(_level(below, above))
    return Mesh(np.concatenate(places), np.concatenate(triangles))


@dataclass(frozen=True, eq=False)
class _Rims:
    """The corners of the loops of a section, and the number ``first`` of the first of them at its lower height."""

    section: Section
    rings: list[Complexes]
    first: int

    def numbers(self, *, upper: bool) -> list[Integers]:
        """The numbers of the corners of every ring at the lower or the upper height."""
        sizes = [len(ring) for ring in self.rings]
        first = self.first + (sum(sizes) if upper else 0)
        starts = np.cumsum([first, *sizes])
        return [start + np.arange(size) for start, size in zip(starts, sizes, strict=False)]


def _walls(rims: _Rims) -> Integers:
    """Two triangles for every side of the rings."""
    found = []
    for low, high in zip(rims.numbers(upper=False), rims.numbers(upper=True), strict=True):
        a, b, c, d = low, np.roll(low, -1), np.roll(high, -1), high
        found += [np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]
    return np.concatenate(found)


def _level(below: _Rims | None, above: _Rims | None) -> Integers:
    """The level face between two sections: what one of them leaves uncovered of the other."""
    upwards = above is None or (below is not None and below.section.extent > above.section.extent)
    wide, narrow = (below, above) if upwards else (above, below)
    assert wide is not None
    rings, numbers = list(wide.rings), wide.numbers(upper=upwards)
    if narrow is not None:
        rings.append(narrow.rings[0][::-1])
        numbers.append(narrow.numbers(upper=not upwards)[0][::-1])
    triangles = np.concatenate(numbers)[_triangulated(rings)]
    return triangles if upwards else triangles[:, ::-1]


def _triangulated(rings: Sequence[Complexes]) -> Integers:
    """Triangles (k, 3) between rings, outer ones counter-clockwise; every corner is kept, so that walls fit."""
    manifold = package("manifold3d", _("solid files"), "linkwright[export]")
    polygons = [np.column_stack([ring.real, ring.imag]) for ring in rings]
    size = max(float(np.abs(polygon).max()) for polygon in polygons)
    return np.asarray(manifold.triangulate([each / size for each in polygons], -1.0), dtype=np.int64)
