"""A program while it is written: its lines, the names in it, where its points are, and its numbers."""

from __future__ import annotations

import json
import keyword
import math
import re
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.dyads.plan import Axes, Guide, Pin, Plan, plan
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.kinetostatics.forces import Forces
from linkwright.words import Translate

#: Names that the program uses itself.
TAKEN = (
    "np",
    "lw",
    "dyads",
    "Body",
    "Line",
    "Load",
    "G",
    "cross",
    "table",
    "motion",
    "library",
    "turning",
    "reactions",
    "label",
    "axis",
    "lean",
    "moved",
    "sign",
    "shift",
    "place",
    "part",
    "i",
    "joint_of",
    "on",
    "force",
    "row",
    "value",
    "print",
    "zip",
    "map",
    "enumerate",
)


class Names:
    """Python names for the points, links and steps of a machine, each its own."""

    def __init__(self) -> None:
        self._known: dict[tuple[str, str], str] = {}
        self._used = {*TAKEN, *keyword.kwlist}

    def of(self, kind: str, name: str) -> str:
        """The name of a point, a link, a driver or a step."""
        key = kind, name
        if key not in self._known:
            plain = re.sub(r"\W", "_", name)
            plain = plain if plain.isidentifier() else f"{kind}_{plain}"
            found = next(each for each in _tries(plain, kind) if each not in self._used)
            self._used.add(found)
            self._known[key] = found
        return self._known[key]


def _tries(name: str, kind: str) -> Iterator[str]:
    yield name
    yield f"{kind}_{name}"
    yield from (f"{kind}_{name}_{i}" for i in range(2, 10_000))


class Script:
    """The lines of a program that solves ``rows`` of a motion, and what its parts share."""

    def __init__(
        self,
        motion: Motion,
        forces: Forces | None,
        translate: Translate,
        *,
        rows: Sequence[int] | None = None,
        source: str = "",
        language: str = "en",
    ) -> None:
        chosen = range(motion.steps) if rows is None else rows
        self.motion, self.forces, self.translate, self.language = motion, forces, translate, language
        self.source = source
        self.rows = [i for i in chosen if motion.ok[i]]
        self.plan: Plan = plan(motion, self.rows)
        self.mechanism = motion.mechanism
        self.names = Names()
        self.lines: list[str] = []
        self.placed: dict[str, str] = {}

    def at(self, link: str, place: complex) -> str:
        """A point of a link by its coordinates along the link's line and to its left."""
        left = "" if number(place.imag) == "0" else f", {number(place.imag)}"
        return f"{self.names.of('link', link)}.point({number(place.real)}{left})"

    def point(self, link: str, point: str) -> str:
        """A point of a link as it was placed, or where it is."""
        key = self.key(link, point)
        if key in self.placed:
            return self.placed[key]
        place = self.plan.axes[link].along(self.plan.local(link, point))
        return pair(place) if link == "frame" else self.at(link, place)

    def outer(self, outer: Pin | Guide) -> str:
        """An outer joint as an argument."""
        if isinstance(outer, Pin):
            return self.point(outer.link, outer.joint)
        axes: Axes = self.plan.axes[outer.link]
        place, turn = axes.along(outer.local), outer.angle - axes.lean
        if outer.link == "frame":
            return f"Line({pair(place)}, {angle(turn)})" if turn else f"Line({pair(place)})"
        arguments = [number(place.real), number(place.imag), angle(turn)]
        return f"{self.names.of('link', outer.link)}.line({', '.join(arguments)})"

    def write(self, *lines: str) -> None:
        """Adds lines to the program."""
        self.lines += lines

    def key(self, link: str, point: str) -> str:
        """The name of a point in the motion."""
        return canonical(self.mechanism, link, point)


#: Below this a coordinate or an angle is rounding, m or rad.
ZERO = 1e-14
#: Share of a step up to which values are equally spaced.
EVEN = 1e-9
#: Columns of a line.
WIDE = 90


def number(value: float) -> str:
    """A number to 13 digits; zero where it is rounding."""
    if abs(value) < ZERO:
        return "0"
    return f"{value:.13g}"


def angle(value: float) -> str:
    """An angle, rad; by its degrees where these are a short number."""
    degrees = math.degrees(value)
    short = f"{degrees:.10g}"
    plain = abs(value) < ZERO or abs(math.radians(float(short)) - value) > 4e-16 * abs(value)
    return number(value) if plain else f"np.radians({short})"


def quoted(text: str) -> str:
    """A text as a literal, whatever it holds."""
    return json.dumps(text, ensure_ascii=False)


def pair(value: complex) -> str:
    """A point or vector."""
    return f"({number(value.real)}, {number(value.imag)})"


def series(values: Floats, *, degrees: bool = False) -> str:
    """Values of all positions: one number, an even course, or all of them; angles in degrees where those are even."""
    array = np.asarray(values, dtype=float)
    if not len(array):
        return "np.zeros(0)"
    if np.ptp(array) <= EVEN * max(np.abs(array).max(), ZERO):
        return number(float(array[0])) if len(array) > 1 and not degrees else f"np.array([{number(float(array[0]))}])"
    shown = np.degrees(array) if degrees else array
    text = _even(shown, degrees)
    if text is not None:
        return f"np.radians({text})" if degrees else text
    listed = [number(float(each)) for each in array]
    line = f"np.array([{', '.join(listed)}])"
    return line if len(line) <= WIDE else "\n".join(["np.array([", *column(listed), "])"])


def _even(values: Floats, turns: bool) -> str | None:
    """An arithmetic series, also one that begins anew after a full turn; None for another."""
    start, step, count = float(values[0]), float(values[1] - values[0]), len(values)
    even = start + step * np.arange(count)
    gap = values - even
    if turns:
        turns_between = 360.0 * np.round(gap / 360.0)
        if turns_between.any() and np.abs(gap - turns_between).max() <= EVEN * abs(step) * count:
            turn = next((each for each in (360, -360) if _within(values, each)), None)
            return None if turn is None else f"({_course(start, step, count)}) % {turn}"
    return _course(start, step, count) if np.abs(gap).max() <= EVEN * abs(step) * count else None


def _within(values: Floats, turn: float) -> bool:
    """Whether angles lie between zero and a full turn of this sense, as a remainder does."""
    return bool((values / turn >= 0.0).all() and (values / turn < 1.0).all())


def _course(start: float, step: float, count: int) -> str:
    """start + step · (0, 1, 2, …), rounded to what the values hold."""
    size = max(abs(start), abs(step) * count)
    first, wide = (round(each / size, 14) * size for each in (start, step))
    begin = "" if abs(first) <= EVEN * abs(step) else f"{number(first)} + "
    return f"{begin}{number(wide)} * np.arange({count})"


def call(target: str, function: str, arguments: Sequence[str]) -> list[str]:
    """The lines of a call whose result gets a name; a long one has a line for each argument."""
    line = f"{target} = dyads.{function}({', '.join(arguments)})"
    if len(line) <= WIDE:
        return [line]
    return [f"{target} = dyads.{function}(", *(f"    {argument}," for argument in arguments), ")"]


def column(items: Iterable[str]) -> Iterator[str]:
    """Items of a list in lines, each with its comma."""
    line = "   "
    for item in items:
        if len(line) + len(item) + 2 > WIDE and line.strip():
            yield line
            line = "   "
        line += f" {item},"
    yield line
