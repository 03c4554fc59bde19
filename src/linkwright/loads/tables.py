"""Magnitudes from a table, between whose rows lies a straight line."""

from __future__ import annotations

from linkwright.engine.late import numpy as np
from linkwright.errors import LinkwrightError
from linkwright.fields.signals import Output, Table
from linkwright.loads.phases import NEAR, TURN
from linkwright.loads.signals import Array, Mask, Signals, input_dimension, shown
from linkwright.words.sentence import Sentence, together


def interpolated(table: Table, signals: Signals, where: Mask) -> Array:
    """Values of a table, (n,); it must cover the positions ``where``.

    Angles count modulo one turn; a table over several whole turns repeats after them. Raises
    LinkwrightError with the range that is missing.
    """
    across, dimension = _across(table, signals)
    x, first, last = across, table.x[0], table.x[-1]
    if dimension == "angle":
        x = _shifted(across, first, last)
    slack = NEAR * (last - first)
    short = where & ((x < first - slack) | (x > last + slack))
    if short.any():
        raise LinkwrightError(_missing(table, x[short], dimension))
    return np.interp(x, table.x, table.y)


def _across(table: Table, signals: Signals) -> tuple[Array, str]:
    if isinstance(table.over, Output):
        return signals.output(table.over)[0], table.over.dimension
    if table.over == "time":
        return signals.time, "time"
    return signals.input, input_dimension(signals)


def _shifted(angle: Array, first: float, last: float) -> Array:
    """Angles moved by whole turns into the table, as far as that is possible."""
    span = last - first
    whole = TURN * max(1.0, round(span / TURN))
    if span > TURN and abs(span - whole) > NEAR:
        return angle
    gone = (angle - first) % whole
    return first + np.where(gone > whole - NEAR, gone - whole, gone)


def _missing(table: Table, short: Array, dimension: str) -> str:
    first, last = table.x[0], table.x[-1]
    ranges = []
    if (short < first).any():
        ranges.append(
            Sentence("loads.stretch", low=shown(float(short.min()), dimension), high=shown(first, dimension))
        )
    if (short > last).any():
        ranges.append(
            Sentence("loads.stretch", low=shown(last, dimension), high=shown(float(short.max()), dimension))
        )
    return Sentence(
        "loads.table_too_short",
        over=table.over,
        first=shown(first, dimension),
        last=shown(last, dimension),
        ranges=together(ranges),
    )
