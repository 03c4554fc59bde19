"""What differs between two files of rows.

A number differs where it is further off than the tolerance times its scale. The scale of a row is the largest number
that the same unit has anywhere in the same subject (a reaction beside the largest reaction of its machine, a
velocity beside the largest velocity), in either file, so that what is zero but for rounding is no difference; but at
least what `LEAST` says, and what follows from other units of the subject by `PRODUCTS`: an acceleration is judged
beside the largest angular velocity times the largest velocity, so that the zero angular acceleration of a
parallelogram is no difference either. Rows without a unit have a scale of their own, their largest number. Means of
a curve count as numbers of it. Words, flags, refusals and findings must be equal.
"""

from __future__ import annotations

import gzip
import json
import math
import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from tests.state.rows import Row

TOLERANCE = 1e-10
#: The scale at least, by unit: what is smaller is not judged by how small it happens to be.
LEAST: Mapping[str, float] = {
    "rad": 1.0,
    "": 1e-3,
    "m": 1e-3,
    "N": 0.1,
    "N·m": 0.1,
    "W": 1.0,
    "J": 1.0,
    "of": 1e-3,  # all that begin with it: an output with its derivatives
}
#: Units that are products of others.
PRODUCTS: Mapping[str, tuple[str, ...]] = {
    "rad/s²": ("rad/s", "rad/s"),
    "m/s²": ("m/s", "rad/s"),
    "rad/s³": ("rad/s", "rad/s", "rad/s"),
    "m/s³": ("m/s", "rad/s", "rad/s"),
    "W": ("N·m", "rad/s"),
}
#: Rows that are known to fewer digits: pattern of ``part/subject/name``, how many times the tolerance (infinite: the
#: row is not compared), and why. Found by moving every dimension of the gallery and of random machines by one unit in
#: its last place.
LOOSER: tuple[tuple[str, float, str], ...] = (
    (
        r"^metrics/(scotch_yoke|shaper_quick_return)/(crank_angle|quick_return|transmission_angle_of).*/at$"
        r"|^metrics/parallelogram/peak_(acceleration|jerk)/rocker/at$",
        math.inf,
        "two places have the same value, and rounding chooses between them",
    ),
    (
        r"^running/oldham_coupling/.*motor_power",
        math.inf,
        "its mean torque is zero but for rounding, whose sign says whether there is a motor",
    ),
    (r"^(metrics|random)/.*/at$", 1e4, "the place of a flat extreme is known to the root of what its value is"),
)

Key = tuple[str, str, str]


class Difference(NamedTuple):
    """``size``: how far off beside the scale; infinite for what is no number."""

    key: Key
    size: float
    text: str


@dataclass
class Summary:
    """Of one part."""

    rows: int = 0
    equal: int = 0
    worst: float = 0.0
    differences: list[Difference] = field(default_factory=list)


class NotAState(Exception):
    """A file that ``dump`` did not write."""


def read(path: Path) -> dict[Key, Row]:
    """The rows of a file by part, subject and name."""
    try:
        with gzip.open(path, "rt", encoding="utf-8") as file:
            head, *rest = (json.loads(line) for line in file)
        if head != {"state": 1}:
            raise NotAState(f"{path}: a state of another form; write it anew with dump")
        return dict(_rows(rest))
    except FileNotFoundError as error:
        raise NotAState(f"{path}: no such file; write it with dump") from error
    except (OSError, EOFError, ValueError) as error:
        raise NotAState(f"{path}: no state ({error}); write one with dump") from error


def _rows(entries: Sequence[list[Any]]) -> Iterator[tuple[Key, Row]]:
    part = subject = ""
    for each in entries:
        if len(each) == 2:
            part, subject = each
        else:
            yield (part, subject, each[0]), Row(part, subject, *each)


def compared(first: Mapping[Key, Row], second: Mapping[Key, Row], tolerance: float = TOLERANCE) -> dict[str, Summary]:
    """A summary of every part, with what differs in the order of the rows."""
    scales = scales_of(first, second)
    found: dict[str, Summary] = defaultdict(Summary)
    for key in sorted(first.keys() | second.keys()):
        summary = found[key[0]]
        summary.rows += 1
        bound = tolerance * looser(key)
        if math.isinf(bound):
            summary.equal += 1
            continue
        if key not in first or key not in second:
            text = "only in the second" if key not in first else "only in the first"
            summary.differences.append(Difference(key, math.inf, text))
            continue
        size, text = differing(first[key], second[key], scales)
        summary.worst = max(summary.worst, size if size <= bound or math.isfinite(size) else 0.0)
        if size > bound:
            summary.differences.append(Difference(key, size, text))
        else:
            summary.equal += 1
    return dict(found)


def renamed(found: Mapping[Key, Row], names: Sequence[tuple[str, str]]) -> dict[Key, Row]:
    """The same rows under the names that a later product has, in their words too."""

    def new(value: Any) -> Any:
        if isinstance(value, str):
            for pattern, name in names:
                value = re.sub(pattern, name, value)
        elif isinstance(value, list):
            value = [new(each) for each in value]
        return value

    changed = (Row(*map(new, row)) for row in found.values()) if names else found.values()
    return {row[:3]: row for row in changed}


def looser(key: Key) -> float:
    """How many times the tolerance a row has."""
    name = "/".join(key)
    return max((times for pattern, times, _ in LOOSER if re.search(pattern, name)), default=1.0)


def scales_of(*files: Mapping[Key, Row]) -> dict[tuple[str, str], float]:
    """The largest number by subject and unit."""
    found: dict[tuple[str, str], float] = defaultdict(float)
    for each in files:
        for row in each.values():
            if row.unit:
                key = row.subject, row.unit
                found[key] = max(found[key], largest(row.value))
    return dict(found)


def scale_of(row: Row, own: float, scales: Mapping[tuple[str, str], float]) -> float:
    """What a row of a largest number is judged by."""
    if not row.unit:
        return max(own, LEAST[""])
    product = math.prod(scales.get((row.subject, unit), 0.0) for unit in PRODUCTS.get(row.unit, ("",)))
    least = LEAST.get(row.unit, LEAST["of"] if row.unit.startswith("of ") else 0.0)
    return max(scales[row.subject, row.unit], product, least)


def largest(value: Any) -> float:
    """The largest size of a number within."""
    return max((abs(each) for _, each in numbers(value) if math.isfinite(each)), default=0.0)


def numbers(value: Any, place: str = "") -> Iterator[tuple[str, float]]:
    """Numbers within a value, each with its place."""
    if isinstance(value, bool) or value is None or isinstance(value, str):
        return
    if isinstance(value, int | float):
        yield place, float(value)
        return
    own = isinstance(value, dict)
    for name, each in value.items() if own else enumerate(value):
        if not (own and name in ("every", "size", "missing")):
            yield from numbers(each, f"{place}.{name}" if place else str(name))


def differing(a: Row, b: Row, scales: Mapping[tuple[str, str], float]) -> tuple[float, str]:
    """How far two rows are apart beside their scale, and where; infinite where they differ in more than numbers."""
    if frame(a.value) != frame(b.value) or a.unit != b.unit:
        return math.inf, f"{shown(a)} → {shown(b)}"
    own = max(largest(a.value), largest(b.value))
    scale = scale_of(a, own, scales)
    worst, text = 0.0, ""
    for (place, x), (_, y) in zip(numbers(a.value), numbers(b.value), strict=True):
        size = apart(x, y, scale)
        if size > worst:
            worst, text = size, f"{f'at {place}: ' if place else ''}{x:.17g} → {y:.17g}"
    return worst, text


def apart(x: float, y: float, scale: float) -> float:
    """The distance of two numbers beside a scale; not a number is equal to itself."""
    if x == y or (math.isnan(x) and math.isnan(y)):
        return 0.0
    if not (math.isfinite(x) and math.isfinite(y)):
        return math.inf
    return abs(x - y) / scale if scale else math.inf


def frame(value: Any) -> Any:
    """A value with its numbers left out: what must be equal."""
    if isinstance(value, dict):
        return {name: each if name in ("every", "size", "missing") else frame(each) for name, each in value.items()}
    if isinstance(value, list):
        return [frame(each) for each in value]
    return "number" if isinstance(value, int | float) and not isinstance(value, bool) else value


def shown(row: Row) -> str:
    text = json.dumps(row.value, ensure_ascii=False)
    return (text if len(text) < 100 else f"{text[:97]}…") + (f" {row.unit}" if row.unit else "")


def report(found: Mapping[str, Summary], most: int) -> Iterator[str]:
    """What differs, the furthest off first in every part, and a line for every part."""
    for part, each in found.items():
        ordered = sorted(each.differences, key=lambda one: -one.size)
        for one in ordered[:most]:
            size = "" if math.isinf(one.size) else f" ({one.size:.1e})"
            yield f"{'/'.join(one.key)}: {one.text}{size}"
        if len(ordered) > most:
            yield f"{part}: {len(ordered) - most} more"
    yield f"{'part':<14}{'rows':>9}{'equal':>9}{'differ':>9}  worst"
    for part, each in found.items():
        yield f"{part:<14}{each.rows:>9}{each.equal:>9}{each.rows - each.equal:>9}  {each.worst:.1e}"
