"""Operations of programs: lines that hold them, and functions with slopes and names in NumPy, LLVM and the C library.

Equal bits: ``sqrt``, ``abs`` and ``floor`` are exact, so they are equal on all back ends. The others
come from the C library on Python floats, and in compiled code but for ``sin``, ``cos``, ``atan`` and
``atan2`` of values along the positions: these are found in all lanes at once, to 1.5 units in the last
place (``ir_functions``). NumPy has vectorised ones of its own, too (its stated bound is 4 units). Look-ups
are equal as well. Sums, products and quotients are rounded one by one by
Python and NumPy; compiled code may fuse and regroup them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Container, Iterable
from typing import Any, NamedTuple

#: Operations that yield a truth value instead of a number.
COMPARISONS = frozenset({"less", "less_equal", "and", "or", "not"})
COMMUTATIVE = frozenset({"add", "mul", "and", "or"})


class Node(NamedTuple):
    """One line of a program: an input, a constant, or an operation on earlier lines.

    ``name``: of an input, or of the table of a ``lookup``, whose ``constant`` is the order of its derivative.
    """

    op: str
    args: tuple[int, ...]
    constant: float
    name: str
    varies: bool  # differs from position to position (else one value per design)


#: The fields of a :class:`Node` as a plain tuple: one of things that cannot refer to others is no longer looked at by
#: the garbage collector, a named one is for as long as it lives.
Entry = tuple[str, tuple[int, ...], float, str, bool]


def needed(arguments: Callable[[int], Iterable[int]], wanted: Iterable[int], stop: Container[int] = ()) -> list[int]:
    """The lines that the wanted ones are found from, in order; what is behind ``stop`` is left out.

    ``arguments``: the numbers of the lines that a line takes.
    """
    found = set(wanted)
    stack = list(found)
    while stack:
        index = stack.pop()
        if index not in stop:
            for arg in arguments(index):
                if arg not in found:
                    found.add(arg)
                    stack.append(arg)
    return sorted(found)


#: d(value)/d(argument) as (trace, arguments, value) -> slope.
Slope = Callable[[Any, list[Any], Any], Any]


class Function(NamedTuple):
    """A function of ``len(slopes)`` numbers; NaN outside its range, never an exception.

    ``ufunc``: its name in NumPy; ``exact``: its intrinsic in LLVM, where every machine has it, else the
    C library's function ``library`` is called.
    """

    value: Callable[..., float]
    ufunc: str
    slopes: tuple[Slope, ...]
    exact: str = ""
    library: str = ""


def _guarded(function: Callable[[float], float]) -> Callable[[float], float]:
    def value(x: float) -> float:
        try:
            return function(x)
        except ValueError:
            return math.nan

    return value


def _exp(x: float) -> float:
    try:
        return math.exp(x)
    except OverflowError:
        return math.inf


def _log(x: float) -> float:
    if x == 0.0:
        return -math.inf
    return math.nan if x < 0.0 else math.log(x)


def _pow(a: float, b: float) -> float:
    try:
        return math.pow(a, b)
    except OverflowError:
        odd = math.fmod(b, 2.0) in (1.0, -1.0)
        return -math.inf if a < 0.0 and odd else math.inf
    except ValueError:
        if a != 0.0:
            return math.nan
        return math.copysign(math.inf, a) if math.fmod(b, 2.0) in (1.0, -1.0) else math.inf


def _floor(x: float) -> float:
    return float(math.floor(x)) if math.isfinite(x) else x


def _sloped(slope: Callable[[Any, Any, Any], Any]) -> tuple[Slope, ...]:
    """The slope of a function of one number, from (trace, argument, value)."""
    return (lambda t, args, value: slope(t, args[0], value),)


def _circle(t: Any, args: list[Any]) -> Any:
    return t.add(t.mul(args[0], args[0]), t.mul(args[1], args[1]))


def _base_slope(t: Any, args: list[Any], value: Any) -> Any:
    return t.mul(args[1], t.power(args[0], t.sub(args[1], 1.0)))


def _exponent_slope(t: Any, args: list[Any], value: Any) -> Any:
    """value log a; 0 where a is 0, as for the powers b > 0 on both sides of it."""
    logarithm = t.function("log", t.select(t.compare("less", 0.0, args[0]), args[0], 1.0))
    zero_or_more = t.compare("less_equal", 0.0, args[0])
    return t.select(zero_or_more, t.mul(value, logarithm), math.nan)


def _root_of(t: Any, x: Any) -> Any:
    return t.function("sqrt", t.sub(1.0, t.mul(x, x)))


FUNCTIONS: dict[str, Function] = {
    "sqrt": Function(
        lambda x: math.nan if x < 0.0 else math.sqrt(x),
        "sqrt",
        _sloped(lambda t, x, value: t.div(0.5, value)),
        exact="sqrt",
    ),
    "abs": Function(
        abs, "absolute", _sloped(lambda t, x, value: t.select(t.compare("less", x, 0.0), -1.0, 1.0)), exact="fabs"
    ),
    "floor": Function(_floor, "floor", _sloped(lambda t, x, value: 0.0), exact="floor"),
    "sin": Function(_guarded(math.sin), "sin", _sloped(lambda t, x, value: t.function("cos", x)), library="sin"),
    "cos": Function(
        _guarded(math.cos), "cos", _sloped(lambda t, x, value: t.neg(t.function("sin", x))), library="cos"
    ),
    "tan": Function(
        _guarded(math.tan), "tan", _sloped(lambda t, x, value: t.add(1.0, t.mul(value, value))), library="tan"
    ),
    "asin": Function(
        _guarded(math.asin), "arcsin", _sloped(lambda t, x, value: t.div(1.0, _root_of(t, x))), library="asin"
    ),
    "acos": Function(
        _guarded(math.acos), "arccos", _sloped(lambda t, x, value: t.div(-1.0, _root_of(t, x))), library="acos"
    ),
    "atan": Function(
        math.atan, "arctan", _sloped(lambda t, x, value: t.div(1.0, t.add(1.0, t.mul(x, x)))), library="atan"
    ),
    "exp": Function(_exp, "exp", _sloped(lambda t, x, value: value), library="exp"),
    "log": Function(_log, "log", _sloped(lambda t, x, value: t.div(1.0, x)), library="log"),
    "pow": Function(_pow, "power", (_base_slope, _exponent_slope), library="pow"),
    "atan2": Function(
        math.atan2,
        "arctan2",
        (
            lambda t, args, value: t.div(args[1], _circle(t, args)),
            lambda t, args, value: t.neg(t.div(args[0], _circle(t, args))),
        ),
        library="atan2",
    ),
}
