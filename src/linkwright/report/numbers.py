"""Columns of results as tables print them."""

from __future__ import annotations

import math
import re

import numpy as np

from linkwright.kinematics.cycle import Floats

#: Significant digits of the largest number of a column.
DIGITS = 6
_UNITS = {"rad": ("°", 180.0 / math.pi), "m": ("mm", 1e3)}
_SYMBOLS = {
    "angle": "φ", "angular_velocity": "ω", "angular_acceleration": "α", "displacement": "s", "velocity": "v",
    "acceleration": "a", "position": "", "effort": "", "magnitude": "F", "couple": "M",
}  # fmt: skip


def in_shown_unit(name: str) -> tuple[str, float]:
    """Head of a column of results in the unit of tables, and the factor from SI."""
    label, _, unit = name.removesuffix("]").rpartition(" [")
    shown, factor = _UNITS.get(unit, (unit, 1.0))
    return f"{short(label)} / {shown}", factor


def short(label: str) -> str:
    """A result's name with the symbols of the books: ``φ crank``, ``x B``, ``F O on crank``."""
    on = re.fullmatch(r"(.+) on (.+)\.(magnitude|couple|x|y)", label)
    if on:
        letter = {"magnitude": "F", "couple": "M", "x": "Fx", "y": "Fy"}[on[3]]
        return f"{letter} {on[1]}→{on[2]}"
    subject, _, what = label.partition(".")
    kind, _, axis = what.rpartition(".") if what.endswith((".x", ".y")) else (what, "", "")
    if kind == "position":
        return f"{axis} {subject}"
    if _SYMBOLS.get(kind):
        return f"{_SYMBOLS[kind]}{axis} {subject}"
    return label


def column(values: Floats) -> list[str]:
    """Numbers of one column with the same decimals, as many as the largest needs for six digits."""
    known = np.abs(values[np.isfinite(values)])
    largest = float(known.max()) if len(known) else 0.0
    if largest and not 1e-4 <= largest < 1e9:
        return [f"{value:.5e}" if math.isfinite(value) else "–" for value in values]
    place = max(DIGITS - 1 - math.floor(math.log10(largest)), 0) if largest else 0
    place = min(place, 6)
    return [_plain(float(value), place) for value in values]


def _plain(value: float, place: int) -> str:
    if not math.isfinite(value):
        return "–"
    text = f"{value:.{place}f}"
    return text.removeprefix("-") if float(text) == 0.0 else text.replace("-", "−")
