"""What a number must be, as people write it: bounds, ranges and equalities; and their values in SI."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from linkwright import units
from linkwright.core.arrays import Floats
from linkwright.errors import QuantityError
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.tables import Either, Value
from linkwright.files.write import flow
from linkwright.words import _

#: A violation below this share of a demand is none.
MET = 1e-6
#: Keys of a demand that is written as a table, with what they mean.
KEYS: Mapping[str, Value] = {
    "at_least": Value(doc=_("smallest value, such as 40 deg")),
    "at_most": Value(doc=_("largest value, such as 60 kN")),
    "equals": Value(doc=_("the value, such as 120 mm")),
    "within": Value(doc=_("how far the value may be off, such as 0.5 mm or 1 %")),
}
_SPAN = re.compile(r"^(?P<first>.+?)\s*\.\.\s*(?P<last>.+)$")
_EQUAL = re.compile(r"^(?P<first>.+?)\s*(?:±|\+/-|\+-)\s*(?P<last>.+)$")
_NUMBER = re.compile(r"^([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*)$")
_SHARE = re.compile(r"^(\d+\.?\d*(?:[eE][+-]?\d+)?)\s*%$")


@dataclass(frozen=True)
class Demand:
    """A quantity that must stay between two values, or be equal to one; ``same``: within this of the start.

    ``within`` and ``same`` are quantities or shares in per cent. Texts of values have units and are read when the
    quantity's dimension is known.
    """

    text: str
    low: str = ""
    high: str = ""
    same: str | None = None
    equals: str = ""
    within: str = ""

    @property
    def unit(self) -> str:
        """The unit in which it is written."""
        texts = filter(None, (self.equals, self.low, self.high))
        return next((unit for _unused, unit in map(_parts, texts) if unit), "")


@dataclass(frozen=True)
class DemandText(Either):
    """A demand on a number, as a text or a table."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Demand | None:
        value = super().read(reader, node, place, siblings)
        found = None if value is None else demand_of(value)
        if value is not None and found is None:
            reader.error(node, place, invalid_demand(value), "", "demand")
        return found


def invalid_demand(value: Any, *, bare: bool = False) -> str:
    """That a value of a file is none, with what would be."""
    if bare:
        return _(
            'invalid demand "{text}"; write at least 40 deg, at most 60 kN, 1..2 m, or 120 mm ± 0.5 mm',
            text=flow(value),
        )
    return _(
        'invalid demand "{text}"; write at least 40 deg, at most 60 kN, 1..2 m, or same within 1 %', text=flow(value)
    )


def demand_of(value: Any, *, bare: bool = False) -> Demand | None:
    """``at least 40 deg``, ``at most 60 kN``, ``1 m..2 m``, ``120 mm ± 0.5 mm``, ``same within 1 %``, or a mapping of
    these; None for what is no demand."""
    if isinstance(value, Mapping):
        return _of_table({key: str(each).strip() for key, each in value.items()})
    plain = str(value).strip()
    for head in ("at least", "at most", "same within", "same"):
        if plain.startswith(head):
            rest = plain[len(head) :].strip()
            if (head == "same" and rest) or (head != "same" and not rest):
                return None
            if head.startswith("same"):
                return Demand("", same=rest or "1e-6 %")
            return Demand("", low=rest) if head == "at least" else Demand("", high=rest)
    if equal := _EQUAL.match(plain):
        return Demand("", equals=_with_unit_of(equal["last"], equal["first"]), within=equal["last"].strip())
    if span := _SPAN.match(plain):
        return Demand("", _with_unit_of(span["last"], span["first"]), span["last"].strip())
    return Demand("", equals=plain) if bare and plain else None


def _of_table(texts: Mapping[str, str]) -> Demand | None:
    """A demand written as a table; None for keys that do not go together."""
    keys = texts.keys()
    if not keys or not any(keys <= each for each in ({"at_least", "at_most", "same"}, {"equals", "within"})):
        return None
    if "equals" not in keys:
        if "within" in keys:
            return None
        return Demand("", texts.get("at_least", ""), texts.get("at_most", ""), texts.get("same"))
    found = demand_of(texts["equals"], bare=True)
    if found is None or not found.equals or (found.within and "within" in keys):
        return None
    return replace(found, within=texts.get("within", found.within))


def _with_unit_of(last: str, first: str) -> str:
    """The first of two values, with the unit of the last one where it has none."""
    (number, unit), (_unused, of_last) = _parts(first), _parts(last)
    return first.strip() if unit or not number or of_last == "%" else f"{first.strip()} {of_last}".strip()


def _parts(text: str) -> tuple[str, str]:
    """Number and unit of a text; nothing of what is no number."""
    found = _NUMBER.match(text.strip())
    return ("", "") if found is None else (found[1], found[2].strip())


@dataclass(frozen=True)
class Bounds:
    """A demand in SI: the quantity lies between ``low`` and ``high``; ``scale``: what counts as much."""

    text: str
    low: float
    high: float
    scale: float

    def violation(self, value: Floats) -> Floats:
        """By how much a value misses, in scales; 0 where it is met."""
        with np.errstate(invalid="ignore"):
            miss = np.maximum(self.low - value, value - self.high) / self.scale
            return np.where(miss > MET, miss, 0.0)


def bounds_of(demand: Demand, kind: units.Dimension, start: float) -> Bounds:
    """The bounds of a demand on a quantity of a dimension; ``start``: its value where the search begins.

    Raises QuantityError for values of another dimension, without a unit, or in the wrong order.
    """
    text = demand.text
    if demand.same is not None:
        if not np.isfinite(start):
            raise QuantityError(
                _('the start has no value of "{text}", so it cannot stay the same; demand a range', text=text),
                code="no-start",
            )
        within = max(_within(demand.same, start, kind, text), 1e-12 * abs(start))
        return Bounds(text, start - within, start + within, max(within, 1e-3 * abs(start)))
    if demand.equals:
        value = value_of(demand.equals, kind, text)
        within = _within(demand.within, value, kind, text) if demand.within else 0.0
        return Bounds(text, value - within, value + within, _scale([value, within], start))
    low = value_of(demand.low, kind, text) if demand.low else -np.inf
    high = value_of(demand.high, kind, text) if demand.high else np.inf
    if low > high:
        message = _(
            "the range falls from {low} to {high}; write the lower value first", low=demand.low, high=demand.high
        )
        raise QuantityError(message, code="falling-demand")
    return Bounds(text, low, high, _scale([low, high], start))


def _within(text: str, value: float, kind: units.Dimension, name: str) -> float:
    """How far a value may be off: a share of it, or a quantity."""
    share = _SHARE.match(text)
    return float(share[1]) / 100 * abs(value) if share else abs(value_of(text, kind, name))


def _scale(values: list[float], start: float) -> float:
    """What counts as much: the largest of some bounds, else the start."""
    sizes = [abs(each) for each in values if np.isfinite(each) and each] or [abs(start)]
    return max(sizes) if np.isfinite(max(sizes)) and max(sizes) > 0 else 1.0


def value_of(text: str, kind: units.Dimension, name: str) -> float:
    """The value, SI, of a text that is one of the quantity ``name``; raises QuantityError."""
    number, unit = _parts(text)
    if not number:
        raise QuantityError(
            _('invalid value "{text}"; write a number with its unit, such as 40 deg', text=text), code="quantity"
        )
    factor, dimension = units.unit(unit) if unit else (1.0, units.NONE)
    if dimension == kind:
        return float(number) * factor
    symbol = units.usual_symbol(kind)
    values = {"text": name, "need": units.name_of(kind), "given": text, "right": f"{float(number):.12g} {symbol}"}
    if symbol:
        raise QuantityError(
            _(
                '"{text}" is {need}, and "{given}" is not; write its unit, as in {right}',
                code="optimize.unit",
                **values,
            ),
            code="wrong-dimension",
        )
    raise QuantityError(
        _(
            '"{text}" is {need}, and "{given}" is not; write a number without a unit',
            code="optimize.no_unit",
            **values,
        ),
        code="missing-unit",
    )
