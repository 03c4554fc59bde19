"""Shapes by shapely, from fine polygons, and random ones with nasty meetings."""

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from linkwright.shapes.loop import Loop
from linkwright.shapes.shape import Piece, Shape

#: Sides of a quarter turn: circles are off by 5e-8 of their radius.
QUARTER = 2500


def polygon_of(piece: Piece, quarter: int = 64) -> BaseGeometry:
    """The area of a piece, its round parts by chords."""
    rings = [np.stack([ring.real, ring.imag], axis=1) for ring in piece.rings]
    if piece.filled:
        core = shapely.Polygon(rings[0])
        for ring in rings[1:]:
            core = core.symmetric_difference(shapely.Polygon(ring))
        return core.buffer(piece.radius, quad_segs=quarter) if piece.radius else core
    # side by side: the buffer of a line that folds back on itself lacks parts
    sides = [
        shapely.LineString([(a.real, a.imag), (b.real, b.imag)]) if a != b else shapely.Point(a.real, a.imag)
        for a, b in piece.sides
    ]
    return shapely.union_all([each.buffer(piece.radius, quad_segs=quarter) for each in sides])


def union_of(shape: Shape, quarter: int = 64) -> BaseGeometry:
    """The union of the pieces, without holes."""
    return shapely.unary_union([polygon_of(piece, quarter) for piece in shape.pieces])


def area_within(loops: tuple[Loop, ...], tolerance: float) -> BaseGeometry:
    """What lies within loops: the symmetric difference of all."""
    found: BaseGeometry = shapely.Polygon()
    for loop in loops:
        places = loop.points(tolerance)
        found = found.symmetric_difference(shapely.Polygon(np.stack([places.real, places.imag], axis=1)))
    return found


def random_shape(rng: np.random.Generator) -> Shape:
    """One to four pieces; some on a coarse grid, so that they touch, coincide, lie in line and within each other."""

    def places(count: int) -> np.ndarray:
        free = rng.uniform(-1.0, 1.0, count) + 1j * rng.uniform(-1.0, 1.0, count)
        return np.round(2.0 * free) / 2.0 if rng.random() < 0.6 else free

    pieces = []
    for _ in range(rng.integers(1, 5)):
        radius = float(rng.choice([0.1, 0.25, 0.5, 0.25 * np.sqrt(2.0), rng.uniform(0.02, 0.4)]))
        kind = rng.integers(5)
        if kind == 0:
            pieces.append(Piece((places(1),), radius))
        elif kind == 1:
            pieces.append(Piece((places(2),), radius))
        elif kind == 2:
            pieces.append(Piece((places(int(rng.integers(3, 6))),), radius))
        else:
            ring = _simple(rng, places(int(rng.integers(3, 7))))
            if ring is not None:
                pieces.append(Piece((ring,), radius if kind == 3 else 0.0, filled=True))
    return Shape(tuple(pieces)) if pieces else random_shape(rng)


def _simple(rng: np.random.Generator, corners: np.ndarray) -> np.ndarray | None:
    """Corners as a polygon that does not cross itself, in either direction; None where they do not make one."""
    middle = corners.mean() + 0.01 * (1.0 + 0.3j)
    ring = corners[np.argsort(np.angle(corners - middle))]
    area = shapely.Polygon(np.stack([ring.real, ring.imag], axis=1))
    if not area.is_valid or area.area < 1e-6:
        return None
    return ring if rng.random() < 0.7 else ring[::-1]
