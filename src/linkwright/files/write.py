"""From a Mechanism to the text of a model file."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

from linkwright.core.arguments import require
from linkwright.core.json_data import Plain
from linkwright.drivers.base import Driver
from linkwright.fields.references import PLACE
from linkwright.files.read_model import FREE_SECTIONS, HEADER
from linkwright.joints.base import IMPLIED, Joint
from linkwright.mechanism.link import LINK_FIELDS, STRUCTURAL_POINTS, Link, Vec, from_drawing
from linkwright.mechanism.mechanism import GRAVITY, Cycle, Mechanism
from linkwright.units import NONE, number, si_symbol

_SAFE = re.compile(r"[^\W\d_][^,\[\]{}#&*!|>'\"%@`:\n\t\\]*(?<! )|[+-]?\d[^,\[\]{}#&*!|>'\"%@`:\n\t\\]*(?<! )")
_RESERVED = frozenset(("null", "Null", "NULL", "true", "false", "True", "False", "TRUE", "FALSE"))


def dump(mechanism: Mechanism) -> str:
    """Text of a model file that reads back as the same mechanism (values to the last digit)."""
    require(mechanism, Mechanism)
    return to_yaml(to_data(mechanism))


def to_data(mechanism: Mechanism) -> Plain:
    """The mechanism as plain data in the layout of a model file."""
    texts = {address: expression.text for address, expression in mechanism.expressions.items()}
    data: Plain = {"format": 1, "name": HEADER["name"].written(mechanism.name)}
    data |= {key: HEADER[key].written(text) for key in ("purpose", "source") if (text := getattr(mechanism, key))}
    data["parameters"] = {name: texts.get(name) or _parameter(mechanism, name) for name in mechanism.parameters}
    data["frame"] = {"points": _substituted(_places(mechanism.frame.points), "frame", texts)}
    drawn = {**mechanism.frame.points, **mechanism.drawing}
    data["links"] = {name: _link(link, texts, drawn) for name, link in mechanism.links.items()}
    joints = {name: _joint(joint, texts) for name, joint in mechanism.joints.items()}
    data["joints"] = {name: found for name, found in joints.items() if found}
    data["assembly"] = dict(mechanism.assembly)
    data["drawing"] = _places(mechanism.drawing)
    data |= _drivers(mechanism.drivers, texts)
    fields, cycle = Cycle.fields(mechanism.across), mechanism.cycle.dimensions() if mechanism.cycle else {}
    cycle_values = {key: fields[key].written(cycle[f"cycle.{key}"]) for key in fields if f"cycle.{key}" in cycle}
    data["cycle"] = _substituted(cycle_values, "cycle", texts)
    gravity = _substituted(GRAVITY.written(mechanism.gravity), "gravity", texts)
    data["gravity"] = [] if gravity == [0.0, 0.0] else gravity
    data["loads"] = {
        name: _substituted(load.written(), f"loads.{name}", texts) for name, load in mechanism.loads.items()
    }
    data["outputs"] = {name: each.expression.text for name, each in mechanism.outputs.items()}
    data |= {name: dict(getattr(mechanism, name)) for name in FREE_SECTIONS}
    return {key: value for key, value in data.items() if value not in ({}, [])}


def _parameter(mechanism: Mechanism, name: str) -> Any:
    value, symbol = mechanism.parameters[name], si_symbol(mechanism.kinds.get(name, NONE))
    return f"{number(value)} {symbol}" if symbol else value


def _places(points: Mapping[str, Vec]) -> Plain:
    return {name: PLACE.written(place) for name, place in points.items()}


def _link(link: Link, texts: Mapping[str, str], drawn: Mapping[str, Vec]) -> Plain:
    points = _substituted(_places(link.points), link.name, texts)
    listed = _as_drawn(link, drawn) if link.geometry == "drawing" else STRUCTURAL_POINTS[link.geometry]
    sizes: Plain = {"lengths": link.lengths, "angle": link.angle} if link.geometry == "bent" else {}
    if link.geometry == "length":
        sizes = {"length": link.lengths[0]}
    mass_values = {key: getattr(link, key) for key in ("mass", "inertia", "mass_centre")}
    sizes |= {key: value for key, value in mass_values.items() if value or f"{link.name}.{key}" in texts}
    written = {key: LINK_FIELDS[key].written(value) for key, value in sizes.items()}
    found = {"points": points, **_substituted(written, link.name, texts)}
    if listed:
        found["points"], rest = list(points)[:listed], list(points)[listed:]
        found["also"] = {name: points[name] for name in rest}
    return {key: found[key] for key in LINK_FIELDS if found.get(key, {}) != {}}


def _as_drawn(link: Link, drawn: Mapping[str, Vec]) -> int:
    """How many of the link's points still follow from the drawing; 0 where a dimension was changed since."""
    names = list(link.points)
    for count in range(len(names), 1, -1):
        listed = names[:count]
        if all(name in drawn for name in listed) and drawn[listed[0]] != drawn[listed[1]]:
            local = from_drawing(listed, drawn)
            if all(local[name] == link.points[name] for name in listed):
                return count
    return 0


def _joint(joint: Joint, texts: Mapping[str, str]) -> Plain | None:
    addresses = {key: f"{joint.name}.{key}" for key in joint.fields()}
    expressions = {key: texts[address] for key, address in addresses.items() if address in texts}
    values = {**joint.written(), **expressions}
    if not values and joint.kind == IMPLIED:
        return None
    return {"kind": joint.kind, **_substituted(values, joint.name, texts)}


def _drivers(drivers: Mapping[str, Driver], texts: Mapping[str, str]) -> Plain:
    found = {name: _driver(driver, texts) for name, driver in drivers.items()}
    if list(found) == ["driver"]:
        return {"driver": found["driver"]}
    return {"drivers": found} if found else {}


def _driver(driver: Driver, texts: Mapping[str, str]) -> Plain:
    law = driver.law
    way: Plain = {"slide": driver.joint}
    if law.rotary:
        way = {"turn": driver.link, "about": driver.joint, "relative_to": driver.relative_to}
    fields, values = type(law).fields(law.rotary), law.text_values()
    written = {key: fields[key].written(value) for key, value in values.items()}
    return {**way, **_substituted(written, driver.name, texts)}


def _substituted(value: Any, address: str, texts: Mapping[str, str]) -> Any:
    """Plain data with the values that were expressions replaced by their texts."""
    if address in texts:
        return texts[address]
    if isinstance(value, dict):
        return {key: _substituted(each, f"{address}.{key}", texts) for key, each in value.items()}
    if isinstance(value, list):
        ends = "xy" if {f"{address}.x", f"{address}.y"} & texts.keys() else range(len(value))
        return [_substituted(each, f"{address}.{end}", texts) for end, each in zip(ends, value, strict=True)]
    return value


def to_yaml(data: Plain) -> str:
    """Plain data as YAML: one line for each entry of a section."""
    lines: list[str] = []
    for key, value in data.items():
        if isinstance(value, dict) and key not in ("driver", "cycle"):
            lines.append(f"{key}:")
            lines += [f"  {scalar(name)}: {flow(each)}" for name, each in value.items()]
        else:
            lines.append(f"{key}: {flow(value)}")
    return "\n".join(lines) + "\n"


def flow(value: Any) -> str:
    """A value in flow style, on one line."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{scalar(str(key))}: {flow(each)}" for key, each in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(flow(each) for each in value) + "]"
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int | float):
        return number(value) if isinstance(value, float) else str(value)
    return scalar(str(value))


def scalar(text: str) -> str:
    """A text as a YAML scalar, in quotes where it would otherwise mean something else."""
    if _SAFE.fullmatch(text) and text not in _RESERVED:
        return text
    return json.dumps(text, ensure_ascii=False)
