"""Graphical scales of a cam's sheet and how they are printed."""

from __future__ import annotations

import numpy as np

from linkwright.pictures.picture import Runs, indexed, joined


def plain(value: float, digits: int = 4) -> str:
    """A number as sheets print it: few digits, no exponent, a true minus, no rounding noise."""
    if abs(value) < 1e-12:
        return "0"
    return np.format_float_positional(value, digits, fractional=False, trim="-").replace("-", "−")


def fixed(value: float, decimals: int = 2) -> str:
    """A number with as many decimals as its column has."""
    text = f"{value:.{decimals}f}"
    return text.lstrip("-") if float(text) == 0 else text.replace("-", "−")


def equal(symbol: Runs, value: float, unit: str, digits: int = 4) -> Runs:
    """``r₀ = 40.43 mm``"""
    gap = "" if unit in ("", "°") else " "
    return joined(symbol, f" = {plain(value, digits)}{gap}{unit}")


def graphical(index: str, value: float, unit: str) -> Runs:
    """``μ_s = 0.5 mm/mm``: a quantity per millimetre of paper; ``unit`` empty for a plain number."""
    over = f"({unit})/mm" if "/" in unit else f"{unit}/mm"
    gap = "" if over[0] in "°/" else " "
    return joined(indexed("μ", index), f" = {plain(value)}{gap}{over}")
