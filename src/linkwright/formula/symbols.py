"""Symbols of a trace: inputs that only stand for other values until these are substituted."""

from __future__ import annotations

from collections.abc import Container

from linkwright.formula.tangent import slope
from linkwright.formula.trace import Scalar, Trace, Value


class Symbols:
    """The symbols of the equations in a trace, which all share the same ones, and with them their derivatives."""

    def __init__(self, trace: Trace) -> None:
        self.trace = trace
        self._all: list[Value] = []
        self._in: dict[int, tuple[Value, ...]] = {}
        self._slopes: dict[tuple[int, int], Scalar] = {}

    def number(self, k: int) -> Value:
        """The symbol of a number, from 0."""
        while len(self._all) <= k:
            self._all.append(self.trace.position(f"~{len(self._all)}"))
        return self._all[k]

    def derivatives(self, value: Scalar, moving: Container[int]) -> list[tuple[int, Scalar]]:
        """Those of a value by the symbols in it that are ``moving``, all by the numbers of their lines."""
        if not isinstance(value, Value):
            return []
        if value.index not in self._in:
            needed = set(self.trace.needed([value.index]))
            self._in[value.index] = tuple(symbol for symbol in self._all if symbol.index in needed)
        found = self._in[value.index]
        return [(symbol.index, self._slope(value, symbol)) for symbol in found if symbol.index in moving]

    def _slope(self, value: Value, symbol: Value) -> Scalar:
        key = value.index, symbol.index
        if key not in self._slopes:
            self._slopes[key] = slope(value, {symbol: 1.0})
        return self._slopes[key]
