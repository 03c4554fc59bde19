"""Drivers and what all their laws have in common."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar

from linkwright.formula.late_import import numpy as np
from linkwright.registry import Registry
from linkwright.words import Message, _

if TYPE_CHECKING:
    from linkwright.core.arrays import Floats
    from linkwright.drivers.cylinder import Cylinder
    from linkwright.fields.base import Field
    from linkwright.formula.trace import Scalar

    Array = Floats


#: Of a driver without a law where a motion is prescribed.
NO_LAW = _(
    "driver {name!r} is free, so no law says its motion; find the motion under forces (linkwright run, lw.run), the "
    "accelerations at one position (linkwright solve --free, lw.release), or give the driver a law such as speed: "
    "{speed}",
    code="dynamics.free_driver",
)
BEYOND_LAW = _(
    "the driver's table covers {first:g} s to {last:g} s, but the motion asks for "
    "{begin:g} s to {end:g} s; shorten the cycle or extend the table",
    code="loads.table_range",
)


class Law(ABC):
    """A joint coordinate as a function of time; ``rotary`` laws are in rad, the others in m.

    ``key`` is the key of the driver in the file that chooses the law.
    """

    key: ClassVar[str]
    #: Whether it says the coordinate at a time.
    prescribed: ClassVar[bool] = True
    rotary: bool

    @abstractmethod
    def coordinate(self, t: Array) -> tuple[Array, Array, Array]:
        """Coordinate and its exact first and second derivative at the times ``t`` (n,) in s."""

    def traced(self, t: Scalar, start: float, end: float) -> tuple[Scalar, Scalar, Scalar]:
        """The same at a traced time from ``start`` to ``end``, s."""
        from linkwright.laws.law_pieces import law_pieces

        return law_pieces(self, start, end).traced(t)

    def at(self, time: float) -> float:
        """Coordinate at one time, s."""
        return float(self.coordinate(np.array([time]))[0][0])

    def natural_duration(self) -> float | None:
        """Time in s after which the law repeats or ends; None where it has no such time."""
        return None

    def span(self) -> tuple[float, float]:
        """First and last time in s at which the law says the coordinate."""
        return -math.inf, math.inf

    def breaks(self, start: float, end: float) -> Array:
        """Times in s from ``start`` to ``end`` at which the coordinate or a derivative of it may jump, in order."""
        return np.empty(0)

    @property
    def own(self) -> Law:
        """The law that the file gives, in whatever cycle."""
        return self

    @property
    def constant_speed(self) -> float | None:
        """The speed of a law q = start + speed t, rad/s or m/s; None for another."""
        return None

    @property
    def placeable(self) -> bool:
        """Whether a coordinate has a time, that of ``time_at``."""
        return self.constant_speed is not None

    def time_at(self, coordinate: Array | float) -> Array:
        """The times (s) at which a law of constant speed has coordinates; 0 where it rests."""
        start, speed = self.at(0.0), self.constant_speed
        return np.asarray((coordinate - start) / speed if speed else 0.0 * np.asarray(coordinate))

    def dimensions(self) -> Mapping[str, float]:
        """Names of the law's dimensions within the driver (``speed``) with their SI values."""
        return {}

    def with_dimensions(self, value: Callable[[str], float], parameters: Mapping[str, float]) -> Law:
        """The same law with the values that ``value`` gives for the names of ``dimensions``."""
        return self

    @classmethod
    @abstractmethod
    def fields(cls, rotary: bool) -> Mapping[str, Field]:
        """What the file may say about the law, ``key`` among it."""

    @classmethod
    @abstractmethod
    def from_values(cls, values: Mapping[str, object], rotary: bool, parameters: Mapping[str, float]) -> Law:
        """The law from the values that were read by ``fields``."""

    @abstractmethod
    def text_values(self) -> Mapping[str, object]:
        """The values of ``fields``, for writing a file."""


class MadeLaw(Law):
    """A law that no file says: it follows from other keys of the model."""

    @classmethod
    def fields(cls, rotary: bool) -> Mapping[str, Field]:
        return {}

    @classmethod
    def from_values(cls, values: Mapping[str, object], rotary: bool, parameters: Mapping[str, float]) -> Law:
        raise NotImplementedError

    def text_values(self) -> Mapping[str, object]:
        return {}


def repeated(places: Array, period: float, start: float, end: float) -> Array:
    """Places of a period and those of the periods before and after, from ``start`` to ``end``, in order."""
    first, last = math.floor((start - places[-1]) / period), math.ceil((end - places[0]) / period)
    every = np.sort((places + period * np.arange(first, last + 1)[:, None]).ravel())
    return np.asarray(every[(every >= start) & (every <= end)])


@dataclass(frozen=True)
class Driver:
    """Prescribes the coordinate of a joint.

    Revolute: the angle of ``link`` against ``relative_to`` (x axis to x axis, counter-clockwise positive).
    Prismatic: the joint's displacement; ``link`` is the block, ``relative_to`` the guide link. A ``cylinder``
    drives the distance of two points; the joint is then its own.
    """

    name: str
    joint: str
    link: str
    relative_to: str
    law: Law
    cylinder: Cylinder | None = None

    def fields(self) -> Mapping[str, Field]:
        """What a file may say about the driver's law, and about its cylinder."""
        fields = self.law.fields(self.law.rotary)
        if self.cylinder is None:
            return fields
        from linkwright.drivers.cylinder import CYLINDER_FIELDS

        return {**CYLINDER_FIELDS, **fields}

    def dimensions(self) -> Mapping[str, float]:
        """Addresses of the driver's dimensions (``driver.speed``) with their SI values."""
        own = {} if self.cylinder is None else self.cylinder.dimensions()
        return {f"{self.name}.{name}": value for name, value in {**self.law.dimensions(), **own}.items()}

    def with_dimensions(self, value: Callable[[str], float], parameters: Mapping[str, float]) -> Driver:
        """The same driver with the values that ``value`` gives for the addresses of ``dimensions``."""

        def own(name: str) -> float:
            return value(f"{self.name}.{name}")

        cylinder = None if self.cylinder is None else self.cylinder.with_dimensions(own)
        return replace(self, law=self.law.with_dimensions(own, parameters), cylinder=cylinder)


LAWS: Registry[type[Law]] = Registry(
    _("driver law"), "linkwright.drivers", entry_points="linkwright.drivers", attribute="key"
)

#: Kinds of laws in words.
LABELS: Mapping[str, Message] = {
    "speed": _("constant speed"),
    "table": _("table"),
    "program": _("motion program"),
    "position": _("expression of the time"),
    "free": _("free, moved by forces"),
}
