"""Holes by which the base plate is screwed down: next to its corners, clear of pins and edges."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence

import numpy as np

from linkwright.core.arrays import Complexes, Floats
from linkwright.fabrication.holes import level_turn
from linkwright.fabrication.part import Hole
from linkwright.fabrication.raster import box, turned
from linkwright.pictures.picture import round_up
from linkwright.shapes.distance import contains
from linkwright.shapes.shape import Shape

#: Radius of a mounting hole as a share of that of the smallest pin, and the wall around it as a share of its radius.
RADIUS, WALL = 0.75, 1.0
#: Steps of the grid of places along the longer side of the plate, and around each the rings, as shares of the wall's
#: radius, on which there must be material.
GRID, ROUND, RINGS = 60, 16, (0.3, 0.55, 0.8, 1.0)


def mounting_holes(shape: Shape, holes: Sequence[Hole], heads: float) -> tuple[Hole, ...]:
    """Up to four holes, each as near as may be to another corner of the plate's box; ``heads``: how far from a pin's
    centre its head reaches, as a multiple of the pin's radius."""
    if not holes:
        return ()
    radius = RADIUS * min(each.radius for each in holes)
    origin, way = holes[0].centre, cmath.exp(1j * level_turn(holes))
    level = turned(turned(shape, 0.0, -origin), -level_turn(holes))
    places = origin + way * _places(level, radius)
    for hole in holes:
        places = places[np.abs(places - hole.centre) > heads * hole.radius + (1.0 + WALL) * radius]
    found: list[complex] = []
    for corner in (origin + way * each for each in _corners(level)):
        free = places
        for each in found:
            free = free[np.abs(free - each) > 2.0 * (1.0 + WALL) * radius]
        if len(free):
            found.append(complex(free[np.abs(free - corner).argmin()]))
    return tuple(Hole("", each, radius, False) for each in found)


def _corners(shape: Shape) -> list[complex]:
    low, high = box(shape)
    return [low, high, complex(high.real, low.imag), complex(low.real, high.imag)]


def _places(shape: Shape, radius: float) -> Complexes:
    """Places on round coordinates around which there is room for a hole and its wall."""
    low, high = box(shape)
    step = round_up(max((high - low).real, (high - low).imag) / GRID)
    x: Floats = step * np.arange(math.ceil(low.real / step), high.real / step)
    y: Floats = step * np.arange(math.ceil(low.imag / step), high.imag / step)
    grid = (x[:, None] + 1j * y[None, :]).ravel()
    ring = np.exp(2j * np.pi * np.arange(ROUND) / ROUND)
    disc = np.concatenate([[0.0], *(share * (1.0 + WALL) * radius * ring for share in RINGS)])
    around = grid[:, None] + disc[None, :]
    return np.asarray(grid[contains(shape, around.ravel()).reshape(around.shape).all(axis=1)])
