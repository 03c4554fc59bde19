"""Numbers, points and series of a listing, as Python writes them."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from linkwright.core.arrays import Floats

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
