"""Expressions of named values as traced values."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from linkwright.core.expressions import Expression
from linkwright.engine import trace
from linkwright.engine.trace import Scalar

_FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    "sin": trace.sin,
    "cos": trace.cos,
    "tan": trace.tan,
    "asin": trace.asin,
    "acos": trace.acos,
    "atan": trace.atan,
    "atan2": trace.angle,
    "sqrt": trace.sqrt,
    "abs": trace.absolute,
    "exp": trace.exp,
    "log": trace.log,
    "min": trace.minimum,
    "max": trace.maximum,
    "sign": trace.sign,
    "step": lambda x: trace.select(x >= 0.0, 1.0, 0.0),
    "pow": trace.power,
}


def traced(expression: Expression, value: Callable[[str], Scalar]) -> Scalar:
    """The expression over traced values of its names."""
    result: Scalar = expression.evaluate({name: value(name) for name in expression.names}, _FUNCTIONS)
    return result
