"""What is optimised: variables within bounds, objectives, and what must be kept."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import field
from typing import Any, Literal

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.given import STEPS
from linkwright.core.quantity import si_of, written
from linkwright.designs.objective_terms import PathError
from linkwright.designs.optimise.paths import path_error
from linkwright.designs.ranges import Range, parse_range
from linkwright.designs.varied_dimensions import between, checked_addresses, gives_part_of_tooth
from linkwright.errors import LinkwrightError, RequestError
from linkwright.fields.base import Field, Schema, Word, given, given_by_file
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.tables import AsWritten, ByAddress, Keys
from linkwright.files.reader import SectionReading
from linkwright.files.write import flow
from linkwright.machine.flywheel import FLUCTUATION
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

Robust = Literal["", "worst", "yield"]
_SPAN = re.compile(r"^(?P<low>.+?)\s*\.\.\s*(?P<high>.+)$")
_NUMBER = re.compile(r"^([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*)$")


@dataclass(frozen=True, eq=False)
class Variable:
    """A dimension between ``low`` and ``high``, SI; ``choices``: the values that it may have, None for all."""

    address: str
    low: float
    high: float
    choices: Floats | None = None
    unit: str = ""

    @property
    def si(self) -> str:
        """The SI unit of its values."""
        return si_of(self.unit)

    def shown(self, value: float) -> str:
        """A value in the unit of the bounds."""
        return written(value, self.unit)

    def allowed(self, values: Floats) -> Floats:
        """The nearest allowed values."""
        if self.choices is None:
            return np.clip(values, self.low, self.high)
        middles = (self.choices[1:] + self.choices[:-1]) / 2
        return np.asarray(self.choices[np.searchsorted(middles, values)])


@dataclass(frozen=True)
class Goal:
    """A quantity to be made small (``sign`` 1) or large (-1)."""

    text: str
    sign: float


@dataclass(frozen=True)
class Demand:
    """A quantity that must stay between two values; ``same``: within this of the start (``share``: of its value).

    Texts of values have units and are read when the quantity's dimension is known.
    """

    text: str
    low: str = ""
    high: str = ""
    same: str | None = None


@dataclass(frozen=True)
class Number(Field):
    """A number from ``low`` to ``high``."""

    low: float
    high: float
    make: Callable[[float], float] = float

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> float | None:
        value = reader.free(node)
        try:
            found = float(value)
        except (TypeError, ValueError, OverflowError):
            found = math.nan
        if self.low <= found <= self.high:
            return self.make(found)
        told = _(
            "{key_}: {given} is no number between {low} and {high}; give one",
            key_=place.key.rpartition(".")[2],
            given=flow(value),
            low=self.low,
            high=self.high,
        )
        reader.error(node, place, told, "", "range")
        return None

    def shape(self) -> Schema:
        return {"type": "number", "minimum": self.low, "maximum": self.high}


@dataclass(frozen=True, eq=False)
class Problem:
    """All of it; ``paths``: path errors by name; ``tolerances``: ± of dimensions, SI."""

    mechanism: Mechanism
    variables: tuple[Variable, ...]
    goals: tuple[Goal, ...]
    demands: tuple[Demand, ...] = ()
    define: Mapping[str, str] = field(default_factory=dict)
    paths: Mapping[str, PathError] = field(default_factory=dict)
    tolerances: Mapping[str, float] = field(default_factory=dict)
    robust: Robust = given(Word(("worst", "yield"), doc="how the tolerances count"), "")
    least_yield: float = given(
        Number(
            1e-12, 1.0, key="yield", doc="share of the machines made that meets the demands; default 0.99"
        ),
        0.99,
    )
    fluctuation: float = given(Number(1e-12, 1.0, doc="coefficient of speed fluctuation"), FLUCTUATION)
    steps: int = given(Number(1.0, 1e6, int, doc="positions of the cycle; default 360"), STEPS)
    evaluations: int = given(Number(1.0, 1e9, int, doc="designs that are judged at most; default 4000"), 4000)
    population: int = given(Number(0.0, 1e6, int, doc="designs of a generation; chosen unless given"), 0)
    seed: int = given(Number(0.0, 1e9, int, doc="of the random numbers; default 0"), 0)

    @property
    def addresses(self) -> tuple[str, ...]:
        """Dimensions that vary, with those that have tolerances."""
        return tuple(dict.fromkeys([*(each.address for each in self.variables), *self.tolerances]))

    @property
    def start(self) -> Floats:
        """The variables of the mechanism as it is."""
        return np.array([self.mechanism.dimension(each.address) for each in self.variables])


_TEXTS: Schema = {"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}]}
SECTION = Keys({
    "vary": ByAddress(AsWritten(), doc="bounds of dimensions and parameters, such as 80..120 mm"),
    "minimize": AsWritten(_TEXTS, doc="numbers that are made least"),
    "maximize": AsWritten(_TEXTS, doc="numbers that are made greatest"),
    "keep": ByAddress(AsWritten(), doc="demands on numbers, such as at least 40 deg"),
    "define": ByAddress(AsWritten(), doc="names for numbers, and errors of paths"),
    "tolerance": ByAddress(AsWritten(), doc="± of dimensions, such as 0.1 mm"),
    **given_by_file(Problem),
})  # fmt: skip


def problem(mechanism: Mechanism, given: Mapping[str, Any] | None = None, source: str = "") -> Problem:
    """A problem from the section ``optimize``, or from what is ``given`` in its place.

    Raises ModelError with all findings.
    """
    return _Reading(
        mechanism, mechanism.optimize if given is None else given, source or mechanism.name
    ).problem()


class _Reading(SectionReading):
    """The settings for a mechanism; those that may be objects in programs are taken as they are given."""

    def __init__(self, mechanism: Mechanism, given: Mapping[str, Any], source: str) -> None:
        self.mechanism = mechanism
        known = SECTION.fields.keys() | {"yield"}
        self.given = {key: each for key, each in given.items() if key not in known or not _empty(each)}
        plain = {key: "" if key in ("minimize", "maximize") else each for key, each in self.given.items()}
        super().__init__(SECTION, "optimize", plain, source)

    def problem(self) -> Problem:
        variables = self._variables()
        define, paths = self._defined()
        goals = tuple(
            Goal(text, sign)
            for key, sign in (("minimize", 1.0), ("maximize", -1.0))
            for text in self._texts(key, paths)
        )
        if not goals:
            self.note(
                "minimize",
                _(
                    "nothing is made least or greatest; give minimize: or maximize: with a number such "
                    "as peak_input_torque",
                ),
                "no-goal",
            )
        sought = [goal.text.strip() for goal in goals]
        for text in sorted({each for each in sought if sought.count(each) > 1}):
            self.note(
                "maximize",
                _("{text} is sought twice; give it once, under minimize: or under maximize:", text=text),
                "goal-twice",
            )
        demands, tolerances = tuple(self._demands()), self._tolerances()
        if "robust" in self.given and not tolerances:
            self.note(
                "tolerance",
                _("robust: needs tolerance: with ± of dimensions, such as crank.length: 0.1 mm"),
                "no-tolerance",
            )
        self.settle()
        numbers = {key: self.values[key] for key in given_by_file(Problem) if key in self.values}
        return Problem(
            self.mechanism, tuple(variables), goals, demands, define, paths, tolerances, **numbers
        )  # fmt: skip

    def _mapping(self, key: str) -> dict[str, Any]:
        value = self.given.get(key)
        return {str(name): each for name, each in value.items()} if isinstance(value, Mapping) else {}

    def _defined(self) -> tuple[dict[str, str], dict[str, PathError]]:
        """Texts and path errors by name."""
        texts, paths = {}, {}
        for name, value in self._mapping("define").items():
            try:
                path = path_error(value)
            except LinkwrightError as error:
                self.note(f"define.{name}", error)
                continue
            if path is None:
                texts[name] = value if isinstance(value, str) else flow(value)
            else:
                paths[name] = path
        return texts, paths

    def _texts(self, key: str, paths: dict[str, PathError]) -> list[str]:
        """Numbers by name; a path error that stands alone gets one."""
        value = self.given.get(key) or []
        found: list[str] = []
        for each in (
            [value] if isinstance(value, (str, PathError)) or not isinstance(value, Iterable) else value
        ):
            if isinstance(each, PathError):
                found.append(f"path_error_{len(paths) + 1}" if paths else "path_error")
                paths[found[-1]] = each
            elif isinstance(each, str):
                found.append(each)
            else:
                self.note(
                    key,
                    _(
                        "{key_}: must be a number's name or a list of them, such as [peak_input_torque, "
                        "flywheel]",
                        key_=key,
                    ),
                    "type",
                )
                return []
        return found

    def _variables(self) -> list[Variable]:
        found = []
        for address, value in self._mapping("vary").items():
            try:
                checked_addresses(self.mechanism, [address])
                found.append(self._variable(address, value))
            except LinkwrightError as error:
                self.note(f"vary.{address}", error)
        if not found and not self.findings:
            self.note(
                "vary",
                _(
                    'nothing varies; give dimensions with ranges: {{"crank.length": "20..30 mm:11"}}',
                    code="study.nothing_varies",
                ),
                "nothing-varies",
            )
        return found

    def _variable(self, address: str, value: Any) -> Variable:
        if isinstance(value, Mapping) and set(value) <= {"values", "whole"} and len(value) == 1:
            ((key, inner),) = value.items()
            text = ", ".join(map(str, inner)) if isinstance(inner, (list, tuple)) else str(inner)
            found = parse_range(self.mechanism, address, text)
            if key == "whole":
                _rising(found)
            choices = np.unique(found.values)
            if key == "whole":
                choices = np.arange(np.ceil(found.low), np.floor(found.high) + 1)
            if len(choices) < 1:
                raise RequestError(
                    _(
                        "{address} has no value to choose from; give values: or a whole: range that holds a "
                        "whole number",
                        code="optimize.no_choice",
                        address=address,
                    )
                )
            return Variable(address, float(choices[0]), float(choices[-1]), choices, found.unit)
        if (
            isinstance(value, (list, tuple))
            and len(value) == 2
            and any(isinstance(each, str) for each in value)
        ):
            value = f"{value[0]}..{value[1]}"
        if isinstance(value, (int, float)):
            value = str(value)
        if not isinstance(value, str):
            try:
                value = np.array(value, float)
            except (TypeError, ValueError):
                raise RequestError(
                    _(
                        "{address}: {given} says no bounds; give two values such as [80 mm, 120 mm], or "
                        "values: [80 mm, 90 mm]",
                        code="optimize.no_bounds",
                        address=address,
                        given=flow(value),
                    )
                ) from None
        found = parse_range(self.mechanism, address, value)
        if len(found.values) > 2 and not (isinstance(value, str) and ".." in value):
            return Variable(address, found.low, found.high, np.unique(found.values), found.unit)
        _rising(found)
        if not found.low < found.high:
            raise RequestError(
                _(
                    "{address} has equal bounds; give a lower and a higher one",
                    code="optimize.bounds",
                    address=address,
                )
            )
        if gives_part_of_tooth(self.mechanism, address, between(found)):
            low, high = math.ceil(found.low), math.floor(found.high)
            raise RequestError(
                _(
                    "{address} gives numbers of teeth, which are whole; write {address}: {{whole: "
                    "{low}..{high}}}",
                    code="optimize.whole_teeth",
                    address=address,
                    low=low,
                    high=high,
                )
            )
        return Variable(address, found.low, found.high, None, found.unit)

    def _demands(self) -> list[Demand]:
        found = []
        for text, value in self._mapping("keep").items():
            demand = _demand(text, value)
            if demand is None:
                self.note(
                    f"keep.{text}",
                    _(
                        '"{given}" is no demand; write at least 40 deg, at most 60 kN, 1..2 m, or same '
                        "within 1 %",
                        given=flow(value),
                    ),
                    "demand",
                )
            else:
                found.append(demand)
        return found

    def _tolerances(self) -> dict[str, float]:
        found = {}
        for address, value in self._mapping("tolerance").items():
            try:
                checked_addresses(self.mechanism, [address])
                text = value if isinstance(value, str) else flow(value)
                found[address] = abs(parse_range(self.mechanism, address, text.lstrip("±+- ")).high)
            except LinkwrightError as error:
                self.note(f"tolerance.{address}", error)
        return found


def _rising(found: Range) -> None:
    """Raises where the first bound is greater than the last one."""
    first, last = float(found.values[0]), float(found.values[-1])
    if first > last:
        said = {"first": found.shown(first), "last": found.shown(last)}
        raise RequestError(
            _(
                "the bounds of {address} fall from {first} to {last}; write the lower one first",
                code="optimize.falling",
            ).format(address=found.address, **said)
        )


def _demand(text: str, value: Any) -> Demand | None:
    """``at least 40 deg``, ``at most 60 kN``, ``1 m..2 m``, ``same``, ``same within 1 %``, or a mapping of these."""
    if isinstance(value, Mapping):
        if not value or set(value) - {"at_least", "at_most", "same"}:
            return None
        same = value.get("same")
        return Demand(
            text,
            str(value.get("at_least", "")),
            str(value.get("at_most", "")),
            None if same is None else str(same),
        )
    plain = str(value).strip()
    for head in ("at least", "at most", "same within", "same"):
        if plain.startswith(head):
            rest = plain[len(head) :].strip()
            if (head == "same" and rest) or (head != "same" and not rest):
                return None
            if head.startswith("same"):
                return Demand(text, same=rest or "1e-6 %")
            return Demand(text, low=rest) if head == "at least" else Demand(text, high=rest)
    span = _SPAN.match(plain)
    if span is None:
        return None
    low, high = span["low"].strip(), span["high"].strip()
    unit = _NUMBER.match(high)
    bare = _NUMBER.match(low)
    if bare is not None and not bare[2] and unit is not None:
        low = f"{low} {unit[2]}".strip()
    return Demand(text, low, high)


def _empty(value: Any) -> bool:
    """Whether nothing is given behind a key."""
    return value is None or (isinstance(value, str | Mapping | list | tuple) and not value)
