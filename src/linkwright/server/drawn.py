"""Points as they are drawn: put on the paper, moved, fixed to the frame and freed."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from linkwright.errors import LinkwrightError
from linkwright.server import request
from linkwright.server.agreement import conditions, nearest
from linkwright.server.draft import Draft
from linkwright.server.entries import fresh
from linkwright.server.references import references
from linkwright.server.removing import remove_drives, take_fixed
from linkwright.server.sizes import remeasure
from linkwright.words import _


def point(draft: Draft, action: Mapping[str, Any]) -> None:
    """A point of the frame, or one that links follow; one that is there is moved."""
    at = complex(*request.place(action, "at"))
    name = request.name(action, "name") if "name" in action else new_point(draft, bool(action.get("fixed")))
    if name in draft.picture()["points"]:
        _move(draft, {name: at}, ())
    else:
        put_point(draft, name, at, bool(action.get("fixed")))


def new_point(draft: Draft, fixed: bool = False, stem: str = "", known: Collection[str] = ()) -> str:
    """A name for a point: the next letter, those of the frame O with a number; ``known``: others that are taken."""
    taken = {*all_points(draft), *known}
    if stem or fixed:
        return fresh(stem or "O", taken)
    return next((each for each in LETTERS if each not in taken), "") or fresh("P", taken)


#: Names of points that move.
LETTERS = "ABCDEFHJKLMNPQRSTUVW"


def all_points(draft: Draft) -> set[str]:
    """The names of all points of a text."""
    shown = draft.picture()
    return {*shown["points"], *(point for points in shown["links"].values() for point in points)}


def put_point(draft: Draft, name: str, at: complex, fixed: bool = False) -> None:
    """Draws a point of the frame or of links that follow."""
    if name not in all_points(draft):
        draft.made.append(name)
    draft.draw(name, at, fixed=fixed or name in draft.picture()["fixed"])


def move(draft: Draft, action: Mapping[str, Any]) -> None:
    """Drags drawn points: lengths that are not locked follow, others hold."""
    places = {name: complex(*at) for name, at in request.places(action, "points").items()}
    _move(draft, places, request.names(action, "locked") if "locked" in action else ())


def _move(draft: Draft, wanted: Mapping[str, complex], locked: Collection[str]) -> None:
    draft.complete(wanted)
    shown = draft.shown()
    before = {name: complex(*place) for name, place in shown["points"].items()}
    for name in wanted:
        draft.where(name)
    held = conditions(draft, set(locked))
    places = {**before, **wanted}
    movable = [name for name in places if name not in shown["fixed"]]
    for free in ([name for name in movable if name not in wanted], movable):
        found = nearest(held, places, free, near=wanted)
        if found is not None and _meets(draft, held, {**places, **found}):
            places |= found
            break
    else:
        raise LinkwrightError(
            _("the locked lengths do not let the drawing go there; unlock one of them", code="studio.locked")
        )
    follow(draft, before, places)


def _meets(draft: Draft, held: list[Any], at: Mapping[str, complex]) -> bool:
    return all(abs(each) <= draft.step for condition in held for each in condition.residual(at))


def follow(draft: Draft, before: Mapping[str, complex], places: Mapping[str, complex]) -> None:
    """Draws points at other places, and measures the links on them again."""
    moved = [name for name, place in places.items() if abs(place - before.get(name, place + 1)) > 0.01 * draft.step]
    for name in moved:
        draft.draw(name, places[name])
    at = {name: complex(*place) for name, place in draft.shown()["points"].items()}
    for link, points in draft.picture()["links"].items():
        if not set(points).isdisjoint(moved):
            remeasure(draft, link, at)


def fix(draft: Draft, action: Mapping[str, Any]) -> str | None:
    """Fixes a point to the frame, or frees it; a drive about one that is freed goes."""
    name, fixed = request.name(action, "point"), bool(action.get("fixed", True))
    draft.complete([name])
    at = draft.where(name)
    if (name in draft.picture()["fixed"]) == fixed:
        return None
    if fixed:
        if (drawing := draft.section("drawing")) is not None and drawing.get(name) is not None:
            draft.take_out("drawing", name)
        draft.draw(name, at, fixed=True)
        return None
    for _unused, user, _unused2 in references(draft, "frame", name):
        raise LinkwrightError(
            _(
                "{name} needs the fixed point {point}; remove {name} first",
                code="studio.point_of",
                point=name,
                name=user,
            )
        )
    driven = remove_drives(draft, name)
    take_fixed(draft, name)
    if any(name in points for points in draft.picture()["links"].values()):
        draft.draw(name, at, fixed=False)
    return _("The drive about it is gone as well.", code="studio.drive_gone") if driven else None
