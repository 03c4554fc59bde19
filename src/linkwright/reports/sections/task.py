"""Task and data: purpose, source, dimensions, masses, joints, drivers, loads; and the kinematic drawing."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from linkwright.core.quantity import number
from linkwright.core.table import Amount, Cell, Table
from linkwright.drivers.base import LABELS as DRIVER_LAWS
from linkwright.errors import LinkwrightError
from linkwright.files.write import to_data
from linkwright.joints.base import PAIRS
from linkwright.laws.base import LABELS
from linkwright.plotting.drawing.draw import draw
from linkwright.reports.document import Block, Figure, Paragraph, literal, printed
from linkwright.reports.key_names import MODEL_KEYS, VALUES
from linkwright.reports.machine_results import ReportContext
from linkwright.reports.pictures import font_scaling
from linkwright.reports.section import section
from linkwright.words import Message, Translate, _, pgettext

#: Entries of a list that is printed in full.
LONGEST = 12
#: Keys of a driver that name its law.
LAWS = ("speed", "table", "program", "position")
#: Keys whose values are words of the model language.
CHOICES = (
    "closure",
    "direction",
    "ends",
    "from",
    "to",
    "interpolation",
    "material",
    "mesh",
    "opposes",
    "pushes",
    "run",
    "side",
    "supports",
    "touch",
    "turn",
    "over",
)
_QUANTITY = re.compile(r"([+-]?\d+(?:\.\d+)?(?:e[+-]?\d+)?)((?: \S+)?)")
#: Kinds of joints and loads, and laws of drivers, in words.
KINDS: Mapping[str, Message] = {
    **DRIVER_LAWS,
    "prismatic": _("guide"),
    "revolute": _("pin"),
    "weld": pgettext("report", "weld"),
    "force": _("force"),
    "torque": _("torque"),
    "spring": _("spring"),
    "damper": _("damper"),
    "pressure": _("pressure"),
    "torsion_spring": _("torsion spring"),
    "torsion_damper": _("torsion damper"),
}


@section("task", _("Task and data"), 1.0)
def task(case: ReportContext) -> Iterator[Block]:
    """What the machine is for, and everything that is given about it."""
    translate, mechanism = case.translate, case.mechanism
    if case.purpose:
        yield Paragraph(literal(case.purpose))
    if case.origin:
        yield Paragraph(translate(_("Source: {source}.", source=literal(case.origin))))
    data = to_data(mechanism)
    yield _points(case)
    yield _links(case)
    if mechanism.parameters:
        rows = [(name, written(value, translate)) for name, value in data["parameters"].items()]
        yield printed(Table((_("name"), _("value")), rows, "<>", _("Parameters")), case.language)
    drivers = {"driver": data["driver"]} if "driver" in data else data.get("drivers", {})
    for title, part in (
        (_("Joints other than pins"), data.get("joints", {})),
        (_("Drivers"), drivers),
        (_("Loads"), data.get("loads", {})),
    ):
        if part:
            body = [(name, kind_of(value, translate), element_data(value, translate)) for name, value in part.items()]
            head = (_("name"), _("kind"), pgettext("report", "given"))
            yield printed(Table(head, body, "<<<", title), case.language)
    if any(mechanism.gravity):
        x, y = (f"{value:g}" for value in mechanism.gravity)
        yield Paragraph(translate(_("Gravity acts with ({x}; {y}) m/s².", x=x, y=y)))


def _points(case: ReportContext) -> Block:
    rows: list[list[Cell]] = [
        [name, *(Amount(each, "length", bare=True) for each in place)]
        for name, place in case.mechanism.frame.points.items()
    ]
    head = (_("point"), "$x$ / mm", "$y$ / mm")
    return printed(Table(head, rows, "<>>", _("Points of the frame")), case.language, "frame")


def _links(case: ReportContext) -> Block:
    rows: list[tuple[Cell, ...]] = []
    for index, (name, link) in enumerate(case.mechanism.links.items(), 1):
        points = [f"{point} {_place(*at)}" for point, at in link.points.items()]
        named = list(link.points)
        size = ""
        if len(named) > 1:
            (ax, ay), (bx, by) = (link.points[each] for each in named[:2])
            size = number(float(np.hypot(bx - ax, by - ay)), "length")
        centre = _place(*link.centre) if link.mass else "–"
        rows.append((index, name, ", ".join(points), size, _or_dash(link.mass), _or_dash(link.inertia), centre))
    head = (
        _("no."),
        _("link"),
        _("points in the link's axes, mm"),
        "$l$ / mm",
        "$m$ / kg",
        "$J_G$ / kg·m²",
        _("mass centre, mm"),
    )
    return printed(Table(head, rows, "<<<>>><", _("Moving links")), case.language, "links")


def _place(x: float, y: float) -> str:
    return f"({number(x, 'length')}; {number(y, 'length')})"


def _or_dash(value: float) -> str:
    return f"{value:.6g}" if value else "–"


def kind_of(value: Any, translate: Translate) -> str:
    """The kind of a joint, a load, or a driver's law, in words; of another package by its own name."""
    kind = str(value.get("kind", "")) or next((law for law in LAWS if law in value), "")
    if kind in KINDS:
        return translate(KINDS[kind])
    return translate(PAIRS[kind]) if kind in PAIRS else kind or "–"


def element_data(value: Any, translate: Translate) -> str:
    """What the model file says of a joint, a driver or a load, but its kind."""
    return written({key: each for key, each in value.items() if key != "kind"}, translate)


def written(value: Any, translate: Translate, key: str = "") -> str:
    """A value of a model file in one line, keys in words, angles in degrees, lengths in mm, six digits; long lists by
    their ends."""
    if isinstance(value, Mapping):
        parts = [
            translate(_("{name}: {value}", name=MODEL_KEYS.get(name, name), value=text))
            for name, text in ((name, written(each, translate, name)) for name, each in value.items())
        ]
        if not key:
            return translate(_("; ")).join(parts)
        listed = translate(pgettext("given", ", ")).join(parts)
        return translate(_("({parts})", parts=listed))
    if isinstance(value, list | tuple):
        shown = [written(each, translate, key) for each in value]
        if len(shown) > LONGEST:
            shown = [*shown[:3], f"… ({len(shown)}) …", shown[-1]]
        return "[" + ", ".join(shown) + "]"
    return _word(str(value), key, translate) or _rounded(str(value))


def _word(text: str, key: str, translate: Translate) -> str:
    """A value that is a word of the model language; empty for names, numbers and expressions."""
    if key == "law" and text in LABELS:
        return translate(LABELS[text])
    known = (text == "frame" or key in CHOICES) and text in VALUES
    return translate(VALUES[text]) if known else ""


def _rounded(text: str) -> str:
    """A quantity with six digits, an angle in degrees, a length in mm; other texts as they are."""
    found = _QUANTITY.fullmatch(text)
    if not found:
        return text
    value, unit = float(found[1]), found[2]
    if unit.strip() == "rad":
        value, unit = math.degrees(value), "°"
    if unit.strip() == "m":
        value, unit = 1e3 * value, " mm"
    turns = f" ({value * 30.0 / math.pi:.6g} rpm)" if unit.strip() == "rad/s" else ""
    return f"{value:.6g}{unit}{turns}"


#: Share of the width and height, mm, of a drawing: two of them share a page.
WIDE, TALLEST = 0.85, 104.0


@section("drawing", _("Kinematic drawing"), 2.0)
def drawing(case: ReportContext) -> Iterator[Block]:
    """The machine at the worked position, and its limit positions."""
    translate = case.translate
    motion, index = case.worked_motion
    yield Paragraph(
        translate(
            _(
                "The machine in the standard symbols is shown in {figure}, at the position that is worked out below.",
                figure="[[drawing]]",
            )
        )
    )
    language = case.language

    def shown(diagonal: float) -> str:
        return draw(motion, position=index, centres=True, diagonal=diagonal, language=language).svg

    def faded(diagonal: float) -> str:
        limits = draw(case.motion, overlay="limits", labels="points", diagonal=diagonal, language=language)
        return limits.svg

    loaded = any(link.mass for link in case.mechanism.links.values()) or bool(case.mechanism.loads)
    caption = translate(_("Kinematic drawing with mass centres and loads") if loaded else _("Kinematic drawing"))
    yield Figure(caption, ((font_scaling(shown, WIDE, TALLEST), WIDE),), "drawing", TALLEST)
    try:
        limits = font_scaling(faded, WIDE, TALLEST)
    except LinkwrightError:
        return
    yield Figure(translate(_("Limit positions of the output, dashed")), ((limits, WIDE),), "limit-drawing", TALLEST)
