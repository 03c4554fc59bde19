"""Values that record what is done to them: one formula, written once, becomes one straight-line program.

A kernel is a plain Python function over values that know ``+ - * /``, the functions of
:mod:`~linkwright.formula.operations`, selection and look-ups in tables.
Called with numbers or arrays of them it computes; called with values of a :class:`Trace` it is written down.
Equal operations on equal arguments are recorded once, and what is known at tracing time
(zeros, ones, constants) is folded away.
"""

from __future__ import annotations

import math
from collections.abc import Container, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, overload

from linkwright.formula.late_import import numpy as np
from linkwright.formula.operations import COMMUTATIVE, FUNCTIONS, Entry, Node, needed

Number = float | int
Operation = tuple[str, *tuple[int, ...]]
#: The constant and the name of a line that has neither.
_NEITHER = (0.0, "")


class Value:
    """A number that is not known yet: a line of a trace."""

    __slots__ = ("index", "trace")
    __array_priority__ = 1000.0

    def __init__(self, trace: Trace, index: int) -> None:
        self.trace = trace
        self.index = index

    def __add__(self, other: Scalar) -> Scalar:
        return self.trace.add(self, other)

    def __radd__(self, other: Scalar) -> Scalar:
        return self.trace.add(other, self)

    def __sub__(self, other: Scalar) -> Scalar:
        return self.trace.sub(self, other)

    def __rsub__(self, other: Scalar) -> Scalar:
        return self.trace.sub(other, self)

    def __mul__(self, other: Scalar) -> Scalar:
        return self.trace.mul(self, other)

    def __rmul__(self, other: Scalar) -> Scalar:
        return self.trace.mul(other, self)

    def __truediv__(self, other: Scalar) -> Scalar:
        return self.trace.div(self, other)

    def __rtruediv__(self, other: Scalar) -> Scalar:
        return self.trace.div(other, self)

    def __neg__(self) -> Scalar:
        return self.trace.neg(self)

    def __pos__(self) -> Value:
        return self

    def __lt__(self, other: Scalar) -> Mask:
        return self.trace.compare("less", self, other)

    def __le__(self, other: Scalar) -> Mask:
        return self.trace.compare("less_equal", self, other)

    def __gt__(self, other: Scalar) -> Mask:
        return self.trace.compare("less", other, self)

    def __ge__(self, other: Scalar) -> Mask:
        return self.trace.compare("less_equal", other, self)

    def __and__(self, other: Mask) -> Mask:
        return self.trace.logic("and", self, other)

    __rand__ = __and__

    def __or__(self, other: Mask) -> Mask:
        return self.trace.logic("or", self, other)

    __ror__ = __or__

    def __invert__(self) -> Mask:
        return self.trace.negate(self)

    def __eq__(self, other: object) -> bool:
        """Whether both are the same line of the same trace (not a comparison of numbers)."""
        return _same(self, other)

    def __hash__(self) -> int:
        return hash((id(self.trace), self.index))

    def __bool__(self) -> bool:
        raise TypeError("a traced value has no truth value yet; use select(condition, a, b)")

    def __repr__(self) -> str:
        return f"Value({self.index}: {self.trace.lines[self.index][0]})"


Scalar = Value | float
Mask = Value | bool


@dataclass
class Trace:
    """The lines written so far, with equal lines shared.

    ``lines``: operations, each with the numbers of the lines that it takes; ``varies``: whether they differ from
    position to position.
    """

    lines: list[Operation] = field(default_factory=list)
    varies: list[bool] = field(default_factory=list)
    _constants: dict[int, tuple[float, str]] = field(default_factory=dict)
    _known: dict[tuple[object, ...], int] = field(default_factory=dict)

    def node(self, index: int) -> Node:
        """A line by its number."""
        line = self.lines[index]
        return Node(line[0], line[1:], *self._constants.get(index, _NEITHER), self.varies[index])

    def constant_and_name(self, index: int) -> tuple[float, str]:
        """The constant and the name of a line."""
        return self._constants.get(index, _NEITHER)

    def entry(self, index: int, number: Mapping[int, int]) -> Entry:
        """A line whose arguments have other numbers."""
        line = self.lines[index]
        constant, name = self._constants.get(index, _NEITHER)
        return line[0], tuple([number[i] for i in line[1:]]), constant, name, self.varies[index]

    def needed(self, wanted: Iterable[int], stop: Container[int] = ()) -> list[int]:
        """The lines that the wanted ones are found from, in order; what is behind ``stop`` is left out."""
        lines = self.lines
        return needed(lambda index: lines[index][1:], wanted, stop)

    # inputs -------------------------------------------------------------------------------
    def parameter(self, name: str) -> Value:
        """One number per design (a length, a mass, the sign of an assembly mode)."""
        return self._line("parameter", name=name)

    def position(self, name: str) -> Value:
        """One number per position, the same for all designs (the input's sine)."""
        return self._line("position", name=name, varies=True)

    def field_input(self, name: str) -> Value:
        """One number per design and position (a load found from an earlier result, the start of an iteration)."""
        return self._line("field", name=name, varies=True)

    # operations ---------------------------------------------------------------------------
    def add(self, a: Scalar, b: Scalar) -> Scalar:
        if not isinstance(b, Value):
            if b == 0.0:
                return a
            if not isinstance(a, Value):
                return a + b
        elif not isinstance(a, Value) and a == 0.0:
            return b
        negated = self._negated(b)
        if negated is not None:
            return self.sub(a, negated)
        negated = self._negated(a)
        if negated is not None:
            return self.sub(b, negated)
        return self._pair("add", a, b)

    def sub(self, a: Scalar, b: Scalar) -> Scalar:
        if not isinstance(b, Value):
            if b == 0.0:
                return a
            if not isinstance(a, Value):
                return a - b
        elif not isinstance(a, Value):
            if a == 0.0:
                return self.neg(b)
        elif _same(a, b):
            return 0.0
        negated = self._negated(b)
        if negated is not None:
            return self.add(a, negated)
        negated = self._negated(a)
        if negated is not None:
            return self.neg(self.add(negated, b))
        return self._pair("sub", a, b)

    def mul(self, a: Scalar, b: Scalar) -> Scalar:
        if not isinstance(b, Value):
            if not isinstance(a, Value):
                return a * b if a and b else 0.0
            a, b = b, a
        if not isinstance(a, Value):
            if a == 0.0 or a == 1.0:
                return b if a else 0.0
            if a == -1.0:
                return self.neg(b)
        left, right = self._negated(a), self._negated(b)
        if left is None and right is None:
            return self._pair("mul", a, b)
        if left is not None and right is not None:
            return self.mul(left, right)
        return self.neg(self.mul(a if left is None else left, b if right is None else right))

    def div(self, a: Scalar, b: Scalar) -> Scalar:
        if not isinstance(b, Value):
            if b == 1.0:
                return a
            if not isinstance(a, Value):
                return a / b if b else (a * math.inf if a else 0.0)
            return self.mul(a, reciprocal(b))
        if not isinstance(a, Value):
            if a == 0.0:
                return 0.0
        elif _same(a, b):
            return 1.0
        return self._pair("div", a, b)

    def neg(self, a: Scalar) -> Scalar:
        if isinstance(a, float | int):
            return -a
        index = a.index
        line = self.lines[index]
        if line[0] == "neg":
            return Value(self, line[1:][0])
        known = self._known.get(("neg", index))
        return self._operation("neg", a) if known is None else Value(self, known)

    def stop(self, a: Scalar) -> Scalar:
        """The value, taken as constant by derivatives."""
        return self._operation("stop", a) if isinstance(a, Value) else a

    def function(self, op: str, *args: Scalar) -> Scalar:
        """A function of :data:`~linkwright.formula.operations.FUNCTIONS`."""
        if any(isinstance(a, Value) for a in args):
            return self._operation(op, *args)
        return FUNCTIONS[op].value(*(float(a) for a in args if not isinstance(a, Value)))

    def power(self, a: Scalar, b: Scalar) -> Scalar:
        """a to the power b; a small integer power is a product, a half one a root."""
        if not isinstance(b, Value) and abs(b) <= _LARGEST_PRODUCT and float(b).is_integer():
            product: Scalar = 1.0
            for bit in bin(int(abs(b)))[2:]:
                product = self.mul(product, product)
                product = self.mul(product, a) if bit == "1" else product
            return product if b >= 0 else self.div(1.0, product)
        return self.function("sqrt", a) if _is(b, 0.5) else self.function("pow", a, b)

    def lookup(self, table: str, x: Scalar, order: int = 0) -> Scalar:
        """A table's value at x, or its derivative; the table itself is passed with every call."""
        if order >= _CONSTANT_DERIVATIVES:
            return 0.0
        at = self.lift(x)
        return self._line("lookup", (at,), float(order), table, self.varies[at])

    def compare(self, op: str, a: Scalar, b: Scalar) -> Mask:
        if isinstance(a, float | int) and isinstance(b, float | int):
            return a < b if op == "less" else a <= b
        return self._operation(op, a, b)

    def logic(self, op: str, a: Mask, b: Mask) -> Mask:
        for one, other in ((a, b), (b, a)):
            if isinstance(one, bool):
                if op == "and":
                    return other if one else False
                return True if one else other
        return self._operation(op, a, b)

    def negate(self, a: Mask) -> Mask:
        return (not a) if isinstance(a, bool) else self._operation("not", a)

    def select(self, condition: Mask, a: Scalar, b: Scalar) -> Scalar:
        if isinstance(condition, bool):
            return a if condition else b
        if _same(a, b):
            return a
        return self._operation("select", condition, a, b)

    # bookkeeping --------------------------------------------------------------------------
    def lift(self, value: Scalar | bool) -> int:
        """The line number of a value; a number becomes a constant line."""
        if isinstance(value, Value):
            if value.trace is not self:
                raise ValueError("values of two different traces cannot be combined")
            return value.index
        return self._line("constant", constant=float(value)).index

    def _pair(self, op: str, a: Scalar, b: Scalar) -> Value:
        """An operation on two numbers."""
        i, j = self.lift(a), self.lift(b)
        if i > j and op in COMMUTATIVE:
            i, j = j, i
        key = (op, i, j)
        index = self._known.get(key)
        if index is None:
            varies = self.varies
            index = self._known[key] = len(varies)
            self.lines.append(key)
            varies.append(varies[i] or varies[j])
        return Value(self, index)

    def _operation(self, op: str, *values: Scalar | bool) -> Value:
        if len(values) == 2:
            return self._pair(op, *values)
        args = tuple([self.lift(value) for value in values])
        key: Operation = (op, *args)
        index = self._known.get(key)
        if index is None:
            varies = self.varies
            index = self._known[key] = len(varies)
            self.lines.append(key)
            varies.append(any(varies[i] for i in args))
        return Value(self, index)

    def _line(
        self, op: str, args: tuple[int, ...] = (), constant: float = 0.0, name: str = "", varies: bool = False
    ) -> Value:
        key = (op, name, *args, repr(constant))
        index = self._known.get(key)
        if index is None:
            index = self._known[key] = len(self.lines)
            self.lines.append((op, *args))
            self.varies.append(varies)
            self._constants[index] = constant, name
        return Value(self, index)

    def _negated(self, value: Scalar) -> Value | None:
        """The value under a negation, if the last operation was one."""
        if isinstance(value, Value):
            line = self.lines[value.index]
            if line[0] == "neg":
                return Value(self, line[1:][0])
        return None


def _is(value: object, number: float) -> bool:
    return isinstance(value, float | int) and not isinstance(value, bool) and value == number


def _same(a: object, b: object) -> bool:
    return isinstance(a, Value) and isinstance(b, Value) and a.index == b.index and a.trace is b.trace


#: Integer powers up to this one are products.
_LARGEST_PRODUCT = 8
#: Derivatives of a cubic of this order and above are zero.
_CONSTANT_DERIVATIVES = 4


def _apply(op: str, *args: Scalar) -> Scalar:
    for x in args:
        if isinstance(x, Value):
            return x.trace.function(op, *args)
    function = FUNCTIONS[op]
    if all(isinstance(x, float | int) for x in args):
        return function.value(*args)
    found: float = getattr(np, function.ufunc)(*args)
    return found


def sqrt(x: Scalar) -> Scalar:
    """Square root; NaN for a negative number."""
    return _apply("sqrt", x)


def reciprocal(x: Scalar) -> Scalar:
    """One over a number; infinite for zero, known or not."""
    if isinstance(x, Value):
        return 1.0 / x
    return 1.0 / x if x else math.inf


def absolute(x: Scalar) -> Scalar:
    """Absolute value."""
    return _apply("abs", x)


def floor(x: Scalar) -> Scalar:
    """The largest integer that is not above x; its derivative is zero."""
    return _apply("floor", x)


def sin(x: Scalar) -> Scalar:
    """Sine of an angle in radians."""
    return _apply("sin", x)


def cos(x: Scalar) -> Scalar:
    """Cosine of an angle in radians."""
    return _apply("cos", x)


def tan(x: Scalar) -> Scalar:
    """Tangent of an angle in radians."""
    return _apply("tan", x)


def asin(x: Scalar) -> Scalar:
    """Arc sine, -π/2 to π/2; NaN beyond ±1."""
    return _apply("asin", x)


def acos(x: Scalar) -> Scalar:
    """Arc cosine, 0 to π; NaN beyond ±1."""
    return _apply("acos", x)


def atan(x: Scalar) -> Scalar:
    """Arc tangent, -π/2 to π/2."""
    return _apply("atan", x)


def angle(y: Scalar, x: Scalar) -> Scalar:
    """Direction of (x, y) from the x axis, counter-clockwise, -π to π (the function atan2)."""
    return _apply("atan2", y, x)


def exp(x: Scalar) -> Scalar:
    """Exponential."""
    return _apply("exp", x)


def log(x: Scalar) -> Scalar:
    """Natural logarithm; -∞ for zero, NaN for a negative number."""
    return _apply("log", x)


def power(a: Scalar, b: Scalar) -> Scalar:
    """a to the power b; NaN for a negative base and a power that is not an integer."""
    for x in (a, b):
        if isinstance(x, Value):
            return x.trace.power(a, b)
    return _apply("pow", a, b)


def lookup(table: str, x: Value, order: int = 0) -> Scalar:
    """Value at x of the named table, or its derivative (see :class:`~linkwright.formula.table.Table`)."""
    return x.trace.lookup(table, x, order)


def stop(x: Scalar) -> Scalar:
    """The value itself, which derivatives take as a constant."""
    return x.trace.stop(x) if isinstance(x, Value) else x


@overload
def select(condition: bool, a: float, b: float) -> float: ...
@overload
def select(condition: Mask, a: Scalar, b: Scalar) -> Scalar: ...
def select(condition: Mask, a: Scalar, b: Scalar) -> Scalar:
    """``a`` where the condition holds, else ``b``."""
    if isinstance(condition, Value):
        return condition.trace.select(condition, a, b)
    if getattr(condition, "shape", ()):
        choices: Any = a, b
        chosen: float = np.where(condition, *choices)
        return chosen
    return a if condition else b


def maximum(a: Scalar, b: Scalar) -> Scalar:
    """The larger of two numbers."""
    return select(a < b, b, a)


def minimum(a: Scalar, b: Scalar) -> Scalar:
    """The smaller of two numbers."""
    return select(b < a, b, a)


def sign(x: Scalar) -> Scalar:
    """1, -1, or 0 for zero; NaN for NaN; its derivative is zero."""
    return select(x > 0.0, 1.0, select(x < 0.0, -1.0, stop(x)))


def nearest_turn(x: Scalar, reference: Scalar) -> Scalar:
    """The angle x shifted by full turns to be nearest to a reference, at most half a turn off."""
    return x + math.tau * floor((reference - x) * (1.0 / math.tau) + 0.5)
