"""Rates that are zero but for rounding, in comparison with the rates of the drivers that cause all others."""

from __future__ import annotations

from typing import TYPE_CHECKING

from linkwright.drivers.base import Driver
from linkwright.errors import LinkwrightError
from linkwright.formula.late_import import numpy as np
from linkwright.formula.trace import Scalar, absolute, select
from linkwright.mechanism.mechanism import Mechanism

if TYPE_CHECKING:
    from linkwright.core.arrays import Floats

#: Share of the drivers' largest rate up to which a rate is rounding, where something reverses.
ROUNDING = 1e-14
#: The same where its own rate is not above the second share of the largest one's square: what is at rest.
STANDING, STEADY = 1e-10, 1e-8
#: Times of a driver's law among which its largest rate is sought, and of a law that has no duration, s, how long.
LOOKS, WHILE = 361, 1.0


def pace_name(dimension: str) -> str:
    """Name of the parameter that holds the drivers' largest rate, of an ``angle`` (rad/s) or a ``length`` (m/s)."""
    return f"pace:{dimension}"


def paces(mechanism: Mechanism) -> dict[str, float]:
    """These parameters; one follows from the other by the size of the mechanism."""
    size, fastest = mechanism.size, 0.0
    for driver in mechanism.drivers.values():
        fastest = max(fastest, _pace(driver, mechanism) / (1.0 if driver.law.rotary else size))
    return {pace_name("angle"): fastest, pace_name("length"): fastest * size}


def moving(rate: Scalar, second: Scalar, pace: Scalar, turning: Scalar) -> Scalar:
    """A rate with its own rate ``second``, zero at rest; ``pace``: the largest one of its dimension, ``turning``: of
    angles, rad/s."""
    steady = absolute(second) <= STEADY * pace * turning
    rest = select(steady, STANDING * pace, ROUNDING * pace)
    return select(absolute(rate) <= rest, 0.0, rate)


def _pace(driver: Driver, mechanism: Mechanism) -> float:
    """The largest rate of a driver, rad/s or m/s, within its law or the mechanism's cycle."""
    law = driver.law
    if law.constant_speed is not None:
        return abs(law.constant_speed)
    first, last = law.span()
    if not np.isfinite([first, last]).all():
        cycle = mechanism.cycle
        first, last = 0.0, law.natural_duration() or (cycle and cycle.duration) or WHILE
    time = np.union1d(np.linspace(first, last, LOOKS), law.breaks(first, last))
    try:
        with np.errstate(all="ignore"):
            rate: Floats = np.abs(law.coordinate(time)[1])
    except LinkwrightError:
        return 0.0
    return float(rate[np.isfinite(rate)].max(initial=0.0))
