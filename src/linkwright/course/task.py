"""What a teacher asks for: section ``course`` of a model file, with what is usual where it says nothing."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output
from linkwright.course.calculation_chain import Line
from linkwright.course.mistakes import Sheet
from linkwright.errors import LinkwrightError, RequestError, about
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.study.ranges import dimension_of
from linkwright.units import DIMENSIONS, parse

KEYS = ("vary", "ask", "at", "tolerance")
#: By how much lengths change, and how far an answer may be off, where nobody says.
SHARE, TOLERANCE = 0.08, 0.01
#: Kinds of outputs that are asked for of the last group, and of all.
PLACED, TURNING = ("angle", "displacement"), ("angular_velocity", "angular_acceleration")
#: What is smaller is not asked for.
NOTHING = 1e-9


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
        return self.output.sentence(alone=True).say(language)

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
    """The task of a model; raises LinkwrightError for settings that make no sense, and for a machine whose position
    is not told by its input."""
    try:
        return _task(mechanism, mechanism.course)
    except RequestError as error:
        raise LinkwrightError(error.sentence) from None


def _task(mechanism: Mechanism, given: Mapping[str, Any]) -> Task:
    for key in given:
        if key not in KEYS:
            hint = offered(str(key), KEYS)
            raise RequestError("course.unknown_key", place=f"course.{key}", name=key, hint=hint)
    if not mechanism.steady:
        raise LinkwrightError("course.no_input", name=mechanism.name)
    driver = next(iter(mechanism.drivers.values()))
    rotary = mechanism.joints[driver.joint].coordinate == "turn"
    at = _quantity("at", given.get("at", "60 deg" if rotary else "0.01 m"), "angle" if rotary else "length")
    sheet = Sheet(mechanism, at)
    return Task(mechanism, _ranges(mechanism, given.get("vary")), _questions(sheet, given.get("ask")), at,
                _tolerance(given.get("tolerance", TOLERANCE)))  # fmt: skip


def _quantity(place: str, given: Any, dimension: str) -> float:
    with about(f"course.{place}", LinkwrightError):
        return parse(str(given), dimension)


def _tolerance(value: Any) -> float:
    text = str(value).strip()
    try:
        found = float(text.removesuffix("%")) * (0.01 if text.endswith("%") else 1.0)
    except ValueError:
        found = math.nan
    if not 0.0 < found <= 0.2:
        raise RequestError("course.bad_tolerance", text=text)
    return found


def _ranges(mechanism: Mechanism, given: Any) -> dict[str, tuple[float, float]]:
    """Limits of the dimensions that change; all lengths of links by a share where nothing is said."""
    dimensions = mechanism.dimensions()
    if given is None:
        own = {name: value for name, value in dimensions.items() if name.endswith(".length") and value > 0.0}
        return {name: ((1 - SHARE) * value, (1 + SHARE) * value) for name, value in own.items()}
    if not isinstance(given, Mapping):
        raise RequestError("course.bad_range", address="vary", text=str(given))
    found = {}
    for address, limits in given.items():
        value = mechanism.dimension(str(address))
        found[str(address)] = _limits(mechanism, str(address), value, limits)
    return found


def _limits(mechanism: Mechanism, address: str, value: float, given: Any) -> tuple[float, float]:
    kind = dimension_of(mechanism, address)
    dimension = next((name for name, each in DIMENSIONS.items() if each == kind), "dimensionless")
    try:
        if isinstance(given, list | tuple) and len(given) == 2:
            low, high = (_quantity(f"vary.{address}", each, dimension) for each in given)
        else:
            share = float(str(given).strip().removesuffix("%")) / 100.0
            low, high = sorted(((1 - share) * value, (1 + share) * value))
    except ValueError:
        raise RequestError("course.bad_range", address=address, text=str(given)) from None
    if not -math.inf < low < high < math.inf:
        raise RequestError("course.bad_range", address=address, text=str(given))
    return low, high


def _questions(sheet: Sheet, given: Any) -> tuple[Question, ...]:
    """The numbers asked for; those of the last group, and of what drives, where nothing is said."""
    if given is not None:
        names = {output.column: output for output in sheet.values}
        if not isinstance(given, list | tuple) or not given:
            raise RequestError("course.no_list", given=str(given), hint=offered("", names))
        found = []
        for name in dict.fromkeys(given):
            if str(name) not in names:
                raise RequestError("course.no_number", name=str(name), hint=offered(str(name), names))
            found.append(Question(names[str(name)]))
        return tuple(found)
    asked = [(line.output, line.group) for line in sheet.lines if line.output and not _told(line)]
    asked = [(output, group) for output, group in asked if output.kind in (*PLACED, *TURNING)]
    last = asked[-1][1] if asked else ""
    ordered = sorted(asked, key=lambda each: each[1] != last)
    chosen = [
        output
        for output, group in ordered
        if (group == last or output.kind in TURNING) and abs(sheet.values[output]) > NOTHING
    ]
    if sheet.mechanism.has_loads:
        whole = [each for each in sheet.values if each.kind == "reaction" and not each.component]
        chosen += [each for each in whole if sheet.values[each] > NOTHING]
        chosen += [each for each in sheet.values if each.kind == "effort"]
    return tuple(map(Question, dict.fromkeys(chosen)))


def _told(line: Line) -> bool:
    """Whether a number is the input's own, or copied from another one."""
    return line.given or line.formula.op in ("symbol", "number")
