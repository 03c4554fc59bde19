"""What a load sees of the mechanism while it is traced, and what it answers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from linkwright.core.dataclass import dataclass
from linkwright.drivers.base import Driver
from linkwright.engine.trace import Scalar
from linkwright.engine.vector import ZERO, Vec
from linkwright.joints.base import Joint
from linkwright.joints.lower import SlidingJoint


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
    def points(self) -> Mapping[str, tuple[float, float]]:
        """Its named points in its axes, m."""
        ...


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
    def link(self, name: str) -> Body:
        """A link, the frame among them."""
        ...


class Described(Protocol):
    """Something that knows its mechanism."""

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism as the file gives it."""
        ...


class Site(Protocol):
    """The mechanism at one position, as traced values. The frame is at rest."""

    @property
    def motion(self) -> Described:
        """What moves."""
        ...

    def place(self, link: str, point: str) -> Vec:
        """A point of a link in frame axes, m."""
        ...

    def distance(self, link: str, a: str, b: str) -> Scalar:
        """Distance of two points of a link, m."""
        ...

    def velocity(self, link: str, point: str) -> Vec:
        """Velocity of a point of a link, m/s."""
        ...

    def axis(self, link: str) -> Vec:
        """Unit vector of the link's x axis."""
        ...

    def omega(self, link: str) -> Scalar:
        """Angular velocity of a link, rad/s."""
        ...

    def turning(self, link: str, against: str) -> Scalar:
        """Angular velocity of a link against another one, rad/s; zero at rest, where digits would tell its sign."""
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
        """Unit vector at an angle given as a dimension."""
        ...


def guide_and_block(site: Site, joint: str) -> tuple[str, str]:
    """The links of a prismatic joint: the one that carries the guide, the one that slides."""
    found = site.motion.mechanism.guides[joint]
    return found.guide, found.block
