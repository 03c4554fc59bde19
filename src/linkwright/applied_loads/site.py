"""What a load sees of the mechanism while it is traced, and what it answers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

from linkwright.drivers.base import Driver
from linkwright.formula.linear_algebra import ZERO, Vec
from linkwright.formula.trace import Scalar
from linkwright.joints.base import Joint
from linkwright.joints.lower_pair import SlidingJoint


@dataclass(frozen=True)
class Wrench:
    """A force (N, frame axes) on a link at a place (m, frame axes), and a torque (N·m)."""

    link: str
    force: Vec = ZERO
    place: Vec = ZERO
    torque: Scalar = 0.0


class Body(Protocol):
    """A link, or the frame."""

    @property
    def points(self) -> Mapping[str, tuple[float, float]]: ...


class Mechanism(Protocol):
    """What loads ask of the mechanism they act on."""

    @property
    def parameters(self) -> Mapping[str, float]: ...
    @property
    def frame(self) -> Body: ...
    @property
    def links(self) -> Mapping[str, Body]: ...
    @property
    def joints(self) -> Mapping[str, Joint]: ...
    @property
    def guides(self) -> Mapping[str, SlidingJoint]: ...
    @property
    def drivers(self) -> Mapping[str, Driver]: ...
    def link(self, name: str) -> Body: ...


class Described(Protocol):
    """Something that knows its mechanism."""

    @property
    def mechanism(self) -> Mechanism: ...


class Site(Protocol):
    """The mechanism at one position, as traced values in SI and frame axes. The frame is at rest."""

    @property
    def motion(self) -> Described: ...

    @property
    def time(self) -> Scalar:
        """Time, s."""
        ...

    def place(self, link: str, point: str) -> Vec: ...
    def distance(self, link: str, a: str, b: str) -> Scalar: ...
    def velocity(self, link: str, point: str) -> Vec: ...
    def omega(self, link: str) -> Scalar: ...

    def axis(self, link: str) -> Vec:
        """Unit vector of the link's x axis."""
        ...

    def turning(self, link: str, against: str) -> Scalar:
        """Angular velocity of a link against another one; zero at rest, where digits would tell its sign."""
        ...

    def turning_second(self, link: str, against: str) -> Scalar:
        """Its rate, rad/s²; zero where inertia is left out."""
        ...

    def sliding_second(self, joint: str) -> Scalar:
        """Acceleration of the block of a prismatic joint along its guide, m/s²; zero where inertia is left out."""
        ...

    def drive_sense(self, link: str, against: str) -> Scalar:
        """1, or -1 where a driver turns or moves a link against another one the other way, by its nominal speed."""
        ...

    def heading_of(self, link: str, point: str) -> Vec:
        """Unit vector of the velocity of a point of a link; zero at rest."""
        ...

    def guide(self, joint: str) -> tuple[Vec, Vec, Scalar]:
        """Of a prismatic joint: the guide's unit vector, the block's point, the sliding velocity."""
        ...

    def dimension(self, field: str) -> Scalar:
        """A quantity of this load by the name of its field (``stiffness``)."""
        ...

    def magnitude(self) -> Scalar:
        """The load's magnitude here: its size within its phase, zero outside."""
        ...

    def direction(self, angle: Scalar) -> Vec:
        """Unit vector at an angle that is a dimension."""
        ...
