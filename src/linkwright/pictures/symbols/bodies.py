"""Bodies of links: bars, plates, gears, racks, cams and the ends of followers."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.core.plane import convex_hull
from linkwright.pictures.picture import Circle, Line, Vec
from linkwright.pictures.symbols.base import SYMBOLS, Shape, around, placed, points, ring


@SYMBOLS.register("bar")
def bar(*, through: ArrayLike = ((0.0, 0.0), (60.0, 0.0))) -> Shape:
    """A thick line through points."""
    line = points(through)
    return Shape((Line(line, "lw-bar"),), (line,))


@SYMBOLS.register("plate")
def plate(*, corners: ArrayLike = ((0.0, 0.0), (60.0, 0.0), (30.0, -40.0))) -> Shape:
    """A ternary or higher link: the filled hull of its points."""
    places = np.asarray(points(corners) @ (1.0, 1j), dtype=np.complex128)
    hull = convex_hull(places).view(float).reshape(-1, 2)
    return Shape((Line(hull, "lw-plate", closed=True),), (np.vstack([hull, hull[:1]]),))


PITCH, TALL, DEEP = 11.0, 3.2, 3.6
#: Teeth of a smaller pitch on the paper are not drawn one by one.
FINEST = 4.0
_TOOTH = np.array([(-0.5, -1.0), (-0.32, -1.0), (-0.16, 1.0), (0.16, 1.0), (0.32, -1.0)])


@SYMBOLS.register("gear")
def gear(
    *, at: Vec = (0.0, 0.0), radius: float = 40.0, turned: float = 0.0, inside: bool = False, teeth: int | None = None
) -> Shape:
    """A gear: teeth on its pitch circle, a chain line; ``inside`` for the teeth of a ring gear.

    Without their number ``teeth`` they show that it is a gear; likewise where they would be too fine to be seen.
    """
    count = max(12, round(2 * math.pi * radius / PITCH))
    if teeth is not None and 2 * math.pi * radius / teeth > FINEST:
        count = teeth
    step = 2 * math.pi / count
    angle = (turned + step * (np.arange(count)[:, None] + _TOOTH[None, :, 0])).ravel()
    small = min(1.0, 2 * math.pi * radius / count / PITCH)
    height = small * np.tile(np.where(_TOOTH[:, 1] > 0, TALL, -DEEP), count) * (-1.0 if inside else 1.0)
    r = radius + height
    outline = around(at, r, angle)
    rim = (Circle(at, radius + 4 * DEEP, "lw-gear"),) if inside else ()
    wheel = Line(outline, "lw-rim" if inside else "lw-gear", closed=True)
    return Shape((*rim, wheel, Circle(at, radius, "lw-pitch")), (ring(at, radius + TALL, 36),))


@SYMBOLS.register("disc")
def disc(*, at: Vec = (0.0, 0.0), radius: float = 40.0) -> Shape:
    """A wheel without teeth: a pulley, a sprocket, a rolling wheel."""
    return Shape((Circle(at, radius, "lw-gear"),), (ring(at, radius, 36),))


@SYMBOLS.register("strand")
def strand(*, start: Vec = (0.0, 0.0), end: Vec = (60.0, 0.0)) -> Shape:
    """A free strand of a belt or chain."""
    line = points([start, end])
    return Shape((Line(line, "lw-strand"),), (line,))


@SYMBOLS.register("rack")
def rack(*, at: Vec = (0.0, 0.0), along: Vec = (1.0, 0.0), start: float = -50.0, end: float = 50.0) -> Shape:
    """A rack: teeth on its pitch line, to the left of ``along`` on the paper."""
    count = max(3, round((end - start) / PITCH))
    step = (end - start) / count
    x = (start + step * (np.arange(count)[:, None] + 0.5 + _TOOTH[None, :, 0])).ravel()
    y = np.tile(np.where(_TOOTH[:, 1] > 0, -TALL, DEEP), count)
    back = [(end, DEEP), (end, 3 * DEEP), (start, 3 * DEEP)]
    outline = placed(np.vstack([np.stack([x, y], axis=1), back]), at, along)
    line = placed([(start, 0), (end, 0)], at, along)
    return Shape((Line(outline, "lw-gear", closed=True), Line(line, "lw-pitch")), (outline, line))


@SYMBOLS.register("cam")
def cam(
    *,
    profile: ArrayLike = ((20.0, 0.0), (15.0, 14.0), (0.0, 20.0), (-15.0, 14.0), (-20.0, 0.0), (0.0, -36.0)),
    pitch: ArrayLike = (),
    outer: ArrayLike = (),
) -> Shape:
    """A cam: its closed profile, filled, and its pitch curve, a chain line; ``outer``: a groove's other wall."""
    inner, curve, wall = points(profile), points(pitch), points(outer)
    body = Line(inner, "lw-plate", closed=True)
    groove = (Line(wall, "lw-rim", closed=True),) if len(wall) else ()
    chain = (Line(curve, "lw-pitch", closed=True),) if len(curve) else ()
    edges = (each for each in (inner, curve, wall) if len(each))
    return Shape((*groove, body, *chain), tuple(_thinned(each) for each in edges))


def _thinned(outline: Floats, most: int = 90) -> Floats:
    """A closed polyline with few of the points of an outline, for keeping labels clear of it."""
    few = outline[:: max(1, len(outline) // most)]
    return np.vstack([few, few[:1]])


@SYMBOLS.register("roller")
def roller(*, at: Vec = (0.0, 0.0), radius: float = 12.0) -> Shape:
    """The roller of a follower."""
    return Shape((Circle(at, radius, "lw-ground"),), (ring(at, radius, 24),))


@SYMBOLS.register("knife")
def knife(*, at: Vec = (0.0, 0.0), along: Vec = (0.0, -1.0)) -> Shape:
    """The edge of a follower: the tip of a wedge that opens ``along``."""
    wedge = placed([(0.0, 0.0), (14.0, 4.5), (14.0, -4.5)], at, along)
    return Shape((Line(wedge, "lw-gear", closed=True),), (np.vstack([wedge, wedge[:1]]),))


@SYMBOLS.register("face")
def face(*, start: Vec = (-30.0, 0.0), end: Vec = (30.0, 0.0)) -> Shape:
    """The flat face of a follower."""
    line = points([start, end])
    return Shape((Line(line, "lw-bar"),), (line,))
