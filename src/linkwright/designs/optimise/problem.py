"""What is optimised: variables within bounds, objectives and demands."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal

import numpy as np

from linkwright.core.arguments import STEPS
from linkwright.core.arrays import Floats
from linkwright.core.quantity import si_of, written
from linkwright.designs.demands import KEYS, Demand, DemandText
from linkwright.designs.objective_terms import PathError
from linkwright.designs.ranges import Range, parse_range
from linkwright.designs.varied_dimensions import between, checked_addresses, gives_part_of_tooth
from linkwright.errors import LinkwrightError, RequestError
from linkwright.fields.base import Number, Quantities, Quantity, Text, Word, file_key, file_keys
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.tables import ByAddress, Either, Integer, Keys, Line, Listed, Table, Value
from linkwright.files.reader import SectionReading
from linkwright.files.write import flow
from linkwright.machine.flywheel import COEFFICIENT, FLUCTUATION
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

Robust = Literal["", "worst", "yield"]


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
class Metres(Quantity):
    """A length; a bare number is one in m."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> float | None:
        bare = reader.free(node)
        return bare if isinstance(bare, float) else super().read(reader, node, place, siblings)


@dataclass(frozen=True)
class Target(Quantities):
    """A target point of a path."""

    @property
    def _one(self) -> Quantity:
        return Metres(self.dimension)


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
    robust: Robust = file_key(
        Word(
            ("worst", "yield"),
            doc=_(
                "worst: objectives and demands hold for the worst machine within the tolerances; "
                "yield: a share of the machines made meets the demands"
            ),
        ),
        "",
    )
    min_yield: float = file_key(
        Number(
            above=0.0,
            maximum=1.0,
            key="yield",
            doc=_("share of the machines made that meets the demands; default 0.99"),
        ),
        0.99,
    )
    fluctuation: float = file_key(COEFFICIENT, FLUCTUATION)
    steps: int = file_key(Integer(1, 1_000_000, doc=_("positions of the cycle; default 360")), STEPS)
    evaluations: int = file_key(
        Integer(
            1, 1_000_000_000, doc=_("most designs of the search (4000); the last steps along gradients come on top")
        ),
        4000,
    )
    population: int = file_key(Integer(0, 1_000_000, doc=_("designs of a generation; chosen unless given")), 0)
    seed: int = file_key(
        Integer(0, 1_000_000_000, doc=_("seed of the search (0); the same seed gives the same result")), 0
    )

    @property
    def addresses(self) -> tuple[str, ...]:
        """Dimensions that vary, with those that have tolerances."""
        return tuple(dict.fromkeys([*(each.address for each in self.variables), *self.tolerances]))

    @property
    def start(self) -> Floats:
        """The variables of the mechanism as it is."""
        return np.array([self.mechanism.dimension(each.address) for each in self.variables])


_VALUES = Listed(Value(), "[20 mm, 25 mm, 32 mm]", alone=True)
_NUMBERS = "[peak_input_torque, flywheel]"
SECTION = Keys(
    {
        "vary": ByAddress(
            Either(_VALUES, Table({"values": _VALUES, "whole": _VALUES})),
            doc=_("bounds of dimensions and parameters, such as 80..120 mm"),
        ),
        "minimize": Listed(
            Text(),
            _NUMBERS,
            alone=True,
            doc=_("quantities to minimize: metrics, flywheel, summaries such as 'jaw.angle range'"),
        ),
        "maximize": Listed(Text(), _NUMBERS, alone=True, doc=_("quantities to maximize")),
        "keep": ByAddress(
            DemandText(Value(), Table({**KEYS, "same": Value()})),
            doc=_("demands on numbers: at least 40 deg, at most 60 kN, 1..2 m, same within 1 % of the start"),
        ),
        "define": ByAddress(
            Either(
                Line(),
                Table(
                    {
                        "point": Text(required=True, doc=_("point that follows a path, such as coupler.P")),
                        "target": Listed(
                            Target("length", ("x", "y")),
                            "[[30 mm, 40 mm], [32 mm, 41 mm]]",
                            required=True,
                            doc=_("places of the point, one for each position"),
                        ),
                    },
                    PathError,
                ),
            ),
            doc=_("names for expressions of numbers, and for errors of paths"),
        ),
        "tolerance": ByAddress(Line(), doc=_("± of dimensions, such as 0.1 mm")),
        **file_keys(Problem),
    }
)


def problem(mechanism: Mechanism, settings: Mapping[str, Any] | None = None, source: str = "") -> Problem:
    """A problem from the section ``optimize``, or from ``settings`` in its place.

    Raises ModelError with all findings.
    """
    return _Reading(
        mechanism, mechanism.optimize if settings is None else settings, source or mechanism.name
    ).problem()


class _Reading(SectionReading):
    """The settings for a mechanism; those that may be objects in programs are taken as they are given."""

    def __init__(self, mechanism: Mechanism, settings: Mapping[str, Any], source: str) -> None:
        self.mechanism = mechanism
        known = SECTION.fields.keys() | {"yield"}
        self.settings = {key: each for key, each in settings.items() if key not in known or not _empty(each)}
        unchanged = len(self.settings) == len(settings)
        super().__init__(SECTION, "optimize", settings if unchanged else self.settings, source)

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
                _("no objective given; add minimize: or maximize: with a metric such as peak_input_torque"),
                "no-goal",
            )
        sought = [goal.text.strip() for goal in goals]
        for text in sorted({each for each in sought if sought.count(each) > 1}):
            self.note(
                "maximize",
                _("{text} is sought twice; give it once, under minimize: or under maximize:", text=text),
                "goal-twice",
            )
        demanded, tolerances = self._read("keep"), self._tolerances()
        demands = tuple(replace(each, text=text) for text, each in demanded.items())
        if "robust" in self.settings and not tolerances:
            self.note(
                "tolerance",
                _("robust: needs tolerance: with ± of dimensions, such as crank.length: 0.1 mm"),
                "no-tolerance",
            )
        self.settle()
        numbers = {key: self.values[key] for key in file_keys(Problem) if key in self.values}
        return Problem(self.mechanism, tuple(variables), goals, demands, define, paths, tolerances, **numbers)

    def _read(self, key: str) -> dict[str, Any]:
        """What could be read by names."""
        return {name: each for name, each in (self.values.get(key) or {}).items() if each is not None}

    def _defined(self) -> tuple[dict[str, str], dict[str, PathError]]:
        """Texts and path errors by name, those of programs as they are."""
        own = {} if self.values.get("define") is None else self.settings["define"]
        found = {**self._read("define"), **{str(n): e for n, e in own.items() if isinstance(e, PathError)}}
        paths = {name: each for name, each in found.items() if isinstance(each, PathError)}
        return {name: each for name, each in found.items() if name not in paths}, paths

    def _texts(self, key: str, paths: dict[str, PathError]) -> list[str]:
        """Numbers by name; a path error without one gets one."""
        read, found = self.values.get(key), list[str]()
        value = self.settings.get(key, read)
        for each in () if read is None else (value,) if isinstance(read, str) else value:
            if isinstance(each, PathError):
                found.append(f"path_error_{len(paths) + 1}" if paths else "path_error")
                paths[found[-1]] = each
            else:
                found.append(str(each))
        return found

    def _variables(self) -> list[Variable]:
        found = []
        for address, value in self._read("vary").items():
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
        if isinstance(value, Mapping) and len(value) == 1:
            return self._chosen(address, *next(iter(value.items())))
        if isinstance(value, tuple) and len(value) == 2 and any(isinstance(each, str) for each in value):
            value = f"{value[0]}..{value[1]}"
        if isinstance(value, (int, float)):
            value = str(value)
        if not isinstance(value, str):
            try:
                value = np.array(value, float)
            except (TypeError, ValueError):
                raise RequestError(
                    _(
                        "{address}: invalid bounds {given}; give two values such as [80 mm, 120 mm], or "
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
                    "{address} gives numbers of teeth, which are integers; write {address}: {{whole:  "
                    "{low}..{high}}}",
                    code="optimize.whole_teeth",
                    address=address,
                    low=low,
                    high=high,
                )
            )
        return Variable(address, found.low, found.high, None, found.unit)

    def _chosen(self, address: str, key: str, value: Any) -> Variable:
        """One of some values, or of the integers of a range."""
        text = ", ".join(map(str, value)) if isinstance(value, tuple) else str(value)
        found = parse_range(self.mechanism, address, text)
        choices = np.unique(found.values)
        if key == "whole":
            _rising(found)
            choices = np.arange(np.ceil(found.low), np.floor(found.high) + 1)
        if len(choices) < 1:
            raise RequestError(
                _(
                    "{address} has no value to choose from; give values: or a whole: range that holds an integer",
                    code="optimize.no_choice",
                    address=address,
                )
            )
        return Variable(address, float(choices[0]), float(choices[-1]), choices, found.unit)

    def _tolerances(self) -> dict[str, float]:
        found = {}
        for address, value in self._read("tolerance").items():
            try:
                checked_addresses(self.mechanism, [address])
                found[address] = abs(parse_range(self.mechanism, address, value.lstrip("±+- ")).high)
            except LinkwrightError as error:
                self.note(f"tolerance.{address}", error)
        return found


def _rising(found: Range) -> None:
    """Raises where the first bound is greater than the last one."""
    first, last = float(found.values[0]), float(found.values[-1])
    if first > last:
        bounds = {"first": found.shown(first), "last": found.shown(last)}
        raise RequestError(
            _(
                "the bounds of {address} fall from {first} to {last}; write the lower one first",
                code="optimize.falling",
            ).format(address=found.address, **bounds)
        )


def _empty(value: Any) -> bool:
    """Whether nothing is given behind a key."""
    return value is None or (isinstance(value, str | Mapping | list | tuple) and not value)
