"""One equation of a joint, and all that solvers need of it, by differentiation.

The :meth:`~linkwright.joints.base.Joint.residual` of a kind is recorded once per pair of links, with symbols for
what moves (:class:`~linkwright.joints.ends.Ends`): places of the links' anchors, vectors fixed in links, rotations.
The engine differentiates it by these, and the values of real links are substituted. From the derivatives follow

- ``parts`` ∂r/∂(x, y, θ) of a link: columns of Jacobians, rows for the rank, and by virtual work the wrenches
  λ ∂r/∂(x, y, θ);
- ``drift`` dr/dt and ``bend`` d²r/dt² from the links' velocities and accelerations (Haug, Computer Aided Kinematics
  and Dynamics of Mechanical Systems, ch. 3).

``held`` rows are those that other joints keep, such as the distance of two wheels' centres, each with the multiplier
that follows from the joint's own force: forces that do no work, which the residual cannot know.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property

from linkwright.elements import Connection, Sizes, TreeJoint
from linkwright.formula.differentiation import slope
from linkwright.formula.linear_algebra import ZERO, Vec
from linkwright.formula.replay import Substitution
from linkwright.formula.trace import Scalar, Value
from linkwright.joints.base import Joint
from linkwright.joints.ends import Angles, Ends, Moving, Part, Poses, States
from linkwright.joints.pose import Pose, Rotor, State

#: Force and moment about the link's anchor, N and N·m.
Wrench = tuple[Vec, Scalar]


class _Real:
    """What the symbols of an equation stand for where real links are."""

    def __init__(self, ends: Ends, poses: Poses, angles: Angles) -> None:
        self.ends, self.poses, self.angles = ends, poses, angles
        self.values: dict[int, Sequence[Scalar]] = {}
        self.parts: dict[str, list[Part]] = {}
        self.put = Substitution(ends.dimensions.trace, self._replacement)

    def of(self, moving: Moving) -> Sequence[Scalar]:
        """Values of one that moves."""
        if id(moving) not in self.values:
            self.values[id(moving)] = moving.values(self.poses, self.angles)
        return self.values[id(moving)]

    def vec(self, vector: Vec) -> Vec:
        """A vector of real links."""
        return Vec(self.put(vector.x), self.put(vector.y))

    def _replacement(self, index: int) -> Scalar | None:
        ends = self.ends
        if index in ends.of:
            moving, component = ends.of[index]
            return self.of(moving)[component]
        if index in ends.real:
            return ends.real[index]
        if index in ends.functions:
            x, of, symbols = ends.functions[index]
            self.put.found |= zip((each.index for each in symbols), of(self.put(x)), strict=True)
            return self.put.found[index]
        return self.put(ends.fixed[index]) if index in ends.fixed else None


#: Derivatives with the symbols by which they are these, and those by which they are their opposites.
Shared = list[tuple[Scalar, tuple[list[int], list[int]]]]


class _Row:
    """One row with its derivatives by the symbols that move in it, by the numbers of their lines."""

    def __init__(self, ends: Ends, value: Scalar) -> None:
        self.ends, self.value = ends, value
        self.first = self._derivatives(value)
        self._second: dict[int, Shared] = {}

    @cached_property
    def shared(self) -> Shared:
        """The derivatives, equal ones together."""
        return _shared(self.first)

    def second(self, symbol: int, part: Value) -> Shared:
        """Derivatives of one of the derivatives."""
        if symbol not in self._second:
            self._second[symbol] = _shared(self._derivatives(part))
        return self._second[symbol]

    def _derivatives(self, value: Scalar) -> list[tuple[int, Scalar]]:
        return self.ends.dimensions.symbols.derivatives(value, self.ends.of)


def _shared(parts: Iterable[tuple[int, Scalar]]) -> Shared:
    """What changes by the same factor is added up before it is multiplied."""
    found: dict[Scalar, tuple[list[int], list[int]]] = {}
    for symbol, part in parts:
        if -part in found:
            found[-part][1].append(symbol)
        else:
            found.setdefault(part, ([], []))[0].append(symbol)
    return list(found.items())


class Rows:
    """Equations between links, with their derivatives, in the trace of the dimensions."""

    def __init__(self, ends: Ends, values: Sequence[Scalar], angles: Angles) -> None:
        self.joint_ends, self.angles = ends, angles
        self._rows = [_Row(ends, value) for value in values]
        self._last: tuple[list[Pose], _Real] | None = None

    @property
    def rows(self) -> int:
        """How many equations there are."""
        return len(self._rows)

    @property
    def ends(self) -> tuple[str, ...]:
        """The links on whose motion the equations depend."""
        return tuple(self.joint_ends.links)

    def _real(self, poses: Poses) -> _Real:
        here = [poses[link] for link in self.joint_ends.links]
        if self._last is None or any(a is not b for a, b in zip(self._last[0], here, strict=True)):
            self._last = here, _Real(self.joint_ends, poses, self.angles)
        return self._last[1]

    def residual(self, poses: Poses) -> list[Scalar]:
        """What the equations leave open."""
        real = self._real(poses)
        return [real.put(row.value) for row in self._rows]

    def parts(self, poses: Poses) -> dict[str, list[Part]]:
        """∂r/∂(x, y, θ) of every end, row by row."""
        return {end: self._parts(end, poses) for end in self.ends}

    def _parts(self, link: str, poses: Poses) -> list[Part]:
        real = self._real(poses)
        if link not in real.parts:
            real.parts[link] = [_part(self.joint_ends, row, link, real) for row in self._rows]
        return real.parts[link]

    def wrenches(self, multipliers: Sequence[Scalar], poses: Poses) -> dict[str, Wrench]:
        """What multipliers of the rows exert on both links of the pair: λ ∂r/∂(x, y, θ)."""
        return {end: _wrench(self._parts(end, poses), multipliers) for end in (self.joint_ends.a, self.joint_ends.b)}

    def drift(self, states: States) -> list[Scalar]:
        """First derivative of the equations in time."""
        real, rates = (self._real(_Poses(states)), in_time(self.joint_ends, lambda moving: moving.rates(states)))
        return [_along(row.shared, rates, real) for row in self._rows]

    def bend(self, states: States) -> list[Scalar]:
        """Second derivative of the equations in time."""
        real, rates = (self._real(_Poses(states)), in_time(self.joint_ends, lambda moving: moving.rates(states)))
        seconds = in_time(self.joint_ends, lambda moving: moving.seconds(states))
        return [_twice(row, rates, seconds, real) for row in self._rows]


class Equation(Rows):
    """The equation of a joint between the two links of a connection."""

    def __init__(self, joint: Joint, connection: Connection, dimensions: Sizes, angles: Angles) -> None:
        ends = Ends(dimensions, connection.a, connection.b)
        super().__init__(ends, joint.residual(ends), angles)
        self.joint, self.connection, self.dimensions = joint, connection, dimensions
        self._places: dict[str, tuple[Ends, Vec]] = {}

    @property
    def on(self) -> str:
        """The link of the connection on which the force is reported."""
        return (self.connection.a, self.connection.b)[self.joint.reported_on]

    def held(self, force: Scalar, poses: Poses, size: Callable[[Scalar], Scalar]) -> dict[str, Wrench]:
        """What the rows that other joints keep exert on both links; empty where there are none.

        ``size``: of the joint's own force, where it enters by its size.
        """
        ends = Ends(self.dimensions, self.connection.a, self.connection.b)
        held = self.joint.held(ends, ends.known(force), lambda _: ends.known(size(force)))
        if not held:
            return {}
        rows = Rows(ends, [row for row, _ in held], self.angles)
        real = rows._real(poses)
        return rows.wrenches([real.put(multiplier) for _, multiplier in held], poses)

    def place(self, end: str, poses: Poses) -> Vec:
        """Where the force on a link of the connection is reported."""
        if end not in self._places:
            ends = Ends(self.dimensions, self.connection.a, self.connection.b)
            self._places[end] = ends, self.joint.place(ends, end)
        ends, place = self._places[end]
        return _Real(ends, poses, self.angles).vec(place)


def in_time(ends: Ends, of: Callable[[Moving], Sequence[Scalar]]) -> dict[int, Scalar]:
    """Rates of the symbols."""
    return {
        symbol.index: rate
        for moving, symbols in ends.moving.items()
        for symbol, rate in zip(symbols, of(moving), strict=True)
    }


def _along(parts: Shared, rates: Mapping[int, Scalar], real: _Real) -> Scalar:
    total: Scalar = 0.0
    for part, (forwards, backwards) in parts:
        change = _sum(rates, forwards) - _sum(rates, backwards)
        if not (isinstance(change, float) and change == 0.0):
            total = total + real.put(part) * change
    return total


def _sum(rates: Mapping[int, Scalar], symbols: Sequence[int]) -> Scalar:
    total: Scalar = 0.0
    for symbol in symbols:
        total = total + rates[symbol]
    return total


def _twice(row: _Row, rates: Mapping[int, Scalar], seconds: Mapping[int, Scalar], real: _Real) -> Scalar:
    """The parts times second rates, and their own rates times first ones."""
    total = _along(row.shared, seconds, real)
    for symbol, part in row.first:
        if isinstance(part, Value):
            total = total + _along(row.second(symbol, part), rates, real) * rates[symbol]
    return total


def _part(ends: Ends, row: _Row, link: str, real: _Real) -> Part:
    total: list[Scalar] = [0.0, 0.0, 0.0]
    for symbol, part in row.first:
        moving, component = ends.of[symbol]
        if moving.moves_with(link):
            factor, changes = real.put(part), moving.parts(link, real.of(moving))[component]
            total = [sum_ + factor * change for sum_, change in zip(total, changes, strict=True)]
    return total[0], total[1], total[2]


def _wrench(parts: Sequence[Part], multipliers: Sequence[Scalar]) -> Wrench:
    force, moment = ZERO, 0.0  # type: tuple[Vec, Scalar]
    for (x, y, turn), multiplier in zip(parts, multipliers, strict=True):
        force, moment = force + Vec(multiplier * x, multiplier * y), moment + multiplier * turn
    return force, moment


def reaction_place(joint: Joint, dimensions: Sizes, poses: Poses) -> Vec:
    """Where the force of a joint is reported, m."""
    a, b = joint.joined[:2]
    ends = Ends(dimensions, a, b)
    place = joint.place(ends, (a, b)[joint.reported_on])
    return _Real(ends, poses, _unturned).vec(place)


def _unturned(link: str) -> Scalar:
    """For what takes no rotation with its turns."""
    return 0.0


class _Poses(Mapping[str, Pose]):
    """The poses of states."""

    def __init__(self, states: States) -> None:
        self.states = states

    def __getitem__(self, link: str) -> Pose:
        return self.states[link].pose

    def __iter__(self) -> Iterator[str]:
        return iter(self.states)

    def __len__(self) -> int:
        return len(self.states)


class ChainPair:
    """A lower pair of an open chain, in the trace of the dimensions.

    Its coordinate q is the child's rotor where it turns, else a displacement, in which the child's place is linear:
    the child moves with what the parent carries along and with ∂place/∂q, which turns with the parent, times dq/dt.
    """

    def __init__(self, joint: Joint, step: TreeJoint, dimensions: Sizes) -> None:
        self.step = step
        self.ends = Ends(dimensions, step.connection.a, step.connection.b)
        self._coordinate = self.ends.symbol()
        self.hung = joint.hang(self.ends, step, self._coordinate)
        place, by = self.hung.place, {self._coordinate: 1.0}
        self._normal = Vec(slope(place.x, by), slope(place.y, by)) if step.slides else ZERO
        self._rows = Rows(self.ends, [] if step.slides else [place.x, place.y], _unturned)

    def place(self, parent: Pose, coordinate: Rotor | Scalar | None) -> Pose:
        """Pose of the child."""
        real = _Real(self.ends, {self.step.parent: parent}, _unturned)
        if isinstance(coordinate, Rotor):
            rotor = coordinate
        else:
            assert self.hung.turned is not None
            rotor = Rotor(parent.rotor.now, parent.rotor.local.turn(self.hung.turned))
            if coordinate is not None:
                real.put.found[self._coordinate.index] = coordinate
        return Pose(self.hung.anchor, real.vec(self.hung.place), rotor)

    def normal(self, parent: Pose) -> Vec:
        """How the child's anchor moves with a growing displacement, in frame axes."""
        return self._rows._real({self.step.parent: parent}).vec(self._normal)

    def arm(self, parent: Pose) -> Vec:
        """From the parent's anchor to the child's, of a pair without displacement."""
        (_, _, x), (_, _, y) = self._rows.parts({self.step.parent: parent})[self.step.parent]
        return Vec(y, -x)

    def rates(self, parent: State, pose: Pose, rate: Scalar) -> State:
        """Velocities of the child, from the coordinate's rate."""
        if self.step.slides:
            velocity = parent.velocity_at(pose.place - parent.pose.place) + self.normal(parent.pose) * rate
            return State(pose, velocity, parent.omega)
        velocity = Vec(*self._rows.drift({self.step.parent: parent}))
        return State(pose, velocity, rate if self.step.turns else parent.omega)

    def accelerate(self, parent: State, child: State, rate: Scalar, second: Scalar) -> State:
        """Accelerations of the child, from the rate and second derivative of the coordinate."""
        if self.step.slides:
            n, arm = self.normal(parent.pose), child.pose.place - parent.pose.place
            carried = parent.acceleration_at(arm) + n.perp * (2.0 * (parent.omega * rate))
            return State(child.pose, child.velocity, child.omega, carried + n * second, parent.alpha)
        acceleration = Vec(*self._rows.bend({self.step.parent: parent}))
        alpha = second if self.step.turns else parent.alpha
        return State(child.pose, child.velocity, child.omega, acceleration, alpha)
