"""Names: one changed wherever a text mentions it, and drawn links named by what they do."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from linkwright.errors import LinkwrightError, with_remedy
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, Sequence
from linkwright.files.node_reader import NAME
from linkwright.files.write import flow
from linkwright.server import request
from linkwright.server.draft import Draft
from linkwright.server.drawn import all_points
from linkwright.server.references import owner_of_plate
from linkwright.server.values import errors
from linkwright.words import _

#: Names that drawing gives to links.
GENERIC = re.compile(r"link\d+")
#: Sections with texts for people; keys whose words are no links, and no points.
PROSE = ("name", "purpose", "source", "report", "sheet")
NO_LINKS = ("kind", "at", "through", "about", "slide", "direction", "along", "normal_to", "law")
POINTS = ("at", "through", "about", "direction", "along", "normal_to", "mass_centre", "points", "between")


def rename(draft: Draft, action: Mapping[str, Any]) -> None:
    """Gives a link, point, pair, load, actuator, stop or driver another name wherever the text mentions it."""
    what, old, new = request.text(action, "what"), request.name(action, "from"), request.name(action, "to")
    if old == new:
        return
    if not NAME.fullmatch(new):
        raise LinkwrightError(
            _(
                "{name!r} cannot be a name: begin with a letter, then letters, digits and _",
                code="studio.no_name",
                name=new,
            )
        )
    known = names(draft, what)
    if old not in known:
        raise LinkwrightError(_("there is nothing named {name!r}", code="studio.nothing_named", name=old))
    taken = known if what == "point" else [each for kind in KINDS if kind != "point" for each in names(draft, kind)]
    if new in taken or new == "frame":
        raise LinkwrightError(_("the name {name!r} is taken", code="studio.name_taken", name=new))
    change(draft, what, old, new)


def names(draft: Draft, what: str) -> list[str]:
    """The names of all elements of a kind."""
    if what == "point":
        return sorted(all_points(draft))
    if what == "driver":
        alone = ["driver"] if draft.section("driver") else []
        return [*alone, *(key for key, _unused in draft.section("drivers") or ())]
    section = KINDS.get(what) or request.refuse("what", "name")
    return [key for key, _unused in draft.section(section) or ()]


#: Sections by what they hold.
KINDS = {
    "link": "links",
    "pair": "joints",
    "load": "loads",
    "actuator": "actuators",
    "stop": "stops",
    "driver": "drivers",
    "point": "drawing",
}
#: Sections whose words name links and joints, and points.
NAMING = ("joints", "loads", "actuators", "stops", "driver", "drivers", "cycle")


#: Where plates have the numbers of their layers.
LAYERS = ("construction", "layers")


def change(draft: Draft, what: str, old: str, new: str) -> None:
    """Writes another name wherever one is mentioned; raises LinkwrightError where the text is worse for it."""
    before, known = draft.text, len(errors(draft.text))
    if what == "driver" and old == "driver" and (alone := draft.section("driver")) is not None:
        entry = draft.text[alone.start : alone.end].strip()
        draft.cut_top("driver")
        draft.put("drivers", new, {})
        drivers = draft.section("drivers")
        if drivers is not None and alone.flow:
            draft.write_key(drivers, new, entry)
        else:
            draft.text = before
            return
    spots = {node.start: (node, text) for node, text in _mentions(draft, what, old, new)}
    for node, text in sorted(spots.values(), key=lambda each: -each[0].start):
        draft.write(node, flow(text))
    now = errors(draft.text)
    if len(now) > known:
        draft.text = before
        raise LinkwrightError(with_remedy(now[0].message, now[0].remedy))
    draft.renamed.append({"kind": what, "from": old, "to": new})


def _mentions(draft: Draft, what: str, old: str, new: str) -> Iterator[tuple[Scalar, str]]:
    """Words that mention a name, with what they say then."""
    head = re.compile(rf"(?<![\w.]){re.escape(old)}(?=\.\w)")
    tail = re.compile(rf"(?<=[\w]\.){re.escape(old)}(?![\w'-])")
    for entry in draft.root.entries:
        if entry.key.text in PROSE:
            continue
        for path, node, is_key in _words(entry.value, (entry.key.text,)):
            text = node.text
            if _is_named(what, path, text, old, is_key=is_key):
                yield node, new
            elif path == LAYERS and is_key and what in ("link", "pair") and owner_of_plate(text) == old:
                yield node, text[: -len(old)] + new
            elif (changed := head.sub(new, text)) != text or (
                what == "point" and (changed := tail.sub(new, text)) != text
            ):
                yield node, changed


def _words(node: Node, path: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], Scalar, bool]]:
    """Keys and words below a node, with the keys that lead to them."""
    if isinstance(node, Scalar):
        yield path, node, False
    elif isinstance(node, Sequence):
        for each in node.items:
            yield from _words(each, path)
    elif isinstance(node, MappingNode):
        for entry in node.entries:
            yield path, entry.key, True
            yield from _words(entry.value, (*path, entry.key.text))


def _is_named(what: str, path: tuple[str, ...], text: str, old: str, *, is_key: bool) -> bool:
    """Whether a word is the name itself."""
    if text != old:
        return False
    section, inner = path[0], path[-1]
    if is_key:
        if what == "point":
            return inner in ("points", "also", "drawing", "assembly") or path == ("joints",)
        if what == "driver" and section == "run":
            return inner in ("at", "speed")
        return path == (KINDS[what],) or (path == ("assembly",) and what == "pair") or inner == KINDS[what]
    if what == "point":
        if path == ("path", "point"):
            return True
        here = inner == "between" if section == "actuators" else inner in POINTS
        return here and section in ("joints", "loads", "actuators", "driver", "drivers", "links", "frame")
    if section == "run":
        return what == "driver" and inner == "prescribed"
    if section not in NAMING:
        return False
    if what == "link":
        return inner not in (*NO_LINKS, "side", "interpolation", "beyond")
    if what == "pair" and path[0] == "actuators":
        return inner == "along"
    return inner in ("slide", "of", "about", "guide", "drivers", "driver")


def by_function(draft: Draft) -> None:
    """Names drawn links by what they do, where the names are free: crank, coupler, rocker."""
    shown = draft.picture()
    links, fixed = shown["links"], set(shown["fixed"])
    driven = shown["driver"]
    moving = [name for name, points in links.items() if len(points) > 1]
    turning = [name for name in moving if fixed & set(links[name])]
    wanted = {}
    if driven in turning:
        wanted["crank"] = [driven]
        between = [name for name in moving if name not in turning and set(links[name]) & set(links[driven])]
        wanted["coupler"] = between[:1]
        ends = {point for name in between[:1] for point in links[name]}
        others = [name for name in turning if name != driven]
        wanted["rocker"] = [name for name in others if ends & set(links[name])][:1]
    for name, found in wanted.items():
        if found and GENERIC.fullmatch(found[0]) and name not in draft.taken:
            change(draft, "link", found[0], name)
            draft.made[:] = [name if each == found[0] else each for each in draft.made]
