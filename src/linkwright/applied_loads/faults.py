"""Where magnitudes have no value, found and named: expressions, tables, intervals, parts of strokes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Literal

from linkwright.applied_loads.signals import Signals, column, input_dimension, named_column, place_named
from linkwright.applied_loads.strokes import NEAR, TURN, StrokePart
from linkwright.core.expression_tree import Node, Number, denominators, evaluate, scalar_functions
from linkwright.core.expressions import ON_VALUES, Expression
from linkwright.core.outputs import Output
from linkwright.core.quantity import shown
from linkwright.errors import QuantityError
from linkwright.formula.late_import import numpy as np
from linkwright.units import LARGEST
from linkwright.words import Message, _, pgettext
from linkwright.words.message import together

if TYPE_CHECKING:
    from linkwright.core.arrays import Flags, Floats

_HALVINGS = 60
#: Any magnitude is below the largest torque.
_LARGEST = LARGEST["torque"]
#: Positions of a turning input at a larger distance (rad) are not neighbours.
_NEIGHBOURS = 0.5


def formula_fault(expression: Expression, signals: Signals, where: Flags, found: Floats) -> Message | None:
    """Where the values ``found`` (n,) of an expression are not finite ``where`` they are needed, at a position or
    between two."""
    columns = {name: column(named_column(name, signals), len(where)) for name in sorted(expression.names)}
    bad = np.flatnonzero(where & ~(np.abs(found) <= _LARGEST))
    if len(bad):
        return _not_finite(expression, columns, signals, int(bad[0]))
    return _pole_between(expression, columns, signals, where)


def _not_finite(expression: Expression, columns: Mapping[str, Floats], signals: Signals, index: int) -> Message:
    where = _("in the only position")
    if signals.mechanism.drivers:
        place = shown(float(signals.input[index]), input_dimension(signals))
        where = _("at input = {input}", input=place)
    try:
        expression.evaluate({name: float(values[index]) for name, values in columns.items()})
    except QuantityError as error:
        return _(
            "{message} {where}; change the expression, or leave that position out by a phase",
            code="loads.formula_fails",
            message=error.message,
            where=where,
        )
    return _(
        '"{text}" is not finite {where}; change the expression',
        code="loads.formula_not_finite",
        text=expression.text,
        where=where,
    )


def _pole_between(
    expression: Expression, columns: Mapping[str, Floats], signals: Signals, where: Flags
) -> Message | None:
    """Where a denominator goes through zero between two neighbouring positions."""
    divisors = [each for each in denominators(expression.tree) if not isinstance(each, Number)]
    if not divisors or len(where) < 2:
        return None
    q = signals.input
    if signals.closes is not None:
        columns = {name: _with_next(name, values, signals) for name, values in columns.items()}
        where, q = np.append(where, where[0]), _with_next("input", q, signals)
    both = where[:-1] & where[1:] & (np.abs(np.diff(q)) < (_NEIGHBOURS if signals.rotary else np.inf))
    for divisor in divisors:
        with np.errstate(all="ignore"):
            values = column(evaluate(divisor, columns, ON_VALUES), len(where))
        for index in np.flatnonzero(both & (values[:-1] * values[1:] < 0)):
            share = _zero(divisor, columns, int(index))
            if share is not None:
                place = shown(float(q[index] + share * (q[index + 1] - q[index])), input_dimension(signals))
                return _(
                    '"{text}" divides by zero near input = {place}; change the expression, or leave that '
                    "position out by a phase",
                    code="loads.formula_divides",
                    text=expression.text,
                    place=place,
                )
    return None


def _with_next(name: str, values: Floats, signals: Signals) -> Floats:
    """Values with those of the position after the last one, where the cycle begins again."""
    assert signals.closes is not None
    period, drift = signals.closes
    gain = {"t": period, "input": drift}.get(name, 0.0)
    found = None if name in ("t", "input") else place_named(name, signals.mechanism)
    if found is not None and found.kind == "angle" and name not in signals.mechanism.parameters:
        gain = 2 * np.pi * np.round((values[-1] - values[0]) / (2 * np.pi))
    return np.append(values, values[0] + gain)


def _zero(divisor: Node, columns: Mapping[str, Floats], index: int) -> float | None:
    """Share of the way to the next position at which a divisor vanishes; None where it jumps over zero."""

    def value(share: float) -> float:
        mixed = {name: float(v[index] + share * (v[index + 1] - v[index])) for name, v in columns.items()}
        try:
            return float(evaluate(divisor, mixed, scalar_functions()))
        except (ZeroDivisionError, ValueError, OverflowError):
            return float("nan")

    low, high, sign, size = 0.0, 1.0, value(0.0), min(abs(value(0.0)), abs(value(1.0)))
    for _unused in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if value(middle) * sign > 0:
            low = middle
        else:
            high = middle
    return low if abs(value(low)) <= 1e-6 * size else None


def interval_fault(start: float, end: float, signals: Signals) -> Message | None:
    """Why an input does not pass an interval of angles."""
    length = end - start
    if not signals.rotary:
        return None
    if length < 0 and signals.heading == 0:
        problem = _(
            "the phase goes from {start} down to {end}, but the input turns to and fro; write "
            "the smaller angle first",
            code="loads.phase_to_and_fro",
        )
    elif length > TURN + NEAR or (length < -TURN - NEAR and signals.heading < 0):
        problem = _(
            "the phase from {start} to {end} is longer than one turn of the input; use a table over the time instead",
            code="loads.phase_too_long",
        )
    else:
        return None
    return problem.format(start=shown(start, "angle"), end=shown(end, "angle"))


_PARTS = {"first": pgettext("loads", "first"), "last": _("last"), "free": _("free")}


def part_fault(output: Output, part: StrokePart, stroke: float) -> Message:
    """How far a stroke (m or rad) is too short for a part of it."""
    return _(
        "too much of the stroke is named ({part}: {amounts}): the output '{output}' moves "
        "through {stroke}; give less",
        code="loads.part_too_long",
        part=_PARTS[part.word],
        amounts=" + ".join(shown(each.way(stroke), output.dimension) for each in part.amounts),
        output=output,
        stroke=shown(stroke, output.dimension),
    )


def table_fault(
    over: Literal["input", "time"] | Output, ends: tuple[float, float], short: Floats, signals: Signals
) -> Message:
    """The range that a table lacks which goes between two ``ends`` and has no values at the places ``short``."""
    dimension = "time" if over == "time" else input_dimension(signals)
    dimension = over.dimension if isinstance(over, Output) else dimension
    (first, last), low, high = ends, float(short.min()), float(short.max())
    missing = [(low, first)] if low < first else []
    missing += [(last, high)] if high > last else []
    ranges = [_("{low} to {high}", low=shown(a, dimension), high=shown(b, dimension)) for a, b in missing]
    covered = {"first": shown(first, dimension), "last": shown(last, dimension)}
    return _(
        "its table over {over} goes from {first} to {last} and does not cover what the cycle "
        "needs: {ranges} is missing; add rows, or limit the load by a phase",
        code="loads.table_too_short",
    ).format(over=over, ranges=together(ranges), **covered)
