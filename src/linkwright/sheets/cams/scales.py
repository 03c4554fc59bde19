"""Graphical scales of a cam's sheet and how they are printed."""

from __future__ import annotations

from linkwright.core.quantity import significant
from linkwright.pictures.picture import Runs, indexed, joined


def equal(symbol: Runs, value: float, unit: str, digits: int = 4) -> Runs:
    """``r₀ = 40.43 mm``"""
    gap = "" if unit in ("", "°") else " "
    return joined(symbol, f" = {significant(value, digits)}{gap}{unit}")


def graphical(index: str, value: float, unit: str) -> Runs:
    """``μ_s = 0.5 mm/mm``: a quantity per millimetre of paper; ``unit`` empty for a plain number."""
    over = f"({unit})/mm" if "/" in unit else f"{unit}/mm"
    gap = "" if over[0] in "°/" else " "
    return joined(indexed("μ", index), f" = {significant(value)}{gap}{over}")
