"""The searches of a cycle: zeros, lowest values and ends of what holds, in many brackets side by side.

One accuracy for all: a zero and an end are met to :data:`ACCURACY` of their bracket's width (or to rounding, where
that is coarser; a Newton step below its square root, which doubles the digits, is the last one); of a smooth minimum
the value is met to rounding and the place, as always where a curve is flat, to about its square root, 1e-8 of the
width.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from linkwright.core.arrays import EQUAL, Flags, Floats

#: Share of a bracket's width to which zeros and ends are met.
ACCURACY = 1e-14
#: The same of a Newton step after which what is left is below that.
_LAST = 1e-8
_HALVINGS = 47
_STEPS = 100
#: Places of a section, and rounds of them, of which each leaves an eighth of the bracket.
_SECTION, _ROUNDS = 17, 10


def first_largest(values: Floats) -> int:
    """Number of the largest of some values (n,), of equal ones the first; NaN counts as none."""
    known = np.where(np.isnan(values), -np.inf, values)
    size = np.abs(known[np.isfinite(known)]).max(initial=0.0)
    return int(np.argmax(known >= known.max() - EQUAL * size))


def zeros(
    function: Callable[[Floats], tuple[Floats, Floats]],
    low: Floats,
    high: Floats,
    first: Floats,
    start: Floats | None = None,
) -> Floats:
    """Zeros (k,) of functions in brackets, by Newton steps that never leave them.

    ``function``: value and slope (k,) at places (k,), one in each bracket; ``first``: the sign (or value) at ``low``,
    other than at ``high``. At a jump or a pole the place of the change of sign is found.
    """
    width, first = np.abs(high - low), np.sign(first)
    here, before = 0.5 * (low + high) if start is None else start, width
    for _ in range(_STEPS):
        value, slope = function(here)
        same = np.sign(value) == first
        low, high = np.where(same, here, low), np.where(same, high, here)
        with np.errstate(all="ignore"):
            newton = here - value / slope
        minimum, maximum = np.minimum(low, high), np.maximum(low, high)
        sound = (newton >= minimum) & (newton <= maximum) & (np.abs(newton - here) <= 0.5 * before)
        there = np.where(value == 0.0, here, np.where(sound, newton, 0.5 * (low + high)))
        before, here = np.abs(there - here), there
        if not (before > np.where(sound, _LAST, ACCURACY) * width).any():
            break
    return here


def ends(holds: Callable[[Floats], Flags], inside: Floats, outside: Floats) -> Floats:
    """The last places (k,) at which something holds, on the way from ``inside``, where it does, to ``outside``."""
    for _ in range(_HALVINGS):
        middle = 0.5 * (inside + outside)
        good = holds(middle)
        inside, outside = np.where(good, middle, inside), np.where(good, outside, middle)
    return inside


def edge(
    holds: Callable[[Floats], Flags], inside: float, outside: float, within: float = 0.0, parts: int = 16
) -> tuple[float, float]:
    """As :func:`ends` for one bracket of which many places can be asked for at once, and the next place beyond.

    ``within``: width of the bracket that is enough, where it is the larger one; ``parts`` of the bracket in a round.
    """
    enough = max(within, ACCURACY * abs(outside - inside))
    while abs(outside - inside) > enough:
        places = np.linspace(inside, outside, parts + 1)
        k = int(np.argmin(np.append(holds(places[1:-1]), False)))
        narrower = float(places[k]), float(places[k + 1])
        if narrower == (inside, outside):
            break
        inside, outside = narrower
    return inside, outside


def lowest(function: Callable[[Floats], Floats], low: Floats, high: Floats) -> tuple[Floats, Floats]:
    """Places and values (k,) of the smallest values in brackets; NaN counts as infinite.

    ``function``: values (k, m) at places (k, m). Brackets are cut into sections around the best place again and
    again; a parabola through the last ones ends the search.
    """
    rows = np.arange(len(low))
    shares = np.linspace(0.0, 1.0, _SECTION)
    place, value = 0.5 * (low + high), np.full(len(low), np.inf)

    def better(at: Floats, values: Floats) -> None:
        nonlocal place, value
        gained = values < value
        place, value = np.where(gained, at, place), np.where(gained, values, value)

    for _ in range(_ROUNDS):
        at = low[:, None] + (high - low)[:, None] * shares
        values = function(at)
        values = np.where(np.isnan(values), np.inf, values)
        best = values.argmin(axis=1)
        better(at[rows, best], values[rows, best])
        if not (np.abs(high - low) > 1e-7 * (np.abs(place) + np.abs(high - low))).any():
            break
        before, after = np.maximum(best - 1, 0), np.minimum(best + 1, _SECTION - 1)
        low, high = at[rows, before], at[rows, after]
    inner = np.clip(best, 1, _SECTION - 2)
    a, b, c = (values[rows, inner + k] for k in (-1, 0, 1))
    with np.errstate(all="ignore"):
        vertex = at[rows, inner] + 0.5 * (a - c) / (a - 2.0 * b + c) * (at[rows, 1] - at[rows, 0])
    vertex = np.where(np.isfinite(vertex), np.clip(vertex, at[:, 0], at[:, -1]), place)
    values = function(vertex[:, None])[:, 0]
    better(vertex, np.where(np.isnan(values), np.inf, values))
    return place, value
