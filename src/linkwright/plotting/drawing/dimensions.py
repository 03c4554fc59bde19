"""Dimensions of links and between points: lengths next to the machine, angles as arcs."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import length_text
from linkwright.errors import RequestError
from linkwright.kinematics.names import find_point
from linkwright.pictures.labels import Label, Obstacles
from linkwright.pictures.picture import Vec
from linkwright.pictures.symbols.base import SYMBOLS, Shape, placed, points, vec, way
from linkwright.plotting.drawing.guides import direction, line_start
from linkwright.plotting.drawing.machine import DrawnMechanism, moved
from linkwright.words import _

Dimension = str | tuple[str, str]
_OFFSETS = (24.0, -24.0, 40.0, -40.0, 58.0, -58.0)
_RADII = (34.0, 48.0, 64.0)
#: Lengths of the paper below this are none, and angles, rad.
ALIKE = 1e-6


@dataclass(frozen=True)
class Dimensioned:
    """A dimension and its label: a length between the places ``ends`` with its dimension ``line``, or an ``arc``; all
    on the paper."""

    shape: Shape
    label: Label
    ends: tuple[Vec, Vec] | None = None
    line: tuple[Vec, Vec] | None = None
    arc: Arc | None = None


@dataclass(frozen=True)
class Arc:
    """About a place of the paper, from one direction over a ``sweep`` (rad, clockwise on the paper)."""

    at: Vec
    radius: float
    first: float
    sweep: float


@dataclass(frozen=True)
class Distance:
    """From a place to another one of the paper, measured ``along`` a direction of the paper; default straight."""

    start: Vec
    end: Vec
    along: Vec | None = None


@dataclass(frozen=True)
class Angle:
    """At a place of the paper, from one direction to another (rad, clockwise on the paper), ``value`` rad."""

    at: Vec
    first: float
    last: float
    value: float


def dimension_lines(
    machine: DrawnMechanism, wanted: Iterable[Dimension] | bool, index: int, ink: list[Floats]
) -> list[Dimensioned]:
    """Dimensions on the side where they cross the fewest lines.

    ``wanted``: links (``crank``, ``frame``) with all that places their points, or two points (``("O1", "O3")``);
    True for all links and the frame.
    """
    found: list[Dimensioned] = []
    for measure in _measures(machine, wanted, index):
        taken = Obstacles.of([*ink, *(line for one in found for line in one.shape.ink)])
        if isinstance(measure, Angle):
            found.append(_arc(measure, taken))
        else:
            found.append(_line(machine, measure, taken))
    return found


def _measures(machine: DrawnMechanism, wanted: Iterable[Dimension] | bool, index: int) -> Iterator[Distance | Angle]:
    if isinstance(wanted, bool):
        for link in ("frame", *machine.motion.mechanism.links) if wanted else ():
            yield from _of_link(machine, link, index)
        return
    for each in wanted:
        if isinstance(each, str):
            found = list(_of_link(machine, each.removesuffix(".length"), index))
            if not found:
                raise RequestError(
                    _(
                        'link "{link}" has one point, so it has no length; name two points instead',
                        code="picture.no_length",
                        link=each,
                    )
                )
            yield from found
        else:
            start, end = (machine.paper(*find_point(machine.motion.mechanism, name), index) for name in each)
            yield Distance(start, end)


def _of_link(machine: DrawnMechanism, name: str, index: int) -> Iterator[Distance | Angle]:
    """What places the points of a link: lengths and the angle of a bent one, the frame's points across and up."""
    link = machine.motion.mechanism.link(name)
    at = {point: machine.paper(name, point, index) for point in link.points}
    rows = list(link.points)
    if name == "frame":
        yield from _of_frame(machine, at)
    elif link.geometry == "bent":
        first, second, third = rows[:3]
        yield Distance(at[first], at[second])
        yield Distance(at[first], at[third])
        yield Angle(at[first], _way(at[first], at[second]), _way(at[first], at[third]), link.angle)
        rows = [first, second, *rows[3:]]
    for number, point in enumerate(rows[1:] if name != "frame" else (), 1):
        if link.geometry == "bent" and number == 1:
            continue
        yield Distance(at[rows[0]], at[point])
        if number > 1 and _off_line(at[rows[0]], at[rows[1]], at[point]):
            yield Distance(at[rows[1]], at[point])
    if name != "frame":
        yield from _slopes(machine, name, index)
    yield from _offsets(machine, name, index)


def _of_frame(machine: DrawnMechanism, at: dict[str, Vec]) -> Iterator[Distance | Angle]:
    """How far the frame's points are from the first one, across and up; directions of its inclined guides."""
    named = list(at)
    for point in named[1:]:
        for along in ((1.0, 0.0), (0.0, 1.0)):
            if abs(np.dot(np.subtract(at[point], at[named[0]]), along)) > ALIKE:
                yield Distance(at[named[0]], at[point], along)
    for joint in machine.guides.values():
        if joint.guide == "frame":
            turned = math.atan2(*direction(machine, joint)[::-1])
            if _inclined(turned):
                yield _slope(at[joint.through], 0.0, turned)


def _slopes(machine: DrawnMechanism, name: str, index: int) -> Iterator[Angle]:
    """Directions of the link's guides against its x axis, where these do not go through two of its points."""
    turn = machine.view.transform(machine.placed[name], index)[2]
    for joint in machine.guides.values():
        if joint.guide == name and joint.direction_points is None and _inclined(joint.direction):
            yield _slope(machine.paper(name, joint.through, index), math.radians(turn), -joint.direction)


def _slope(at: Vec, axis: float, turned: float) -> Angle:
    """The acute angle between an axis and a line turned against it (rad, clockwise on the paper)."""
    turned = math.remainder(turned, 2.0 * math.pi)
    far = abs(turned) > math.pi / 2
    return Angle(
        at,
        axis + (math.copysign(math.pi, turned) if far else 0.0),
        axis + turned,
        math.pi - abs(turned) if far else abs(turned),
    )


def _inclined(angle: float) -> bool:
    """Whether a direction, rad, is neither level nor upright."""
    return min(abs(angle % (math.pi / 2)), abs(-angle % (math.pi / 2))) > ALIKE


def _offsets(machine: DrawnMechanism, name: str, index: int) -> Iterator[Distance]:
    """Normal offsets of the link's guides."""
    for joint in machine.guides.values():
        if joint.guide == name and joint.offset:
            local = points([machine.local(name, joint.through), line_start(machine, joint)])
            start, end = moved(local, machine.view.transform(machine.placed[name], index))
            yield Distance(vec(start), vec(end))


def _line(machine: DrawnMechanism, measure: Distance, taken: Obstacles) -> Dimensioned:
    """A dimension line on the better side."""
    a, b, rises = measure.start, measure.end, (0.0, 0.0)
    if measure.along is not None:
        along = np.array(measure.along)
        if np.dot(np.subtract(b, a), along) < 0:
            a, b = b, a
        across = np.array([-along[1], along[0]])
        rises = (0.0, float(np.dot(np.subtract(b, a), across)))
        b = vec(np.array(b) - rises[1] * across)
    base = [(offset, offset + (min(rises) if offset < 0 else max(rises))) for offset in _OFFSETS]
    shapes = [
        (SYMBOLS["dimension_line"](start=a, end=b, offset=place, rises=rises), offset, place)
        for offset, place in base
    ]
    shape, _unused, place = min(shapes, key=lambda each: _crossing(each[0], taken) + 0.3 * abs(each[1]))
    length, direct = way(a, b)
    ends = a, vec(placed([(length, rises[1])], a, direct)[0])
    first, last = (vec(row) for row in placed([(0.0, place), (length, place)], a, direct))
    text, anchors = length_text(length / machine.view.scale), _middle(a, b, place)
    label = Label(text, anchors, "lw-value", 12.0, 5.0, along=(first, last))
    return Dimensioned(shape, label, ends, (first, last))


def _arc(measure: Angle, taken: Obstacles) -> Dimensioned:
    """An arc with heads between the directions."""
    sweep = (measure.last - measure.first + math.pi) % (2 * math.pi) - math.pi
    shapes = [
        (SYMBOLS["dimension_arc"](at=measure.at, radius=radius, first=measure.first, sweep=sweep), radius)
        for radius in _RADII
    ]
    shape, radius = min(shapes, key=lambda pair: _crossing(pair[0], taken) + 0.3 * pair[1])
    middle = measure.first + 0.5 * sweep
    x, y = measure.at[0] + radius * math.cos(middle), measure.at[1] + radius * math.sin(middle)
    text = f"{abs(math.degrees(measure.value)):.6g}°"
    label = Label(text, ((x, y),), "lw-value", 12.0, 5.0)
    return Dimensioned(shape, label, arc=Arc(measure.at, radius, measure.first, sweep))


def _crossing(shape: Shape, taken: Obstacles) -> float:
    """Ink near points along a dimension line."""
    if not shape.ink:
        return 0.0
    line = shape.ink[0]
    share = np.linspace(0.0, 1.0, 15)[:, None]
    dots = line[0] + share * (line[-1] - line[0]) if len(line) == 2 else line
    return float(taken.under(np.hstack([dots - 4.0, dots + 4.0])).sum())


def _middle(a: Vec, b: Vec, offset: float) -> tuple[Vec, ...]:
    length, along = way(a, b)
    shares: Sequence[float] = (0.5, 0.4, 0.6, 0.3, 0.7)
    return tuple(vec(row) for row in placed([(share * length, offset) for share in shares], a, along))


def _off_line(a: Vec, b: Vec, c: Vec) -> bool:
    """Whether three places do not lie on one line."""
    (ux, uy), (vx, vy) = np.subtract(b, a), np.subtract(c, a)
    return float(abs(ux * vy - uy * vx)) > 1e-6 * (math.hypot(ux, uy) * math.hypot(vx, vy) + 1.0)


def _way(start: Vec, end: Vec) -> float:
    return math.atan2(end[1] - start[1], end[0] - start[0])
