"""From a Mechanism to the text of a model file."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

from linkwright.drivers.base import Driver
from linkwright.fields.base import written_quantity
from linkwright.files.read_links import LINK_FIELDS
from linkwright.files.read_model import KEPT
from linkwright.joints.base import IMPLIED, Joint
from linkwright.mechanism.geometry import STRUCTURAL_POINTS, from_drawing
from linkwright.mechanism.mechanism import Link, Mechanism, Vec
from linkwright.units import NONE, number, si_symbol

Plain = dict[str, Any]
_SAFE = re.compile(
    r"[^\W\d_][^,\[\]{}#&*!|>'\"%@`:\n\t\\]*(?<! )|[+-]?\d[^,\[\]{}#&*!|>'\"%@`:\n\t\\]*(?<! )"
)
_RESERVED = frozenset(("null", "Null", "NULL", "true", "false", "True", "False", "TRUE", "FALSE"))


def dump(mechanism: Mechanism) -> str:
    """Text of a model file that reads back as the same mechanism (values to the last digit)."""
    return to_yaml(to_data(mechanism))


def to_data(mechanism: Mechanism) -> Plain:
    """The mechanism as plain data in the layout of a model file."""
    texts = {address: expression.text for address, expression in mechanism.expressions.items()}
    data: Plain = {"format": 1, "name": mechanism.name}
    data |= {key: text for key in ("purpose", "source") if (text := getattr(mechanism, key))}
    data["parameters"] = {
        name: texts.get(name) or _parameter(mechanism, name) for name in mechanism.parameters
    }
    data["frame"] = {"points": _points(mechanism.frame, texts)}
    drawn = {**mechanism.frame.points, **mechanism.drawing}
    data["links"] = {name: _link(link, texts, drawn) for name, link in mechanism.links.items()}
    data["joints"] = {
        name: found for name, joint in mechanism.joints.items() if (found := _joint(joint, texts))
    }
    data["assembly"] = dict(mechanism.assembly)
    data["drawing"] = {name: [_length(x), _length(y)] for name, (x, y) in mechanism.drawing.items()}
    data |= _drivers(mechanism.drivers, texts)
    cycle = mechanism.cycle.dimensions() if mechanism.cycle else {}
    values = {
        address.removeprefix("cycle."): _cycle_value(mechanism, address, value)
        for address, value in cycle.items()
    }
    data["cycle"] = _substituted(values, "cycle", texts)
    if mechanism.gravity != (0.0, 0.0) or "gravity.x" in texts or "gravity.y" in texts:
        data["gravity"] = [
            texts.get(f"gravity.{axis}") or written_quantity(value, "acceleration")
            for axis, value in zip("xy", mechanism.gravity, strict=True)
        ]
    data["loads"] = {
        name: _substituted(load.written(), f"loads.{name}", texts) for name, load in mechanism.loads.items()
    }
    data |= {name: dict(getattr(mechanism, name)) for name in KEPT}
    return {key: value for key, value in data.items() if value not in ({}, [])}


def _parameter(mechanism: Mechanism, name: str) -> Any:
    value, symbol = mechanism.parameters[name], si_symbol(mechanism.kinds.get(name, NONE))
    return f"{number(value)} {symbol}" if symbol else value


def _length(value: float) -> Any:
    return written_quantity(value, "length")


def _points(link: Link, texts: Mapping[str, str]) -> Plain:
    return {point: _coordinates(f"{link.name}.{point}", place, texts) for point, place in link.points.items()}


def _coordinates(address: str, place: Vec, texts: Mapping[str, str]) -> list[Any]:
    return [texts.get(f"{address}.{axis}") or _length(value) for axis, value in zip("xy", place, strict=True)]


def _link(link: Link, texts: Mapping[str, str], drawn: Mapping[str, Vec]) -> Plain:
    points = _points(link, texts)
    names = list(points)
    listed = _as_drawn(link, drawn) if link.geometry == "drawing" else STRUCTURAL_POINTS[link.geometry]
    found: Plain = {"points": names[:listed] if listed else points}
    name = link.name
    if link.geometry == "length":
        found["length"] = texts.get(f"{name}.length") or _length(link.lengths[0])
    if link.geometry == "bent":
        found["lengths"] = [
            texts.get(f"{name}.lengths.{i}") or _length(value) for i, value in enumerate(link.lengths)
        ]
        found["angle"] = texts.get(f"{name}.angle") or written_quantity(link.angle, "angle")
    if listed and names[listed:]:
        found["also"] = {point: points[point] for point in names[listed:]}
    for key, value in (("mass", link.mass), ("inertia", link.inertia)):
        if value or f"{name}.{key}" in texts:
            found[key] = texts.get(f"{name}.{key}") or LINK_FIELDS[key].written(value)
    if link.mass_centre is not None:
        found["mass_centre"] = _coordinates(f"{name}.mass_centre", link.mass_centre, texts)
    return found


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
    values, fields = joint.written(), joint.fields()
    if not values and joint.kind == IMPLIED:
        return None
    values |= {key: 0.0 for key in fields if f"{joint.name}.{key}" in texts}
    written = {
        key: value if isinstance(value, list | str) else fields[key].written(value)
        for key, value in values.items()
    }
    return {"kind": joint.kind, **_substituted(written, joint.name, texts)}


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


def _cycle_value(mechanism: Mechanism, address: str, value: float) -> Any:
    first = next(iter(mechanism.drivers.values()), None)
    across = "angle" if first is None or first.law.rotary else "length"
    return written_quantity(
        value, {"cycle.duration": "time", "cycle.turns": "dimensionless"}.get(address, across)
    )


def _substituted(value: Any, address: str, texts: Mapping[str, str]) -> Any:
    """Plain data with the values that were expressions replaced by their texts."""
    if address in texts:
        return texts[address]
    if isinstance(value, dict):
        return {key: _substituted(each, f"{address}.{key}", texts) for key, each in value.items()}
    if isinstance(value, list):
        return [_substituted(each, f"{address}.{index}", texts) for index, each in enumerate(value)]
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
