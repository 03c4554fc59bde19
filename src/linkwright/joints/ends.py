"""What the equation of a joint is written over: points, vectors and rotations of its links, with how they move."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from linkwright.elements import Sizes
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.trace import Scalar, Value, angle
from linkwright.joints.pose import Pose, State

Poses = Mapping[str, Pose]
States = Mapping[str, State]
#: The rotation of a link's x axis with its turns, rad, by the link's name.
Angles = Callable[[str], Scalar]
#: A function's value and first two derivatives.
Function = Callable[[Scalar], tuple[Scalar, Scalar, Scalar]]
#: ∂r/∂(x, y, θ) of one row by one link.
Part = tuple[Scalar, Scalar, Scalar]


@dataclass(frozen=True)
class Moving(ABC):
    """Something of a link that a motion changes, with one symbol for each of its components."""

    link: str

    @abstractmethod
    def values(self, poses: Poses, angles: Angles) -> Sequence[Scalar]:
        """Of real links."""

    def moves_with(self, link: str) -> bool:
        """Whether it changes with a link."""
        return link == self.link

    @abstractmethod
    def parts(self, link: str, values: Sequence[Scalar]) -> Sequence[Part]:
        """Derivatives of the components by (x, y, θ) of a link with which they change."""

    @abstractmethod
    def rates(self, states: States) -> Sequence[Scalar]:
        """First derivatives in time."""

    @abstractmethod
    def seconds(self, states: States) -> Sequence[Scalar]:
        """Second derivatives in time."""


@dataclass(frozen=True)
class _Anchor(Moving):
    """The place of a link's anchor."""

    def values(self, poses: Poses, angles: Angles) -> Sequence[Scalar]:
        place = poses[self.link].place
        return place.x, place.y

    def parts(self, link: str, values: Sequence[Scalar]) -> Sequence[Part]:
        return (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)

    def rates(self, states: States) -> Sequence[Scalar]:
        velocity = states[self.link].velocity
        return velocity.x, velocity.y

    def seconds(self, states: States) -> Sequence[Scalar]:
        acceleration = states[self.link].acceleration
        return acceleration.x, acceleration.y


@dataclass(frozen=True)
class _Arm(Moving):
    """A vector fixed in a link: ``local`` in its axes, or with ``to_point`` from the anchor to that point."""

    local: Vec
    to_point: bool

    def _own(self, pose: Pose) -> Vec:
        return self.local - pose.anchor if self.to_point else self.local

    def values(self, poses: Poses, angles: Angles) -> Sequence[Scalar]:
        pose = poses[self.link]
        found = pose.spin(self._own(pose))
        return found.x, found.y

    def parts(self, link: str, values: Sequence[Scalar]) -> Sequence[Part]:
        x, y = values
        return (0.0, 0.0, -y), (0.0, 0.0, x)

    def rates(self, states: States) -> Sequence[Scalar]:
        state = states[self.link]
        return self._of_rotor(state.pose, lambda arm: arm.perp * state.omega)

    def seconds(self, states: States) -> Sequence[Scalar]:
        state = states[self.link]
        square = state.omega * state.omega
        return self._of_rotor(state.pose, lambda arm: arm.perp * state.alpha - arm * square)

    def _of_rotor(self, pose: Pose, rate: Callable[[Vec], Vec]) -> Sequence[Scalar]:
        """The rate of a vector that lies along the rotor is a share of the rotor's own."""
        own = self._own(pose)
        share = own.over(pose.rotor.local)
        if isinstance(share.y, float) and share.y == 0.0:
            found = rate(pose.rotor.now) * share.x
        else:
            found = rate(pose.spin(own))
        return found.x, found.y


@dataclass(frozen=True)
class _Rotation(Moving):
    """The rotation of a link with its turns, rad."""

    def values(self, poses: Poses, angles: Angles) -> Sequence[Scalar]:
        return (0.0 if self.link == "frame" else angles(self.link),)

    def parts(self, link: str, values: Sequence[Scalar]) -> Sequence[Part]:
        return ((0.0, 0.0, 1.0),)

    def rates(self, states: States) -> Sequence[Scalar]:
        return (states[self.link].omega,)

    def seconds(self, states: States) -> Sequence[Scalar]:
        return (states[self.link].alpha,)


@dataclass(frozen=True)
class _Between(Moving):
    """The angle of a link's x axis from a direction in another link's axes, within half a turn, rad."""

    against: str
    direction: Vec

    def moves_with(self, link: str) -> bool:
        return link in (self.link, self.against)

    def values(self, poses: Poses, angles: Angles) -> Sequence[Scalar]:
        turned = poses[self.link].direction.turn(poses[self.against].spin(self.direction).conjugate)
        return (angle(turned.y, turned.x),)

    def parts(self, link: str, values: Sequence[Scalar]) -> Sequence[Part]:
        return ((0.0, 0.0, 1.0 if link == self.link else -1.0),)

    def rates(self, states: States) -> Sequence[Scalar]:
        return (states[self.link].omega - states[self.against].omega,)

    def seconds(self, states: States) -> Sequence[Scalar]:
        return (states[self.link].alpha - states[self.against].alpha,)


class Ends:
    """The links of a pair as its residual sees them: ``a`` and ``b``, and any others that it names."""

    def __init__(self, dimensions: Sizes, a: str, b: str) -> None:
        self.dimensions, self.a, self.b = dimensions, a, b
        self.links: dict[str, None] = {}
        self.moving: dict[Moving, tuple[Value, ...]] = {}
        self.of: dict[int, tuple[Moving, int]] = {}
        self.real: dict[int, Scalar] = {}
        self.fixed: dict[int, Scalar] = {}
        self.functions: dict[int, tuple[Scalar, Function, tuple[Value, ...]]] = {}
        self._count = 0

    def point(self, link: str, point: str) -> Vec:
        """A named point of a link, in frame axes, m."""
        place = self._vec(_Anchor(link))
        return place + self._vec(_Arm(link, self.local(link, point), True))

    def vector(self, link: str, local: Vec) -> Vec:
        """A vector that is fixed in a link, from the link's axes to frame axes."""
        return self._vec(_Arm(link, local, False))

    def rotation(self, link: str) -> Scalar:
        """Rotation of a link's x axis from the frame's with its turns, rad."""
        return self._symbols(_Rotation(link), 1)[0]

    def angle_from(self, link: str, against: str, direction: Vec) -> Scalar:
        """Angle of a link's x axis from a ``direction`` in the axes of link ``against``, -π to π, rad."""
        self.links[against] = None
        return self._symbols(_Between(link, against, direction), 1)[0]

    def still(self, value: Scalar) -> Scalar:
        """The value, taken as one that motion does not change (its change with the dimensions remains)."""
        found = self.symbol()
        self.fixed[found.index] = value
        return found

    def function(self, x: Scalar, of: Function) -> tuple[Scalar, Scalar]:
        """A function of x, and its derivative as a value that is taken as still.

        ``of`` gives its value and first two derivatives, where shorter formulas for these are known.
        """
        off, (value, first, second) = x - self.still(x), (self.symbol() for _ in range(3))
        for each in (value, first, second):
            self.functions[each.index] = (x, of, (value, first, second))
        return value + first * off + 0.5 * second * (off * off), first

    def known(self, value: Scalar) -> Scalar:
        """A value of real links."""
        found = self.symbol()
        self.real[found.index] = value
        return found

    def local(self, link: str, point: str) -> Vec:
        """A named point in the axes of its link, m."""
        return self.dimensions.point(link, point)

    def dimension(self, address: str) -> Scalar:
        """A dimension by its address (``guide.offset``)."""
        return self.dimensions(address)

    def unit(self, address: str) -> Vec:
        """Unit vector at an angle that is a dimension."""
        return self.dimensions.unit(address)

    def _vec(self, moving: Moving) -> Vec:
        return Vec(*self._symbols(moving, 2))

    def _symbols(self, moving: Moving, count: int) -> tuple[Value, ...]:
        self.links[moving.link] = None
        if moving not in self.moving:
            self.moving[moving] = tuple(self.symbol() for _ in range(count))
            self.of |= {symbol.index: (moving, k) for k, symbol in enumerate(self.moving[moving])}
        return self.moving[moving]

    def symbol(self) -> Value:
        """A symbol that belongs to no link, such as the coordinate of a chain."""
        self._count += 1
        return self.dimensions.symbols.number(self._count - 1)


@dataclass(frozen=True)
class Hung:
    """How a lower pair hangs a child on its parent.

    The child's ``anchor`` in its own axes, its ``place`` over the pair's ends and coordinate, and for pairs that do
    not turn what the child's axes see of the parent's vector (1, 0).
    """

    anchor: Vec
    place: Vec
    turned: Vec | None = None
