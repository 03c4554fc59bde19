"""Units in which design numbers are shown; values are SI."""

from __future__ import annotations

import math
from collections.abc import Mapping

from linkwright.units import si_unit

#: Units in which tables show a dimension, with the factor from SI.
SHOWN: Mapping[str, tuple[str, float]] = {"angle": ("°", 180 / math.pi), "length": ("mm", 1e3)}

#: Sizes, SI, below which an angle and a length of a machine are rounding.
NOTHING: Mapping[str, float] = {"angle": 1e-9, "length": 1e-15}


def shown_unit(dimension: str) -> str:
    """Unit in which tables show the dimension: degrees for angles, mm for lengths, else SI."""
    return SHOWN[dimension][0] if dimension in SHOWN else si_unit(dimension)


def shown(value: float, dimension: str, digits: int = 6) -> str:
    """A value with its unit as tables and sentences show it: ``68.4094°``, ``397.606 mm``."""
    unit = shown_unit(dimension)
    gap = "" if unit in ("", "°") else " "
    return f"{number(value, dimension, digits)}{gap}{unit}"


def number(value: float, dimension: str, digits: int = 6) -> str:
    """The number alone, in the shown unit; zero without a sign, rounding of an angle or a length as zero."""
    if abs(value) < NOTHING.get(dimension, 0.0):
        return "0"
    if math.isinf(value):
        return "∞" if value > 0.0 else "-∞"
    factor = SHOWN[dimension][1] if dimension in SHOWN else 1.0
    return f"{value * factor + 0.0:.{digits}g}"
