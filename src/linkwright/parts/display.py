"""Units in which machine-part results are shown; values are SI."""

from __future__ import annotations

from collections.abc import Mapping

from linkwright.metrics.quantities import FURTHER, SHOWN
from linkwright.units import SI_UNITS

#: Dimensions that only these results have, with their SI units.
OWN: Mapping[str, str] = {
    "slope": "rad",
    "flexural_rigidity": "N·m²",
    "section_modulus": "m³",
    "power_of_drag": "kg/m",
    "length_per_angle_cubed": "m/rad³",
    "per_angle_squared": "1/rad²",
}
#: Units of display with the factor from SI, where they differ from SI.
UNITS: Mapping[str, tuple[str, float]] = {
    **SHOWN,
    "pressure": ("MPa", 1e-6),
    "slope": ("mrad", 1e3),
    "area": ("mm²", 1e6),
    "section_modulus": ("mm³", 1e9),
    "second_moment_of_area": ("mm⁴", 1e12),
}


def si_unit(dimension: str) -> str:
    """SI unit of a dimension; empty for a plain number."""
    return OWN.get(dimension) or FURTHER.get(dimension) or SI_UNITS.get(dimension, "")


def unit(dimension: str) -> str:
    """Unit in which the dimension is shown."""
    return UNITS[dimension][0] if dimension in UNITS else si_unit(dimension)


def number(value: float, dimension: str = "", digits: int = 6) -> str:
    """The number alone in the shown unit; nothing but rounding is zero."""
    shown = value * (UNITS[dimension][1] if dimension in UNITS else 1.0)
    return f"{0.0 if abs(shown) < 1e-12 else shown:.{digits}g}"


def shown(value: float, dimension: str = "", digits: int = 6) -> str:
    """Number and unit: ``4.21875 mm``, ``12 MPa``."""
    name = unit(dimension)
    return f"{number(value, dimension, digits)}{'' if name in ('', '°') else ' '}{name}"
