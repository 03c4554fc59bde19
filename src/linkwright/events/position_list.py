"""Positions that are asked for one by one: inputs or times, ranges of them, and limit positions of an output.

As text ``0..-360 deg:15 deg, limits``, as a list ``[0 deg, 60 deg, rocker min]``, or as a start and a step of either
sign, ``{from: 0 deg, step: -15 deg, to: -360 deg}``. The order of the list is preserved.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from linkwright import units
from linkwright.core.expressions import amount
from linkwright.errors import QuantityError, RequestError
from linkwright.kinematics.names import place_meant
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.words import _, pgettext

if TYPE_CHECKING:
    from linkwright.events.limit_positions import LimitPosition
    from linkwright.kinematics.motion import Motion

#: More positions than this are taken for a mistake.
MOST = 1_000_000
#: Steps of the cycle in which limit positions are sought.
LOOKS = 360
#: Keys of a start with a step.
STEPPED = ("from", "step", "to", "count")
#: Suffix of an output: one of its limit positions, or both.
LIMITS = ("min", "max", "limits")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?\s*", re.IGNORECASE)
#: One number with a comma where its point should be; two values would each have a unit.
_COMMA = re.compile(r"[+-]?\d*[1-9]\d*,\d+\s*[^\d\s,.][^,]*")


@dataclass(frozen=True)
class Place:
    """An input of the first driver (rad or m), or a time (s)."""

    value: float
    is_time: bool = False


@dataclass(frozen=True)
class AtLimit:
    """Limit positions of an output, of the one that the tables are about where none is named: ``min``, ``max``, or
    both in the order of the motion."""

    output: str
    kind: str


@dataclass(frozen=True)
class Stepped:
    """Equal steps, of either sign, from a first position on: so many positions."""

    first: AtLimit
    step: float
    count: int


Entry = Place | AtLimit | Stepped


@dataclass(frozen=True)
class PositionList:
    """What is asked for, in its order."""

    entries: tuple[Entry, ...]

    @property
    def at_limits(self) -> list[AtLimit]:
        """The limit positions among them."""
        firsts = (each.first if isinstance(each, Stepped) else each for each in self.entries)
        return [each for each in firsts if isinstance(each, AtLimit)]

    @property
    def outputs(self) -> list[str]:
        """Outputs that are named."""
        return [each.output for each in self.at_limits if each.output]

    def solved(self, mechanism: Mechanism, output: str = "", failures: Literal["raise", "mark"] = "mark") -> Motion:
        """The motion at these positions, each for itself; ``output``: whose ``limits`` are meant.

        Raises LinkwrightError for a limit position that is not there, and for an input of a driver that follows a
        law of its own.
        """
        from linkwright.kinematics.solve import solve_motion

        if self._by_time(mechanism):
            times = self.times(mechanism, output)
            return solve_motion(mechanism, times=times, failures=failures)
        return solve_motion(mechanism, at=self.inputs(mechanism, output), failures=failures)

    def inputs(self, mechanism: Mechanism, output: str = "") -> list[float]:
        """The first driver's coordinates; raises as :meth:`solved`."""
        law = next(iter(mechanism.drivers.values())).law
        return [law.at(value) if timed else value for value, timed in self._values(mechanism, output, "input")]

    def times(self, mechanism: Mechanism, output: str = "") -> list[float]:
        """The times, s; raises as :meth:`solved`."""
        from linkwright.kinematics.positions import CycleError

        found = []
        for value, timed in self._values(mechanism, output, "time"):
            driver = next(iter(mechanism.drivers.values()))
            if not timed and not driver.law.constant_speed:
                raise CycleError(
                    _(
                        "driver {name!r} follows its own law in time; ask for positions by times instead of inputs",
                        code="motion.own_law",
                        name=driver.name,
                    )
                )
            found.append(value if timed else float(driver.law.time_at(value)))
        return found

    def _by_time(self, mechanism: Mechanism) -> bool:
        steady = next(iter(mechanism.drivers.values())).law.constant_speed is not None
        return not steady or any(isinstance(each, Place) and each.is_time for each in self.entries)

    def _values(
        self, mechanism: Mechanism, output: str, kind: Literal["input", "time"]
    ) -> Iterator[tuple[float, bool]]:
        """Every position, and whether it is a time; limit positions as ``kind``."""
        from linkwright.kinematics.solve import solve_motion

        cycle: Motion | None = None
        for entry in self.entries:
            if isinstance(entry, Place):
                yield entry.value, entry.is_time
                continue
            if cycle is None:
                cycle = solve_motion(mechanism, steps=LOOKS, failures="mark")
            first = entry.first if isinstance(entry, Stepped) else entry
            for limit in _limits(cycle, first, output):
                if isinstance(entry, AtLimit):
                    yield float(getattr(limit, kind)), kind == "time"
                else:
                    yield from ((limit.input + k * entry.step, False) for k in range(entry.count))


def _limits(cycle: Motion, entry: AtLimit, output: str) -> list[LimitPosition]:
    from linkwright.events.limit_positions import limits_of

    try:
        limits = limits_of(cycle, entry.output or output or None)
    except RequestError:
        if entry.output or output:
            raise
        raise RequestError(
            _(
                'no link of "{name}" on the frame turns back, so limits has no positions to stand '
                'for; name the output that does: "coupler limits", "C.x max"',
                code="solve.no_limits",
                name=cycle.mechanism.name,
            )
        ) from None
    found = sorted(limits, key=lambda each: each.index)
    chosen = [each for each in found if entry.kind in ("limits", each.kind)]
    if not chosen:
        raise RequestError(
            _(
                '"{name}" does not turn back in this motion, so it has no limit positions',
                code="picture.no_limit_positions",
                name=entry.output or output,
            )
        )
    return chosen


# reading --------------------------------------------------------------------------------------
def of_text(text: str, dimensions: Sequence[str]) -> PositionList:
    """The positions of a text with commas between them: quantities of one of the ``dimensions``, ranges
    ``FROM..TO:STEP``, and words.

    The first bound and the step of a range take the unit of ``TO`` where they have none. Raises QuantityError or
    RequestError, which say what is wrong.
    """
    parts = [part.strip() for part in text.split(",")]
    if not all(parts):
        raise RequestError(_('"{text}" has an empty place between commas', code="solve.empty_value", text=text))
    if _COMMA.fullmatch(text.strip()):
        raise units.decimal_comma(text.strip())
    found: list[Entry] = []
    for part in parts:
        word = _word(part)
        if word is not None:
            found.append(word)
        elif ".." in part:
            found += _range(part, dimensions)
        else:
            found.append(_place(part, "", dimensions))
    return PositionList(tuple(found))


def of_value(value: Any, dimensions: Sequence[str]) -> PositionList:
    """The positions of a value of a file: a text, a list of texts, or a start with a step; raises as
    :func:`of_text`."""
    if isinstance(value, Mapping):
        return PositionList(tuple(_stepped(value, dimensions)))
    parts = value if isinstance(value, list | tuple) else [value]
    if not parts:
        raise RequestError(_('"{text}" has an empty place between commas', code="solve.empty_value", text="[]"))
    entries: list[Entry] = []
    for part in parts:
        entries += (
            of_value(part, dimensions).entries
            if isinstance(part, Mapping)
            else of_text(str(part), dimensions).entries
        )
    return PositionList(tuple(entries))


def values_of(text: str, dimension: str) -> list[float]:
    """SI values of a list of quantities and ranges, see :func:`of_text`, in which no words are."""
    found: list[float] = []
    for entry in of_text(text, (dimension,)).entries:
        if not isinstance(entry, Place):
            raise units.not_a_number(text.strip(), dimension)
        found.append(entry.value)
    return found


def known_outputs(mechanism: Mechanism, listed: PositionList) -> None:
    """Raises RequestError for a limit position of what is no output, with the nearest one."""
    for name in listed.outputs:
        place_meant(mechanism, name)


def _word(part: str) -> AtLimit | None:
    """``limits``, ``OUTPUT min``, ``OUTPUT max``, ``OUTPUT limits``; None for what may be a quantity."""
    if part in LIMITS:
        return AtLimit("", part)
    output, _unused, kind = part.rpartition(" ")
    if kind not in LIMITS or _NUMBER.fullmatch(output):
        return None
    return AtLimit(output.strip(), kind)


def _stepped(mapping: Mapping[str, Any], dimensions: Sequence[str]) -> Iterable[Entry]:
    """``{from, step, to}`` or ``{from, step, count}``, or ``{from, to, count}``."""
    for key in mapping:
        if key not in STEPPED:
            raise RequestError(
                _(
                    'invalid key of positions with a step "{name}"; {hint}',
                    code="solve.step_key",
                    name=str(key),
                    hint=offered(str(key), STEPPED),
                )
            )
    texts = {key: str(value).strip() for key, value in mapping.items()}
    if "from" not in texts or len(texts) != 3:
        raise RequestError(
            _(
                "positions with a step need from and two of step, to and count: {{from: 0 deg, step: "
                "-15 deg, to: -360 deg}}",
                code="solve.step_keys",
            )
        )
    count = _count(texts["count"]) if "count" in texts else 0
    first = _word(texts["from"])
    if first is not None:
        if first.kind == "limits" or "to" in texts:
            raise RequestError(
                _(
                    'from "{text}" on, give one limit position with step and count: {{from: jaw max, '
                    "step: 15 deg, count: 24}}",
                    code="solve.step_from_limit",
                    text=texts["from"],
                )
            )
        return [Stepped(first, _place(texts["step"], "", dimensions).value, count)]
    begin = _place(texts["from"], "", dimensions)
    if "to" not in texts:
        step = _place(texts["step"], "", dimensions).value
        return [Place(begin.value + k * step, begin.is_time) for k in range(count)]
    end = _place(texts["to"], "", dimensions).value
    if count:
        share = [k / (count - 1) for k in range(count)]
        return [Place((1.0 - k) * begin.value + k * end, begin.is_time) for k in share]
    shown = f"{texts['from']}..{texts['to']}:{texts['step']}"
    step = _place(texts["step"], "", dimensions).value
    return [Place(value, begin.is_time) for value in _steps(begin.value, end, step, shown)]


def _count(text: str) -> int:
    if not text.isdecimal() or not 2 <= int(text) <= MOST:
        raise RequestError(
            pgettext(
                "solve",
                'invalid number of positions "{text}"; give 2 to {most}',
                code="solve.bad_count",
                text=text,
                most=MOST,
            )
        )
    return int(text)


def _range(text: str, dimensions: Sequence[str]) -> list[Place]:
    bounds, colon, step_text = text.partition(":")
    first, last = bounds.split("..", 1)
    if not colon or not step_text.strip():
        raise RequestError(
            _('"{text}" has no step; write from..to:step, such as 0..90deg:10', code="solve.range_step", text=text)
        )
    number = _NUMBER.match(last.strip())
    unit = last.strip()[number.end() :] if number else ""
    if not number or re.match(r"[*/^+-]", unit):
        unit = last.strip().rpartition(" ")[2]
    end = _place(last, unit, dimensions)
    only = ("time",) if end.is_time else [each for each in dimensions if each != "time"]
    begin, step = (_place(each, unit, only).value for each in (first, step_text))
    return [Place(value, end.is_time) for value in _steps(begin, end.value, step, text)]


def _steps(begin: float, end: float, step: float, text: str) -> list[float]:
    """From ``begin`` on, not beyond ``end``; a step without a sign leads towards the end."""
    count = abs(end - begin) / abs(step) if step else math.inf
    if count > MOST:
        raise RequestError(
            _(
                '"{text}" has more than {most} steps; take a larger step',
                code="solve.range_long",
                text=text,
                most=MOST,
            )
        )
    if step < 0.0 < end - begin:
        raise RequestError(
            _(
                '"{text}" never comes to its end, from which the step leads away; turn the sign of the step',
                code="solve.step_away",
                text=text,
            )
        )
    along = math.copysign(step, end - begin)
    return [begin + along * k for k in range(math.floor(count * (1 + 1e-12) + 1e-9) + 1)]


def _place(text: str, unit: str, dimensions: Sequence[str]) -> Place:
    """A quantity of one of the dimensions, in ``unit`` where it has no unit; errors are those of the first."""
    own = text.strip()
    if unit and _NUMBER.fullmatch(own):
        own = f"{own} {unit}"
    first: QuantityError | None = None
    for dimension in dimensions:
        try:
            return Place(amount(own, dimension), dimension == "time")
        except QuantityError as error:
            first = first or error
    assert first is not None
    raise first
