"""Values that record what is done to them: one formula, written once, becomes one straight-line program.

A kernel is a plain Python function over values that know ``+ - * / sqrt`` and selection.
Called with numbers it computes; called with values of a :class:`Trace` it is written down.
Equal operations on equal arguments are recorded once, and what is known at tracing time
(zeros, ones, constants) is folded away.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Literal, overload

Number = float | int
Kind = Literal["constant", "parameter", "position", "field", "state", "operation"]

#: Operations that yield a truth value instead of a number.
COMPARISONS = frozenset({"less", "less_equal", "and", "or", "not"})
COMMUTATIVE = frozenset({"add", "mul", "and", "or"})


@dataclass(frozen=True, slots=True)
class Node:
    """One line of a program: an input, a constant, or an operation on earlier lines."""

    op: str
    args: tuple[int, ...] = ()
    constant: float = 0.0
    name: str = ""
    varies: bool = False  # differs from position to position (else one value per design)


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

    def __or__(self, other: Mask) -> Mask:
        return self.trace.logic("or", self, other)

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
        return f"Value({self.index}: {self.trace.nodes[self.index].op})"


Scalar = Value | float
Mask = Value | bool


@dataclass
class Trace:
    """The lines written so far, with equal lines shared."""

    nodes: list[Node] = field(default_factory=list)
    _known: dict[tuple[object, ...], int] = field(default_factory=dict)

    # inputs -------------------------------------------------------------------------------
    def parameter(self, name: str) -> Value:
        """One number per design (a length, a mass, the sign of an assembly mode)."""
        return self._line(Node("parameter", name=name))

    def position(self, name: str) -> Value:
        """One number per position, the same for all designs (the input's sine)."""
        return self._line(Node("position", name=name, varies=True))

    def field_input(self, name: str) -> Value:
        """One number per design and position (a load found from an earlier result)."""
        return self._line(Node("field", name=name, varies=True))

    def state(self, name: str) -> Value:
        """A number carried from one position to the next (the start of an iteration)."""
        return self._line(Node("state", name=name, varies=True))

    # operations ---------------------------------------------------------------------------
    def add(self, a: Scalar, b: Scalar) -> Scalar:
        if _is(a, 0.0):
            return b
        if _is(b, 0.0):
            return a
        if isinstance(a, float | int) and isinstance(b, float | int):
            return a + b
        negated = self._negated(b)
        if negated is not None:
            return self.sub(a, negated)
        negated = self._negated(a)
        if negated is not None:
            return self.sub(b, negated)
        return self._operation("add", a, b)

    def sub(self, a: Scalar, b: Scalar) -> Scalar:
        if _is(b, 0.0):
            return a
        if _is(a, 0.0):
            return self.neg(b)
        if isinstance(a, float | int) and isinstance(b, float | int):
            return a - b
        if _same(a, b):
            return 0.0
        negated = self._negated(b)
        if negated is not None:
            return self.add(a, negated)
        negated = self._negated(a)
        if negated is not None:
            return self.neg(self.add(negated, b))
        return self._operation("sub", a, b)

    def mul(self, a: Scalar, b: Scalar) -> Scalar:
        if _is(a, 0.0) or _is(b, 0.0):
            return 0.0
        if _is(a, 1.0):
            return b
        if _is(b, 1.0):
            return a
        if _is(a, -1.0):
            return self.neg(b)
        if _is(b, -1.0):
            return self.neg(a)
        if isinstance(a, float | int) and isinstance(b, float | int):
            return a * b
        left, right = self._negated(a), self._negated(b)
        if left is not None and right is not None:
            return self.mul(left, right)
        if left is not None:
            return self.neg(self.mul(left, b))
        if right is not None:
            return self.neg(self.mul(a, right))
        return self._operation("mul", a, b)

    def div(self, a: Scalar, b: Scalar) -> Scalar:
        if _is(b, 1.0):
            return a
        if _is(a, 0.0):
            return 0.0
        if isinstance(a, float | int) and isinstance(b, float | int):
            return a * reciprocal(b) if b == 0 else a / b
        if _same(a, b):
            return 1.0
        if isinstance(b, float | int):
            return self.mul(a, reciprocal(b))
        return self._operation("div", a, b)

    def neg(self, a: Scalar) -> Scalar:
        if isinstance(a, float | int):
            return -a
        negated = self._negated(a)
        return negated if negated is not None else self._operation("neg", a)

    def unary(self, op: str, a: Scalar) -> Scalar:
        """``sqrt``, ``abs``, ``sin``, ``cos``; ``stop``: the value, taken as constant by derivatives."""
        if isinstance(a, float | int):
            return _UNARY[op](float(a))
        return self._operation(op, a)

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
        return self._line(Node("constant", constant=float(value))).index

    def _operation(self, op: str, *values: Scalar | bool) -> Value:
        args = tuple(self.lift(value) for value in values)
        if op in COMMUTATIVE and args[0] > args[1]:
            args = (args[1], args[0])
        varies = any(self.nodes[i].varies for i in args)
        return self._line(Node(op, args, varies=varies))

    def _line(self, node: Node) -> Value:
        key = (node.op, node.args, repr(node.constant), node.name)
        index = self._known.get(key)
        if index is None:
            index = self._known[key] = len(self.nodes)
            self.nodes.append(node)
        return Value(self, index)

    def _negated(self, value: Scalar) -> Value | None:
        """The value under a negation, if the last operation was one."""
        if not isinstance(value, Value):
            return None
        node = self.nodes[value.index]
        return Value(self, node.args[0]) if node.op == "neg" else None


def _is(value: object, number: float) -> bool:
    return isinstance(value, float | int) and not isinstance(value, bool) and value == number


def _same(a: object, b: object) -> bool:
    return isinstance(a, Value) and isinstance(b, Value) and a.index == b.index and a.trace is b.trace


_UNARY: dict[str, Callable[[float], float]] = {
    "sqrt": lambda x: math.sqrt(x) if x >= 0.0 else math.nan,
    "abs": abs,
    "sin": math.sin,
    "cos": math.cos,
    "stop": lambda x: x,
}


def _apply(op: str, x: Scalar) -> Scalar:
    if isinstance(x, Value):
        return x.trace.unary(op, x)
    return _UNARY[op](x)


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


def sin(x: Scalar) -> Scalar:
    """Sine, for numbers known once per design."""
    return _apply("sin", x)


def cos(x: Scalar) -> Scalar:
    """Cosine, for numbers known once per design."""
    return _apply("cos", x)


def stop(x: Scalar) -> Scalar:
    """The value itself, which derivatives take as a constant."""
    return _apply("stop", x)


@overload
def select(condition: bool, a: float, b: float) -> float: ...
@overload
def select(condition: Mask, a: Scalar, b: Scalar) -> Scalar: ...
def select(condition: Mask, a: Scalar, b: Scalar) -> Scalar:
    """``a`` where the condition holds, else ``b``."""
    if isinstance(condition, Value):
        return condition.trace.select(condition, a, b)
    return a if condition else b


def maximum(a: Scalar, b: Scalar) -> Scalar:
    """The larger of two numbers."""
    return select(a < b, b, a)


def minimum(a: Scalar, b: Scalar) -> Scalar:
    """The smaller of two numbers."""
    return select(b < a, b, a)
