"""Drives, guides, slots and gears as they are drawn."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any

from linkwright.errors import LinkwrightError
from linkwright.joints.gear import GearPair
from linkwright.joints.prismatic import PrismaticJoint
from linkwright.server import request
from linkwright.server.draft import Draft
from linkwright.server.drawn import FINEST, coordinates, put_link, put_point
from linkwright.server.entries import fresh
from linkwright.units import number
from linkwright.words import _

#: Two numbers of teeth.
TEETH = re.compile(r"\s*([1-9][0-9]{0,5})\s*[:：]\s*([1-9][0-9]{0,5})\s*")

_NO_SLOT = _("{name!r} is not a link with two drawn points along which something could slide", code="studio.no_slot")


def driver(draft: Draft, action: Mapping[str, Any]) -> None:
    """A link turned about a pin of the frame, evenly."""
    link, about = request.name(action, "link"), request.name(action, "about")
    draft.put_top("driver", {"turn": link, "about": about, "speed": "60 rpm"})


def guide(draft: Draft, action: Mapping[str, Any]) -> None:
    """A block on a fixed guide through a point's place in the drawing."""
    shown = draft.shown()
    link, at = request.name(action, "link"), request.name(action, "at")
    if at not in shown["points"]:
        raise LinkwrightError(
            _("there is no place for the point {name!r} on the paper", code="studio.no_point", name=at)
        )
    through = fresh("G", [*shown["points"], *shown["fixed"]])
    put_point(draft, through, shown["points"][at], fixed=True)
    angle = f"{number(round(request.number(action, 'angle'), 3))} deg"
    draft.put_new(
        "joints",
        "guide",
        {
            "kind": PrismaticJoint.kind,
            "guide": "frame",
            "through": through,
            "direction": angle,
            "block": link,
            "at": at,
        },
    )


def slot(draft: Draft, action: Mapping[str, Any]) -> None:
    """A block that slides along a moving link, from its first point to its last, at a point next to or on it."""
    shown, along, at = draft.shown(), request.name(action, "along"), request.name(action, "at")
    ends = shown["links"].get(along, [])
    if len(ends) < 2 or not all(point in shown["points"] for point in (*ends, at)):
        raise LinkwrightError(_NO_SLOT.format(name=along))
    (ax, ay), (bx, by), (x, y) = (shown["points"][point] for point in (ends[0], ends[-1], at))
    if not math.dist((ax, ay), (bx, by)):
        raise LinkwrightError(_NO_SLOT.format(name=along))
    across = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / math.dist((ax, ay), (bx, by))
    block = fresh("slider", list(shown["links"]))
    put_link(draft, block, [at])
    entry = {
        "kind": PrismaticJoint.kind,
        "guide": along,
        "through": ends[0],
        "direction": [ends[0], ends[-1]],
        "block": block,
        "at": at,
    }
    if abs(across) >= FINEST / 2:
        entry["offset"] = coordinates([across])[0]
    draft.put_new("joints", "slot", entry)


def gear(draft: Draft, action: Mapping[str, Any]) -> None:
    """Two links as gears with numbers of teeth ``20:40``."""
    text = request.text(action, "teeth")
    teeth = TEETH.fullmatch(text)
    if teeth is None:
        raise LinkwrightError(
            _("invalid numbers of teeth {text!r}; write them as 20:40", code="studio.no_teeth", text=text)
        )
    links = request.names(action, "links")
    entry = {"kind": GearPair.kind, "links": links, "teeth": [int(z) for z in teeth.groups()]}
    draft.put_new("joints", "mesh", entry)
