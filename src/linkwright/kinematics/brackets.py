"""Stretches of a motion in which a rate changes its sign, or may do so twice."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np


class Bracket(NamedTuple):
    """A stretch after the position ``before``, at ``begin`` s, from ``low`` to ``high`` (shares of ``span`` s), with
    its rates; near ``start`` the rate is zero."""

    before: int
    begin: float
    span: float
    low: float
    high: float
    rate_low: float
    rate_high: float
    start: float

    @property
    def kind(self) -> Literal["max", "min"]:
        """Of the limit in it."""
        return "max" if self.rate_low * self.span > 0.0 else "min"


class Columns:
    """Brackets side by side."""

    def __init__(self, brackets: Sequence[Bracket]) -> None:
        self.before = np.array([each.before for each in brackets])
        rows = np.array([each[1:] for each in brackets]).T
        self.begin, self.span, self.low, self.high, self.rate_low, self.rate_high, self.start = rows


def zero_between(a: float, b: float, slope_a: float, slope_b: float) -> float:
    """Share at which a rate is about zero, from rates of unlike signs and slopes at both ends: by the cubic of the
    share over the rate, exact to fourth order; by the straight line where that one leaves the stretch."""
    at = a / (a - b)
    if slope_a == 0.0 or slope_b == 0.0:
        return at
    rest, rise = 1.0 - at, b - a
    cubic = at * at * (3.0 - 2.0 * at) + at * rest * rise * (rest / slope_a - at / slope_b)
    return cubic if 0.0 < cubic < 1.0 else at


def places_of(data: bytes, pair: bytes) -> list[int]:
    """Where two bytes stand beside each other."""
    found, k = list[int](), data.find(pair)
    while k >= 0:
        found.append(k)
        k = data.find(pair, k + 1)
    return found


def part_of(dip: Bracket, low: float, high: float, a: float, b: float) -> Bracket:
    """A part of a stretch at whose ends the rate has unlike signs."""
    return Bracket(dip.before, dip.begin, dip.span, low, high, a, b, low + (high - low) * a / (a - b))


def which_dip(brackets: list[Bracket], second_a: Sequence[float], second_b: Sequence[float]) -> list[bool]:
    """Whether a rate of one sign at both ends of a stretch may cross zero within, by the cubic through the rates and
    second derivatives (per s) there."""
    columns = Columns(brackets)
    a, b = columns.rate_low, columns.rate_high
    u = np.linspace(0.0, 1.0, 33)[:, None]
    h00, h10 = (1 + 2 * u) * (1 - u) ** 2, u * (1 - u) ** 2
    cubic = h00 * a + (1 - h00) * b + columns.span * (h10 * second_a - u**2 * (1 - u) * second_b)
    lowest = (np.sign(a) * cubic).min(axis=0)
    return (lowest < 0.5 * np.minimum(np.abs(a), np.abs(b))).tolist()  # type: ignore[no-any-return]
