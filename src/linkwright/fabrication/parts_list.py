"""The list of parts: what is needed how often, of what, how large and how heavy."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from linkwright.core.quantity import number, shown
from linkwright.core.table import Amount, Cell, Table
from linkwright.errors import speaker
from linkwright.fabrication.cut_lines import box_of
from linkwright.fabrication.part import Hole, Part, Place
from linkwright.fields.material import LABELS
from linkwright.words import Message, Translate, _, pgettext

if TYPE_CHECKING:
    from linkwright.fabrication.cut_parts import CutParts

#: What parts are called by the word before their own name, and those without one.
CALLED: Mapping[str, Message] = {
    "pin": pgettext("parts list", "pin {name}"),
    "post": pgettext("parts list", "post {name}"),
    "guide": pgettext("parts list", "guide {name}"),
    "block": pgettext("parts list", "block {name}"),
    "wheel": pgettext("parts list", "wheel {name}"),
    "rack": pgettext("parts list", "rack {name}"),
    "cam": pgettext("parts list", "cam {name}"),
    "roller": pgettext("parts list", "roller {name}"),
    "rod": pgettext("parts list", "rod {name}"),
    "hub": pgettext("parts list", "hub {name}"),
    "face": pgettext("parts list", "face {name}"),
    "edge": pgettext("parts list", "edge {name}"),
    "spacer": pgettext("parts list", "spacer {name}"),
    "washer": pgettext("parts list", "washer {name}"),
}
ALONE: Mapping[str, Message] = {
    "frame": pgettext("parts list", "base plate"),
    "cover": pgettext("parts list", "cover"),
    "spacer": pgettext("parts list", "spacer"),
    "washer": pgettext("parts list", "washer"),
}
AS_GIVEN = pgettext("material", "as given")
HEADS = (
    _("no."),
    pgettext("parts list", "part"),
    pgettext("parts list", "number"),
    pgettext("parts list", "size / mm"),
    _("material"),
    pgettext("parts list", "layer"),
    _("mass / {unit}"),
    _("all / {unit}"),
    pgettext("parts list", "holes"),
)
#: Masses below this, kg, are shown in grams.
LIGHT = 1.0
TITLE = _("Parts of {name}")
PRESSED = _(
    "A pin is pressed into its lowest plate and all that move with that one (p); in the others it turns, and "
    "their holes are larger by the fit, {fit}. Posts are pressed in."
)
PRESSED_EXACT = _(
    "A pin is pressed into its lowest plate and all that move with that one (p); in the others it turns in a hole of "
    "its own diameter; larger ones: `fit` in the section construction. Posts are pressed in."
)
HEAD = _("{pin}, head Ø{head} × {height}")
TWO_HEADS = _("{pin}, 2 heads Ø{head} × {height}")
TOTAL = _("{count} parts, together {mass}.")


@dataclass(frozen=True)
class Line:
    """Equal parts of the list, one line for all."""

    number: int
    parts: tuple[Part, ...]

    @property
    def first(self) -> Part:
        """One of the parts."""
        return self.parts[0]

    @property
    def count(self) -> int:
        """How many are needed."""
        return sum(each.count for each in self.parts)


def lines_of(parts: Sequence[Part]) -> list[Line]:
    """The lines of a list: every plate has its own, equal pins share one."""
    equal: dict[object, list[Part]] = {}
    for each in parts:
        sizes = (each.diameter, each.bore, each.length, each.head, *each.heads)
        pin = (each.name.partition(" ")[0], each.material, *(f"{1e3 * size:.6f}" for size in sizes))
        equal.setdefault(pin if each.sort == "pin" else each.name, []).append(each)
    return [Line(number, tuple(same)) for number, same in enumerate(equal.values(), 1)]


def called(parts: Sequence[Part], translate: Translate) -> str:
    """What equal parts are called: ``pin A, B``."""
    word = parts[0].name.partition(" ")[0]
    names = [each.name.partition(" ")[2] for each in parts]
    if word in CALLED and all(names):
        return translate(CALLED[word].format(name=", ".join(names)))
    return ", ".join(translate(ALONE[each.name]) if each.name in ALONE else each.name for each in parts)


def tables(found: CutParts, language: str = "en") -> tuple[Table, ...]:
    """The list of parts, and what its numbers mean."""
    translate = speaker(language)
    unit, per_kg = ("g", 1e3) if max(each.count * each.mass for each in found.parts) < LIGHT else ("kg", 1.0)
    rows = [_row(line, translate, per_kg) for line in lines_of(found.parts)]
    heads = [translate(each.format(unit=unit)) for each in HEADS]
    title = translate(TITLE.format(name=found.mechanism.name))
    construction = found.mechanism.construction
    fit = 0.0 if construction is None else construction.fit
    count = sum(each.count for each in found.parts)
    notes = [
        translate(TOTAL.format(count=count, mass=f"{per_kg * found.mass:.4g} {unit}")),
        translate(PRESSED.format(fit=shown(fit, "length")) if fit else PRESSED_EXACT),
        *found.notes,
    ]
    return (Table(heads, rows, ">" + "<>" + "<<" + ">>>" + "<", title, notes),)


def _row(line: Line, translate: Translate, per_kg: float) -> list[Cell]:
    part = line.first
    masses = (per_kg * part.mass, per_kg * sum(each.count * each.mass for each in line.parts))
    return [
        line.number,
        called(line.parts, translate),
        line.count,
        size_text(part, translate),
        translate(LABELS.get(part.material, AS_GIVEN)),
        part.layer,
        *(Amount(each, digits=4) if part.mass else None for each in masses),
        ", ".join(holes_text(part)),
    ]


def size_text(part: Part, translate: Translate) -> str:
    """The size of a part in mm: length, width and thickness of a plate, diameters and length of what is round."""
    length = number(part.length, "length")
    if part.sort == "plate":
        low, high = box_of(part.loops)
        return " × ".join((*(number(each, "length", 5) for each in ((high - low).real, (high - low).imag)), length))
    if part.bore:
        return f"Ø{number(part.diameter, 'length')}/{number(part.bore, 'length')} × {length}"
    text = f"Ø{number(part.diameter, 'length')} × {length}"
    heights = [each for each in part.heads if each]
    if not heights:
        return text
    form = HEAD if len(heights) == 1 else TWO_HEADS
    sizes = {"head": number(part.head, "length"), "height": number(heights[0], "length")}
    return translate(form.format(pin=text, **sizes))


def holes_text(part: Part) -> Iterator[str]:
    """The holes of a plate: the pins that go through them, and their diameters in mm; p: pressed in."""
    sizes: dict[tuple[str, bool], list[str]] = {}
    for hole in part.holes:
        sizes.setdefault((number(2.0 * hole.radius, "length"), hole.fixed), []).append(hole_name(hole))
    for (diameter, fixed), names in sizes.items():
        named = [each for each in names if each]
        text = f"{len(names)} × Ø{diameter}" if not named else f"{' '.join(named)} Ø{diameter}"
        yield f"{text} p" if fixed else text


def hole_name(hole: Hole) -> str:
    """The name at a hole: that of its pin or post without the word before it."""
    return hole.pin.partition(" ")[2] or hole.pin


def data(found: CutParts) -> dict[str, Any]:
    """The parts as plain data, SI."""
    parts = [
        {
            "name": each.name,
            "sort": each.sort,
            "count": each.count,
            "material": each.material,
            "mass": each.mass,
            "length": each.length,
            "layer": each.layer,
            **({"diameter": each.diameter} if each.diameter else {}),
            **({"bore": each.bore} if each.bore else {}),
            **({"head": each.head, "heads": list(each.heads)} if any(each.heads) else {}),
            **({"holes": [_hole(hole) for hole in each.holes]} if each.sort == "plate" else {}),
            "places": [_place(place) for place in each.places],
        }
        for each in found.parts
    ]
    return {"name": found.mechanism.name, "mass": found.mass, "parts": parts, "notes": [*map(str, found.notes)]}


def _place(place: Place) -> dict[str, Any]:
    return {"link": place.carrier, "at": [place.at.real, place.at.imag], "z": place.z, "on": place.on}


def _hole(hole: Hole) -> dict[str, Any]:
    centre = [hole.centre.real, hole.centre.imag]
    return {"pin": hole.pin, "centre": centre, "diameter": 2.0 * hole.radius, "pressed": hole.fixed}
