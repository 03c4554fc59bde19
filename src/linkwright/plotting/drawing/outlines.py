"""A machine drawn as it is made: outlines of its plates, blocks, guides and pins to scale."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from linkwright.mechanism.wheels_and_cams import wheel_sizes
from linkwright.pictures.picture import Circle, Line, Outline
from linkwright.pictures.symbols.base import SYMBOLS, Shape, points, ring
from linkwright.plotting.drawing.joint_marks import marks
from linkwright.plotting.drawing.machine import DrawnMechanism, Layer, Part, plain_points
from linkwright.shapes.boundary import boundary
from linkwright.shapes.distance import contains
from linkwright.solids.solid import Solid, Sort
from linkwright.solids.solids_of import solids
from linkwright.words.message import in_language

#: Layer and style of what takes room, from the bottom of the paper upwards.
LOOKS: dict[Sort, tuple[Layer, str]] = {
    "frame": ("ground", "lw-base"),
    "guide": ("ground", "lw-base"),
    "wheel": ("ground", "lw-gear"),
    "cam": ("ground", "lw-gear"),
    "link": ("bodies", "lw-plate"),
    "block": ("blocks", "lw-block"),
    "roller": ("blocks", "lw-block"),
    "post": ("pins", "lw-pin"),
    "pin": ("pins", "lw-pin"),
}
#: Arms of the cross in the middle of a pin, as shares of its radius.
CROSS = 0.6


def outlines_of(machine: DrawnMechanism) -> Iterator[Part]:
    """All that takes room, with pitch circles of wheels, strands of belts, and dots at points that are no joints."""
    mechanism = machine.motion.mechanism
    found = solids(mechanism).by_name.values()
    order = [*LOOKS]
    for solid in sorted(found, key=lambda each: (order.index(each.sort), -each.shape.bound[1])):
        yield _outlined(machine, solid)
    yield from _pitch_lines(machine)
    for link in mechanism.links.values():
        own = [each.shape for each in found if each.carrier == link.name]
        for name in plain_points(machine, link):
            if not own or any(contains(shape, np.array([complex(*link.points[name])])).all() for shape in own):
                yield Part("pins", link.name, SYMBOLS["point"](at=machine.local(link.name, name)))


def notes_of_outlines(machine: DrawnMechanism, language: str) -> list[str]:
    """What sizes were taken by rule, and what is not drawn."""
    return [in_language(each, language) for each in solids(machine.motion.mechanism).notes]


def _outlined(machine: DrawnMechanism, solid: Solid) -> Part:
    layer, style = LOOKS[solid.sort]
    scale = np.array([machine.view.scale, -machine.view.scale])
    loops = []
    for loop in boundary(solid.shape):
        corners = np.array([(edge.start.real, edge.start.imag) for edge in loop.edges])
        loops.append((corners, np.array([edge.bulge for edge in loop.edges])))
    outline = Outline(tuple(loops), style).placed(np.zeros(2), scale=(scale[0], scale[1]))
    ink = tuple(np.split(outline.points, np.flatnonzero(np.isnan(outline.points[:, 0]))))
    shape = Shape((outline,), tuple(line[np.isfinite(line).all(axis=1)] for line in ink))
    return Part(layer, solid.carrier, shape + (_cross(outline) if solid.sort == "pin" else Shape(())))


def _cross(outline: Outline) -> Shape:
    """The cross in the middle of a pin."""
    low, high = outline.cloud.min(axis=0), outline.cloud.max(axis=0)
    middle, (arm, _unused) = 0.5 * (low + high), 0.5 * CROSS * (high - low)
    ways = (np.array([arm, 0.0]), np.array([0.0, arm]))
    return Shape(tuple(Line(points([middle - way, middle + way]), "lw-hatch") for way in ways))


def _pitch_lines(machine: DrawnMechanism) -> Iterator[Part]:
    """Pitch circles, and the strands of belts."""
    mechanism, scale, done = machine.motion.mechanism, machine.view.scale, set[tuple[str, float, float, float]]()
    for joint in mechanism.joints.values():
        sizes = wheel_sizes(joint, mechanism)
        if sizes is None:
            continue
        for mark in marks(joint, mechanism, {}):
            at = machine.view.local(mark.at)
            if mark.symbol == "strand":
                strand = SYMBOLS["strand"](start=at, end=machine.view.local(mark.to))
                yield Part("ground", mark.link, strand)
            elif mark.symbol in ("gear", "disc") and (key := (mark.link, *mark.at, mark.radius)) not in done:
                done.add(key)
                radius = scale * mark.radius
                circle = Shape((Circle(at, radius, "lw-pitch"),), (ring(at, radius, 36),))
                yield Part("ground", mark.link, circle)
