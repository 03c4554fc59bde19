"""The text of a model file: written from a Mechanism, or changed in place with everything else as it was."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from linkwright.core.arguments import require
from linkwright.core.data import Plain
from linkwright.drivers.base import Driver
from linkwright.drivers.cylinder import barrel_name, rod_name
from linkwright.errors import Finding, LinkwrightError, ModelError, with_remedy
from linkwright.fields.body import BODY_FIELDS
from linkwright.fields.mass import FROM_SHAPE
from linkwright.fields.nodes import Entry, Node, Scalar, Sequence, located
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.references import PLACE
from linkwright.files.compose import compose
from linkwright.files.read_model import FREE_SECTIONS, HEADER, SECTIONS
from linkwright.filesystem import atomic_write
from linkwright.joints.base import IMPLIED, Joint
from linkwright.mechanism.link import LINK_FIELDS, STRUCTURAL_POINTS, Link, Vec, from_drawing
from linkwright.mechanism.mechanism import GRAVITY, Mechanism
from linkwright.registry import offered
from linkwright.units import NONE, number, si_symbol
from linkwright.words import _

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
    if mechanism.frame.shape is not None:
        data["frame"]["shape"] = _substituted(mechanism.frame.shape.written(), "frame.shape", texts)
    drawn = {**mechanism.frame.points, **mechanism.drawing}
    cylinders = {name: each for name, each in mechanism.drivers.items() if is_whole(mechanism, each)}
    parts = {link for each in cylinders.values() for link in (each.link, each.relative_to)}
    data["links"] = {name: _link(link, texts, drawn) for name, link in mechanism.links.items() if name not in parts}
    own = {each.joint for each in cylinders.values()}
    joints = {name: _joint(joint, texts) for name, joint in mechanism.joints.items() if name not in own}
    data["joints"] = {name: found for name, found in joints.items() if found}
    data["assembly"] = dict(mechanism.assembly)
    data["drawing"] = _places(mechanism.drawing)
    data |= _drivers(mechanism, cylinders, texts)
    data["cycle"] = _substituted(mechanism.cycle.written(mechanism.across), "cycle", texts) if mechanism.cycle else {}
    data["path"] = _substituted(mechanism.path.written(), "path", texts) if mechanism.path else {}
    gravity = _substituted(GRAVITY.written(mechanism.gravity), "gravity", texts)
    data["gravity"] = [] if gravity == [0.0, 0.0] else gravity
    data["loads"] = {
        name: _substituted(load.written(), f"loads.{name}", texts) for name, load in mechanism.loads.items()
    }
    data["actuators"] = {
        name: _substituted(each.written(), f"actuators.{name}", texts) for name, each in mechanism.actuators.items()
    }
    data["stops"] = {
        name: _substituted(stop.written(), f"stops.{name}", texts) for name, stop in mechanism.stops.items()
    }
    data["run"] = _substituted(mechanism.run.written(mechanism.drivers), "run", texts) if mechanism.run else {}
    if mechanism.construction is not None:
        data["construction"] = _substituted(mechanism.construction.written(texts), "construction", texts)
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
    mass_values = {key: getattr(link, key) for key in ("mass", "inertia", "mass_centre", "colour", "shape")}
    if link.mass_from_shape:
        mass_values |= {"mass": FROM_SHAPE, "inertia": 0.0, "mass_centre": None}
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


def is_whole(mechanism: Mechanism, driver: Driver) -> bool:
    """Whether a driver is a cylinder whose links and joint are still those that two points make."""
    if driver.cylinder is None:
        return False
    links = [mechanism.links.get(each) for each in (driver.relative_to, driver.link)]
    joint = mechanism.joints.get(driver.joint)
    plain = {"guide": driver.relative_to, "block": driver.link, "direction": 0.0}
    ends = (each.point for each in driver.cylinder.between)
    return (
        joint is not None
        and {key: getattr(joint, key, None) for key in plain} == plain
        and not any(getattr(joint, key, 0.0) for key in ("offset", "block_angle", "friction"))
        and all(link is not None and list(link.points) == [end] for link, end in zip(links, ends, strict=True))
        and driver.joint == driver.name
    )


def _drivers(mechanism: Mechanism, cylinders: Collection[str], texts: Mapping[str, str]) -> Plain:
    found = {
        name: _cylinder(mechanism, driver, texts) if name in cylinders else _driver(driver, texts)
        for name, driver in mechanism.drivers.items()
    }
    if list(found) == ["driver"]:
        return {"driver": found["driver"]}
    return {"drivers": found} if found else {}


def _driver(driver: Driver, texts: Mapping[str, str]) -> Plain:
    way: Plain = {"slide": driver.joint}
    if driver.law.rotary:
        way = {"turn": driver.link, "about": driver.joint, "relative_to": driver.relative_to}
    return {**way, **_law(driver, texts)}


def _cylinder(mechanism: Mechanism, driver: Driver, texts: Mapping[str, str]) -> Plain:
    assert driver.cylinder is not None
    bodies = {}
    for key, name in (("barrel", driver.relative_to), ("rod", driver.link)):
        written = _link(mechanism.links[name], texts, {})
        bodies[key] = {each: value for each, value in written.items() if each in BODY_FIELDS}
    own = _substituted(driver.cylinder.written(), driver.name, texts)
    return {**own, **{key: each for key, each in bodies.items() if each}, **_law(driver, texts)}


def _law(driver: Driver, texts: Mapping[str, str]) -> Plain:
    fields, values = driver.law.fields(driver.law.rotary), driver.law.text_values()
    written = {key: fields[key].written(value) for key, value in values.items()}
    return _substituted(written, driver.name, texts)  # type: ignore[no-any-return]


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
        if isinstance(value, dict) and key not in ("driver", "cycle", "path", "run"):
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


_AXES = {"x": "0", "y": "1"}
ReadText = Callable[[str, str], tuple[Mechanism | None, list[Finding]]]


class Edit(NamedTuple):
    """What takes the place of a part of a text; ``adds``: a key that was not there."""

    start: int
    end: int
    written: str
    adds: bool = False

    def overlaps(self, other: Edit) -> bool:
        """Whether both change the same characters."""
        return self.start < other.end and other.start < self.end

    def made(self, text: str) -> str:
        """The text with it."""
        return text[: self.start] + self.written + text[self.end :]


class Document:
    """The text of a model file, its mechanism, and changes of single values that keep comments and order."""

    def __init__(self, text: str, name: str, read_text: ReadText) -> None:
        self.name, self._read_text = name, read_text
        self.text, self.mechanism = text, self._checked(text)
        self._composed = "", MappingNode(0, 0, 0, 0, [])

    def __repr__(self) -> str:
        return f"Document({self.name!r}: {self.mechanism!r})"

    def _checked(self, text: str) -> Mechanism:
        mechanism, findings = self._read_text(text, self.name)
        if mechanism is None:
            raise ModelError(findings)
        return mechanism

    def located(self, error: ModelError, without: Collection[str] = ()) -> ModelError:
        """The error with its findings at their lines; those below keys ``without`` are not about the text."""
        root, other = _root(self.text), tuple(f"{key}." for key in without)
        return ModelError(
            [each if f"{each.key}.".startswith(other) else located(each, root, self.name) for each in error.findings]
        )

    def set(self, address: str, value: str) -> None:
        """Write ``value`` (as text of the file, such as ``"1.3 m"``) at a place of the file.

        ``address`` is a dimension's address (``crank.length``) or a path of keys (``links.crank.length``). A last
        key that is not there yet is added, a section at the end. Raises ModelError, and changes nothing, where the
        new text is not a model; LinkwrightError for a place that the file does not have.
        """
        self.set_all({address: value})

    def set_all(self, values: dict[str, str]) -> None:
        """The same for texts by address, all or none of them: the new text is checked once."""
        text, left = self.text, list(values.items())
        while left:
            root, edits = _root(text), list[Edit]()
            while left:
                edit = self._edit(text, root, *left[0])
                if edits and (edit.adds or any(edit.overlaps(each) for each in edits)):
                    break
                edits.append(edit)
                left.pop(0)
                if edit.adds:
                    break
            for edit in sorted(edits, reverse=True):
                text = edit.made(text)
        self.mechanism, self.text = self._checked(text), text

    def _edit(self, text: str, root: MappingNode, address: str, value: str) -> Edit:
        for path in _paths(address, root):
            node, rest = _follow(root, path)
            if not rest:
                return self._replaced(text, node, value)
            last = len(rest) == 1 and rest[0] not in ("x", "y", "0", "1")
            if last and isinstance(node, MappingNode) and (node is not root or rest[0] in SECTIONS):
                return self._added(text, node, rest[0], value)
        raise no_place(address, self.mechanism)

    def has(self, path: str) -> bool:
        """Whether the file has something at a path of keys."""
        return not _follow(self._tree, path.split("."))[1]

    def block(self, entries: Mapping[str, Plain]) -> str:
        """Text of a section for ``set``: one line for each entry, in a JSON file all on one."""
        if self._json:
            return json.dumps(entries, ensure_ascii=False)
        newline = "\r\n" if "\r\n" in self.text else "\n"
        return "".join(f"{newline}  {scalar(name)}: {flow(each)}" for name, each in entries.items())

    def inline(self, value: Plain) -> str:
        """Text of a table for ``set``, on one line."""
        return json.dumps(value, ensure_ascii=False) if self._json else flow(value)

    def place(self, address: str) -> tuple[int, int] | None:
        """Span of the value at an address in the text: its first offset and the one behind it; None where the
        file has no such place."""
        root = self._tree
        offset = 1 if self.text.startswith("\ufeff") else 0
        for path in _paths(address, root):
            node, rest = _follow(root, path)
            if not rest and isinstance(node, Scalar):
                return node.start + offset, node.end + offset
        return None

    def edit(self, address: str, value: str) -> Edit | None:
        """What :meth:`set` would do to the text; None for a place that the file does not have."""
        try:
            return self._edit(self.text, self._tree, address, value)
        except LinkwrightError:
            return None

    def with_text(self, text: str) -> Document:
        """A document of another text; raises ModelError where that is not a model."""
        return Document(text, self.name, self._read_text)

    @property
    def _tree(self) -> MappingNode:
        if self._composed[0] != self.text:
            self._composed = self.text, _root(self.text)
        return self._composed[1]

    def save(self, path: str | Path, *, force: bool = False) -> None:
        """Write the text to a file, atomically.

        Raises LinkwrightError where it cannot be written, and for a file that is there already unless ``force``.
        """
        atomic_write(path, self.text.encode(), force=force)

    def _replaced(self, text: str, node: Node, value: str) -> Edit:
        offset = 1 if text.startswith("\ufeff") else 0
        start, end = node.start + offset, node.end + offset
        while end > start and text[end - 1] in " \r\n":
            end -= 1
        written = self._written(value)
        if isinstance(node, Scalar) and node.empty and start == end:
            written = f" {written}"
        return Edit(start, end, written)

    def _added(self, text: str, node: MappingNode, key: str, value: str) -> Edit:
        offset = 1 if text.startswith("\ufeff") else 0
        name = json.dumps(key) if self._json else key
        entry = f"{name}:{value}" if value.startswith(("\n", "\r\n")) else f"{name}: {self._written(value)}"
        if not node.entries or node.flow:
            place = _flow_end(node, text, offset)
            glue = ", " if node.entries else ""
            return Edit(place, place, glue + entry, adds=True)
        last = node.entries[-1]
        line_end = text.find("\n", content_end(last) + offset)
        at = len(text) if line_end < 0 else line_end
        if text[at - 1 : at] == "\r":
            at -= 1
        newline = "\r\n" if "\r\n" in text else "\n"
        return Edit(at, at, newline + " " * last.key.column + entry, adds=True)

    @property
    def _json(self) -> bool:
        return self.text.lstrip("\ufeff \t\r\n").startswith("{")

    def _written(self, value: str) -> str:
        stripped = value.strip()
        if stripped[:1] in ("[", "{", '"', "'"):
            return stripped
        return json.dumps(stripped, ensure_ascii=False) if self._json and stripped != "0" else flow(stripped)


def no_place(address: str, mechanism: Mechanism) -> LinkwrightError:
    """The error for an address that a file has no place for: of no dimension, or of one behind a word, such as the
    density of a material that it names."""
    sentence = _('the file has no place for "{address}"', code="model.no_place", address=address)
    known = mechanism.dimensions()
    behind = _("write numbers in place of the word of the file from which it follows")
    return LinkwrightError(with_remedy(sentence, behind if address in known else offered(address, known)))


def _root(text: str) -> MappingNode:
    root, _unused = compose(text.removeprefix("\ufeff"))
    assert isinstance(root, MappingNode)
    return root


def _flow_end(node: MappingNode, text: str, offset: int) -> int:
    """Where to insert before the closing brace: behind the last entry's value."""
    if node.entries:
        return content_end(node.entries[-1]) + offset
    return text.rfind("}", 0, node.end + offset)


def content_end(entry: Entry) -> int:
    """Offset behind the last character of an entry's value."""
    value = entry.value
    if isinstance(value, Scalar) or value.end <= value.start:
        return max(value.end, entry.key.end)
    if isinstance(value, MappingNode) and not value.flow and value.entries:
        return content_end(value.entries[-1])
    if isinstance(value, Sequence) and not value.flow and value.items:
        return value.items[-1].end
    return value.end


def _paths(address: str, root: MappingNode) -> list[list[str]]:
    """The paths of keys that an address may mean, best first."""
    parts = address.split(".")
    found = [parts]
    if len(parts) == 1:
        found.append(["parameters", *parts])
    head, *rest = parts
    for section in ("links", "joints", "drivers"):
        owners = root.get(section)
        if isinstance(owners, MappingNode) and owners.get(head) is not None:
            found.append([section, *parts])
            if section == "links" and len(rest) == 2:
                found += [[section, head, holder, *rest] for holder in ("points", "also")]
    found += [[*path, body, *rest] for path, body in _bodies(head, root)]
    if head == "run" and len(rest) == 2:
        found.append([head, rest[0]])
    if head == "frame" and len(rest) == 2:
        found.append(["frame", "points", *rest])
    return found


def _bodies(link: str, root: MappingNode) -> list[tuple[list[str], str]]:
    """The driver's path and the key under which a file has the barrel or the rod of that name."""
    several = root.get("drivers")
    named = [name for name, _unused in several] if isinstance(several, MappingNode) else []
    paths = {"driver": ["driver"], **{name: ["drivers", name] for name in named}}
    made = {"barrel": barrel_name, "rod": rod_name}
    return [(path, body) for name, path in paths.items() for body, named_by in made.items() if link == named_by(name)]


def _follow(root: MappingNode, path: list[str]) -> tuple[Node, list[str]]:
    """The node at a path, or the last that exists and the keys that are left."""
    node: Node = root
    for index, part in enumerate(path):
        below: Node | None = None
        if isinstance(node, MappingNode):
            below = node.get(part)
        elif isinstance(node, Sequence):
            position = _AXES.get(part, part)
            below = node.items[int(position)] if position.isdecimal() and int(position) < len(node.items) else None
        if below is None:
            return node, path[index:]
        node = below
    return node, []
