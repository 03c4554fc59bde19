"""Expressions of named parameters as traced values."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from linkwright.engine.trace import Scalar, Value, absolute, cos, maximum, minimum, sin, sqrt
from linkwright.errors import LinkwrightError
from linkwright.model.expressions import Expression
from linkwright.words.sentence import Sentence


def traced(expression: Expression, value: Callable[[str], Scalar]) -> Scalar:
    """The expression over traced parameters.

    Raises:
        LinkwrightError: the expression uses a function that the engine does not know.
    """
    names = {name: value(name) for name in expression.names}
    result: Scalar = expression.evaluate(names, _functions(expression))
    return result


def _functions(expression: Expression) -> Mapping[str, Callable[..., Any]]:
    known: dict[str, Callable[..., Any]] = {
        "sin": sin,
        "cos": cos,
        "tan": lambda x: sin(x) / cos(x),
        "sqrt": sqrt,
        "abs": absolute,
        "min": minimum,
        "max": maximum,
        "pow": lambda x, n: _power(expression, x, n),
    }
    for name in ("asin", "acos", "atan", "atan2", "exp", "log", "sign", "step"):
        known[name] = _refusal(expression, name)
    return known


def _power(expression: Expression, base: Scalar, exponent: Scalar) -> Scalar:
    if isinstance(exponent, Value):
        raise LinkwrightError(Sentence("motion.power_varies", text=expression.text))
    whole = round(2 * exponent)
    if abs(2 * exponent - whole) > 1e-12:
        raise LinkwrightError(Sentence("motion.odd_power", text=expression.text, exponent=exponent))
    factor = sqrt(base) if whole % 2 else base
    result: Scalar = 1.0
    for _ in range(abs(whole) if whole % 2 else abs(whole) // 2):
        result = result * factor
    return result if whole >= 0 else 1.0 / result


def _refusal(expression: Expression, name: str) -> Callable[..., Any]:
    def refuse(*_: Any) -> Any:
        raise LinkwrightError(Sentence("motion.no_sweep", text=expression.text, name=name))

    return refuse
