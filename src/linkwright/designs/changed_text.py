"""The text of a model file with changed dimensions, which reads back as the changed machine.

A number is replaced in place, a missing key is added. What an assembled drawing says, the geometry of
links drawn in it, phases of wheels and assemblies, is derived anew from the drawing of the changed machine.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from linkwright import units
from linkwright.designs.ranges import dimension_of
from linkwright.errors import LinkwrightError, QuantityError, with_remedy
from linkwright.files.document import Document
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.kinematics.solve import solve_motion
from linkwright.mechanism.drawing import Drawing
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.units import number
from linkwright.words import _

_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*([^\s\"'#,\]}]*)")
#: Lengths from this one on are in m.
_LONG = 1.0
#: A number that no text around it holds.
_MARK = "1234567.0625"
#: Fewest and most digits of a number that is read back as the same.
_DIGITS = range(12, 18)


@dataclass(frozen=True)
class Written:
    """How a text holds a number in a unit of ``factor`` SI: with ``before`` and ``after`` in place of what is at
    ``span``, its first offset and the one behind it."""

    span: tuple[int, int]
    before: str
    after: str
    unit: str
    factor: float

    def text(self, value: float) -> str:
        """The replacement text."""
        return f"{self.before}{digits(value, self.factor)}{self.after}"


def written(document: Document, address: str, value: float) -> Written | None:
    """How a document holds the dimension, or the coordinate of its drawing, at an address; None where it cannot."""
    place = document.place(address)
    if place is not None and (match := _NUMBER.search(document.text, *place)):
        unit = _unit(match[1], match[2], value)
        if unit is not None:
            return Written(match.span(1), "", "", unit, factor_of(unit))
    unit = usual_unit(document.mechanism, address, value)
    found = document.edit(address, f"{_MARK} {unit}".strip())
    if found is None:
        return None
    before, after = found.written.split(_MARK)
    return Written((found.start, found.end), before, after, unit, factor_of(unit))


def _unit(text: str, unit: str, value: float) -> str | None:
    """The unit behind a number of the text, if both give the value; a bare zero has none to go by."""
    try:
        factor = factor_of(unit)
    except QuantityError:
        return None
    same = abs(float(text) * factor - value) <= 1e-12 * abs(value)
    return unit if same and (unit or value != 0.0) else None


def usual_unit(mechanism: Mechanism, address: str, value: float) -> str:
    """The unit of a dimension, or of a coordinate of the drawing, that its file gives none."""
    drawn = address.startswith("drawing.")
    kind = units.DIMENSIONS["length"] if drawn else dimension_of(mechanism, address)
    if kind == units.DIMENSIONS["length"]:
        return "m" if abs(value) >= _LONG else "mm"
    if kind == units.DIMENSIONS["angle"]:
        return "deg"
    return units.si_symbol(kind) if kind else ""


def factor_of(unit: str) -> float:
    """SI value of one of a unit."""
    return units.unit(unit)[0] if unit else 1.0


def digits(value: float, factor: float) -> str:
    """The shortest number that gives an SI value in a unit again, to the last digit where there is one."""
    near = value / factor
    texts = (f"{near:.{count}g}" for count in _DIGITS)
    return number(float(next((text for text in texts if float(text) * factor == value), repr(near))))


def drawn_places(document: Document) -> dict[str, tuple[Written, str]]:
    """How a document holds the coordinates of its drawing, each with the output that is its place, by address."""
    mechanism, found = document.mechanism, dict[str, tuple[Written, str]]()
    for point, place in mechanism.drawing.items():
        key = _key(mechanism, point)
        for axis, value in zip("xy", place, strict=True):
            how = written(document, address := f"drawing.{point}.{axis}", value)
            if key is not None and how is not None:
                found[address] = how, f"{key}.{axis}"
    return found


def _key(mechanism: Mechanism, point: str) -> str | None:
    """A drawn point as outputs name it; None where no link has it."""
    for name, link in (("frame", mechanism.frame), *mechanism.links.items()):
        own = point.removeprefix(f"{name}.")
        if own in link.points:
            return canonical(mechanism, name, own)
    return None


def moves(mechanism: Mechanism, address: str) -> bool:
    """Whether a change of a dimension may move what is drawn: all but masses, loads, gravity and speeds."""
    owner, _unused, key = address.partition(".")
    if owner in mechanism.links:
        return key.partition(".")[0] not in ("mass", "inertia", "mass_centre")
    return owner not in ("loads", "gravity", "cycle", *mechanism.drivers)


def changed_text(document: Document, values: Mapping[str, float]) -> str:
    """The text of a document with changed dimensions (SI), all else as it was.

    Raises LinkwrightError where the file has no place for one, or where the changed machine cannot be assembled,
    ModelError where no file may hold it.
    """
    old = document.mechanism
    new = old.with_dimensions(values)
    changed = {address: float(value) for address, value in values.items() if value != old.dimension(address)}
    drawn = drawn_places(document) if any(moves(old, each) for each in changed) else {}
    edits = []
    for address, value in changed.items():
        how = written(document, address, old.dimension(address))
        if how is not None:
            edits.append((how, value))
        elif not (drawn and address in drawn_dimensions(old)):
            near = offered(address, old.dimensions())
            raise LinkwrightError(
                with_remedy(_('the file has no place for "{address}"', code="model.no_place", address=address), near)
            )
    if drawn:
        motion = as_drawn(old, new)
        edits += [(how, _coordinate(motion, key)) for how, key in drawn.values()]
    return document.with_text(replaced(document.text, edits)).text


def drawn_dimensions(mechanism: Mechanism) -> set[str]:
    """Addresses that follow from the drawing: the geometry of links that have it from there."""
    drawn = [link for link in mechanism.links.values() if link.geometry == "drawing"]
    return {address for link in drawn for address in link.geometry_dimensions()}


def as_drawn(old: Mechanism, new: Mechanism) -> Motion:
    """A changed machine where its drivers stand in the drawing."""
    drawing = Drawing(old)
    drawn = {name: drawing.driver(name) for name in old.drivers}
    at = {name: old.drivers[name].law.at(0.0) if q is None else q for name, q in drawn.items()}
    return solve_motion(new, at=at)


def _coordinate(motion: Motion, key: str) -> float:
    point, _unused, axis = key.rpartition(".")
    return float(motion.point(point).position[0]["xy".index(axis)])


def replaced(text: str, edits: Iterable[tuple[Written, float]]) -> str:
    """A text with numbers written into it."""
    for how, value in sorted(edits, key=lambda each: each[0].span, reverse=True):
        start, end = how.span
        text = text[:start] + how.text(value) + text[end:]
    return text
