"""Springs, dampers, and a load of a kind without a symbol."""

from __future__ import annotations

import math

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.pictures.picture import Circle, Line, Vec
from linkwright.pictures.symbols.base import SYMBOLS, Shape, around, placed, points, ring, way

#: Coils of a spring, and half of their width.
COILS, HEIGHT = 6, 7.0


@SYMBOLS.register("spring")
def spring(*, start: Vec = (0.0, 0.0), end: Vec = (60.0, 0.0)) -> Shape:
    """A coil spring between two points."""
    length, along = way(start, end)
    lead = min(0.18 * length, 16.0)
    x = np.linspace(lead, length - lead, 2 * COILS + 1)
    y = np.where(np.arange(len(x)) % 2 == 0, HEIGHT, -HEIGHT)
    y[0] = y[-1] = 0.0
    line = placed(np.vstack([[(0.0, 0.0)], np.stack([x, y], axis=1), [(length, 0.0)]]), start, along)
    return Shape((Line(line, "lw-spring"),), (line,))


@SYMBOLS.register("torsion_spring")
def torsion_spring(*, at: Vec = (0.0, 0.0), radius: float = 14.0) -> Shape:
    """A spiral about a pin."""
    t = np.linspace(0.0, 1.0, 60)
    angle, r = 4.5 * math.pi * t, 6.0 + (radius - 6.0) * t
    line = around(at, r, angle)
    return Shape((Line(line, "lw-spring"),), (line,))


@SYMBOLS.register("damper")
def damper(*, start: Vec = (0.0, 0.0), end: Vec = (60.0, 0.0), height: float = 8.0) -> Shape:
    """A dashpot between two points."""
    length, along = way(start, end)
    body = min(26.0, 0.5 * length)
    a, b, c = (length - body) / 2, (length + body) / 2, length / 2 + 0.15 * body
    lines = (
        [(0, 0), (a, 0)],
        [(b, -height), (a, -height), (a, height), (b, height)],
        [(c, -0.7 * height), (c, 0.7 * height)],
        [(c, 0), (length, 0)],
    )
    strokes = [placed(line, start, along) for line in lines]
    return Shape(tuple(Line(stroke, "lw-spring") for stroke in strokes), tuple(strokes))


@SYMBOLS.register("torsion_damper")
def torsion_damper(*, at: Vec = (0.0, 0.0), radius: float = 16.0) -> Shape:
    """A dashpot bent about a pin: the pot, closed at one end, and the vane in it on its arm."""
    inner, outer, middle = radius - 5.0, radius + 5.0, -0.5 * math.pi
    start, end, vane = middle - 0.8, middle + 0.7, middle + 0.15

    def arc(r: float, first: float, last: float) -> Floats:
        return around(at, r, np.linspace(first, last, 15))

    def ray(angle: float, first: float, last: float) -> Floats:
        return around(at, np.array([first, last]), np.array(angle))

    strokes = (
        np.concatenate([arc(outer, end, start), arc(inner, start, end)]),
        ray(vane, inner + 1.5, outer - 1.5),
        np.concatenate([arc(radius, vane, end + 0.55), ray(end + 0.55, radius, 6.0)]),
        np.concatenate([arc(radius, start, start - 0.4), ray(start - 0.4, radius, 6.0)]),
    )
    return Shape(tuple(Line(stroke, "lw-spring") for stroke in strokes), strokes)


SIZE = 7.0


@SYMBOLS.register("general_load")
def general_load(*, at: Vec = (0.0, 0.0), ends: tuple[Vec, ...] = ()) -> Shape:
    """A crossed ring; with two ``ends`` halfway on a dashed line between them, else at ``at``."""
    line = points(ends)
    middle = points([at])[0] if len(ends) < 2 else line.mean(axis=0)
    x, y = float(middle[0]), float(middle[1])
    a = SIZE / np.sqrt(2.0)
    crossed = ([(x - a, y - a), (x + a, y + a)], [(x - a, y + a), (x + a, y - a)])
    strokes = (Line(points(each), "lw-load-thin") for each in crossed)
    shape = Shape((Circle((x, y), SIZE, "lw-load-ring"), *strokes), (ring((x, y), SIZE),))
    if len(ends) < 2:
        return shape
    return Shape((Line(line, "lw-load-thin lw-load-dashed"),), (line,)) + shape
