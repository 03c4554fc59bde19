"""Equations of worked solutions whose formulas are texts rather than terms."""

from __future__ import annotations

from linkwright.parts.display import number, unit
from linkwright.worked.page import Equation, Step


def put(
    step: Step, symbol: str, formula: str, value: float, dimension: str = "", *, numbers: str = ""
) -> None:
    """Adds a result: symbol, formula, the formula with its numbers, and the value (SI) in the shown unit."""
    shown = number(value, dimension)
    step.items.append(
        Equation(symbol, symbol, formula, formula, numbers, numbers, shown, unit(dimension), value)
    )
