"""A calculation of machine parts as a chapter of a report: purpose, given data, sketch, solution, results."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from linkwright import units
from linkwright.core.table import Table
from linkwright.errors import LinkwrightError
from linkwright.parts.base import Problem, Result
from linkwright.reports.document import Block, Figure, Heading, Paragraph, literal, noted, printed, symbols
from linkwright.reports.document import Table as TableBlock
from linkwright.reports.key_names import CALCULATION_KEYS
from linkwright.reports.machine_results import picture
from linkwright.reports.section import SECTIONS
from linkwright.reports.sections.method import step_blocks, to_scale
from linkwright.reports.sections.references import errata_blocks
from linkwright.reports.settings import Settings
from linkwright.words import Message, Translate, _
from linkwright.words.message import in_language

#: Sections of machines' reports whose own text follows a heading of a calculation, by the heading.
PLACES: Mapping[Message, str] = {_("Purpose"): "task", _("Sketch"): "drawing", _("Solution"): "worked"}
#: Share of the page's width of a sketch, and its maximum height, mm.
WIDE, TALLEST = 0.8, 90.0


@dataclass(frozen=True)
class OwnText:
    """The user's own text at its place in a chapter."""

    text: str


def calculation(problem: Problem, own: Settings, translate: Translate, language: str) -> Iterator[Block | OwnText]:
    """The blocks of one calculation with the settings of its file, under a heading with its name; raises
    LinkwrightError where it has no result."""
    found = problem.solve()
    texts = dict(own.text)
    places = {translate(heading): name for heading, name in PLACES.items()}
    for block in _chapters(problem, found, own, translate, language):
        yield block
        name = places.get(block.text) if isinstance(block, Heading) else None
        if name is not None and name in texts:
            yield OwnText(texts.pop(name))
    for name, text in texts.items():
        yield Heading(translate(SECTIONS[name].title), 2)
        yield OwnText(text)
    if own.errata:
        yield Heading(translate(_("Mistakes of the source")), 2)
        yield from errata_blocks(own.errata, in_language(own.source or problem.source, language), translate)


def _chapters(problem: Problem, found: Result, own: Settings, translate: Translate, language: str) -> Iterator[Block]:
    """Heading, purpose, given data, sketch, solution and results."""
    yield Heading(literal(in_language(found.title, language)), 1)
    purpose, source = (
        in_language(each, language) for each in (own.purpose or problem.purpose, own.source or problem.source)
    )
    if purpose or source:
        yield Heading(translate(_("Purpose")), 2)
        if purpose:
            yield Paragraph(literal(purpose))
        if source:
            yield Paragraph(translate(_("Source: {source}.", source=literal(source))))
    data = list(given_data(problem, translate))
    if data:
        yield Heading(translate(_("Given data")), 2)
        yield from data
    yield from _sketch(problem, translate, language)
    yield from numbers_and_way(found, translate, language, 2)


def numbers_and_way(found: Result, translate: Translate, language: str, level: int) -> Iterator[Block]:
    """The worked way, the numbers, and diagrams of them, under headings of a level."""
    yield Heading(translate(_("Solution")), level)
    for step in found.tidy_steps(translate):
        yield Heading(symbols(step.title), level + 1)
        yield from step_blocks(step)
    yield Heading(translate(_("Results")), level)
    yield from _results(found, translate, language)
    yield from _pictures(found, translate, language)


def _results(found: Result, translate: Translate, language: str) -> Iterator[Block]:
    head = (_("name"), _("value"), _("unit"), _("remark"))
    for table in found.tables(language)[1:]:
        width = 4 if any(row[3] for row in table.rows) else 3
        if table.rows:
            title, rows = (
                literal(in_language(table.title, language)) or _("Results"),
                [row[:width] for row in table.rows],
            )
            yield printed(Table(head[:width], rows, "<><<"[:width], title), language, first=_label)
        for remark in table.notes:
            yield Paragraph(literal(in_language(remark, language)))


def _label(text: str) -> str:
    """A label of a table: a symbol as a formula, words as they are."""
    bare = text.strip()
    short = len(bare) <= 4 or "." in bare or "_" in bare
    if (
        short
        and bare.isprintable()
        and " " not in bare
        and not any(c > "\u2e7f" for c in bare)
        and not bare.islower()
        and any(c.isalpha() for c in bare)
    ):
        return noted(bare)
    return symbols(text)


def _sketch(problem: Problem, translate: Translate, language: str) -> Iterator[Block]:
    """The sketch of what is calculated, where its kind has one."""
    from linkwright.plotting.sketches.base import sketch

    try:
        drawn = sketch(problem, language)
    except LinkwrightError as error:
        yield Paragraph(literal(error.translate(language)), "missing")
        return
    if drawn is not None:
        yield Heading(translate(_("Sketch")), 2)
        yield Figure(
            translate(_("Supports, loads and dimensions: {name}", name=literal(in_language(problem.name, language)))),
            ((drawn.svg, WIDE),),
            tallest=TALLEST,
        )


def _pictures(found: Result, translate: Translate, language: str) -> Iterator[Block]:
    """Its own drawing, where it has one, and its diagrams."""
    draw = getattr(found, "draw", None)
    if draw is not None:
        yield Figure(literal(in_language(found.title, language)), ((draw(language=language).svg, 0.5),))
    from linkwright.plotting.diagrams.base import RESULT_DIAGRAMS

    for kind in sorted(RESULT_DIAGRAMS, key=lambda each: not RESULT_DIAGRAMS[each].usual):
        if not RESULT_DIAGRAMS[kind].suits(found):
            continue
        try:
            svg = picture(found.plot(kind, language=language, title=""))
        except LinkwrightError as error:
            if RESULT_DIAGRAMS[kind].usual:
                yield Paragraph(literal(error.translate(language)), "missing")
            continue
        caption = f"{literal(in_language(found.title, language))}: {translate(RESULT_DIAGRAMS[kind].title)}"
        yield (
            to_scale(translate, caption, svg) if RESULT_DIAGRAMS[kind].to_scale else Figure(caption, ((svg, 0.75),))
        )


#: Symbols of single values, by key, or by kind and key where a kind has another one.
SYMBOLS: Mapping[str, str] = {
    "friction": "μ",
    "sliding_friction": "μ'",
    "wrap": "θ",
    "groove": "α",
    "tight": "T1",
    "slack": "T2",
    "torque": "M",
    "radius": "r",
    "mass": "m",
    "speed": "v",
    "rotor.speed": "ω",
    "cam.speed": "ω",
    "vibration.speed": "ω",
    "wedge.load": "Q",
    "angle": "α",
    "floor": "μf",
    "wall": "μw",
    "length": "L",
    "modulus": "E",
    "section.modulus": "W",
    "strength": "Re",
    "density": "ρ",
    "second_moment": "I",
    "area": "A",
    "safety": "S",
    "force": "F",
    "couple": "M",
    "line": "q",
    "at": "x",
    "from": "x1",
    "to": "x2",
    "stiffness": "k",
    "damping": "c",
    "damping_ratio": "ζ",
    "stiffness_x": "kx",
    "stiffness_y": "ky",
    "inertia": "J",
    "lift": "h",
    "rise_time": "T",
    "height": "h",
    "drag_coefficient": "c_w",
    "linear": "b",
    "quadratic": "k",
    "gravity": "g",
    "incline": "α",
    "confidence": "1 − α",
    "base_radius": "r_b",
    "roller_radius": "r_r",
    "offset": "e",
    "barrel_radius": "R",
    "width": "b",
    "load": "F_l",
    "preload": "F_0",
    "pivot_distance": "c",
    "arm": "l",
    "pressure_angle": "α_max",
    "magnitude": "F",
    "size": "F",
    "unbalance": "U",
    "frequency": "f",
    "duration": "T",
    "displacement": "x0",
    "velocity": "v0",
    "torsional_stiffness": "k_θ",
    "settlement": "w0",
    "tolerance": "T",
    "clearance": "c",
    "lower": "L",
    "upper": "U",
    "about": "r0",
    "belt.mass": "m",
    "forces.at": "r",
    "rigid_body.at": "r",
    "mounts.at": "r",
    "rotor.at": "z",
    "rotor.angle": "θ",
    "trajectory.at": "φ",
    "program.from": "",
    "program.to": "",
    "cam.from": "",
    "cam.to": "",
    "cam.at": "",
    "cam.velocity": "",
    "vibration.force": "F",
}
_VALUE = re.compile(r"([-+−]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*)", re.DOTALL)
#: Keys that the solution states as formulas.
STATED = ("minimize", "maximize", "subject_to")
#: Keys that hold things under names which the user chose.
NAMED = (
    "supports",
    "loads",
    "forces",
    "couples",
    "masses",
    "inertias",
    "planes",
    "springs",
    "dampers",
    "start",
    "mounts",
    "samples",
    "tests",
    "regressions",
    "capability",
    "variables",
    "subject_to",
    "dimensions",
    "clearances",
    "components",
    "angles",
    "parameters",
)


def given_data(problem: Problem, translate: Translate) -> Iterator[Block]:
    """A table of single values; of every mapping of names and every list of mappings a table of its own."""
    data, single, tables = problem.given(), [], []
    for key, value in data.items():
        if key in STATED:
            continue
        if key in NAMED and isinstance(value, Mapping) and value:
            tables.append(_by_name(problem.kind, key, value, translate))
        elif isinstance(value, Sequence) and value and all(isinstance(each, Mapping) for each in value):
            numbered = {str(i): each for i, each in enumerate(value, 1)}
            tables.append(_by_name(problem.kind, key, numbered, translate))
        else:
            single += list(_rows(problem.kind, (key,), value, translate))
    if single:
        head = tuple(map(translate, (_("name"), _("symbol"), _("value"), _("unit"))))
        yield TableBlock(translate(_("Given data")), head, tuple(single), "<^><")
    yield from tables


def _rows(kind: str, path: tuple[str, ...], value: Any, translate: Translate) -> Iterator[tuple[str, ...]]:
    """Rows of a single value; of a mapping one for each of its values, named with what they belong to."""
    if isinstance(value, Mapping):
        for key, each in value.items():
            yield from _rows(kind, (*path, str(key)), each, translate)
        return
    name, symbol = " – ".join(dict.fromkeys(_word(kind, part, translate) for part in path)), _symbol(kind, path)
    shown, unit = _split(value, translate)
    yield literal(name), _math(symbol), shown, literal(unit)


def _by_name(kind: str, key: str, things: Mapping[str, Any], translate: Translate) -> TableBlock:
    """Things by name, a column for every key that one of them has."""
    bare = ("force",) if key in ("forces", "loads") else ("value",)
    flat = {name: dict(_flat(each, bare=bare)) for name, each in things.items()}
    columns = list(dict.fromkeys(column for each in flat.values() for column in each))
    head = [translate(_("name"))]
    for column in columns:
        symbol = _math(_symbol(kind, (key, *column)))
        word = literal(" – ".join(_word(kind, part, translate) for part in column))
        head.append(f"{word} {symbol}" if symbol else word)
    rows = [
        (literal(name), *(_cell(each[column], translate) if column in each else "–" for column in columns))
        for name, each in flat.items()
    ]
    caption = translate(_("Given: {what}", what=_word(kind, key, translate)))
    return TableBlock(caption, tuple(head), tuple(rows), "<" + "^" * len(columns))


def _flat(value: Any, path: tuple[str, ...] = (), *, bare: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], Any]]:
    """Values of a thing by their keys, those of mappings within it too; a single value as that of ``bare``."""
    if isinstance(value, Mapping):
        for key, each in value.items():
            yield from _flat(each, (*path, str(key)), bare=bare)
    else:
        yield path or bare, value


def _word(kind: str, key: str, translate: Translate) -> str:
    """What a key is called; a name that the user chose is itself."""
    named = CALCULATION_KEYS.get(f"{kind}_{key}") or CALCULATION_KEYS.get(key)
    return translate(named) if named else key


def _symbol(kind: str, path: tuple[str, ...]) -> str:
    """The symbol of a key, as a formula on a line; empty where it has none."""
    above = path[-2] if len(path) > 1 else kind
    return next(
        (SYMBOLS[each] for each in (f"{above}.{path[-1]}", f"{kind}.{path[-1]}", path[-1]) if each in SYMBOLS), ""
    )


def _math(symbol: str) -> str:
    return noted(symbol) if symbol else ""


def _cell(value: Any, translate: Translate) -> str:
    shown, unit = _split(value, translate)
    return shown if not unit else f"{shown}{'' if unit == '°' else ' '}{literal(unit)}"


def _split(value: Any, translate: Translate) -> tuple[str, str]:
    """A value as it is printed, and its unit."""
    if isinstance(value, bool):
        return translate(_("yes") if value else _("no")), ""
    if isinstance(value, list | tuple):
        parts = [_split(each, translate) for each in value]
        shared = {unit for _unused, unit in parts if unit}
        if len(shared) == 1 and all(unit or text in ("0", "0.0") for text, unit in parts):
            return f"({', '.join(text for text, _unused in parts)})", shared.pop()
        return f"({', '.join(f'{text} {unit}'.rstrip() for text, unit in parts)})", ""
    text = str(value).strip()
    found = _VALUE.fullmatch(text)
    if found is None:
        return literal(text), ""
    power = "e" in found[1].lower()
    number = noted(found[1].lower()) if power else found[1].replace("-", "−")
    unit = found[2].strip()
    if unit:
        try:
            units.unit(units.tidy(unit))
        except LinkwrightError:
            return literal(text), ""
    return number, "°" if unit == "deg" else unit
