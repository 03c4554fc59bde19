"""The torque that a machine needs and the one that its actuators have, at any positions of its cycle."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from linkwright.actuators.base import Actuator
from linkwright.core.arrays import Floats, largest
from linkwright.drivers.constant_speed import ConstantSpeed
from linkwright.dynamics.verdicts.quasi_static import Course, Efforts, QuasiStatic
from linkwright.errors import RequestError
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.input_range import input_range
from linkwright.kinematics.solve import solve_motion
from linkwright.mechanism.cycle import Cycle
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import no_such
from linkwright.words import _

#: Time, s, at which a machine in motion has been switched on for long.
ALWAYS = 1e6
#: Share of the range of a free input that is left out at each end.
_SHORT = 0.01


@dataclass(frozen=True)
class Torques:
    """Torques (forces of a driver that slides) at positions, in the sense in which the driver moves: (n,) each.

    ``time`` s in the cycle, ``input`` the driver's coordinate, rad or m; ``needed`` to move on, NaN where no finite
    effort does; ``available`` from the actuators; ``ideal``: needed without friction; ``returning``: what the driver
    must hold back with, the actuators off, so that the machine does not run backwards (not positive where it stands
    by itself); ``rate`` and ``second`` of the driver in the sense of its motion.
    """

    time: Floats
    input: Floats
    rate: Floats
    second: Floats
    needed: Floats
    available: Floats
    ideal: Floats
    returning: Floats

    @property
    def left(self) -> Floats:
        """Needed less available: what is left for one more motor."""
        return self.needed - self.available

    @property
    def excess(self) -> Floats:
        """Available less needed; minus infinity where no effort moves the machine."""
        return np.where(np.isnan(self.needed), -np.inf, self.available - self.needed)

    @property
    def ratio(self) -> Floats:
        """Available over needed; infinite where the loads move the machine, zero where the drive pushes it back or no
        effort moves it."""
        with np.errstate(all="ignore"):
            found = np.where(self.needed > 0.0, np.maximum(self.available, 0.0) / self.needed, np.inf)
            return np.where(self.available >= self.needed, found, np.minimum(found, 1.0) * (self.needed > 0.0))


class Drive:
    """A driver of a mechanism, with what moves it and what resists."""

    def __init__(self, mechanism: Mechanism, driver: str | None = None) -> None:
        self.source = mechanism
        self.name = _driver(mechanism, driver)
        self.rotary = mechanism.drivers[self.name].law.rotary
        self.prescribed = all(each.law.prescribed for each in mechanism.drivers.values())
        self.mechanism = mechanism if self.prescribed else _at_constant_speed(mechanism)
        self.driven = any(each.drives for each in mechanism.actuators.values())

    @cached_property
    def _load(self) -> QuasiStatic:
        return QuasiStatic(replace(self.source, actuators=resisting(self.source)))

    @cached_property
    def _all(self) -> QuasiStatic:
        return QuasiStatic(replace(self.source, actuators=at_limits(self.source))) if self.driven else self._load

    @cached_property
    def _off(self) -> QuasiStatic:
        return QuasiStatic(replace(self.source, actuators=switched_off(self.source)))

    def cycle(self, steps: int, *, closed: bool = False) -> Floats:
        """Times of the positions of the cycle that are reached, s; ``closed``: the first one again at the end."""
        motion = solve_motion(self.mechanism, steps=steps, endpoint=closed, failures="mark")
        return np.asarray(motion.time[motion.ok])

    @property
    def period(self) -> float | None:
        """Time after which the cycle repeats, s; None of one that does not."""
        return over_cycle(self.mechanism, 1).period

    @property
    def speed(self) -> float | None:
        """The size of the driver's constant speed, rad/s or m/s; None where it has a law, or none."""
        found = self.mechanism.drivers[self.name].law.constant_speed if self.prescribed else None
        return None if found is None else abs(found)

    def course(self, times: Floats) -> tuple[Course, Floats]:
        """Course and times of those positions that are reached."""
        motion = solve_motion(self.mechanism, times=times, failures="mark")
        return Course.of(motion, motion.ok), motion.time[motion.ok]

    def starting(self, times: Floats) -> Torques:
        """At rest, at the verge of motion."""
        course, reached = self.course(times)
        senses = {name: _senses(rate) for name, rate in course.rates.items()}
        sense = senses[self.name]
        load = self._load.starting(course, senses)
        net = self._all.starting(course, senses) if self.driven else load
        back = self._off.starting(course, {**senses, self.name: -sense})
        return self._torques(course, reached, sense, load, net, sense * back.effort[self.name])

    def running(self, times: Floats) -> Torques:
        """At the speeds and accelerations of the cycle; inertia of actuators counts against what they supply."""
        course, reached = self.course(times)
        sense = _senses(course.rates[self.name])
        load = self._load.running(course, ALWAYS)
        net = self._all.running(course, ALWAYS) if self.driven else load
        return self._torques(course, reached, sense, load, net, np.full(course.count, np.nan))

    def _torques(
        self, course: Course, time: Floats, sense: Floats, load: Efforts, net: Efforts, returning: Floats
    ) -> Torques:
        """Of what the driver must supply without what drives the machine (``load``) and with it (``net``)."""
        name = self.name
        return Torques(
            time=time,
            input=course.places[name],
            rate=sense * course.rates[name],
            second=sense * course.seconds[name],
            needed=sense * load.effort[name],
            available=sense * (load.effort[name] - net.effort[name]),
            ideal=sense * load.ideal[name],
            returning=returning,
        )

    def quality(self, times: Floats) -> Floats:
        """Of the worst group of links, 0 at a dead point of the driver, 1 at best, (n,)."""
        return self._load.quality(self.course(times)[0])


def at_limits(mechanism: Mechanism) -> dict[str, Actuator]:
    """The actuators switched on, those that are controlled at their limits; without brakes that come later."""
    found = {name: each for name, each in mechanism.actuators.items() if not (each.brakes and each.begin)}
    return {name: replace(each.at_limit(), begin=None, until=None) for name, each in found.items()}


def resisting(mechanism: Mechanism) -> dict[str, Actuator]:
    """Brakes that always act, and flywheels: a part of the load."""
    return {name: each for name, each in at_limits(mechanism).items() if not each.drives}


def switched_off(mechanism: Mechanism) -> dict[str, Actuator]:
    """The actuators switched off; gears that lock and brakes that always act hold on."""
    found = {name: each for name, each in mechanism.actuators.items() if not (each.brakes and each.begin)}
    return {name: replace(each, begin=None, until=None if each.brakes else 0.0) for name, each in found.items()}


def mean_over(x: Floats, values: Floats) -> float:
    """Mean of values at increasing places or times, by the trapezoidal rule."""
    from scipy.integrate import trapezoid

    return float(trapezoid(values, x) / (x[-1] - x[0]))


def _driver(mechanism: Mechanism, driver: str | None) -> str:
    if not mechanism.drivers:
        raise RequestError(
            _(
                "{name!r} has no driver, so nothing says along which coordinate it is driven; add a driver",
                code="verdicts.no_driver",
                name=mechanism.name,
            )
        )
    name = driver or next(iter(mechanism.drivers))
    if name not in mechanism.drivers:
        raise RequestError(no_such(_("driver"), name, mechanism.drivers))
    return name


def _at_constant_speed(mechanism: Mechanism) -> Mechanism:
    """The mechanism with its free coordinates at a slow speed, which no number found at rest depends on."""
    drivers = {}
    for name, driver in mechanism.drivers.items():
        law = driver.law
        slow = ConstantSpeed(1.0 if law.rotary else 0.1 * mechanism.size, law.at(0.0), law.rotary)
        drivers[name] = driver if law.prescribed else replace(driver, law=slow)
    found = replace(mechanism, drivers=drivers)
    return _within_range(found) if len(drivers) == 1 and mechanism.cycle is None else found


def _within_range(mechanism: Mechanism) -> Mechanism:
    """The same over the range of its input, where that is no full turn, short of its dead points."""
    found = input_range(mechanism)
    if found.full or found.low is None or found.high is None:
        return mechanism
    low, high = found.low.value, found.high.value
    short = _SHORT * (high - low)
    return replace(mechanism, cycle=Cycle(start=low + short, end=high - short))


def _senses(rates: Floats) -> Floats:
    """The sense of motion at every position: 1 or -1, at rest the one of the position before."""
    signs = np.where(np.abs(rates) > 1e-9 * largest(rates), np.sign(rates), 0.0)
    moving = np.flatnonzero(signs)
    if not moving.size:
        return np.ones_like(rates)
    before = moving[np.clip(np.searchsorted(moving, np.arange(len(signs)), "right") - 1, 0, None)]
    return np.asarray(signs[before])
