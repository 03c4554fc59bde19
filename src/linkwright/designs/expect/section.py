"""Section ``expect`` of a model file: what must hold, by name, and what its entries mean in a machine."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any

from linkwright.analysis.by_name import is_summary, wanted
from linkwright.core.expressions import Expression, amount
from linkwright.core.outputs import Output
from linkwright.designs.demands import KEYS, Demand, bounds_of, demand_of, invalid_demand
from linkwright.designs.expect.facts import FACTS, known_word
from linkwright.designs.named_numbers import NumberNames, expression_of, is_number, is_one_name
from linkwright.errors import LinkwrightError, RequestError
from linkwright.events.position_list import PositionList, known_outputs, of_value
from linkwright.fields.base import Text
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.tables import ByAddress, Either, Table, Value
from linkwright.files.reader import SectionReading
from linkwright.kinematics.names import no_output, output_meant, output_names
from linkwright.kinematics.positions import rotary
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import no_such
from linkwright.units import powers
from linkwright.words import _

_OF = _("what is expected, where the entry has a name of its own: a metric, an output, a summary, an expression")
_AT = _("input at which an output has the value, such as 60 deg or rocker max, a time, or inputs by driver")


@dataclass(frozen=True)
class Entry:
    """One entry as written; ``of``: what the demand is on, by default the entry's own name; ``at``: the input, or
    inputs by driver."""

    demand: Demand
    of: str = ""
    at: str | float | Mapping[str, Any] = ""

    @property
    def place(self) -> str:
        """The input as text."""
        if isinstance(self.at, Mapping):
            return ", ".join(f"{name} {value}" for name, value in self.at.items())
        return str(self.at)


@dataclass(frozen=True)
class EntryField(Either):
    """A demand as a text, or a table with ``of`` and ``at``."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Entry | None:
        value = super().read(reader, node, place, siblings)
        if value is None:
            return None
        own = dict(value) if isinstance(value, Mapping) else {}
        of, at = own.pop("of", ""), own.pop("at", "")
        demand = demand_of(own if isinstance(value, Mapping) else value, bare=True)
        if demand is None or demand.same is not None:
            reader.error(node, place, invalid_demand(value, bare=True), "", "demand")
            return None
        return Entry(demand, of, at)


SECTION = ByAddress(
    EntryField(Value(), Table({"of": Text(doc=_OF), "at": Either(Value(), ByAddress(Value()), doc=_AT), **KEYS})),
    doc=_(
        "what must hold, by metric, output, summary or fact: at least 40 deg, at most 60 kN, 1..2 m, "
        "120 mm ± 0.5 mm; for the command check --expect"
    ),
)


@dataclass(frozen=True)
class Subject:
    """What an entry is about: a ``fact`` of the structure, an ``output`` over the cycle or ``at`` a position, or else
    ``numbers``, in an ``expression`` where they are more than one name."""

    fact: str = ""
    output: Output | None = None
    at: PositionList | Mapping[str, float] | None = None
    expression: Expression | None = None
    numbers: Mapping[str, str] | None = None


@dataclass(frozen=True)
class Asked:
    """An entry with its ``name`` and what it is about."""

    name: str
    entry: Entry
    subject: Subject

    @property
    def of(self) -> str:
        """What the demand is on."""
        return self.entry.of or self.name


def expected(mechanism: Mechanism, source: str = "") -> tuple[Asked, ...]:
    """The entries of a machine's section; raises ModelError with all findings about what they name."""
    reading = SectionReading(SECTION, "expect", mechanism.expect, source)
    found = []
    for name, entry in (reading.values or {}).items():
        if entry is None:
            continue
        key, text = f"{name}.of" if entry.of else name, entry.of or name
        try:
            if entry.at == "":
                subject = _subject(mechanism, text, entry.demand)
            else:
                subject, key = _at(mechanism, text, entry.demand), f"{name}.at"
                subject = replace(subject, at=_place(mechanism, entry.at))
            found.append(Asked(name, entry, subject))
        except LinkwrightError as error:
            reading.note(key, error)
    reading.settle()
    return tuple(found)


def _subject(mechanism: Mechanism, text: str, demand: Demand) -> Subject:
    """What an entry is about; raises LinkwrightError for what there is not, and for values of another dimension."""
    dimensions = mechanism.dimensions()
    if text in FACTS:
        return _fact(text, demand)
    if is_number(text, dimensions):
        return _number(mechanism, text, demand)
    with suppress(RequestError):
        output = output_meant(mechanism, text)
        _fits(demand, text, output.dimension)
        return Subject(output=output)
    if is_one_name(text):
        no_output(mechanism, text, [*FACTS, *NumberNames(()), *output_names(mechanism)])
    expression, numbers = expression_of(text, mechanism, dimensions, names=NumberNames(dimensions))
    for name in numbers.values():
        _number(mechanism, name)
    return Subject(expression=expression, numbers=numbers)


def _fact(name: str, demand: Demand) -> Subject:
    """A fact, with one of its words, or with a count."""
    if FACTS[name].words:
        known_word(name, demand.equals)
    else:
        _fits(demand, name, "dimensionless")
    return Subject(name)


def _number(mechanism: Mechanism, text: str, demand: Demand | None = None) -> Subject:
    """A metric, a summary or a dimension; raises RequestError for the summary of no output."""
    if is_summary(text) and text not in mechanism.dimensions():
        (summary,) = wanted([text])
        output = output_meant(mechanism, summary.output)
        if demand is not None:
            _fits(demand, text, mechanism.across if summary.kind in ("argmin", "argmax") else output.dimension)
    return Subject(numbers={"": text})


def _fits(demand: Demand, text: str, dimension: str) -> None:
    """Raises QuantityError for a demand on what has another dimension."""
    if dimension:
        bounds_of(replace(demand, text=text), powers(dimension), 0.0)


def _at(mechanism: Mechanism, text: str, demand: Demand) -> Subject:
    """An output that is expected at one position; raises RequestError for a number of the full cycle."""
    try:
        output = output_meant(mechanism, text)
    except RequestError:
        if text in FACTS or is_number(text, mechanism.dimensions()):
            raise RequestError(
                _(
                    '"{text}" is a number of the full cycle, which has no value at one input; leave at out, or name '
                    "an output such as rocker.angle",
                    code="expect.number_at",
                    text=text,
                )
            ) from None
        raise
    _fits(demand, text, output.dimension)
    return Subject(output=output)


def _place(mechanism: Mechanism, at: str | float | Mapping[str, Any]) -> PositionList | Mapping[str, float]:
    """One position, or inputs by driver; raises LinkwrightError for what is none."""
    if not mechanism.drivers:
        raise RequestError(_("the model has no driver, so there is no input to set", code="solve.no_input"))
    if isinstance(at, Mapping):
        return _inputs(mechanism, at)
    places = of_value(at, (mechanism.across, "time"))
    known_outputs(mechanism, places)
    if len(places.entries) != 1:
        raise RequestError(
            _('"{text}" is more than one position; give one entry for each', code="expect.one_place", text=str(at))
        )
    return places


def _inputs(mechanism: Mechanism, values: Mapping[str, Any]) -> dict[str, float]:
    """Coordinates of drivers, rad or m; raises LinkwrightError for an unknown driver and other dimensions."""
    drivers = rotary(mechanism)
    for name in values:
        if name not in drivers:
            raise RequestError(no_such(_("driver"), name, drivers))
    return {name: amount(str(value), "angle" if drivers[name] else "length") for name, value in values.items()}
