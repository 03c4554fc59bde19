"""The course of the input: from when to when a mechanism is driven, and its drivers' coordinates at any time."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass
from functools import cached_property
from math import pi

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.inputs import driven, turned
from linkwright.drivers.base import Driver
from linkwright.errors import LinkwrightError
from linkwright.formula.trace import Scalar, Trace, cos, sin
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.positions import Positions
from linkwright.mechanism.mechanism import Mechanism

#: A closed cycle of a driver that turns steadily is looked at from here on, as share of it, lest places of symmetric
#: machines fall on the ends of pieces.
BEGIN = 0.0038710
#: Share of the cycle by which it may differ from an integer number of turns.
FULL_TURN = 1e-9
#: Times among which the way of a law is measured.
LOOKS = 361
#: Share by which a dimension is changed to see whether times and inputs follow from it.
_NUDGE = 1e-3


@dataclass(frozen=True)
class Course:
    """From ``begin``, s, for a ``duration``, s; ``closed``: whether the first position follows the last.

    ``turns``: full turns of the only driver, at constant speed, that a closed cycle has; 0 for any other course,
    whose times no dimension moves.
    """

    drivers: tuple[Driver, ...]
    begin: float
    duration: float
    closed: bool
    turns: int
    seam: bool = False

    @classmethod
    def of(cls, mechanism: Mechanism, positions: Positions, *, seam: bool = False) -> Course:
        """That of positions along the drivers' laws; ``seam``: something goes by the time or by the turns of the
        input, which begin anew with every cycle."""
        times, drivers = positions.around, tuple(mechanism.drivers.values())
        begin, end = float(times.min()), float(times.max())
        law, turns = drivers[0].law, 0
        if positions.closed and len(drivers) == 1 and law.rotary and (speed := law.constant_speed):
            share = abs(speed) * (end - begin) / (2.0 * pi)
            turns = round(share) if abs(share - round(share)) <= FULL_TURN * share else 0
        return cls(drivers, begin, end - begin, positions.closed, turns, seam)

    @property
    def first(self) -> Driver:
        """The first driver."""
        return self.drivers[0]

    @property
    def key(self) -> Hashable:
        """What its formulas depend on, as long as its drivers are there."""
        names = tuple(driver.name for driver in self.drivers)
        if self.turns:
            return (*names, True)
        return (*names, *(id(driver.law) for driver in self.drivers), self.begin, self.duration)

    @property
    def origin(self) -> float:
        """Where it is looked at from, as share of the cycle after its beginning."""
        return BEGIN if self.turns and not self.seam else 0.0

    @cached_property
    def laps(self) -> float:
        """How many turns the driver makes that turns most, to and fro; at least one."""
        if self.turns:
            return float(self.turns)
        time, found = self.begin + self.duration * np.linspace(0.0, 1.0, LOOKS), 1.0
        for driver in self.drivers:
            if driver.law.rotary:
                found = max(found, float(np.abs(np.diff(driver.law.coordinate(time)[0])).sum()) / (2.0 * pi))
        return found

    @cached_property
    def breaks(self) -> Floats:
        """Times, s, within the course, both ends among them, at which a driver's law goes over to another formula;
        none of one that turns steadily."""
        if self.turns:
            return np.array([self.begin, self.begin + self.duration]) if self.seam else np.empty(0)
        end = self.begin + self.duration
        inner = [driver.law.breaks(self.begin, end) for driver in self.drivers]
        every = np.unique(np.concatenate([[self.begin, end], *inner]))
        every = every[(every >= self.begin) & (every <= end)]
        return np.asarray(every[np.append(True, np.diff(every) > 1e-12 * self.duration)])

    def inputs(self, t: Trace, time: Scalar, varied: frozenset[str]) -> dict[str, Scalar]:
        """The inputs of programs at a traced time; the first driver's coordinate is ``input``."""
        found: dict[str, Scalar] = {"time": time}
        for driver in self.drivers:
            if self.turns:
                start, speed = (
                    (t.position if name in varied else t.parameter)(name)
                    for name in (f"{driver.name}.start", f"{driver.name}.speed")
                )
                q = start + speed * time
                found |= turned(driver.name, q, cos, sin)
            else:
                q, rate, second = driver.law.traced(time, self.begin, self.begin + self.duration)
                found |= driven(driver.name, driver.law.rotary, (q, rate, second), cos, sin)
            found.setdefault("input", q)
        return found


def moves(mechanism: Mechanism, address: str, steps: int) -> bool:
    """Whether times or inputs of the cycle follow from a dimension."""
    value = mechanism.dimension(address)
    for factor in (1.0 + _NUDGE, 1.0 - _NUDGE):
        try:
            changed = mechanism.with_dimensions({address: factor * value if value else factor - 1.0})
            return over_cycle(changed, steps).key != over_cycle(mechanism, steps).key
        except LinkwrightError:
            continue
    return True
