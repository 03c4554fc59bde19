"""Lists and ranges of quantities on the command line: ``0 deg, 30 deg`` and ``0..90deg:10``."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence

from linkwright import units
from linkwright.cli.errors import UsageError
from linkwright.cli.parser import did_you_mean
from linkwright.core.expressions import amount
from linkwright.errors import about
from linkwright.words.sentence import Sentence

#: More values than this are taken for a slip.
MOST = 1_000_000
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?\s*", re.IGNORECASE)
#: One number with a comma where its point should be; two values would each have a unit.
_COMMA = re.compile(r"[+-]?\d*[1-9]\d*,\d+\s*[^\d\s,.][^,]*")


def quantities(text: str, dimension: str, option: str) -> list[float]:
    """SI values of a list of quantities and ranges, separated by commas; raises UsageError.

    A range is ``FROM..TO:STEP``; its first bound and its step take the unit of ``TO`` where they have none.
    """
    parts = [part.strip() for part in text.split(",")]
    if not all(parts):
        raise UsageError("solve.empty_value", option=option, text=text)
    if _COMMA.fullmatch(text.strip()):
        raise UsageError("cli.about", name=option, cause=units.decimal_comma(text.strip()))
    found: list[float] = []
    for part in parts:
        if ".." in part:
            found += _range(part, dimension, option)
        else:
            found.append(_value(part, "", dimension, option))
    return found


def joined(words: Sequence[str]) -> str:
    """Words that follow an option, each with values, as the one list that they are."""
    return ("; " if any("=" in word for word in words) else ", ").join(words)


def inputs(text: str, rotary: Mapping[str, bool]) -> dict[str, list[float]]:
    """Coordinates by driver of ``--at``: a list for the first driver, or ``NAME=list; NAME=list``."""
    found: dict[str, list[float]] = {}
    for part in text.split(";"):
        name, equals, values = part.rpartition("=")
        name = name.strip() if equals else next(iter(rotary))
        if name not in rotary:
            cause = did_you_mean(Sentence("solve.no_driver", name=name), name, rotary)
            raise UsageError("cli.about", name="--at", cause=cause)
        found[name] = quantities(values, "angle" if rotary[name] else "length", "--at")
    counts = {len(values) for values in found.values()} - {1}
    if len(counts) > 1:
        raise UsageError("solve.uneven", counts=tuple(map(str, sorted(counts))))
    return found


def _range(text: str, dimension: str, option: str) -> list[float]:
    bounds, colon, step_text = text.partition(":")
    first, last = bounds.split("..", 1)
    if not colon or not step_text.strip():
        raise UsageError("solve.range_step", option=option, text=text)
    unit = _NUMBER.sub("", last.strip(), count=1).strip()
    begin, end = _value(first, unit, dimension, option), _value(last, unit, dimension, option)
    step = abs(_value(step_text, unit, dimension, option))
    count = abs(end - begin) / step if step else math.inf
    if count > MOST:
        raise UsageError("solve.range_long", option=option, text=text, most=MOST)
    sign = math.copysign(step, end - begin)
    return [begin + sign * i for i in range(math.floor(count * (1 + 1e-12) + 1e-9) + 1)]


def _value(text: str, unit: str, dimension: str, option: str) -> float:
    """SI value of a text, which takes ``unit`` where it has none of its own."""
    own = text.strip()
    if unit and _NUMBER.fullmatch(own):
        own = f"{own} {unit}"
    with about(option, UsageError):
        return amount(own, dimension)
