"""Symbols of machines: bodies of links, joints, supports, guides, springs and dampers."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.core.plane import convex_hull
from linkwright.pictures.picture import Circle, Line, Vec
from linkwright.pictures.symbols.base import PIN, SYMBOLS, Shape, around, hatching, joined, placed, points, ring, way


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

    Without their number ``teeth`` they show that it is a gear; likewise where they would be too fine to be visible.
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


@SYMBOLS.register("pin")
def pin(*, at: Vec = (0.0, 0.0), radius: float = PIN) -> Shape:
    """A small open circle."""
    return Shape((Circle(at, radius, "lw-pin"),), (ring(at, radius),))


@SYMBOLS.register("point")
def point(*, at: Vec = (0.0, 0.0), radius: float = 0.55 * PIN) -> Shape:
    """A dot: a named point that is no joint."""
    return Shape((Circle(at, radius, "lw-point"),), (ring(at, radius, 8),))


@SYMBOLS.register("fixed_pivot")
def fixed_pivot(*, at: Vec = (0.0, 0.0), toward: Vec = (0.0, 1.0), size: float = 18.0) -> Shape:
    """Triangle from the pin to the ground, which lies in the direction ``toward``."""
    half, base = 0.62 * size, 0.9 * size
    triangle = placed([(0, 0), (size, -half), (size, half)], at, toward)
    ground = placed([(size, base), (size, -base)], at, toward)
    first, last = ((float(x), float(y)) for x, y in ground)
    elements = (
        Line(triangle, "lw-support", closed=True),
        Line(ground, "lw-ground"),
        *(Line(stroke, "lw-hatch") for stroke in hatching(first, last, 1)),
    )
    outline = placed(
        [
            (0, 0),
            (size, -half),
            (size, -base),
            (size + 7, -base),
            (size + 7, base),
            (size, base),
            (size, half),
            (0, 0),
        ],
        at,
        toward,
    )
    middle = placed([(0, 0), (size + 4, 0), (size + 4, -base), (size + 4, base)], at, toward)
    return Shape(elements, (outline, middle))


@SYMBOLS.register("weld")
def weld(*, at: Vec = (0.0, 0.0), first: Vec = (1.0, 0.0), second: Vec = (0.0, 1.0), size: float = 13.0) -> Shape:
    """A filled triangle between the directions ``first`` and ``second`` of two bars; a square where they align."""
    cross = first[0] * second[1] - first[1] * second[0]
    if abs(cross) < 0.17:
        a = 0.45 * size
        corners = placed([(-a, -a), (a, -a), (a, a), (-a, a)], at, first)
    else:
        corners = points([at, *((at[0] + size * x, at[1] + size * y) for x, y in (first, second))])
    return Shape((Line(corners, "lw-weld", closed=True),), (corners,))


@SYMBOLS.register("wall")
def wall(*, at: Vec = (0.0, 0.0), toward: Vec = (0.0, 1.0), size: float = 18.0) -> Shape:
    """Hatched ground to which a link is welded; it lies in the direction ``toward``."""
    line = placed([(0, size), (0, -size)], at, toward)
    a, b = ((float(x), float(y)) for x, y in line)
    strokes = hatching(a, b, 1)
    ink = placed([(0, size), (0, -size), (7, -size), (7, size)], at, toward)
    return Shape((Line(line, "lw-ground"), *(Line(stroke, "lw-hatch") for stroke in strokes)), (ink,))


@SYMBOLS.register("mass_centre")
def mass_centre(*, at: Vec = (0.0, 0.0), radius: float = 6.0) -> Shape:
    """The symbol for the centre of mass."""
    quarters = [around(at, radius, np.linspace(first, first + 0.5 * np.pi, 13)) for first in (0.0, np.pi)]
    filled = (Line(np.vstack([points([at]), arc]), "lw-mass", closed=True) for arc in quarters)
    return Shape((Circle(at, radius, "lw-mass-ring"), *filled), (ring(at, radius),))


LENGTH, HEIGHT = 30.0, 18.0


@SYMBOLS.register("ground_guide")
def ground_guide(
    *,
    at: Vec = (0.0, 0.0),
    along: Vec = (1.0, 0.0),
    start: float = -30.0,
    end: float = 30.0,
    side: int = 1,
    height: float = HEIGHT,
) -> Shape:
    """A hatched surface that the block slides on, from ``start`` to ``end`` of the line through ``at``.

    ``side`` +1: the ground is to the right of ``along`` on the paper.
    """
    y = side * (height / 2 + 1.3)
    rail = placed([(start, y), (end, y)], at, along)
    first, last = ((float(x), float(z)) for x, z in rail)
    strokes = hatching(first, last, side)
    under = placed([(start, y + 7 * side), (end, y + 7 * side)], at, along)
    middle = placed([(start, y + 3.5 * side), (end, y + 3.5 * side)], at, along)
    elements = (Line(rail, "lw-ground"), *(Line(stroke, "lw-hatch") for stroke in strokes))
    return Shape(elements, (rail, middle, under))


@SYMBOLS.register("moving_guide")
def moving_guide(*, at: Vec = (0.0, 0.0), along: Vec = (1.0, 0.0), start: float = -30.0, end: float = 30.0) -> Shape:
    """The rod of a moving link on which a block slides."""
    rod = placed([(start, 0), (end, 0)], at, along)
    return Shape((Line(rod, "lw-bar"),), (rod,))


@SYMBOLS.register("slider")
def slider(*, at: Vec = (0.0, 0.0), along: Vec = (1.0, 0.0), length: float = LENGTH, height: float = HEIGHT) -> Shape:
    """A block with its long side along the guide."""
    a, b = length / 2, height / 2
    corners = placed([(-a, -b), (a, -b), (a, b), (-a, b)], at, along)
    outline = placed([(-a, -b), (a, -b), (a, b), (-a, b), (-a, -b)], at, along)
    return Shape((Line(corners, "lw-block", closed=True),), (outline,))


@SYMBOLS.register("barrel")
def barrel(*, at: Vec = (0.0, 0.0), along: Vec = (1.0, 0.0), length: float = 60.0, height: float = 15.0) -> Shape:
    """The barrel, hinged at ``at``."""
    a, b = 1.6 * PIN, height / 2
    box = placed([(a, -b), (length, -b), (length, b), (a, b)], at, along)
    stem = placed([(0, 0), (a, 0)], at, along)
    outline = placed([(a, -b), (length, -b), (length, b), (a, b), (a, -b)], at, along)
    return Shape((Line(stem, "lw-bar"), Line(box, "lw-block", closed=True)), (stem, outline))


@SYMBOLS.register("piston")
def piston(*, at: Vec = (0.0, 0.0), along: Vec = (1.0, 0.0), length: float = 40.0, height: float = 15.0) -> Shape:
    """Rod and piston; the rod ends at ``at`` and reaches back ``length`` against ``along``."""
    rod = placed([(-length, 0), (0, 0)], at, along)
    head = placed([(-length, -0.36 * height), (-length, 0.36 * height)], at, along)
    return joined([Shape((Line(rod, "lw-bar"),), (rod,)), Shape((Line(head, "lw-bar"),))])


#: Coils of a spring, and half of their width.
COILS, COIL_HEIGHT = 6, 7.0


@SYMBOLS.register("spring")
def spring(*, start: Vec = (0.0, 0.0), end: Vec = (60.0, 0.0)) -> Shape:
    """A coil spring between two points."""
    length, along = way(start, end)
    lead = min(0.18 * length, 16.0)
    x = np.linspace(lead, length - lead, 2 * COILS + 1)
    y = np.where(np.arange(len(x)) % 2 == 0, COIL_HEIGHT, -COIL_HEIGHT)
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
