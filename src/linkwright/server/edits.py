"""Changes of a model's text by drawing: actions by name, carried out one after the other as one step."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

from linkwright.core.data import Plain
from linkwright.errors import LinkwrightError
from linkwright.server import cams, drawn, joining, links, masses, naming, pairs, pasting, request, values
from linkwright.server.agreement import agree, unmet
from linkwright.server.draft import Draft
from linkwright.server.removing import remove
from linkwright.words import _


class Edited(NamedTuple):
    """A text after actions, what the user should know about them, names of new elements, what can be drawn."""

    text: str
    notes: list[str]
    made: list[str]
    renamed: list[dict[str, str]]
    picture: Plain


def edited(text: str, actions: Sequence[Mapping[str, Any]]) -> Edited:
    """The text after actions of drawing, all of them or none.

    Lengths are metres and angles degrees where they are numbers; typed values are texts with units as a file has
    them ("140 mm"). Names are optional where they end in ``?``: a fresh one is made then. Every action may have
    ``places``: {point: [x, y]} of points that the text has not, or places by its lengths.

    Points: ``point`` {name?, at, fixed?} · ``fix`` {point, fixed} · ``merge`` {from, into, locked?: [address]} ·
    ``weld`` {point, on}: the links at a joint, one alone with the frame · ``move`` {points: {name: [x, y]}, locked?}
    Links: ``link`` {name?, points, places?, length?, sides?}: one point makes a block, two a bar with ``length`` as
    typed or as measured, more a plate; ``sides``: typed length or null of each side of a plate, in the order of its
    points, the last side leads back · ``add_point`` {link, point?, at} · ``split`` {link, point?, at} ·
    ``mass`` {link, mass} or {link, section: {shape: flat | round | tube, size: [text, text], density}}: flat width
    and thickness, round diameter, tube outer and inner diameter
    Pairs and drives: ``driver`` {link, about?} or {slide: joint} · ``guide`` {at, angle, link?}: without a link a
    block is made · ``slot`` {along, at} · ``gear`` {links, teeth: "20:40", inside?} · ``rack`` {pinion, rack} ·
    ``cam`` {cam, at, lift}
    Loads: ``load`` {link, at, force, angle} · ``add`` {section, stem, entry} with the entry as a file has it
    Anything: ``set`` {path: [key, …], value} · ``unset`` {path} · ``rename`` {what, from, to} ·
    ``remove`` {items: [{kind, name}]} · ``optimize`` {section} ·
    ``paste`` {items, shift: [dx, dy], mirror?: x | y, of?: text}

    ``kind`` and ``what`` are point, link, pair, load or driver. ``made`` has the names of new elements of all actions
    in their order: of a point, link, pair or load that was not there before; ``renamed``: [{kind, from, to}], by
    ``rename`` and by ``driver``, which names drawn links by function (link1 → crank). Raises LinkwrightError for an
    action that the text does not admit.
    """
    draft, notes = Draft(text), list[str]()
    for action in actions:
        act = _ACTIONS.get(str(action.get("do")))
        if act is None:
            raise LinkwrightError(
                _("there is no drawing action {name!r}", code="studio.no_action", name=str(action.get("do")))
            )
        draft.places |= request.places(action, "places")
        known, excused = len(draft.made), unmet(draft)
        notes.append(act(draft, action) or "")
        agree(draft, draft.made[known:], excused)
        notes += [_unmet(each) for each in unmet(draft) if each not in excused]
    return Edited(
        draft.text,
        [each for each in notes if each],
        draft.made,
        draft.renamed,
        {**draft.picture(), "unmet": unmet(draft)},
    )


def _unmet(link: str) -> str:
    return _(
        "{link} cannot be that long where its ends are joined; its length stays, the drawing shows another one.",
        code="studio.unmet",
        link=link,
    )


def _optimize(draft: Draft, action: Mapping[str, Any]) -> None:
    """The section with variables, objectives and demands; none where nothing varies."""
    draft.put_section("optimize", request.mapping(action, "section"))


_ACTIONS: dict[str, Callable[[Draft, Mapping[str, Any]], str | None]] = {
    "rename": naming.rename,
    "point": drawn.point,
    "fix": drawn.fix,
    "move": drawn.move,
    "link": links.link,
    "add_point": links.add_point,
    "split": joining.split,
    "merge": joining.merge,
    "weld": joining.weld,
    "driver": pairs.driver,
    "guide": pairs.guide,
    "slot": pairs.slot,
    "gear": pairs.gear,
    "cam": cams.add_cam,
    "rack": cams.add_rack,
    "mass": masses.mass,
    "load": masses.load,
    "add": values.add,
    "set": values.put,
    "unset": values.unset,
    "paste": pasting.paste,
    "optimize": _optimize,
    "remove": remove,
}
