"""A driver that rocks: to and fro between two limits, along a harmonic that stands still at both."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

from linkwright.core.attached import attached
from linkwright.drivers.base import Law, MadeLaw
from linkwright.formula.late_import import numpy as np

if TYPE_CHECKING:
    from linkwright.drivers.base import Array
    from linkwright.fields.base import Field
    from linkwright.formula.trace import Scalar

#: Share of the range that stays free at each limit where the file says nothing. At a limit links are in line: rates
#: per rate of the driver grow as the inverse root of the distance to it, and joint forces with them.
MARGIN = 0.01


@dataclass(frozen=True)
class Rock:
    """Between which coordinates a driver rocks: the ``ends`` (rad or m), or, without them, the limits of the range in
    which the machine can be assembled, each with a ``margin`` as share of that range."""

    ends: tuple[float, float] | None = None
    margin: float | None = None

    @property
    def share(self) -> float:
        """The margin as share of the range."""
        return MARGIN if self.margin is None else self.margin


@dataclass(frozen=True)
class Harmonic(MadeLaw):
    """q = middle − swing·cos(2π·t/period): rests at both ends and passes the middle fastest.

    A steady speed would jump from +v to −v at the ends, with infinite accelerations and inertia forces. ``swing`` is
    negative where it begins at the upper end. Coordinates in rad or m, the ``period`` in s.
    """

    middle: float
    swing: float
    period: float
    rotary: bool = True

    @classmethod
    def between(cls, low: float, high: float, speed: float, rotary: bool) -> Harmonic:
        """From one end to the other and back, with the size of ``speed`` as mean speed; begins at the end from which
        a driver of that sign moves."""
        swing = math.copysign(0.5 * (high - low), speed)
        return cls(0.5 * (low + high), swing, 2.0 * (high - low) / abs(speed), rotary)

    @property
    def ends(self) -> tuple[float, float]:
        """The smaller and the larger coordinate between which it moves."""
        return self.middle - abs(self.swing), self.middle + abs(self.swing)

    @property
    def pulsation(self) -> float:
        """2π/period, rad/s."""
        return 2.0 * math.pi / self.period

    def coordinate(self, t: Array) -> tuple[Array, Array, Array]:
        pulsation = self.pulsation
        c, s = np.cos(pulsation * t), np.sin(pulsation * t)
        swing = self.swing
        return self.middle - swing * c, swing * pulsation * s, swing * pulsation**2 * c

    def traced(self, t: Scalar, start: float, end: float) -> tuple[Scalar, Scalar, Scalar]:
        from linkwright.formula.trace import cos, sin

        pulsation, swing = self.pulsation, self.swing
        c, s = cos(pulsation * t), sin(pulsation * t)
        return self.middle - swing * c, swing * pulsation * s, swing * pulsation**2 * c

    def natural_duration(self) -> float:
        return self.period

    @property
    def placeable(self) -> bool:
        return True

    def time_at(self, coordinate: Array | float) -> Array:
        """The times on the way out, s; of a coordinate beyond the ends that of the end."""
        share = (self.middle - np.asarray(coordinate)) / self.swing
        return np.asarray(np.arccos(np.clip(share, -1.0, 1.0)) / self.pulsation)


@dataclass(frozen=True)
class Rocking(MadeLaw):
    """The law of a driver of constant speed in a cycle that rocks.

    ``steady``: the law of the file, whose speed is the mean one; ``machine``: the mechanism with that law and no
    cycle, whose limits are looked for when the law is first asked for. A driver without limits keeps its own law.
    """

    steady: Law
    rock: Rock
    machine: Any = field(repr=False, hash=False)
    rotary: bool = True

    key = "speed"

    @property
    def own(self) -> Law:
        return self.steady

    @cached_property
    def course(self) -> Law:
        """The law that holds: the harmonic between the limits, or the own one of a driver that finds none."""
        ends = self.rock.ends or self.limits()
        speed = self.steady.constant_speed
        return self.steady if ends is None or not speed else Harmonic.between(*ends, speed, self.rotary)

    @attached
    def limits(self) -> tuple[float, float] | None:
        """Between which coordinates it rocks, margins left; None where the driver turns fully."""
        raise NotImplementedError

    @property
    def ends(self) -> tuple[float, float] | None:
        """Smallest and largest coordinate; None where the driver turns fully."""
        return self.course.ends if isinstance(self.course, Harmonic) else None

    def coordinate(self, t: Array) -> tuple[Array, Array, Array]:
        return self.course.coordinate(t)

    def traced(self, t: Scalar, start: float, end: float) -> tuple[Scalar, Scalar, Scalar]:
        return self.course.traced(t, start, end)

    def natural_duration(self) -> float | None:
        return self.course.natural_duration()

    @property
    def constant_speed(self) -> float | None:
        return self.course.constant_speed

    @property
    def placeable(self) -> bool:
        return self.course.placeable

    def time_at(self, coordinate: Array | float) -> Array:
        return self.course.time_at(coordinate)

    def dimensions(self) -> Mapping[str, float]:
        return self.steady.dimensions()

    def with_dimensions(self, value: Callable[[str], float], parameters: Mapping[str, float]) -> Law:
        """The own law with these values; the mechanism gives it its cycle again."""
        return self.steady.with_dimensions(value, parameters)

    @classmethod
    def fields(cls, rotary: bool) -> Mapping[str, Field]:
        from linkwright.drivers.constant_speed import ConstantSpeed

        return ConstantSpeed.fields(rotary)

    def text_values(self) -> Mapping[str, object]:
        return self.steady.text_values()
