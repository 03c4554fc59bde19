"""The given data of a calculation as tables: single values with symbols and units, and a table for every list."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from linkwright import units
from linkwright.errors import LinkwrightError
from linkwright.parts.base import Problem
from linkwright.reports.document import Block, Table, literal, noted
from linkwright.reports.key_names import CALCULATION_KEYS
from linkwright.words import Translate, _

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


def given_data(problem: Problem, say: Translate) -> Iterator[Block]:
    """A table of single values; of every mapping of names and every list of mappings a table of its own."""
    data, single, tables = problem.given(), [], []
    for key, value in data.items():
        if key in STATED:
            continue
        if key in NAMED and isinstance(value, Mapping) and value:
            tables.append(_by_name(problem.kind, key, value, say))
        elif isinstance(value, Sequence) and value and all(isinstance(each, Mapping) for each in value):
            numbered = {str(i): each for i, each in enumerate(value, 1)}
            tables.append(_by_name(problem.kind, key, numbered, say))
        else:
            single += list(_rows(problem.kind, (key,), value, say))
    if single:
        head = tuple(map(say, (_("name"), _("symbol"), _("value"), _("unit"))))
        yield Table(say(_("Given data")), head, tuple(single), "<^><")
    yield from tables


def _rows(kind: str, path: tuple[str, ...], value: Any, say: Translate) -> Iterator[tuple[str, ...]]:
    """Rows of a single value; of a mapping one for each of its values, named with what they belong to."""
    if isinstance(value, Mapping):
        for key, each in value.items():
            yield from _rows(kind, (*path, str(key)), each, say)
        return
    name, symbol = " – ".join(dict.fromkeys(_word(kind, part, say) for part in path)), _symbol(kind, path)
    shown, unit = _split(value, say)
    yield literal(name), _math(symbol), shown, literal(unit)


def _by_name(kind: str, key: str, things: Mapping[str, Any], say: Translate) -> Table:
    """Things by name, a column for every key that one of them has."""
    bare = ("force",) if key in ("forces", "loads") else ("value",)
    flat = {name: dict(_flat(each, bare=bare)) for name, each in things.items()}
    columns = list(dict.fromkeys(column for each in flat.values() for column in each))
    head = [say(_("name"))]
    for column in columns:
        symbol = _math(_symbol(kind, (key, *column)))
        word = literal(" – ".join(_word(kind, part, say) for part in column))
        head.append(f"{word} {symbol}" if symbol else word)
    rows = [
        (literal(name), *(_cell(each[column], say) if column in each else "–" for column in columns))
        for name, each in flat.items()
    ]
    caption = say(_("Given: {what}", what=_word(kind, key, say)))
    return Table(caption, tuple(head), tuple(rows), "<" + "^" * len(columns))


def _flat(value: Any, path: tuple[str, ...] = (), *, bare: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], Any]]:
    """Values of a thing by their keys, those of mappings within it too; a single value as that of ``bare``."""
    if isinstance(value, Mapping):
        for key, each in value.items():
            yield from _flat(each, (*path, str(key)), bare=bare)
    else:
        yield path or bare, value


def _word(kind: str, key: str, say: Translate) -> str:
    """What a key is called; a name that the user chose is itself."""
    named = CALCULATION_KEYS.get(f"{kind}_{key}") or CALCULATION_KEYS.get(key)
    return say(named) if named else key


def _symbol(kind: str, path: tuple[str, ...]) -> str:
    """The symbol of a key, as a formula on a line; empty where it has none."""
    above = path[-2] if len(path) > 1 else kind
    return next(
        (SYMBOLS[each] for each in (f"{above}.{path[-1]}", f"{kind}.{path[-1]}", path[-1]) if each in SYMBOLS), ""
    )


def _math(symbol: str) -> str:
    return noted(symbol) if symbol else ""


def _cell(value: Any, say: Translate) -> str:
    shown, unit = _split(value, say)
    return shown if not unit else f"{shown}{'' if unit == '°' else ' '}{literal(unit)}"


def _split(value: Any, say: Translate) -> tuple[str, str]:
    """A value as it is printed, and its unit."""
    if isinstance(value, bool):
        return say(_("yes") if value else _("no")), ""
    if isinstance(value, list | tuple):
        parts = [_split(each, say) for each in value]
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
