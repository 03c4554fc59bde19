"""Preferred sizes: the numbers to which widths, pins and plates are rounded."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Sequence

#: Steps of a decade, ISO 497 series R″10.
STEPS = (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0)


def _millimetres(text: str) -> tuple[float, ...]:
    return tuple(1e-3 * float(each) for each in text.split())


#: Diameters of pins, m: ISO 2338 (parallel pins) up to 50 mm, ISO 2340 (clevis pins) beyond.
PINS = _millimetres("1 1.2 1.5 2 2.5 3 4 5 6 8 10 12 16 20 25 30 40 50 60 70 80 90 100")
#: Thicknesses of plate that is in stock, m.
PLATES = _millimetres("0.5 0.8 1 1.5 2 2.5 3 4 5 6 8 10 12 15 20 25 30 40 50 60 80 100")
#: Widths of flat bars, m.
WIDTHS = _millimetres(
    "1 1.5 2 3 4 5 6 8 10 12 14 16 18 20 22 25 28 30 32 35 40 45 50 55 60 65 70 75 80 90 100 "
    "110 120 130 140 150 160 180 200"
)
#: A size counts as reached within this share.
ROUNDING = 1e-9


def at_least(size: float, series: Sequence[float]) -> float:
    """The smallest preferred size (m) that is not below another; beyond the series by steps of a decade."""
    wanted = size * (1.0 - ROUNDING)
    if wanted <= series[-1]:
        return series[bisect_left(series, wanted)]
    return decade(size, up=True)


def decade(size: float, *, up: bool) -> float:
    """The preferred number of any decade next to a positive size, not below or not above it."""
    power = 10.0 ** math.floor(math.log10(size * (1.0 + ROUNDING)))
    share = size / power
    if up:
        return next((each * power for each in STEPS if each >= share * (1.0 - ROUNDING)), 10.0 * power)
    return power * max(each for each in STEPS if each <= share * (1.0 + ROUNDING))
