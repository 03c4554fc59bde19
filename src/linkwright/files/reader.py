"""The reader of one model: walks the nodes, turns them into values, and gathers every finding on the way."""

from __future__ import annotations

import re
from collections import ChainMap
from collections.abc import Iterator, MutableMapping
from contextlib import contextmanager
from dataclasses import replace
from typing import Any, Literal

from linkwright import units
from linkwright.core import expressions
from linkwright.core.expressions import Expression
from linkwright.core.outputs import Output
from linkwright.errors import Finding, LinkwrightError, ModelError, QuantityError
from linkwright.fields.base import Field
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, Section, Sequence, node_of, noun, towards
from linkwright.fields.reading import Names, Place
from linkwright.fields.references import LinkPoint, resolve_output
from linkwright.files.node_reader import NUMBER, PlainReader
from linkwright.registry import listed, nearest
from linkwright.words import Message, _

#: A name with dots in a text; superscripts belong to units.
_WORD = re.compile(r"(?![⁰¹²³⁴⁵⁶⁷⁸⁹])[^\W\d](?:(?![⁰¹²³⁴⁵⁶⁷⁸⁹])[\w'-])*(?:\.[^\W\d][\w'-]*)*")


class Reader(PlainReader):
    """Values from nodes: quantities, expressions of parameters, references to what the model names."""

    def __init__(self, source: str, *, si: bool = False) -> None:
        super().__init__(source, si=si)
        self.names = Names()
        self.kinds: dict[str, units.Dimension] = {}
        self.values: dict[str, float] = {}
        self.broken: set[str] = set()
        self.used: set[str] = set()
        self.expressions: dict[str, Expression] = {}
        self.input_rotary = True
        self.cylinders: tuple[str, ...] = ()
        self.has_path = False
        self._plain: str = ""
        self._variables: dict[str, units.Dimension] = {}

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
        if self.si and NUMBER.fullmatch(text):
            text = f"{text} {units.SI_UNITS[dimension]}".strip()
        try:
            parsed = expressions.parse_quantity(text, dimension, self.kinds)
            value = parsed if isinstance(parsed, float) else self._evaluated(parsed, node, place)
            if value is None:
                return None
            return self.within(value, node, place, units.LARGEST[dimension], units.SI_UNITS[dimension])
        except QuantityError as error:
            self.used |= {each for each in _WORD.findall(text) if each in self.kinds}
            self.quantity_error(error, node, place, text)
            return None

    def within(self, value: float, node: Node, place: Place, largest: float, unit: str) -> float | None:
        """The value, or None after a finding where it is above ``largest``, which no machine reaches."""
        if abs(value) <= largest:
            return value
        limit = f"{units.number(largest)} {unit}".rstrip()
        shown = node.text if isinstance(node, Scalar) else f"{value:g}"
        self.finding(
            node,
            place,
            _("{shown} is more than any machine has"),
            "range",
            _("check the number and its unit; at most {limit}"),
            shown=shown,
            limit=limit,
        )
        return None

    def _evaluated(self, value: Expression, node: Node, place: Place) -> float | None:
        self.used |= value.names
        if value.names & self.broken:
            self.unread += 1
            return None
        if isinstance(node, Scalar) and value.text != units.tidy(node.text):
            self.finding(
                node,
                place,
                _('"{text}" is read as {read}'),
                "read-as",
                _("write it this way if it may be misread"),
                severity="note",
                text=node.text,
                read=value.text,
            )
        if not value.names:
            return value.evaluate({})
        if self._plain:
            self.finding(
                node,
                place,
                _('"{text}" uses a parameter, which {what} cannot follow'),
                "expression",
                _("write the number with its unit"),
                text=value.text,
                what=self._plain,
            )
            return None
        result = value.evaluate(self.values)
        self.expressions[place.address] = value
        return float(result)

    def quantity_text(self, node: Node, place: Place, example: str) -> str | None:
        """The text of a quantity or expression."""
        text = node.text.strip() if isinstance(node, Scalar) and not node.empty else ""
        if text and len(text) <= expressions.MAX_LENGTH:
            return text
        problem = (
            _('"{text}…" has {count} characters', text=text[:40], count=len(text))
            if text
            else _("expected a quantity, not {node}", node=noun(node))
        )
        self.error(node, place, problem, _('write it as in "{example}"', example=example), "type")
        return None

    def quantity_error(self, error: QuantityError, node: Node, place: Place, text: str) -> None:
        """Note the finding for a QuantityError, unless it only follows from a parameter that is wrong
        itself."""
        if self.follows(text):
            return
        offset = 0
        if isinstance(node, Scalar) and "\n" not in node.text:
            offset = error.column + (0 if node.plain else 1)
        bare = error.code == "wrong-dimension" and self.kinds.get(text) == units.NONE
        remedy = (
            _('give the parameter "{name}" its unit under parameters', code="model.give_unit_there", name=text)
            if bare
            else error.remedy
        )
        self.error(node, place, error.message, remedy, error.code, column=offset)

    def follows(self, text: str) -> bool:
        """Whether a text has a name that is wrong itself, so that what is wrong with the text may only follow."""
        found = not self.broken.isdisjoint(re.findall(r"\w+", text))
        self.unread += found
        return found

    def formula(
        self, node: Node, place: Place, dimension: str, variables: MutableMapping[str, units.Dimension]
    ) -> Expression | None:
        """An expression of variables and parameters."""
        text = self.quantity_text(node, place, "30 deg*sin(2*pi*t/(2 s))")
        if text is None:
            return None
        kinds = ChainMap(variables, self.kinds)
        try:
            found = expressions.parse_as(text, dimension, kinds)
            self.used |= found.names
            if found.names & self.broken:
                self.unread += 1
                return None
            return found
        except QuantityError as error:
            self.quantity_error(error, node, place, text)
            return None

    def magnitude(self, node: Node, place: Place, dimension: str) -> float | Expression | None:
        """A quantity, or an expression of time, input and outputs."""
        text = units.tidy(node.text) if isinstance(node, Scalar) else ""
        variables = self.output_variables()
        if self._follows(text, dimension, variables):
            return self.formula(node, place, dimension, variables)
        words = set(re.findall(_WORD, text))
        own = {*self.kinds, *units.UNITS, *expressions.OWN_NAMES}
        if words <= own or expressions.is_literal(text, self.kinds):
            return self.quantity(node, place, dimension)
        return self.formula(node, place, dimension, variables)

    def _follows(self, text: str, dimension: str, variables: MutableMapping[str, units.Dimension]) -> bool:
        """Whether a text is an expression of variables; ``t`` behind a number is the unit of mass."""
        try:
            if expressions.is_literal(text, self.kinds) and units.unit_fits(text, dimension):
                return False
            return not variables.keys().isdisjoint(expressions.parse(text, ChainMap(variables, self.kinds)).names)
        except QuantityError:
            return False

    def output_variables(self) -> dict[str, units.Dimension]:
        """The names that an expression over the cycle may use, with their dimensions."""
        length, angle = units.DIMENSIONS["length"], units.DIMENSIONS["angle"]
        if self._variables:
            return self._variables
        taken = {*self.kinds, *units.UNITS, *expressions.OWN_NAMES}
        found = {link: angle for link in self.names.links if link != "frame" and link not in taken}
        found |= {name: length for name in self.names.sliding if name not in taken}
        found |= {f"{link}.angle": angle for link in self.names.links if link != "frame"}
        found |= {f"{name}.displacement": length for name in self.names.sliding.values()}
        owned = {(link, point) for link, points in self.names.links.items() for point in points}
        places = {*(point for _unused, point in owned), *(f"{link}.{point}" for link, point in owned)}
        found |= {f"{each}{way}.{axis}": length for each in places for way in ("", ".position") for axis in "xy"}
        found |= {"t": units.DIMENSIONS["time"], "input": angle if self.input_rotary else length}
        self._variables = found
        return found

    def input_dimension(self) -> str:
        """Name of the dimension of the first driver's coordinate."""
        return "angle" if self.input_rotary else "length"

    def increasing(
        self, node: Node, place: Place, x_name: str, xs: tuple[float, ...], ys: tuple[float, ...], y_name: str
    ) -> bool:
        """Whether a table is one: equal counts, two rows or more, x increasing."""
        if len(xs) != len(ys):
            self.finding(
                node,
                place,
                _("{xs} values of {x_name}, but {ys} of {y_name}"),
                "table",
                _("give as many"),
                xs=len(xs),
                x_name=x_name,
                ys=len(ys),
                y_name=y_name,
            )
        elif len(xs) < 2:
            self.finding(node, place, _("a table needs two rows or more"), "table", _("add rows"))
        else:
            falling = [index for index in range(1, len(xs)) if xs[index] <= xs[index - 1]]
            if not falling:
                return True
            self.finding(
                node,
                place.child(x_name),
                _("value {place} is not larger than the one before it"),
                "table",
                _("give {x_name} in increasing order"),
                place=falling[0] + 1,
                x_name=x_name,
            )
        return False

    def known(self, node: Node, place: Place | str, what: Message, name: str, candidates: list[str]) -> bool:
        """Whether a name exists; a finding with the nearest if not."""
        if name in candidates:
            return True
        if what in ("link", "joint", "pin", "point") and not self.names.listed:
            self.unread += 1
            return False
        owners = self.names.owners(name) if what in ("joint", "pin") else []
        if owners:
            if not self.names.incomplete:
                self.finding(
                    node,
                    place,
                    _('there is no pin "{name}": only {owner} has a point of this name'),
                    "unknown-name",
                    _("give the point the same name on a second link"),
                    name=name,
                    owner=owners[0],
                )
            return False
        self.finding(
            node,
            place,
            _('there is no {what} "{name}"'),
            "unknown-name",
            listed(name, candidates),
            what=what,
            name=name,
        )
        return False

    def point_of(self, node: Node, place: Place | str, name: str, link: str) -> bool:
        """Whether the link has the point."""
        points = list(self.names.links.get(link, ()))
        if name in points:
            return True
        if link in self.names.illegible:
            self.unread += 1
            return False
        others = self.names.owners(name)
        if others:
            self.finding(
                node,
                place,
                _('the link "{link}" has no point "{name}"'),
                "unknown-name",
                _("it is on {others}; points of {link}: {points}"),
                link=link,
                name=name,
                others=tuple(others),
                points=tuple(points),
            )
            return False
        return self.known(node, place, _("point on {link}:", link=link), name, points)

    def link_point(self, node: Node, place: Place, text: str) -> LinkPoint | None:
        """A point of the mechanism: ``link.point``, or ``point`` where it is one place."""
        link, dot, point = text.partition(".")
        if dot:
            if not self.known(node, place, _("link"), link, list(self.names.links)):
                return None
            return LinkPoint(link, point) if self.point_of(node, place, point, link) else None
        owners = self.names.owners(text)
        if not owners:
            everywhere = list(dict.fromkeys(each for points in self.names.links.values() for each in points))
            self.known(node, place, _("point"), text, everywhere)
            return None
        if len(owners) > 1 and set(owners) - set(self.names.pins.get(text, ())):
            self.finding(
                node,
                place,
                _('the point "{text}" is on several links that are not joined there'),
                "ambiguous",
                _("write one of {names}"),
                text=text,
                names=tuple(f"{owner}.{text}" for owner in owners),
            )
            return None
        return LinkPoint(owners[0], text)

    def output(self, node: Node, place: Place, text: str) -> Output | None:
        """An output of the mechanism by its text."""
        found = resolve_output(text, self.names.links, self.names.sliding)
        if found is not None:
            return found
        if not self.names.listed or (self.names.illegible and text.endswith((".x", ".y"))):
            self.unread += 1
            return None
        names = [*self.names.links, *self.names.sliding]
        points = dict.fromkeys(f"{point}.x" for points in self.names.links.values() for point in points)
        offer = nearest(text, [*(name for name in names if name != "frame"), *points])
        remedy = _("(a link's name for its angle, POINT.x, POINT.y, or a prismatic joint's name)")
        if offer:
            remedy = _(
                "{hint} (a link's name for its angle, POINT.x, POINT.y, or a prismatic joint's name)",
                hint=_('did you mean "{offer}"?', offer=offer),
            )
        self.finding(node, place, _('there is no output "{text}"'), "unknown-name", remedy, text=text)
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
        x = node.get("x")
        first = x.items[0] if isinstance(x, Sequence) and x.items else None
        if found and found.kind == "angle" and isinstance(first, Scalar) and units.unit_fits(first.text, "length"):
            guide = self.names.blocks.get(found.owner)
            remedy = (
                _("for the way of the link write the name of its guide: over: {guide}", guide=guide)
                if guide
                else _("name a guide or a point's coordinate, such as C.x", code="model.over_point")
            )
            message = _(
                '"{link}" is the angle of that link, and x are lengths', code="model.over_angle", link=found.owner
            )
            self.error(value, place.child("over"), message, remedy, "unit")
            return None, "length"
        return found, found.dimension if found else self.input_dimension()


class SectionReading:
    """A section stored as plain data, read by its field; each mistake is noted once.

    ``values``: what the field gives; ``where``: named as the file where the section is from none.
    """

    def __init__(self, field: Field, key: str, section: Any, where: str = "") -> None:
        self.key, own = key, section if isinstance(section, Section) else None
        self.node, self.reader = (own.node, Reader(own.source)) if own else (node_of(section), Reader(""))
        self.where = "" if own else where
        self.values = field.read(self.reader, self.node, Place(key, key), {})
        self.findings = dict.fromkeys(replace(each, where=each.where or self.where) for each in self.reader.findings)

    def note(self, key: str, problem: str | LinkwrightError, code: str = "") -> None:
        """Notes what is wrong at a key of the section: a sentence, or an error that it makes."""
        remedy = problem.remedy if isinstance(problem, QuantityError) else ""
        if isinstance(problem, LinkwrightError):
            code = code or problem.code
            problem = problem.message if isinstance(problem, QuantityError) else problem.sentence
        where = self.where or self.reader.where(towards(self.node, key))
        self.findings[Finding("error", where, f"{self.key}.{key}", problem, remedy, code)] = None

    def settle(self) -> None:
        """Raises ModelError with all findings, where there are any."""
        if self.findings:
            raise ModelError([*self.findings])
