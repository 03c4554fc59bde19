"""The tree of an expression: its value and its dimension."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from linkwright import units
from linkwright.errors import QuantityError
from linkwright.words import Message, _

_OF_TWO = ("atan2", "min", "max")
_OF_ONE = ("sin", "cos", "tan", "asin", "acos", "atan", "sqrt", "abs", "exp", "log", "sign", "step")
ARITY: Mapping[str, int] = {**dict.fromkeys(_OF_ONE, 1), **dict.fromkeys(_OF_TWO, 2)}
_FROM_ANGLE, _TO_ANGLE = ("sin", "cos", "tan"), ("asin", "acos", "atan")
_ANGLE = units.DIMENSIONS["angle"]


@dataclass(frozen=True)
class Number:
    """A constant in SI with its dimension."""

    value: float
    dimension: units.Dimension = units.NONE
    column: int = 0


@dataclass(frozen=True)
class Variable:
    """A free name."""

    name: str
    column: int = 0


@dataclass(frozen=True)
class Negative:
    """Minus an operand."""

    operand: Node
    column: int = 0


@dataclass(frozen=True)
class Binary:
    """Two operands joined by ``+ - * / ^``."""

    sign: str
    left: Node
    right: Node
    column: int = 0


@dataclass(frozen=True)
class Call:
    """A function of ARITY applied to arguments."""

    function: str
    arguments: tuple[Node, ...]
    column: int = 0


Node = Number | Variable | Negative | Binary | Call


@cache
def scalar_functions() -> Mapping[str, Callable[..., Any]]:
    """The functions of the language on floats; ``step(x)`` is 1 from x = 0 on."""
    own: dict[str, Callable[..., Any]] = {"abs": abs, "min": min, "max": max, "pow": pow}
    own |= {"sign": lambda x: (x > 0) - (x < 0), "step": lambda x: 1.0 if x >= 0 else 0.0}
    return functions_of(math, own)


def functions_of(module: object, own: Mapping[str, Callable[..., Any]]) -> Mapping[str, Callable[..., Any]]:
    """The functions of the language, and ``pow`` of powers: ``own`` ones, else those of a module."""
    return {name: own.get(name) or getattr(module, name) for name in (*ARITY, "pow")}


def evaluate(node: Node, values: Mapping[str, Any], functions: Mapping[str, Callable[..., Any]]) -> Any:
    """Value of a tree on values of any type; powers with integer exponents are products."""
    match node:
        case Number(value):
            return value
        case Variable(name):
            return values[name]
        case Negative(operand):
            return -evaluate(operand, values, functions)
        case Call(function, arguments):
            return functions[function](*(evaluate(argument, values, functions) for argument in arguments))
        case Binary("^", base, Number(exponent)) if exponent == int(exponent) and abs(exponent) <= 12:
            return _integer_power(evaluate(base, values, functions), int(exponent))
        case Binary("^", base, Number(0.5)):
            return functions["sqrt"](evaluate(base, values, functions))
    left, right = evaluate(node.left, values, functions), evaluate(node.right, values, functions)
    match node.sign:
        case "+":
            return left + right
        case "-":
            return left - right
        case "*":
            return left * right
        case "/":
            return left / right
    return functions["pow"](left, right)


def _integer_power(base: Any, exponent: int) -> Any:
    if exponent == 0:
        return 1.0
    product = base
    for _unused in range(abs(exponent) - 1):
        product = product * base
    return product if exponent > 0 else 1.0 / product


def denominators(node: Node) -> Iterator[Node]:
    """All that an expression divides by; the cosine for a tangent."""
    match node:
        case Negative(operand):
            yield from denominators(operand)
        case Call(function, arguments):
            if function == "tan":
                yield Call("cos", arguments)
            for argument in arguments:
                yield from denominators(argument)
        case Binary(sign, left, right):
            if sign == "/":
                yield right
            if sign == "^" and (isinstance(right, Negative) or (isinstance(right, Number) and right.value < 0)):
                yield left
            yield from denominators(left)
            yield from denominators(right)


def dimension_of(node: Node, kinds: Mapping[str, units.Dimension]) -> units.Dimension:
    """Dimension of a tree; raises QuantityError with the column where dimensions do not fit."""
    match node:
        case Number(_, dimension):
            return dimension
        case Variable(name):
            return kinds[name]
        case Negative(operand):
            return dimension_of(operand, kinds)
        case Call(function, arguments, column):
            return _call_dimension(function, arguments, kinds, column)
        case Binary("^", base, exponent, column):
            return _power_dimension(base, exponent, kinds, column)
        case Binary("*" | "/" as sign, left, right):
            return units.times(dimension_of(left, kinds), dimension_of(right, kinds), 1 if sign == "*" else -1)
    word = "added" if node.sign == "+" else "subtracted"
    return _common_dimension((node.left, node.right), kinds, node.column, word)


class Derived(tuple[float, float, float, float, float]):
    """The dimension of a name whose value is a product of several quantities, see :func:`derived`."""


def derived(node: Node, kinds: Mapping[str, units.Dimension]) -> bool:
    """Whether a radian may be left out of a tree's dimension or be added to it: in a product of several quantities
    (``r*phi``, ``P/omega``, ``sqrt(k/m)``), and where pi says that radians are meant (``2*pi*f``); not in one
    quantity or a multiple of it (``2*f``, ``1/T``)."""
    match node:
        case Number(value):
            return value == math.pi
        case Variable(name):
            return isinstance(kinds[name], Derived)
        case Negative(operand) | Binary("^", operand):
            return derived(operand, kinds)
        case Call("sqrt" | "abs" | "min" | "max", arguments):
            return all(derived(each, kinds) for each in arguments)
        case Binary("+" | "-", left, right):
            return derived(left, kinds) and derived(right, kinds)
        case Binary("*" | "/", left, right):
            both = units.NONE not in (dimension_of(left, kinds), dimension_of(right, kinds))
            return both or derived(left, kinds) or derived(right, kinds)
    return False


_CANNOT_BE = {
    "added": _("{right} cannot be added to {left}"),
    "subtracted": _("{right} cannot be subtracted from {left}"),
    "compared": _("{right} cannot be compared with {left}"),
    "opposed": _("{right} cannot be set against {left}"),
}


def _common_dimension(
    nodes: tuple[Node, ...], kinds: Mapping[str, units.Dimension], column: int, word: str
) -> units.Dimension:
    left, right = (dimension_of(node, kinds) for node in nodes)
    for node, other in zip(nodes, (right, left), strict=True):
        if isinstance(node, Number) and node.value == 0 and node.dimension == units.NONE:
            return other
    if left == right:
        return left
    if units.nearly(left, right):
        loose = [derived(node, kinds) for node in nodes]
        if any(loose):
            return left if loose[1] else right
    bare = any(isinstance(node, Number) and node.dimension == units.NONE for node in nodes)
    if {left, right} == {units.NONE, _ANGLE} and not bare:
        return _ANGLE
    values = {"right": units.name_of(right), "left": units.name_of(left)}
    raise _wrong(_CANNOT_BE[word], column, _("give both the same dimension"), **values)


def _wrong(message: Message, column: int, remedy: Message, **values: object) -> QuantityError:
    """The error about a dimension, with the values of its text."""
    return QuantityError(message.format(**values), remedy, column=column, code="wrong-dimension")


def _power_dimension(
    base: Node, exponent: Node, kinds: Mapping[str, units.Dimension], column: int
) -> units.Dimension:
    if dimension_of(exponent, kinds) != units.NONE:
        raise _wrong(_("an exponent has a unit"), column, _("use a plain number"))
    kind = dimension_of(base, kinds)
    if kind == units.NONE:
        return units.NONE
    power = exponent.operand if isinstance(exponent, Negative) else exponent
    if not isinstance(power, Number):
        raise _wrong(_("a quantity with a unit has an exponent that is not a number"), column, _("write the number"))
    return units.times(units.NONE, kind, power.value if power is exponent else -power.value)


def _call_dimension(
    function: str, arguments: tuple[Node, ...], kinds: Mapping[str, units.Dimension], column: int
) -> units.Dimension:
    if function in ("min", "max", "atan2"):
        word = "compared" if function != "atan2" else "opposed"
        kind = _common_dimension(arguments, kinds, column, word)
        return _ANGLE if function == "atan2" else kind
    kind = dimension_of(arguments[0], kinds)
    if function == "abs":
        return kind
    if function == "sqrt":
        return units.times(units.NONE, kind, 0.5)
    if function in ("sign", "step"):
        return units.NONE
    allowed = (units.NONE, _ANGLE) if function in _FROM_ANGLE else (units.NONE,)
    if kind not in allowed:
        needed = units.NOUNS["angle" if function in _FROM_ANGLE else "dimensionless"]
        raise _wrong(
            _("{function} is taken of {kind}, where {needed} is needed"),
            column,
            _("divide by a quantity of the same dimension"),
            function=function,
            kind=units.name_of(kind),
            needed=needed,
        )
    return _ANGLE if function in _TO_ANGLE else units.NONE
