"""Magnitudes from an expression, with every place where it has no value found and named."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from linkwright.core.arrays import Flags, Floats
from linkwright.core.expression_tree import Binary, Call, Negative, Node, Number, evaluate, scalar_functions
from linkwright.core.expressions import ON_VALUES, Expression
from linkwright.core.outputs import Output
from linkwright.engine.late_import import numpy as np
from linkwright.errors import LinkwrightError, QuantityError
from linkwright.fields.signals import resolve_output
from linkwright.loads.signals import Signals, column, input_dimension, shown, spot
from linkwright.registry import offered
from linkwright.units import LARGEST
from linkwright.words.sentence import Sentence

if TYPE_CHECKING:
    from linkwright.mechanism.mechanism import Mechanism

_HALVINGS = 60
#: Any magnitude is below the largest torque.
_LARGEST = LARGEST["torque"]
#: Positions of a turning input that are further apart (rad) are not taken for neighbours.
_APART = 0.5


def refuse_formula(expression: Expression, signals: Signals, where: Flags, found: Floats) -> None:
    """Raises LinkwrightError where the values ``found`` (n,) of an expression are not finite ``where`` they are
    needed, at a position or between two."""
    columns = {name: column(named_column(name, signals), len(where)) for name in sorted(expression.names)}
    bad = np.flatnonzero(where & ~(np.abs(found) <= _LARGEST))
    if len(bad):
        raise LinkwrightError(_refusal(expression, columns, signals, int(bad[0])))
    _no_poles_between(expression, columns, signals, where)


def named_column(name: str, signals: Signals) -> Any:
    """Values, a number or (n,), of a parameter, ``t``, ``input`` or an output in an expression."""
    mechanism = signals.mechanism
    if name in mechanism.parameters:
        return mechanism.parameters[name]
    if name in ("t", "input"):
        return signals.time if name == "t" else signals.input
    found = output_named(name, signals.mechanism)
    if found is None:
        known = ["t", "input", *mechanism.parameters, *mechanism.links, *mechanism.joints]
        raise LinkwrightError("loads.unknown_in_magnitude", name=name, hint=offered(name, known))
    return signals.output(found)[0]


def output_named(name: str, mechanism: Mechanism) -> Output | None:
    """The output that a name in an expression means."""
    links = {"frame": mechanism.frame, **mechanism.links}
    return resolve_output(name, {link: tuple(each.points) for link, each in links.items()}, mechanism.guides)


def _refusal(expression: Expression, columns: Mapping[str, Floats], signals: Signals, index: int) -> str:
    try:
        expression.evaluate({name: float(values[index]) for name, values in columns.items()})
    except QuantityError as error:
        where = spot(signals, index)
        return Sentence("loads.formula_fails", message=error.message, where=where)
    return Sentence("loads.formula_not_finite", text=expression.text, where=spot(signals, index))


def _no_poles_between(
    expression: Expression, columns: Mapping[str, Floats], signals: Signals, where: Flags
) -> None:
    """Raises where a denominator goes through zero between two neighbouring positions."""
    divisors = [each for each in denominators(expression.tree) if not isinstance(each, Number)]
    if not divisors or len(where) < 2:
        return
    closes = signals.closes
    if closes is not None:
        columns = {name: _with_next(name, values, signals) for name, values in columns.items()}
        where = np.append(where, where[0])
    both = where[:-1] & where[1:] & _neighbours(signals)
    for divisor in divisors:
        with np.errstate(all="ignore"):
            values = column(evaluate(divisor, columns, ON_VALUES), len(where))
        for index in np.flatnonzero(both & (values[:-1] * values[1:] < 0)):
            share = _zero(divisor, columns, int(index))
            if share is not None:
                raise LinkwrightError(_between(expression, signals, int(index), share))


def _neighbours(signals: Signals) -> Flags:
    """Which positions lie next to the one that follows them."""
    q = signals.input if signals.closes is None else _with_next("input", signals.input, signals)
    return np.abs(np.diff(q)) < (_APART if signals.rotary else np.inf)


def _with_next(name: str, values: Floats, signals: Signals) -> Floats:
    """Values with those of the position after the last one, where the cycle begins again."""
    assert signals.closes is not None
    period, drift = signals.closes
    gain = {"t": period, "input": drift}.get(name, 0.0)
    found = None if name in ("t", "input") else output_named(name, signals.mechanism)
    if found is not None and found.kind == "angle" and name not in signals.mechanism.parameters:
        gain = 2 * np.pi * np.round((values[-1] - values[0]) / (2 * np.pi))
    return np.append(values, values[0] + gain)


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
            if sign == "^" and (
                isinstance(right, Negative) or (isinstance(right, Number) and right.value < 0)
            ):
                yield left
            yield from denominators(left)
            yield from denominators(right)


def _zero(divisor: Node, columns: Mapping[str, Floats], index: int) -> float | None:
    """Share of the way to the next position at which a divisor vanishes; None where it jumps over zero."""

    def value(share: float) -> float:
        mixed = {name: float(v[index] + share * (v[index + 1] - v[index])) for name, v in columns.items()}
        try:
            return float(evaluate(divisor, mixed, scalar_functions()))
        except (ZeroDivisionError, ValueError, OverflowError):
            return float("nan")

    low, high, sign, size = 0.0, 1.0, value(0.0), min(abs(value(0.0)), abs(value(1.0)))
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if value(middle) * sign > 0:
            low = middle
        else:
            high = middle
    return low if abs(value(low)) <= 1e-6 * size else None


def _between(expression: Expression, signals: Signals, index: int, share: float) -> str:
    q = signals.input if signals.closes is None else _with_next("input", signals.input, signals)
    place = shown(float(q[index] + share * (q[index + 1] - q[index])), input_dimension(signals))
    return Sentence("loads.formula_divides", text=expression.text, place=place)
