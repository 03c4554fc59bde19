"""Links as they are drawn: bars with their length, plates, blocks; points that are added to them."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import count
from typing import Any

from linkwright.errors import LinkwrightError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.files.write import flow
from linkwright.server import request
from linkwright.server.draft import Draft, coordinates, length
from linkwright.server.drawn import all_points, new_point, put_point
from linkwright.server.entries import fresh, texts
from linkwright.server.forms import link_entry
from linkwright.server.geometry import Values, heading, shape
from linkwright.server.sizes import quantity, typed
from linkwright.words import _


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
    return fresh(stem, draft.taken)


def fresh_block(draft: Draft) -> str:
    """A name for a block: slider, then with numbers."""
    known = draft.taken
    return "slider" if "slider" not in known else next(n for k in count(2) if (n := f"slider{k}") not in known)


def put_link(draft: Draft, name: str, points: list[str], sides: list[str | None] | None = None) -> None:
    """A link through points, with its sizes; points that nothing draws become part of the drawing."""
    if len(set(points)) < len(points):
        raise LinkwrightError(_("a link has each of its points once", code="studio.point_twice"))
    draft.complete(points)
    known, there = draft.picture()["points"], all_points(draft)
    for point in points:
        if point not in there:
            draft.where(point)
        if point not in known and point in draft.shown()["points"]:
            put_point(draft, point, draft.where(point))
    if name not in draft.picture()["links"]:
        draft.made.append(name)
    places = draft.shown()["points"]
    at = {point: complex(*places[point]) for point in points if point in places}
    given = sides or [None] * len(points)
    sized = len(points) > 1 and len(at) == len(points)
    draft.put("links", name, link_entry(draft, at, given) if sized else {"points": points})


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
    for each in known[:2]:
        draft.where(each)
    turned = heading(draft.root, name, at)
    if turned is None and len(known) == 1:
        draft.put("links", name, {"points": [*known, point]})
        _give_length(draft, name, at, known[0], point)
        return
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
