"""Drives, guides, slots and gears as they are drawn."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from linkwright.core.data import Plain
from linkwright.errors import LinkwrightError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.files.write import flow
from linkwright.joints.base import JOINTS
from linkwright.joints.gear import GearPair
from linkwright.joints.prismatic import PrismaticJoint
from linkwright.server import request
from linkwright.server.draft import Draft, length
from linkwright.server.drawn import new_point, put_point
from linkwright.server.entries import word
from linkwright.server.links import fresh_block, put_link
from linkwright.server.naming import by_function
from linkwright.server.outline import outlined
from linkwright.server.reassembled import reassemble
from linkwright.server.values import accept, errors
from linkwright.units import number
from linkwright.words import _

#: Speeds of new drives.
TURNING, SLIDING = "60 rpm", "0.1 m/s"
#: Keys of a drive that say what it drives.
WAYS = ("turn", "about", "relative_to", "slide")
#: Two numbers of teeth.
TEETH = re.compile(r"\s*([1-9][0-9]{0,5})\s*[:：]\s*([1-9][0-9]{0,5})\s*")

_NO_SLOT = _("{name!r} is not a link with two drawn points along which something could slide", code="studio.no_slot")


_NO_GEARS = _(
    "{links} cannot mesh: each needs a fixed point to turn about, or a pin on one common arm", code="studio.no_gears"
)
_NOT_DRIVEN = _(
    "{name!r} cannot be driven: it needs a fixed point to turn about, or a guide to slide along",
    code="studio.no_drive",
)


def driver(draft: Draft, action: Mapping[str, Any]) -> None:
    """A link turned about a pin, of the frame where none is named, or a block moved along its guide, evenly."""
    if "slide" in action:
        name = request.name(action, "slide")
        if name not in _slides(draft):
            raise LinkwrightError(_NOT_DRIVEN.format(name=name))
        _drive(draft, {"slide": name, "speed": SLIDING})
        reassemble(draft)
        return
    link = request.name(action, "link")
    draft.link(link)
    shown = draft.picture()
    pin = next((point for point in shown["links"][link] if point in shown["fixed"]), None)
    slide = next(
        (key for key, joint in _slides(draft).items() if link in (word(joint, "block"), word(joint, "guide"))), None
    )
    if "about" in action or pin is not None:
        about, before = request.name(action, "about") if "about" in action else pin, draft.text
        _drive(draft, {"turn": link, "about": about, "speed": TURNING})
        accept(draft, before, ["driver"])
        by_function(draft)
    elif slide is not None:
        _drive(draft, {"slide": slide, "speed": SLIDING})
    else:
        raise LinkwrightError(_NOT_DRIVEN.format(name=link))
    reassemble(draft)


def _drive(draft: Draft, entry: Plain) -> None:
    """Writes the drive: in place of a single one, or of the first of several; its law stays where it fits."""
    drivers = draft.section("drivers")
    node = drivers.entries[0].value if drivers is not None and drivers.entries else draft.root.get("driver")
    way = "turn" if "turn" in entry else "slide"
    if isinstance(node, MappingNode) and node.get(way) is not None:
        law = {key: outlined(value) for key, value in node if key not in WAYS}
        entry = {key: value for key, value in entry.items() if key in WAYS} | law
    if node is not None:
        draft.write(node, flow(entry))
    else:
        draft.put_top("driver", entry)


def _slides(draft: Draft) -> dict[str, MappingNode]:
    """The joints along which something slides."""
    joints = ((key, joint) for key, joint in draft.section("joints") or () if isinstance(joint, MappingNode))
    kinds = {key: (joint, word(joint, "kind")) for key, joint in joints}
    return {
        key: joint for key, (joint, kind) in kinds.items() if kind in JOINTS and JOINTS[kind].coordinate == "slide"
    }


def guide(draft: Draft, action: Mapping[str, Any]) -> None:
    """A block on a fixed guide through a point's place in the drawing; without a link a new block on the point."""
    at = request.name(action, "at")
    draft.complete([at])
    place, shown = draft.where(at), draft.shown()
    link = request.name(action, "link") if "link" in action else fresh_block(draft)
    if link not in shown["links"]:
        put_link(draft, link, [at])
    through = new_point(draft, stem="G")
    put_point(draft, through, place, fixed=True)
    direction = f"{number(round(request.number(action, 'angle'), 3))} deg"
    entry = {"kind": PrismaticJoint.kind, "guide": "frame", "through": through, "direction": direction}
    draft.put_new("joints", "guide", {**entry, "block": link, "at": at})


def slot(draft: Draft, action: Mapping[str, Any]) -> None:
    """A block that slides along a moving link, from its first point to its last, at a point next to or on it."""
    along, at = request.name(action, "along"), request.name(action, "at")
    ends = draft.picture()["links"].get(along, [])
    draft.complete([*ends, at])
    places = draft.shown()["points"]
    if len(ends) < 2 or at in ends or not all(point in places for point in (*ends, at)):
        raise LinkwrightError(_NO_SLOT.format(name=along))
    start, end, place = (draft.where(point) for point in (ends[0], ends[-1], at))
    if start == end:
        raise LinkwrightError(_NO_SLOT.format(name=along))
    across = ((end - start).conjugate() * (place - start)).imag / abs(end - start)
    block = fresh_block(draft)
    put_link(draft, block, [at])
    entry = {"kind": PrismaticJoint.kind, "guide": along, "through": ends[0], "direction": [ends[0], ends[-1]]}
    entry |= {"block": block, "at": at}
    if abs(across) >= draft.step / 2:
        entry["offset"] = length(across, draft.step)
    draft.put_new("joints", "slot", entry)


def gear(draft: Draft, action: Mapping[str, Any]) -> None:
    """Two links as gears with numbers of teeth ``20:40``, one in the other with ``inside``."""
    text = request.text(action, "teeth")
    teeth = TEETH.fullmatch(text)
    if teeth is None:
        raise LinkwrightError(
            _("invalid numbers of teeth {text!r}; write them as 20:40", code="studio.no_teeth", text=text)
        )
    links = request.names(action, "links")
    for each in links:
        draft.link(each)
    if len(set(links)) != 2:
        raise LinkwrightError(_NO_GEARS.format(links=tuple(links)))
    entry = {"kind": GearPair.kind, "links": links, "teeth": [int(z) for z in teeth.groups()]}
    if action.get("inside"):
        entry["mesh"] = "internal"
    before = draft.text
    name = draft.put_new("joints", "mesh", entry)
    if any(each.key.startswith(f"joints.{name}") and each.code == "reference" for each in errors(draft.text)):
        draft.text = before
        raise LinkwrightError(_NO_GEARS.format(links=tuple(links)))
