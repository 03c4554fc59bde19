"""The reader of one model: walks the nodes, turns them into values, and gathers every finding on the way."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, Literal

from linkwright import units
from linkwright.errors import Finding, QuantityError, Severity
from linkwright.model import expressions
from linkwright.model.expressions import Expression
from linkwright.model.fields import Field
from linkwright.model.nodes import Mapping as MappingNode
from linkwright.model.nodes import Node, Scalar, Sequence, noun
from linkwright.model.reference_fields import LinkPoint
from linkwright.model.signal_fields import Output, resolve_output
from linkwright.registry import nearest

_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
NAME = re.compile(r"[^\W\d][\w'-]*")


@dataclass(frozen=True)
class Place:
    """Where a value stands: ``key`` in the file, ``address`` among the mechanism's dimensions."""

    key: str
    address: str

    def child(self, name: str) -> Place:
        """A key below, which counts in the address as well."""
        return Place(f"{self.key}.{name}" if self.key else name, f"{self.address}.{name}" if self.address else name)

    def nested(self, name: str) -> Place:
        """A key below that the address leaves out."""
        return Place(f"{self.key}.{name}" if self.key else name, self.address)


@dataclass
class Names:
    """The names in a model, known before its values are read.

    ``links`` maps every link, the frame among them, to its points; ``joints`` every joint, the implied pins
    among them, to its kind; ``pins`` every implied pin to its links.
    """

    links: dict[str, tuple[str, ...]] = field(default_factory=lambda: {"frame": ()})
    joints: dict[str, str] = field(default_factory=dict)
    pins: dict[str, tuple[str, ...]] = field(default_factory=dict)

    def owners(self, point: str) -> list[str]:
        """The links that have a point of this name."""
        return [link for link, points in self.links.items() if point in points]


class Reader:
    """Values from nodes; every method that reads returns None after it has noted a finding.

    ``si`` admits bare numbers as SI values (models built in code).
    """

    def __init__(self, source: str, *, si: bool = False) -> None:
        self.source, self.si = source, si
        self.findings: list[Finding] = []
        self.names = Names()
        self.kinds: dict[str, units.Dimension] = {}
        self.values: dict[str, float] = {}
        self.broken: set[str] = set()
        self.used: set[str] = set()
        self.expressions: dict[str, Expression] = {}
        self.input_rotary = True
        self._plain: str = ""

    # findings

    @property
    def error_count(self) -> int:
        """How many errors were found so far."""
        return sum(finding.severity == "error" for finding in self.findings)

    def error(
        self, node: Node | None, place: Place | str, message: str, remedy: str = "", code: str = "", *, column: int = 0,
        severity: Severity = "error",
    ) -> None:
        """Note a finding at a node; ``column`` is an offset within it."""
        key = place if isinstance(place, str) else place.key
        self.findings.append(Finding(severity, self.where(node, column), key, message, remedy, code))

    def where(self, node: Node | None, column: int = 0) -> str:
        """The place of a node as ``file:line:column``."""
        if node is None or self.si:
            return self.source
        return f"{self.source}:{node.line + 1}:{node.column + column + 1}"

    # plain structure

    def mapping(self, node: Node | None, place: Place | str) -> MappingNode | None:
        """The node if it is a mapping."""
        if isinstance(node, MappingNode):
            return node
        self.error(node, place, f"{noun(node)} stands where a mapping (key: value) is needed",
                   "write {key: value, …} or indented lines key: value", "type")
        return None

    def items(self, node: Node, place: Place | str, count: int | None, form: str) -> list[Node] | None:
        """The items of a list, of a given count where there is one; ``form`` is an example."""
        if not isinstance(node, Sequence):
            self.error(node, place, f"{noun(node)} stands where a list is needed", f"write it as {form}", "type")
            return None
        if count is None or len(node.items) == count:
            return node.items
        texts = [item.text if isinstance(item, Scalar) else "" for item in node.items]
        comma = len(texts) > count and any(re.fullmatch(r"[+-]?\d+", text) and text != "0" for text in texts)
        remedy = f"write it as {form}" + (", with decimal points, not commas" if comma else "")
        code = "decimal-comma" if comma else "count"
        self.error(node, place, f"{len(node.items)} values stand where {count} are needed", remedy, code)
        return None

    def text(self, node: Node, place: Place | str) -> str | None:
        """The text of a single value."""
        if isinstance(node, Scalar) and not node.empty:
            return node.text
        self.error(node, place, f"{noun(node)} stands where a text is needed", "write a name or a text", "type")
        return None

    def name(self, node: Node, place: Place | str, what: str) -> str | None:
        """A name that the user chose for something new."""
        text = self.text(node, place)
        if text is None or NAME.fullmatch(text):
            return text
        right = re.sub(r"[^\w'-]", "_", text).strip("_") or "a"
        right = right if NAME.fullmatch(right) else f"{what[0]}{right}"
        self.error(node, place, f'"{text}" cannot be the name of a {what}',
                   f'names begin with a letter and hold letters, digits, _ and -: "{right}"', "name")
        return None

    def word(self, node: Node, place: Place | str, choices: tuple[str, ...]) -> str | None:
        """One of a few words."""
        text = self.text(node, place)
        if text is None or text in choices:
            return text
        offer = nearest(text, choices)
        hint = f'did you mean "{offer}"? ' if offer else ""
        self.error(node, place, f'"{text}" is not known here', f"{hint}(one of: {', '.join(choices)})", "unknown-word")
        return None

    def table(self, node: Node, place: Place, fields: Mapping[str, Field]) -> dict[str, Any] | None:
        """The values of a mapping by its fields; unknown and missing keys are findings."""
        mapping = self.mapping(node, place)
        if mapping is None:
            return None
        keys = {each.key or name: name for name, each in fields.items()}
        self.unknown_keys(mapping, place, list(keys))
        found: dict[str, Any] = {}
        for key, name in keys.items():
            value = mapping.get(key)
            if value is None:
                if fields[name].required:
                    self.error(mapping, place.child(key), f'the key "{key}" is missing',
                               fields[name].doc or "add it", "missing-key")
                continue
            found[name] = fields[name].read(self, value, place.child(key), found)
        return found

    def unknown_keys(self, mapping: MappingNode, place: Place, known: list[str]) -> None:
        """A finding for each key that is not known, with the nearest that is."""
        present = {entry.key.text for entry in mapping.entries}
        for entry in mapping.entries:
            key = entry.key.text
            if key in known:
                continue
            number = re.match(r"\s*\d", key) and isinstance(entry.value, Scalar) and entry.value.empty
            if number:
                self.error(entry.key, place, f'"{key}" stands alone; a decimal comma splits a value',
                           "write numbers with a decimal point, such as 60.5 mm", "decimal-comma")
                continue
            offer = nearest(key, [each for each in known if each not in present] or known)
            remedy = f'did you mean "{offer}"? ' if offer else ""
            self.error(entry.key, place.child(key), f'unknown key "{key}"', f"{remedy}(known: {', '.join(known)})",
                       "unknown-key")

    def free(self, node: Node) -> Any:
        """Plain data of any node, numbers and truth values as in YAML 1.2."""
        if isinstance(node, MappingNode):
            return {key: self.free(value) for key, value in node}
        if isinstance(node, Sequence):
            return [self.free(item) for item in node.items]
        assert isinstance(node, Scalar)
        if not node.plain:
            return node.text
        if node.empty:
            return None
        if node.text in ("true", "false"):
            return node.text == "true"
        if re.fullmatch(r"[+-]?\d{1,18}", node.text):
            return int(node.text)
        return float(node.text) if _NUMBER.fullmatch(node.text) else node.text

    # quantities

    @contextmanager
    def plain_numbers(self, what: str) -> Iterator[None]:
        """Within it quantities take no parameters, because ``what`` does not follow their changes."""
        before, self._plain = self._plain, what
        yield
        self._plain = before

    def quantity(self, node: Node, place: Place, dimension: str) -> float | None:
        """SI value of a quantity; an expression of parameters is noted under the place's address."""
        text = self.quantity_text(node, place, units.example(dimension))
        if text is None:
            return None
        if self.si and _NUMBER.fullmatch(text):
            text = f"{text} {units.SI_UNITS[dimension]}".strip()
        try:
            value = expressions.parse_quantity(text, dimension, self.kinds)
            if isinstance(value, float):
                return value
            return self._evaluated(value, node, place)
        except QuantityError as error:
            self.quantity_error(error, node, place, text)
            return None

    def _evaluated(self, value: Expression, node: Node, place: Place) -> float | None:
        self.used |= value.names
        if value.names & self.broken:
            return None
        if self._plain:
            self.error(node, place, f'"{value.text}" uses a parameter, which {self._plain} cannot follow',
                       "write the number with its unit", "expression")
            return None
        result = value.evaluate(self.values)
        self.expressions[place.address] = value
        return float(result)

    def quantity_text(self, node: Node, place: Place, example: str) -> str | None:
        """The text of a quantity or expression."""
        if isinstance(node, Scalar) and not node.empty and node.text.strip():
            return node.text.strip()
        self.error(node, place, f"{noun(node)} stands where a quantity is needed", f'write it as in "{example}"', "type")
        return None

    def quantity_error(self, error: QuantityError, node: Node, place: Place, text: str) -> None:
        """Note the finding for a QuantityError, unless it only follows from a parameter that is wrong itself."""
        if any(re.search(rf"(?<!\w){re.escape(name)}(?!\w)", text) for name in self.broken):
            return
        offset = 0
        if isinstance(node, Scalar) and "\n" not in node.text:
            offset = error.column + (0 if node.plain else 1)
        self.error(node, place, error.message, error.remedy, error.code, column=offset)

    def formula(
        self, node: Node, place: Place, dimension: str, variables: Mapping[str, units.Dimension]
    ) -> Expression | None:
        """An expression of variables and parameters."""
        text = self.quantity_text(node, place, "30 deg*sin(2*pi*t/(2 s))")
        if text is None:
            return None
        kinds = {**self.kinds, **variables}
        try:
            if expressions.is_literal(units.tidy(text), kinds):
                units.parse(text, dimension)
            found = expressions.parse(text, kinds)
            self.used |= found.names
            if found.names & self.broken:
                return None
            expressions.require(found, dimension, kinds)
            return found
        except QuantityError as error:
            self.quantity_error(error, node, place, text)
            return None

    def magnitude(self, node: Node, place: Place, dimension: str) -> float | Expression | None:
        """A quantity, or an expression of time, input and outputs."""
        outputs = self.output_variables()
        text = node.text if isinstance(node, Scalar) else ""
        words = set(re.findall(r"[^\W\d][\w'-]*(?:\.[^\W\d][\w'-]*)*", text))
        if not words & set(outputs) or expressions.is_literal(units.tidy(text), self.kinds):
            return self.quantity(node, place, dimension)
        return self.formula(node, place, dimension, outputs)

    def output_variables(self) -> dict[str, units.Dimension]:
        """The names that an expression over the cycle may use, with their dimensions."""
        length, angle = units.DIMENSIONS["length"], units.DIMENSIONS["angle"]
        taken = {*self.kinds, *units.UNITS, *expressions.CONSTANTS, *expressions.FUNCTIONS}
        found = {link: angle for link in self.names.links if link != "frame" and link not in taken}
        found |= {name: length for name, kind in self.names.joints.items() if kind == "prismatic" and name not in taken}
        for link, points in self.names.links.items():
            for point in points:
                for axis in ("x", "y"):
                    found[f"{point}.{axis}"] = found[f"{link}.{point}.{axis}"] = length
        return {**found, "t": units.DIMENSIONS["time"], "input": angle if self.input_rotary else length}

    def input_dimension(self) -> str:
        """Name of the dimension of the first driver's coordinate."""
        return "angle" if self.input_rotary else "length"

    def increasing(
        self, node: Node, place: Place, x_name: str, xs: tuple[float, ...], ys: tuple[float, ...], y_name: str
    ) -> bool:
        """Whether a table is one: equal counts, two rows or more, x increasing."""
        if len(xs) != len(ys):
            self.error(node, place, f"{len(xs)} values of {x_name}, but {len(ys)} of {y_name}", "give as many", "table")
        elif len(xs) < 2:
            self.error(node, place, "a table needs two rows or more", "add rows", "table")
        else:
            falling = [index for index in range(1, len(xs)) if xs[index] <= xs[index - 1]]
            if not falling:
                return True
            self.error(node, place.child(x_name), f"value {falling[0] + 1} is not larger than the one before it",
                       f"give {x_name} in increasing order", "table")
        return False

    # references

    def known(self, node: Node, place: Place | str, what: str, name: str, candidates: list[str]) -> bool:
        """Whether a name exists; a finding with the nearest if not."""
        if name in candidates:
            return True
        offer = nearest(name, candidates)
        hint = f'did you mean "{offer}"? ' if offer else ""
        self.error(node, place, f'there is no {what} "{name}"', f"{hint}({what}s: {', '.join(candidates) or 'none'})",
                   "unknown-name")
        return False

    def point_of(self, node: Node, place: Place | str, name: str, link: str) -> bool:
        """Whether the link has the point."""
        points = list(self.names.links.get(link, ()))
        if name in points:
            return True
        others = self.names.owners(name)
        if others:
            self.error(node, place, f'the link "{link}" has no point "{name}"',
                       f"it is on {', '.join(others)}; points of {link}: {', '.join(points) or 'none'}", "unknown-name")
            return False
        return self.known(node, place, f"point on {link}:", name, points)

    def ray(self, node: Node, place: Place, link: str | None) -> tuple[str, str] | None:
        """Two different points [P, Q] of a link."""
        items = self.items(node, place, 2, "[P, Q]")
        if items is None:
            return None
        names = [self.text(item, place) for item in items]
        if link is not None:
            for item, name in zip(items, names, strict=True):
                if name is not None and not self.point_of(item, place, name, link):
                    return None
        first, second = names
        if first is None or second is None:
            return None
        if first == second:
            self.error(node, place, f'both points are "{first}"', "name two different points", "reference")
            return None
        return first, second

    def link_point(self, node: Node, place: Place, text: str) -> LinkPoint | None:
        """A point of the mechanism: ``link.point``, or ``point`` where it is one place."""
        link, dot, point = text.partition(".")
        if dot:
            if not self.known(node, place, "link", link, list(self.names.links)):
                return None
            return LinkPoint(link, point) if self.point_of(node, place, point, link) else None
        owners = self.names.owners(text)
        if not owners:
            everywhere = list(dict.fromkeys(each for points in self.names.links.values() for each in points))
            self.known(node, place, "point", text, everywhere)
            return None
        if len(owners) > 1 and set(owners) - set(self.names.pins.get(text, ())):
            self.error(node, place, f'the point "{text}" is on several links that are not joined there',
                       f"write one of {', '.join(f'{owner}.{text}' for owner in owners)}", "ambiguous")
            return None
        return LinkPoint(owners[0], text)

    def output(self, node: Node, place: Place, text: str) -> Output | None:
        """An output of the mechanism by its text."""
        found = resolve_output(text, self.names.links, self.names.joints)
        if found is not None:
            return found
        names = [*self.names.links, *(name for name, kind in self.names.joints.items() if kind == "prismatic")]
        points = dict.fromkeys(f"{point}.x" for points in self.names.links.values() for point in points)
        offer = nearest(text, [*(name for name in names if name != "frame"), *points])
        self.error(node, place, f'there is no output "{text}"', (f'did you mean "{offer}"? ' if offer else "") +
                   "(a link's name for its angle, POINT.x, POINT.y, or a prismatic joint's name)", "unknown-name")
        return None

    def over(self, node: MappingNode, place: Place) -> tuple[Literal["input", "time"] | Output | None, str]:
        """What a table goes over, and the dimension of that."""
        value = node.get("over")
        text = value.text if isinstance(value, Scalar) else None
        if value is None or text is None or text == "input":
            return ("input" if text else None), self.input_dimension()
        if text == "time":
            return "time", "time"
        found = self.output(value, place.child("over"), text)
        return found, found.dimension if found else self.input_dimension()
