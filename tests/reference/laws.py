"""Driver laws of a mechanism, evaluated from their plain data: constant speed, table, expression of the time.

Expressions are read with Python's own grammar and differentiated by truncated Taylor series.
"""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline, PPoly
from tests.reference.multibody import Array

UNITS = {
    "deg": math.pi / 180,
    "°": math.pi / 180,
    "rad": 1.0,
    "m": 1.0,
    "mm": 1e-3,
    "cm": 1e-2,
    "s": 1.0,
    "ms": 1e-3,
    "min": 60.0,
    "rpm": math.pi / 30,
    "Hz": 1.0,
    "N": 1.0,
    "kN": 1e3,
}


@dataclass(frozen=True)
class Taylor:
    """A function of the time by value, first and second derivative."""

    f: Array
    d: Array
    dd: Array

    def __add__(self, o: Taylor) -> Taylor:
        return Taylor(self.f + o.f, self.d + o.d, self.dd + o.dd)

    def __neg__(self) -> Taylor:
        return Taylor(-self.f, -self.d, -self.dd)

    def __mul__(self, o: Taylor) -> Taylor:
        return Taylor(self.f * o.f, self.d * o.f + self.f * o.d, self.dd * o.f + 2 * self.d * o.d + self.f * o.dd)

    def through(self, f: Array, first: Array, second: Array) -> Taylor:
        return Taylor(f, first * self.d, second * self.d**2 + first * self.dd)

    def power(self, n: float) -> Taylor:
        x = self.f
        return self.through(x**n, n * x ** (n - 1), n * (n - 1) * x ** (n - 2) if n not in (0, 1) else 0 * x)


def _sqrt(x: Taylor) -> Taylor:
    return x.power(0.5)


def _sin(x: Taylor) -> Taylor:
    return x.through(np.sin(x.f), np.cos(x.f), -np.sin(x.f))


def _cos(x: Taylor) -> Taylor:
    return x.through(np.cos(x.f), -np.sin(x.f), -np.cos(x.f))


def _exp(x: Taylor) -> Taylor:
    return x.through(np.exp(x.f), np.exp(x.f), np.exp(x.f))


FUNCTIONS = {"sqrt": _sqrt, "sin": _sin, "cos": _cos, "exp": _exp}


def taylor(text: str, values: Mapping[str, float | Array], t: Array) -> Taylor:
    """The expression `text` of t (s) and named values, with its derivatives at the times t."""
    one = np.ones_like(t)
    names = {name: Taylor(value * one, 0 * one, 0 * one) for name, value in {**values, "pi": math.pi}.items()}
    names["t"] = Taylor(t, one, 0 * one)
    return _value(_parsed(text), names, one)


@lru_cache(maxsize=100)
def _parsed(text: str) -> ast.expr:
    unit = "|".join(sorted(map(re.escape, UNITS), key=len, reverse=True))
    numbers = r"(?<![\w.])(\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+)"
    prepared = re.sub(rf"{numbers}\s+({unit})\b", lambda m: f"({m[1]}*{UNITS[m[2]]!r})", text)
    return ast.parse(prepared.replace("^", "**"), mode="eval").body


def _value(node: ast.expr, names: Mapping[str, Taylor], one: Array) -> Taylor:
    match node:
        case ast.Constant(value=float() | int() as number):
            return Taylor(number * one, 0 * one, 0 * one)
        case ast.Name(id=name):
            return names[name]
        case ast.UnaryOp(op=ast.USub(), operand=inner):
            return -_value(inner, names, one)
        case ast.Call(func=ast.Name(id=name), args=[inner]):
            return FUNCTIONS[name](_value(inner, names, one))
        case ast.BinOp(left=left, op=ast.Pow(), right=right):
            return _value(left, names, one).power(float(_value(right, names, one).f[0]))
        case ast.BinOp(left=left, op=op, right=right):
            a, b = _value(left, names, one), _value(right, names, one)
            return _combined(op, a, b)
    raise ValueError(f"not understood: {ast.dump(node)}")


def _combined(op: ast.operator, a: Taylor, b: Taylor) -> Taylor:
    match op:
        case ast.Add():
            return a + b
        case ast.Sub():
            return a + -b
        case ast.Mult():
            return a * b
        case ast.Div():
            return a * b.power(-1)
    raise ValueError(f"not understood: {ast.dump(op)}")


def law_values(law: Any, t: Array) -> Taylor:
    """Coordinate of a driver law with its derivatives at the times t (n,)."""
    if hasattr(law, "speed"):
        return Taylor(law.start + law.speed * t, law.speed + 0 * t, 0 * t)
    if hasattr(law, "times"):
        return _table(np.array(law.times), np.array(law.positions), law.interpolation, t)
    return taylor(law.expression.text, law.parameters, t)


def _table(times: Array, positions: Array, interpolation: str, t: Array) -> Taylor:
    value, first, second, drift = _pieces(tuple(times), tuple(positions), interpolation)
    return Taylor(value(t) + drift * (t - times[0]), first(t) + drift, second(t))


@lru_cache(maxsize=100)
def _pieces(times: tuple[float, ...], positions: tuple[float, ...], interpolation: str) -> Any:
    """Piecewise polynomials of value, slope and curvature, and the slope of what is added to them."""
    x, y, drift = np.array(times), np.array(positions), 0.0
    if interpolation == "linear":
        pieces: Any = PPoly(np.array([np.diff(y) / np.diff(x), y[:-1]]), x)
    elif interpolation == "periodic":
        drift = (y[-1] - y[0]) / (x[-1] - x[0])
        rest = y - drift * (x - x[0])
        pieces = CubicSpline(x, np.append(rest[:-1], rest[0]), bc_type="periodic")
    else:
        pieces = CubicSpline(x, y)
    return pieces, pieces.derivative(1), pieces.derivative(2), drift


def kinks(law: Any) -> list[float]:
    """Times at which the law's velocity jumps."""
    return list(law.times[1:-1]) if getattr(law, "interpolation", "") == "linear" else []
