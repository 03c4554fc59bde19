"""What a teacher asks for: section ``course`` of a model file, with what is usual where it says nothing."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from linkwright.core.expressions import amount
from linkwright.core.outputs import Output
from linkwright.course.mistakes import Line, Sheet
from linkwright.designs.ranges import dimension_of
from linkwright.errors import LinkwrightError, QuantityError, RequestError
from linkwright.fields.base import Text
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.tables import ByAddress, Keys, Listed, Value
from linkwright.files.reader import SectionReading
from linkwright.files.write import flow
from linkwright.kinematics.names import result_meant
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.units import DIMENSIONS
from linkwright.words import _


@dataclass(frozen=True)
class ShareOfAnswer(Value):
    """How far an answer may be off: a share up to 0.2."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        value = super().read(reader, node, place, siblings)
        found = None if value is None else _share(value)
        if found is None or 0.0 < found <= 0.2:
            return found
        message = _(
            'invalid tolerance "{text}"; give a share up to 0.2, such as 0.01 or 1 %',
            code="course.bad_tolerance",
            text=flow(value),
        )
        reader.error(node, place, message, "", "bad-tolerance")
        return None


SECTION = Keys(
    {
        "vary": ByAddress(
            Listed(Value(), "[0.3 m, 0.35 m]", alone=True),
            doc=_("dimensions that change, by a share (8 %) or between two values"),
        ),
        "ask": Listed(Text(), "[rocker.angle, driver.effort]", doc=_("results that are asked for")),
        "at": Value(doc=_("input at which they are asked for, such as 60 deg")),
        "tolerance": ShareOfAnswer(doc=_("how far an answer may be off, such as 1 %")),
    }
)
#: By how much lengths change, and how far an answer may be off, where nobody says.
SHARE, TOLERANCE = 0.08, 0.01
#: The position at which numbers are asked for where nobody says which.
USUAL_PLACE = {"angle": "60 deg", "length": "0.01 m"}
#: Kinds of outputs that are asked for of the last group, and of all.
PLACED, TURNING = ("angle", "displacement"), ("angular_velocity", "angular_acceleration")
#: A coordinate below this is zero in the drawing that it follows from, m.
ROUNDED = 1e-9
#: What is smaller is not asked for.
NOTHING = 1e-9


_NO_RANGE = _('invalid range "{text}"; give a share (8 %) or two values ([0.3 m, 0.35 m])', code="course.bad_range")


@dataclass(frozen=True)
class Question:
    """One number that is asked for: one of the machine's outputs."""

    output: Output

    @property
    def name(self) -> str:
        """What answers call it: the name over its column."""
        return self.output.column

    def text(self, language: str) -> str:
        """What it is, in words: ``angular velocity of jaw``."""
        return self.output.sentence(alone=True).translate(language)

    @property
    def unit(self) -> str:
        """The unit in which it is answered."""
        return "°" if self.output.dimension == "angle" else self.output.unit


@dataclass(frozen=True)
class Task:
    """``ranges``: smallest and largest value, SI, of every dimension that changes; ``at``: the input, rad or m."""

    mechanism: Mechanism
    ranges: Mapping[str, tuple[float, float]]
    questions: tuple[Question, ...]
    at: float
    tolerance: float


def task(mechanism: Mechanism) -> Task:
    """The task of a model; raises ModelError with all findings about its settings, LinkwrightError for a machine
    whose position its input does not determine."""
    if not mechanism.steady:
        raise LinkwrightError(
            _(
                "variants need a machine whose drivers have constant speed; those of {name!r} follow "
                "laws in time, or there are none",
                code="course.no_input",
                name=mechanism.name,
            )
        )
    return _Reading(mechanism, mechanism.course).task()


class _Reading(SectionReading):
    """The settings for a mechanism."""

    def __init__(self, mechanism: Mechanism, section: Mapping[str, Any]) -> None:
        super().__init__(SECTION, "course", section)
        self.mechanism = mechanism
        self.settings = {key: each for key, each in (self.values or {}).items() if each is not None}

    def task(self) -> Task:
        across = self.mechanism.across
        at = self._quantity("at", self.settings.get("at", USUAL_PLACE[across]), across)
        ranges, tolerance = self._ranges(), self.settings.get("tolerance", TOLERANCE)
        questions: tuple[Question, ...] = ()
        try:
            questions = () if at is None else self._questions(Sheet(self.mechanism, at))
        except LinkwrightError as error:
            self.note("at", error)
        self.settle()
        assert at is not None
        return Task(self.mechanism, ranges, questions, at, tolerance)

    def _quantity(self, key: str, value: Any, dimension: str) -> float | None:
        try:
            return amount(str(value), dimension)
        except QuantityError as error:
            self.note(key, error)
            return None

    def _ranges(self) -> dict[str, tuple[float, float]]:
        """Limits of the dimensions that change; the sizes of all links by a share by default."""
        section = self.settings.get("vary")
        if section is None:
            sizes = {name: self.mechanism.dimension(name) for name in _usual_sizes(self.mechanism)}
            return {name: _by(SHARE, value) for name, value in sizes.items()}
        found = {}
        for address, limits in section.items():
            try:
                value = self.mechanism.dimension(address)
            except LinkwrightError as error:
                self.note(f"vary.{address}", error)
                continue
            if limits is not None and (between := self._limits(address, value, limits)) is not None:
                found[address] = between
        return found

    def _limits(self, address: str, value: float, limits: Any) -> tuple[float, float] | None:
        key = f"vary.{address}"
        if isinstance(limits, tuple) and len(limits) == 2:
            kind = dimension_of(self.mechanism, address)
            dimension = next((name for name, each in DIMENSIONS.items() if each == kind), "dimensionless")
            low, high = (self._quantity(key, each, dimension) for each in limits)
            if low is None or high is None:
                return None
        else:
            share = _share(limits, bare=0.01)
            low, high = _by(share, value)
        if -math.inf < low < high < math.inf:
            return low, high
        self.note(key, _NO_RANGE.format(text=flow(limits)), "bad-range")
        return None

    def _questions(self, sheet: Sheet) -> tuple[Question, ...]:
        """The numbers asked for; those of the last group, and of what drives, by default."""
        section = self.settings.get("ask")
        if section is None:
            return _usual_questions(sheet)
        names = {output.column: output for output in sheet.values}
        if not section:
            message = _(
                'invalid list of results "{given}"; {hint}',
                code="course.no_list",
                given="[]",
                hint=offered("", names),
            )
            self.note("ask", message, "no-list")
            return ()
        found = []
        for i, name in enumerate(section):
            if name is None:
                continue
            with suppress(RequestError):
                meant = result_meant(self.mechanism, name, sheet.values)
                if meant in sheet.values:
                    found.append(Question(meant))
                    continue
            message = _(
                'there is no result "{name}" at this position; {hint}',
                code="course.no_number",
                name=name,
                hint=offered(name, names),
            )
            self.note(f"ask.{i}", message, "no-number")
        return tuple(dict.fromkeys(found))


def _by(share: float, value: float) -> tuple[float, float]:
    """The smallest and the largest value within a share of one."""
    low, high = sorted(((1 - share) * value, (1 + share) * value))
    return low, high


def _usual_sizes(mechanism: Mechanism) -> Iterator[str]:
    """Dimensions that say how large the links are, as each is given: its length, its two lengths, or the coordinates
    of its points, those of a drawing among them."""
    found = {name: value for name, value in mechanism.dimensions().items() if value}
    for link in mechanism.links.values():
        own = [name for name in found if name.startswith(f"{link.name}.")]
        places = {f"{link.name}.{point}.{axis}" for point in link.points for axis in "xy"}
        lengths = [name for name in own if name.startswith(f"{link.name}.length")]
        yield from lengths or [name for name in own if name in places and abs(found[name]) > ROUNDED]


def _share(share: Any, *, bare: float = 1.0) -> float:
    """A share as ``8 %``, or a number times ``bare``; NaN for anything else."""
    text = flow(share).strip('"').strip()
    try:
        return float(text.removesuffix("%")) * (0.01 if text.endswith("%") else bare)
    except ValueError:
        return math.nan


def _usual_questions(sheet: Sheet) -> tuple[Question, ...]:
    """The numbers of the last group, and of what drives."""
    asked = [(line.output, line.group) for line in sheet.lines if line.output and not _is_asked(line)]
    asked = [(output, group) for output, group in asked if output.kind in (*PLACED, *TURNING)]
    last = asked[-1][1] if asked else ""
    ordered = sorted(asked, key=lambda each: each[1] != last)
    chosen = [
        output
        for output, group in ordered
        if (group == last or output.kind in TURNING) and abs(sheet.values[output]) > NOTHING
    ]
    if sheet.mechanism.has_loads:
        forces = [each for each in sheet.values if each.kind == "reaction" and not each.component]
        chosen += [each for each in forces if sheet.values[each] > NOTHING]
        chosen += [each for each in sheet.values if each.kind == "effort"]
    return tuple(map(Question, dict.fromkeys(chosen)))


def _is_asked(line: Line) -> bool:
    """Whether a number is the input's own, or copied from another one."""
    return line.is_given or line.formula.op in ("symbol", "number")
