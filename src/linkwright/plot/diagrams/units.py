"""Units in which axes show a quantity."""

from __future__ import annotations

import math
from collections.abc import Iterable

from linkwright.core.arrays import Floats, largest
from linkwright.core.dataclass import dataclass
from linkwright.metrics.quantities import si_unit

_FIXED = {
    "angle": ("°", 180 / math.pi),
    "length": ("mm", 1e3),
    "time": ("s", 1.0),
    "velocity": ("m/s", 1.0),
    "acceleration": ("m/s²", 1.0),
    "angular_velocity": ("rad/s", 1.0),
    "angular_acceleration": ("rad/s²", 1.0),
}
_PREFIXED = {"force": "N", "torque": "N·m", "power": "W", "energy": "J"}
_PREFIXES = ((1e7, "M", 1e-6), (1e4, "k", 1e-3), (1e-2, "", 1.0), (0.0, "m", 1e3))


@dataclass(frozen=True)
class Unit:
    """A unit's name, and the factor from SI to it."""

    name: str
    factor: float

    def text(self, value: float, digits: int = 4) -> str:
        """An SI value as text with the unit: ``56.14 kN``."""
        shown = significant(value * self.factor, digits)
        return f"{shown}{self.name}" if self.name in ("°", "") else f"{shown} {self.name}"

    def label(self, quantity: str, between: str = " ") -> str:
        """The label of an axis: quantity and unit, ``travel (mm)``; the quantity alone where there is no unit."""
        return f"{quantity}{between}({self.name})" if self.name else quantity


def unit_of(dimension: str, arrays: Iterable[Floats] = ()) -> Unit:
    """The unit for a quantity; forces, torques, powers and energies take a prefix by their largest size."""
    if dimension in _FIXED:
        return Unit(*_FIXED[dimension])
    if dimension not in _PREFIXED:
        return Unit(si_unit(dimension), 1.0)
    size = max(map(largest, arrays), default=0.0)
    prefix, factor = next((p, f) for least, p, f in _PREFIXES if size >= least or (size == 0.0 and f == 1.0))
    return Unit(prefix + _PREFIXED[dimension], factor)


def significant(value: float, digits: int = 4) -> str:
    """A number with a true minus sign and no exponent where none is needed."""
    if value and abs(value) < 1e-12:
        value = 0.0
    places = 0 if value == 0 else max(0, digits - 1 - math.floor(math.log10(abs(value))))
    text = f"{value:.{digits}g}" if places > 7 or abs(value) >= 1e7 else f"{value:.{places}f}"
    if "." in text and "e" not in text:
        text = text.rstrip("0").rstrip(".")
    return ("0" if text in ("-0", "") else text).replace("-", "−")


def round_up(value: float) -> float:
    """The smallest of 1, 2, 2.5, 5 times a power of ten that is not below a value."""
    power = 10.0 ** math.floor(math.log10(value) + 1e-12)
    return min(k * power for k in (1.0, 2.0, 2.5, 5.0, 10.0) if k * power >= value * (1 - 1e-9))
