"""Bodies that cannot move against each other become one: bars in triangles, bodies that share two points."""

from __future__ import annotations

import math
from itertools import combinations

from linkwright.importers.layout import FRAME, Body, Layout, Remarks
from linkwright.words import _

#: Keys of pairs of wheels that name links.
WHEEL_KEYS = {"links", "carrier", "pinion", "rack"}


def join_rigid(layout: Layout, remarks: Remarks) -> dict[str, str]:
    """Joins bodies that share two distinct points, and three bodies pinned in a triangle, as long as there are any.

    What is joined with the frame becomes the frame; a note tells of each. Returns the name that each body has now, of
    all that are gone.
    """
    gone: dict[str, str] = {}
    while (found := _rigid(layout)) is not None:
        kept, *others = sorted(found, key=lambda name: name != FRAME)
        for name in others:
            message = _("{old} and {new} cannot move against each other and are one link", old=name, new=kept)
            remarks.remark("note", message, "", "import.joined", key=layout.bodies[name].key or name)
            join(layout, kept, name)
            gone[name] = kept
    return {name: _last(gone, name) for name in gone}


def _last(gone: dict[str, str], name: str) -> str:
    while name in gone:
        name = gone[name]
    return name


def _rigid(layout: Layout) -> tuple[str, ...] | None:
    """Bodies of which none moves against another, in the order of the layout; None: all move."""
    bodies = {body.name: body for body in layout.all}
    shared: dict[tuple[str, str], list[str]] = {}
    holders: dict[str, list[str]] = {}
    for body in bodies.values():
        for point in body.places:
            holders.setdefault(point, []).append(body.name)
    for point, names in holders.items():
        for a, b in combinations(names, 2):
            shared.setdefault((a, b), []).append(point)
    size = max((math.dist((0.0, 0.0), each) for body in layout.all for each in body.places.values()), default=1.0)
    for (a, b), points in shared.items():
        if any(math.dist(bodies[a].places[p], bodies[a].places[q]) > 1e-9 * size for p, q in combinations(points, 2)):
            return a, b
    for (a, b), points in shared.items():
        for c in bodies:
            first, second = shared.get((a, c)), shared.get((b, c))
            if first and second and _corners(bodies[a], bodies[b], points[0], first[0], second[0], size):
                return a, b, c
    return None


def _corners(a: Body, b: Body, ab: str, ac: str, bc: str, size: float) -> bool:
    """Whether the three pins of three bodies are corners of a triangle, not on a line."""
    (x0, y0), (x1, y1), (x2, y2) = a.places[ab], a.places[ac], b.places[bc]
    return abs((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)) > 1e-6 * size * size


def join(layout: Layout, kept: str, name: str) -> None:
    """Makes a body a part of another one; masses add up about their common centre."""
    body, target = layout.bodies.pop(name), layout.body(kept)
    if target.mass and body.mass and target.centre and body.centre:
        total = target.mass + body.mass
        both = zip(target.centre, body.centre, strict=True)
        x, y = ((target.mass * p + body.mass * q) / total for p, q in both)
        joined = (x, y)
        target.inertia += target.mass * math.dist(target.centre, joined) ** 2
        target.inertia += body.inertia + body.mass * math.dist(body.centre, joined) ** 2
        target.mass, target.centre = total, joined
    elif body.mass:
        target.mass, target.inertia, target.centre = body.mass, body.inertia, body.centre
    target.colour, target.length = target.colour or body.colour, None
    for point, place in body.places.items():
        target.places.setdefault(point, place)
    for slide in layout.slides:
        slide.guide = kept if slide.guide == name else slide.guide
        slide.block = kept if slide.block == name else slide.block
    for force in layout.forces:
        force.on = kept if force.on == name else force.on
    for drive in layout.drives:
        drive.turn = kept if drive.turn == name else drive.turn
        drive.against = kept if drive.against == name else drive.against
        if drive.between is not None:
            (a, one), (b, other) = drive.between
            drive.between = (kept if a == name else a, one), (kept if b == name else b, other)
    for wheels in layout.wheels:
        for key in WHEEL_KEYS & wheels.values.keys():
            value = wheels.values[key]
            if isinstance(value, list):
                wheels.values[key] = [kept if each == name else each for each in value]
            elif value == name:
                wheels.values[key] = kept
    layout.traced = [
        f"{kept}.{each.split('.')[1]}" if each.startswith(f"{name}.") else each for each in layout.traced
    ]
