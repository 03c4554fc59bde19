"""How a number with a dimension is shown: its unit, its digits, what is rounding. Values are SI."""

from __future__ import annotations

import math
from collections.abc import Mapping

from linkwright.units import DIMENSIONS, Dimension, powers, si_symbol, si_unit
from linkwright.units import unit as parsed

#: Units in which dimensions are shown, with the factor from SI; all others are shown in SI.
SHOWN: Mapping[str, tuple[str, float]] = {
    "angle": ("°", 180 / math.pi),
    "length": ("mm", 1e3),
    "pressure": ("MPa", 1e-6),
    "slope": ("mrad", 1e3),
    "section_area": ("mm²", 1e6),
    "section_modulus": ("mm³", 1e9),
    "second_moment_of_area": ("mm⁴", 1e12),
}
#: Sizes, SI, below which an angle and a length of a machine are rounding.
ZERO_TOLERANCES: Mapping[str, float] = {"angle": 1e-9, "length": 1e-15}
MINUS, INFINITE, MISSING = "−", "∞", "–"


def shown_unit(dimension: str) -> str:
    """The unit in which a dimension is shown: degrees for angles, mm for lengths."""
    return SHOWN[dimension][0] if dimension in SHOWN else si_unit(dimension)


def shown_factor(dimension: str) -> float:
    """From SI to the unit in which a dimension is shown."""
    return SHOWN[dimension][1] if dimension in SHOWN else 1.0


def number(value: float, dimension: str = "", digits: int = 6) -> str:
    """The number alone, in the shown unit; zero without a sign, rounding of an angle or a length as zero."""
    if abs(value) < ZERO_TOLERANCES.get(dimension, 0.0):
        return "0"
    if math.isinf(value):
        return INFINITE if value > 0.0 else f"-{INFINITE}"
    return f"{value * shown_factor(dimension) + 0.0:.{digits}g}"


def shown(value: float, dimension: str = "", digits: int = 6) -> str:
    """Number and unit: ``68.4094°``, ``397.606 mm``, ``12 MPa``."""
    return with_unit(number(value, dimension, digits), shown_unit(dimension))


def length_text(metres: float, digits: int = 6) -> str:
    """A length by its size: ``1.25 m`` from one metre upwards, ``60.5 mm`` below."""
    text = f"{metres:.{digits}g}"
    return f"{text} m" if float(text) >= 1.0 else f"{1000 * metres:.{digits}g} mm"


def with_unit(number: str, unit: str) -> str:
    """A number with its unit behind it, a gap between but before degrees."""
    return f"{number}{'' if unit in ('', '°') else ' '}{unit}"


def per_mm(unit: str) -> str:
    """The unit of a scale, a quantity over a millimetre of paper: ``N/mm``, ``(m/s)/mm``."""
    return f"({unit})/mm" if "/" in unit else f"{unit}/mm"


def unit_of_kind(kind: Dimension) -> tuple[str, float]:
    """The unit in which a dimension is shown that is known by its powers, and the factor from SI; an area is taken
    for a cross section."""
    name = next((name for name in ("section_area", *DIMENSIONS) if powers(name) == kind), "")
    return SHOWN.get(name, (si_symbol(kind), 1.0))


def in_kind(value: float, kind: Dimension, digits: int = 6) -> str:
    """Number and unit of a dimension that is known by its powers."""
    unit, factor = unit_of_kind(kind)
    return with_unit(number(value * factor, digits=digits), unit)


def written(value: float, unit: str, *, bare: bool = False) -> str:
    """A value in the unit that a user wrote, ``bare`` without it; SI where he wrote none."""
    text = number(value / (parsed(unit)[0] if unit else 1.0))
    return text if bare or not unit else f"{text} {unit}"


def si_of(unit: str) -> str:
    """The SI unit of what a user wrote in a unit; empty where he wrote none."""
    return si_symbol(parsed(unit)[1]) if unit else ""


def significant(value: float, digits: int = 4) -> str:
    """A number on a picture: a true minus sign, no exponent where none is needed."""
    if value and abs(value) < 1e-12:
        value = 0.0
    places = 0 if value == 0 else max(0, digits - 1 - math.floor(math.log10(abs(value))))
    text = f"{value:.{digits}g}" if places > 7 or abs(value) >= 1e7 else f"{value:.{places}f}"
    if "." in text and "e" not in text:
        text = text.rstrip("0").rstrip(".")
    return ("0" if text in ("-0", "") else text).replace("-", MINUS)


def fixed(value: float, places: int, minus: str = MINUS) -> str:
    """A number of a column with so many decimals; zero without a sign, a dash for none."""
    if not math.isfinite(value):
        return MISSING
    text = f"{value:.{places}f}"
    return text.removeprefix("-") if float(text) == 0.0 else text.replace("-", minus)
