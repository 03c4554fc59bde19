"""What must hold for a machine, with what it comes to: section ``expect`` of its model file, evaluated."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from linkwright import units
from linkwright.core.arguments import require
from linkwright.core.quantity import number, shown, written
from linkwright.core.table import Table, Tabular
from linkwright.designs.demands import Bounds, Demand, bounds_of
from linkwright.designs.expect.facts import FACTS, INCOMPLETE
from linkwright.designs.expect.section import Asked, expected
from linkwright.designs.expect.values import Value, Values
from linkwright.errors import Finding, LinkwrightError, QuantityError
from linkwright.files.model_file import load
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _, pgettext
from linkwright.words.message import in_language

_TURN = 2.0 * math.pi
HEAD = (
    pgettext("expect", "expectation"),
    pgettext("expect", "found"),
    pgettext("expect", "expected"),
    pgettext("expect", "verdict"),
)
#: What a file without expectations is answered.
NONE = _("{name!r} has no expectations")
HOW = _(
    "write what must hold in a section expect, such as expect: {{mobility: 1, {example}}}; "
    "names are those of linkwright metrics and of outputs"
)


@dataclass(frozen=True)
class Expectation:
    """One entry of the section: what was found, and whether that is as expected.

    ``value``: a number, SI, or a word; None where there is none, for the ``reason``. Of an output over the cycle it
    is the smallest, and ``last`` the largest. ``low`` and ``high``: the bounds, SI, infinite where there is none.
    ``rests``: it is bounded on one side, and is of a place that is the same over the cycle.
    """

    name: str
    of: str
    at: str
    demand: Demand
    holds: bool
    value: float | str | None
    last: float | None = None
    low: float = -math.inf
    high: float = math.inf
    dimension: str = ""
    unit: str = ""
    si: str = ""
    reason: str = ""
    rests: bool = False

    @property
    def off(self) -> float:
        """By how much a number is above (positive) or below its bounds, SI; 0 where it holds or is none."""
        if self.holds or self.value is None or isinstance(self.value, str):
            return 0.0
        under, over = self.value - self.low, (self.value if self.last is None else self.last) - self.high
        return over if over >= -under else under

    @property
    def subject(self) -> str:
        """What the demand is on, as tables write it."""
        return _("{of} at {at}", of=self.of, at=self.at) if self.at else self.of

    @property
    def label(self) -> str:
        """Its name, with what it is on where that is another."""
        return self.subject if self.of == self.name else _("{name} ({of})", name=self.name, of=self.subject)

    @property
    def found(self) -> str:
        """The value as text, in the unit of the demand; a dash for none."""
        if self.value is None:
            return "–"
        if isinstance(self.value, str):
            return self.value
        first = self._shown(self.value)
        if self.last is None:
            return first
        return _("{low} to {high}", low=self._shown(self.value), high=self._shown(self.last))

    @property
    def expected(self) -> str:
        """The demand as text."""
        demand = self.demand
        if demand.equals:
            return f"{demand.equals} ± {demand.within}" if demand.within else demand.equals
        if demand.low and demand.high:
            return _("{low} to {high}", low=demand.low, high=demand.high)
        return _("at least {low}", low=demand.low) if demand.low else _("at most {high}", high=demand.high)

    @property
    def verdict(self) -> str:
        """Whether it holds, else by how much it does not, or why there is no value."""
        if self.holds:
            return pgettext("expect", "holds")
        if self.value is None:
            return _("no value: {cause}", cause=self.reason)
        if isinstance(self.value, str) or not self.off:
            return pgettext("expect", "fails")
        size = self._shown(abs(self.off))
        return _("fails: {off} too large", off=size) if self.off > 0 else _("fails: {off} too small", off=size)

    def _shown(self, value: float) -> str:
        if self.unit:
            return written(value, self.unit)
        return shown(value, self.dimension) if self.dimension else f"{number(value)} {self.si}".strip()

    @property
    def _one(self) -> str:
        return self._shown(self.value) if isinstance(self.value, float) else self.found

    def finding(self) -> Finding:
        """The error that it does not hold, or the note that it is of what rests, at its key."""
        about, key = self.label, f"expect.{self.name}"
        if self.holds:
            message = _(
                "{name} holds, but says little: it is {found} over the full cycle", name=about, found=self._one
            )
            return Finding("note", "", key, message, _("name what moves, or expect the value itself"), "constant")
        if self.value is None:
            message = _("{name} has no value here: {cause}", name=about, cause=self.reason)
            return Finding("error", "", key, message, "", "no-value")
        texts = {"name": about, "found": self.found, "expected": self.expected, "off": self._shown(abs(self.off))}
        template = _("{name} is {found}, expected: {expected}")
        if self.off > 0:
            template = _("{name} is {found}, expected: {expected} ({off} too large)")
        elif self.off < 0:
            template = _("{name} is {found}, expected: {expected} ({off} too small)")
        return Finding("error", "", key, template.format(**texts), self._remedy(), "not-met")

    def _remedy(self) -> Message:
        if self.demand.equals and not self.demand.within and self.of not in FACTS:
            example = f"{self.demand.equals} ± {'1 %' if self.low else f'0.01 {self.unit}'.strip()}"
            return _("change the machine, or write how near is enough: {example}", example=example)
        return _("change the machine, or what is expected of it")

    def data(self, language: str = "en") -> dict[str, Any]:
        """Plain data, SI."""
        return {
            "name": self.name,
            "of": self.of,
            "at": self.at,
            "expected": in_language(self.expected, language),
            "holds": self.holds,
            "value": self.value if self.last is None else [self.value, self.last],
            "unit": self.si,
            "low": None if math.isinf(self.low) else self.low,
            "high": None if math.isinf(self.high) else self.high,
            "off": self.off,
            "reason": in_language(self.reason, language),
        }


@dataclass(frozen=True)
class Expectations(Tabular):
    """The expectations of a machine, in the order of its file.

    ``ok``: whether all hold; ``findings()``: an error for each that does not; ``text()``, ``data()``,
    ``to_dataframe()``: the table.
    """

    name: str
    rows: tuple[Expectation, ...]
    how: str = ""

    @property
    def ok(self) -> bool:
        """Whether all of them hold."""
        return all(each.holds for each in self.rows)

    def __iter__(self) -> Iterator[Expectation]:
        return iter(self.rows)

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, name: str) -> Expectation:
        return next(each for each in self.rows if each.name == name)

    def findings(self) -> list[Finding]:
        """An error for every expectation that does not hold, a note for one of a place that rests; a note where there
        is none."""
        if not self.rows:
            return [Finding("note", "", "", NONE.format(name=self.name), self.how, "no-expectations")]
        found, causes = [], set[str]()
        for each in self.rows:
            if not each.holds or each.rests:
                finding = each.finding()
                if each.reason and str(each.reason) in causes:
                    message = _("{name} has no value here for the same reason", name=each.name)
                    finding = replace(finding, message=message)
                causes.add(str(each.reason))
                found.append(finding)
        return found

    def tables(self, language: str = "en") -> tuple[Table, ...]:
        """Name, what was found, what is expected, and the verdict."""
        if not self.rows:
            return (Table(title=self.title, notes=[NONE.format(name=self.name), self.how]),)
        rows = [[each.label, each.found, each.expected, each.verdict] for each in self.rows]
        return (Table(HEAD, rows, "<>><", self.title),)

    @property
    def title(self) -> str:
        """The machine with how many hold."""
        if not self.rows:
            return self.name
        met = sum(each.holds for each in self.rows)
        return _("{name}: {met} of {count} expectations hold", name=self.name, met=met, count=len(self.rows))

    def data(self, language: str = "en") -> dict[str, Any]:
        """Plain data, SI."""
        return {"name": self.name, "ok": self.ok, "expectations": [each.data(language) for each in self.rows]}

    def columns(self) -> dict[str, list[Any]]:
        """The same by column."""
        rows = [each.data() for each in self.rows]
        return {key: [row[key] for row in rows] for key in (rows[0] if rows else ())}

    def __repr__(self) -> str:
        return f"Expectations({self.title!s})"


def expectations(source: Mechanism | str | Path) -> Expectations:
    """What a machine's section ``expect`` demands, with what is found: one row for each entry.

    Args:
        source: a mechanism, a model file, or ``gallery:NAME``.

    Returns:
        The table; numbers SI. Those of the cycle are exact between its positions, as metrics are; an output without
        a summary is expected over the full cycle. Where ``cycle: incomplete`` is expected, they are those of the
        positions that are reached.

    Raises:
        ModelError: the file or its section cannot be read, or an entry names what there is not; with all findings.

    Example:
        >>> import linkwright as lw
        >>> found = lw.expectations(lw.loads('''
        ... format: 1
        ... name: Crank-rocker
        ... frame: {points: {O1: [0 mm, 0 mm], O2: [250 mm, 0 mm]}}
        ... links:
        ...   crank: {points: [O1, A], length: 100 mm}
        ...   coupler: {points: [A, B], length: 400 mm}
        ...   rocker: {points: [O2, B], length: 350 mm}
        ... assembly: {B: left}
        ... driver: {turn: crank, about: O1, speed: 60 rpm}
        ... expect: {transmission_angle: at least 20 deg, rocker.angle range: 54.7 deg ± 0.1 deg}
        ... '''))
        >>> found.ok
        True
    """
    require(source, Mechanism, str, PathLike)
    mechanism = source if isinstance(source, Mechanism) else load(source)
    asked = expected(mechanism)
    values = Values(mechanism, in_part=any(each.entry.demand.equals == INCOMPLETE for each in asked))
    return Expectations(mechanism.name, tuple(_judged(each, values) for each in asked), how_to(mechanism))


def how_to(mechanism: Mechanism) -> Message:
    """How to write expectations of a machine."""
    from linkwright.analysis.outputs import mechanism_outputs

    output = next(iter(mechanism_outputs(mechanism)[-1:]), None)
    size = "40 mm ± 1 mm" if output is not None and output.dimension == "length" else "40 deg ± 1 deg"
    example = "cycle: complete" if output is None else f"{output.name} range: {size}"
    return HOW.format(example=example)


def _judged(asked: Asked, values: Values) -> Expectation:
    """An entry with its value, or with the reason why there is none."""
    entry = asked.entry
    plain = Expectation(asked.name, asked.of, entry.place, entry.demand, False, None, unit=entry.demand.unit)
    try:
        found = values.of(asked)
    except LinkwrightError as error:
        return replace(plain, reason=error.sentence)
    if asked.subject.fact and FACTS[asked.subject.fact].words:
        return replace(plain, value=found.number, holds=entry.demand.equals == found.number)
    try:
        compared = _compared(plain, found)
        one_sided = math.isinf(compared.low) != math.isinf(compared.high)
        return replace(compared, rests=compared.holds and one_sided and values.rests(asked))
    except QuantityError as error:
        return replace(plain, reason=error.sentence)


def _compared(plain: Expectation, found: Value) -> Expectation:
    """A number with its bounds."""
    value = float(found.number)
    bounds = bounds_of(replace(plain.demand, text=plain.of), found.kind, 1.0)
    if found.turns:
        value += _TURN * round((_middle(bounds) - value) / _TURN)
    ends = np.array([value, value if found.last is None else found.last])
    holds = bool(np.isfinite(ends).all() and not bounds.violation(ends).any())
    return replace(
        plain,
        holds=holds,
        value=value,
        last=found.last,
        low=bounds.low,
        high=bounds.high,
        dimension=found.name,
        si=units.si_symbol(found.kind),
    )


def _middle(bounds: Bounds) -> float:
    ends = [each for each in (bounds.low, bounds.high) if math.isfinite(each)]
    return sum(ends) / len(ends)
