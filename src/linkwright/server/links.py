"""Links as they are drawn: bars with their length, plates, blocks; points that are added to them."""

from __future__ import annotations

import cmath
from collections.abc import Mapping
from typing import Any

from linkwright.core.data import Plain
from linkwright.core.expressions import amount
from linkwright.errors import LinkwrightError, QuantityError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.files.write import flow
from linkwright.server import request
from linkwright.server.agreement import Condition, nearest
from linkwright.server.draft import Draft, coordinates, length
from linkwright.server.drawn import new_point, put_point
from linkwright.server.entries import fresh, texts
from linkwright.server.geometry import Values, heading, shape
from linkwright.server.sizes import angle, in_axes, quantity, typed
from linkwright.words import _

_NO_TRIANGLE = _("sides of {sides} make no triangle", code="studio.no_triangle")


def link(draft: Draft, action: Mapping[str, Any]) -> None:
    """A block of one point, a bar of two, a plate of more."""
    points = request.names(action, "points")
    sides = action.get("sides") or [None] * len(points)
    if not points or not isinstance(sides, list) or len(sides) != len(points):
        request.refuse("sides" if points else "points", "names")
    name = request.name(action, "name") if "name" in action else fresh_link(draft, "link" if points[1:] else "slider")
    written = [None if side in (None, "") else quantity(side, "length", "sides") for side in sides]
    written[0] = typed(action, "length", "length") or written[0]
    put_link(draft, name, points, written)


def fresh_link(draft: Draft, stem: str = "link") -> str:
    """A name for a link."""
    return fresh(stem, [*draft.picture()["links"], *(key for key, _unused in draft.section("joints") or ())])


def put_link(draft: Draft, name: str, points: list[str], sides: list[str | None] | None = None) -> None:
    """A link through points, with its sizes; points that nothing draws become part of the drawing."""
    if len(set(points)) < len(points):
        raise LinkwrightError(_("a link has each of its points once", code="studio.point_twice"))
    draft.complete(points)
    known = draft.picture()["points"]
    for point in points:
        if point not in known and point in draft.shown()["points"]:
            put_point(draft, point, draft.where(point))
    if name not in draft.picture()["links"]:
        draft.made.append(name)
    places = draft.shown()["points"]
    at = {point: complex(*places[point]) for point in points if point in places}
    given = sides or [None] * len(points)
    sized = len(points) > 1 and len(at) == len(points)
    draft.put("links", name, _entry(draft, at, given) if sized else {"points": points})


def _entry(draft: Draft, at: Mapping[str, complex], sides: list[str | None]) -> Plain:
    """The sizes of a link between places; of a plate, typed sides go round it in the order of its points."""
    points, local = list(at), in_axes(at, at)
    first = sides[0] or length(abs(local[points[1]]), draft.step)
    if len(points) == 2:
        return {"points": points, "length": first}
    if len(points) == 3 and any(sides):
        return _triangle(draft, local, sides)
    step = draft.step
    if any(sides[1:]):
        local, step = _with_sides(local, sides), 0.01 * step
    also = {point: coordinates(local[point], step) for point in points[2:]}
    return {"points": points[:2], "length": first, "also": also}


def _triangle(draft: Draft, local: Mapping[str, complex], sides: list[str | None]) -> Plain:
    """Two lengths from the first point and the angle between them, by the third side where that was typed."""
    _corner, second, third = local.values()
    drawn = (abs(second), abs(third - second), abs(third))
    a, b, c = (side or length(size, draft.step) for side, size in zip(sides, drawn, strict=True))
    turn = angle(cmath.phase(third))
    if sides[1]:
        sign = "-" if third.imag < 0 else ""
        turn = f"{sign}acos((({a})^2 + ({c})^2 - ({b})^2)/(2*({a})*({c})))"
        try:
            amount(turn, "angle")
        except QuantityError:
            raise LinkwrightError(_NO_TRIANGLE.format(sides=(a, b, c))) from None
    return {"points": list(local), "lengths": [a, c], "angle": turn}


def _with_sides(local: Mapping[str, complex], sides: list[str | None]) -> dict[str, complex]:
    """Corners of a plate nearest to those drawn whose typed sides are as long as typed."""
    corners, wanted = list(local), list[Condition]()
    for start, end, side in zip(corners, [*corners[1:], corners[0]], sides, strict=True):
        if side or start == corners[0]:
            size = amount(side, "length") if side else abs(local[end] - local[start])
            wanted.append(_apart(start, end, size))
    found = nearest(wanted, local, corners[1:])
    if found is None:
        raise LinkwrightError(_NO_TRIANGLE.format(sides=tuple(side for side in sides if side)))
    return in_axes(corners, {**local, **found})


def _apart(start: str, end: str, size: float) -> Condition:
    return Condition("", (start, end), lambda at: [abs(at[end] - at[start]) - size])


def add_point(draft: Draft, action: Mapping[str, Any]) -> None:
    """A point of a link more: a new one, or a joint that is there."""
    name = request.name(action, "link")
    draft.link(name)
    known = draft.picture()["links"][name]
    point = request.name(action, "point") if "point" in action else new_point(draft)
    if point in known:
        raise LinkwrightError(
            _("{link!r} has the point {name!r} already", code="studio.has_point", link=name, name=point)
        )
    draft.complete([*known, point])
    if point not in draft.picture()["points"]:
        there = draft.shown()["points"].get(point)
        put_point(draft, point, complex(*(request.place(action, "at") if "at" in action or not there else there)))
    places = draft.shown()["points"]
    at = {each: complex(*places[each]) for each in (*known, point) if each in places}
    entry = draft.link(name)
    sized = shape(Values(draft.root), entry)
    if sized is None:
        draft.write(entry.get("points") or entry, flow([*texts(entry.get("points")), point]))
        return
    turned = heading(draft.root, name, at)
    if turned is None and len(known) == 1:
        draft.put("links", name, {"points": [*known, point]})
        _give_length(draft, name, at, known[0], point)
        return
    if turned is None:
        draft.where(next(each for each in known if each not in at))
    base = next(iter(sized.points))
    local = (at[point] - at[base]) / (turned or 1.0) + sized.points[base]
    _put_coordinates(draft, name, point, coordinates(local, draft.step))


def _give_length(draft: Draft, name: str, at: Mapping[str, complex], first: str, second: str) -> None:
    size = abs(at[second] - at[first])
    draft.write_key(draft.link(name), "length", length(size, draft.step))


def _put_coordinates(draft: Draft, name: str, point: str, written: list[str]) -> None:
    """Writes where a further point is in a link's axes."""
    entry = draft.link(name)
    key = "points" if isinstance(entry.get("points"), MappingNode) else "also"
    table = entry.get(key)
    if isinstance(table, MappingNode):
        draft.write_key(table, point, flow(written))
    else:
        draft.write_key(entry, "also", flow({point: written}))
