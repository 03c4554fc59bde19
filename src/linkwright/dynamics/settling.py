"""What holds where a motion begins, or goes on behind an event."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.dynamics.integration import AT_ONCE
from linkwright.dynamics.system import ZERO, System


def settle_anew(system: System, t: float, y: Floats, touch: Iterable[int], no_gap: Floats | float = 0.0) -> Floats:
    """The same as :func:`settle` where nothing held before."""
    go_by_gaps(system, t, y, range(len(system.surfaces)))
    return settle(system, t, y, touch, no_gap=no_gap)


def settle(
    system: System,
    t: float,
    y: Floats,
    touch: Iterable[int],
    slips: Mapping[int, int] | None = None,
    no_gap: Floats | float = 0.0,
) -> Floats:
    """Lets a system find what holds (see :meth:`System.decide`); the state, rates of what holds exactly zero.

    As forces begin to go another way, phases of loads may, and other forces then. A surface stays on its side where
    its gap is at most ``no_gap``, (surfaces,) or one number.
    """
    touching, found = list(touch), y.copy()
    for _round in range(AT_ONCE):
        if system.decide(t, found, touching, slips).constrained:
            _hold_still(system, t, found)
        if not _moved_over(system, t, found, no_gap):
            break
    return found


def go_by_gaps(system: System, t: float, y: Floats, indices: Iterable[int]) -> None:
    """Sets the sides on which surfaces are, or go to where they are zero."""
    out = system.outputs(t, y)
    gaps, rates, holding = system.gaps(out), system.gap_rates(out), system.holding.copy()
    for index in indices:
        value = gaps[index] if gaps[index] != 0.0 else rates[index]
        holding.sides[index] = 1.0 if value >= 0.0 else -1.0
    system.hold(holding)


def freedoms_held(system: System, t: float, y: Floats) -> int:
    """How many of the freedoms what sticks and touches holds."""
    return int(np.linalg.matrix_rank(_held_rates(system, t, y)[0]))


def _moved_over(system: System, t: float, y: Floats, no_gap: Floats | float) -> bool:
    """Sets the sides of surfaces that do not go by rates as their gaps are now; whether one has changed."""
    gaps, holding = system.gaps(system.outputs(t, y)), system.holding.copy()
    clear = np.abs(gaps) > no_gap
    for index, surface in enumerate(system.surfaces):
        if not surface.by_rate and clear[index]:
            holding.sides[index] = 1.0 if gaps[index] > 0.0 else -1.0
    if (holding.sides == system.holding.sides).all():
        return False
    system.hold(holding)
    return True


def _hold_still(system: System, t: float, y: Floats) -> None:
    """Sets the rates of what holds to zero; where that is all that can move, those that are rounding as well."""
    rates = y[len(system.free) : 2 * len(system.free)]
    by, still = _held_rates(system, t, y)
    rates -= np.linalg.lstsq(by, still, rcond=None)[0]
    if np.linalg.matrix_rank(by) == len(rates) and np.abs(rates).max() <= ZERO * system.pace.max(initial=0.0):
        rates[:] = 0.0


def _held_rates(system: System, t: float, y: Floats) -> tuple[Floats, Floats]:
    """Derivatives by the free rates (held, n) of the rates (held,) of what sticks and touches, and these."""
    out, holding = system.outputs(t, y), system.holding
    stuck = [group[0][0] for group in holding.stick]
    by = [*(system.gap_by(out, index) for index in stuck), *(system.stop_by(out, k) for k in holding.touch)]
    still = [*system.gaps(out)[stuck], *system.at_stops("stop_rate", out)[holding.touch]]
    return np.array(by), np.array(still)
