"""Points and links as they are drawn."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.files.write import flow
from linkwright.server import request
from linkwright.server.draft import Draft
from linkwright.units import number

#: Drawn coordinates are integer multiples of this, m.
FINEST = 1e-4


def coordinates(at: Iterable[float]) -> list[str]:
    """Drawn coordinates (m) as they are written."""
    return [f"{number(round(x / FINEST) / 10)} mm" if abs(x) >= FINEST / 2 else "0 mm" for x in at]


def point(draft: Draft, action: Mapping[str, Any]) -> None:
    """A point of the frame, or one that links follow."""
    put_point(draft, request.name(action, "name"), request.place(action, "at"), bool(action.get("fixed")))


def put_point(draft: Draft, name: str, at: list[float], fixed: bool = False) -> None:
    """Draws a point of the frame or of links that follow."""
    place, known = coordinates(at), draft.picture()
    if name not in known["points"] and not any(name in points for points in known["links"].values()):
        draft.made.append(name)
    if not fixed:
        draft.put("drawing", name, place)
        return
    frame = draft.section("frame")
    points = frame.get("points") if frame is not None else None
    if not isinstance(points, MappingNode):
        draft.put("frame", "points", {name: place})
    else:
        draft.write_key(points, name, flow(place))


def link(draft: Draft, action: Mapping[str, Any]) -> None:
    """A link through points."""
    put_link(draft, request.name(action, "name"), request.names(action, "points"))


def put_link(draft: Draft, name: str, points: list[str]) -> None:
    """A link through points; those that no drawing gives become part of it."""
    known, there = draft.picture()["points"], draft.shown()["points"]
    for point in points:
        if point not in known and point in there:
            put_point(draft, point, there[point])
    if name not in draft.picture()["links"]:
        draft.made.append(name)
    draft.put("links", name, {"points": points})
