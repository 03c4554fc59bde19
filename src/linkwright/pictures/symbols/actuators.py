"""Symbols of what drives, brakes and stops a machine: motors, brakes, flywheels, cylinders, end stops."""

from __future__ import annotations

import math

import numpy as np

from linkwright.pictures.picture import Circle, Line, Vec
from linkwright.pictures.symbols.base import PIN, SYMBOLS, Shape, around, hatching, placed, points, ring, vec, way

#: Radius of a motor, and distance of its middle from the pin that it turns.
MOTOR, AWAY = 11.0, 44.0


@SYMBOLS.register("motor")
def motor(*, at: Vec = (0.0, 0.0), toward: Vec = (1.0, 0.0)) -> Shape:
    """A circle with the letter M, beside the pin ``at`` in the direction ``toward``, with its shaft."""
    shaft = placed([(PIN, 0.0), (AWAY - MOTOR, 0.0)], at, toward)
    x, y = middle = (at[0] + AWAY * toward[0], at[1] + AWAY * toward[1])
    letter = points([(x - 4.6, y + 4.8), (x - 4.6, y - 4.8), (x, y + 1.6), (x + 4.6, y - 4.8), (x + 4.6, y + 4.8)])
    elements = (Line(shaft, "lw-spring"), Circle(middle, MOTOR, "lw-rim"), Line(letter, "lw-spring"))
    return Shape(elements, (shaft, ring(middle, MOTOR, 18)))


#: Radius of the drum of a brake; half the angle that its shoe takes.
DRUM, SHOE = 15.0, 0.55


@SYMBOLS.register("brake")
def brake(*, at: Vec = (0.0, 0.0), toward: Vec = (1.0, 0.0)) -> Shape:
    """A drum about the pin ``at``, and the shoe that is pressed on it from the direction ``toward``."""
    middle = math.atan2(toward[1], toward[0])
    angle = np.linspace(middle - SHOE, middle + SHOE, 9)
    shoe = np.concatenate([around(at, DRUM + 1.0, angle), around(at, DRUM + 6.0, angle[::-1])])
    stem = placed([(DRUM + 6.0, 0.0), (DRUM + 13.0, 0.0)], at, toward)
    elements = (Circle(at, DRUM, "lw-ground"), Line(shoe, "lw-weld", closed=True), Line(stem, "lw-spring"))
    return Shape(elements, (ring(at, DRUM, 24), shoe, stem))


@SYMBOLS.register("flywheel")
def flywheel(*, at: Vec = (0.0, 0.0), radius: float = 30.0) -> Shape:
    """A disc with a heavy rim about a pin."""
    rings = (Circle(at, radius, "lw-gear"), Circle(at, radius - 5.0, "lw-ground"))
    return Shape(rings, (ring(at, radius, 36),))


#: Height of a cylinder's barrel.
TALL = 11.0


@SYMBOLS.register("cylinder")
def cylinder(
    *, start: Vec = (0.0, 0.0), end: Vec = (60.0, 0.0), barrel: float | None = None, rod: float | None = None
) -> Shape:
    """A cylinder from the eye at ``start`` to that of its rod at ``end``; lengths of ``barrel`` and ``rod`` by these
    where they are not given."""
    length, along = way(start, end)
    first = min(1.6 * PIN, 0.1 * length)
    last = max(first, min(0.62 * length if barrel is None else barrel, 0.94 * length))
    half, inside = TALL / 2, min(last, max(first, 0.7 * first + 0.3 * last if rod is None else length - rod))
    lines = (
        [(0, 0), (first, 0)],
        [(last, -1.8), (last, -half), (first, -half), (first, half), (last, half), (last, 1.8)],
        [(inside, -half), (inside, half)],
        [(inside, 0), (length, 0)],
    )
    strokes = [placed(line, start, along) for line in lines]
    return Shape(tuple(Line(stroke, "lw-spring") for stroke in strokes), tuple(strokes))


@SYMBOLS.register("end_stop")
def end_stop(*, at: Vec = (0.0, 0.0), toward: Vec = (1.0, 0.0), size: float = 9.0) -> Shape:
    """A hatched buffer whose face is touched at ``at``; it lies in the direction ``toward``."""
    pad = placed([(0, -0.55 * size), (5, -0.55 * size), (5, 0.55 * size), (0, 0.55 * size)], at, toward)
    face = placed([(5, size), (5, -size)], at, toward)
    strokes = hatching(vec(face[0]), vec(face[1]), 1)
    elements = (
        Line(pad, "lw-weld", closed=True),
        Line(face, "lw-ground"),
        *(Line(each, "lw-hatch") for each in strokes),
    )
    return Shape(elements, (placed([(0, -size), (0, size), (12, size), (12, -size), (0, -size)], at, toward),))
