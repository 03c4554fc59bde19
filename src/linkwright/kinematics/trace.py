"""The motion of a mechanism, traced along its solving order into one program, and all its outputs by name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence, Set
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from linkwright.core.inputs import Input
from linkwright.core.outputs import KINDS, POINT, SLIDE, Output, row_name, row_names
from linkwright.elements import Group, TreeJoint
from linkwright.formula.linear_algebra import ZERO, Vec, product
from linkwright.formula.trace import Mask, Scalar, Trace, select
from linkwright.joints.pose import FRAME_POSE, FRAME_STATE, Pose, State
from linkwright.kinematics.dimensions import Dimensions, DriverInput, driver_input, moving, pace_name
from linkwright.kinematics.equation import reaction_place
from linkwright.kinematics.groups import GroupTracer, Placed, dyad_shape, pair_of
from linkwright.kinematics.names import canonical, find_point
from linkwright.kinematics.rotations import Angles
from linkwright.mechanism.mechanism import Mechanism
from linkwright.topology.analysis import Structure


@dataclass
class MotionTrace:
    """Every link's state as traced values, and what the groups know about themselves.

    ``outcome``: 0 where the mechanism is in position, else the number (from 1) of the first group that
    is not, negative if it is in reach but singular.
    """

    mechanism: Mechanism
    structure: Structure
    trace: Trace
    dimensions: Dimensions
    drivers: dict[str, DriverInput]
    poses: dict[str, Pose] = field(default_factory=lambda: {"frame": FRAME_POSE})
    states: dict[str, State] = field(default_factory=lambda: {"frame": FRAME_STATE})
    placed: dict[str, Placed] = field(default_factory=dict)
    valid: Mask = True
    outcome: Scalar = 0.0
    angles: Angles = field(init=False)

    @property
    def next_states(self) -> dict[str, Scalar]:
        """Chain coordinates of the groups without closed form, carried to the next position."""
        own = {name: value for p in self.placed.values() for name, value in p.next_states.items()}
        return own | self.angles.carried

    def moving(self, rate: Scalar, second: Scalar, dimension: str) -> Scalar:
        """A rate, with its own rate, of an ``angle`` or a ``length``, zero at rest; the rate itself where drivers are
        free, as none of its digits is rounding then."""
        if not all(driver.law.prescribed for driver in self.mechanism.drivers.values()):
            return rate
        pace, turning = (self.trace.parameter(pace_name(each)) for each in (dimension, "angle"))
        return moving(rate, second, pace, turning)

    def turning(self, link: str, against: str) -> Scalar:
        """Angular velocity of a link against another one, rad/s, zero at rest."""
        a, b = self.states[against], self.states[link]
        return self.moving(b.omega - a.omega, b.alpha - a.alpha, "angle")

    def reaction_place(self, joint: str) -> Vec:
        """Where the force of a joint is reported."""
        return reaction_place(self.mechanism.joints[joint], self.dimensions, self.poses)

    def point(self, link: str, local: Vec) -> tuple[Vec, Vec, Vec]:
        """Position, velocity and acceleration of a point in a link's axes."""
        state = self.states[link]
        return state.pose.place + state.arm(local), state.velocity_of(local), state.acceleration_of(local)


def trace_motion(
    mechanism: Mechanism,
    structure: Structure,
    *,
    free: Set[str] = frozenset(),
    iterations: int = 1,
    modes_vary: Set[str] = frozenset(),
    rates: bool = True,
) -> MotionTrace:
    """Traces positions and, with ``rates``, velocities and accelerations of all links.

    ``free``: dimensions that will vary (others are known zeros where they are zero); ``iterations``:
    Newton steps of groups without closed form, 0: all groups are left open as their states say; ``modes_vary``:
    groups (by name) whose assembly mode is set per position, for motion through change points.
    """
    trace = Trace()
    dimensions = Dimensions(mechanism, trace, free)
    drivers = {name: driver_input(driver, dimensions) for name, driver in mechanism.drivers.items()}
    motion = MotionTrace(mechanism, structure, trace, dimensions, drivers)

    def mode(group: Group) -> Scalar:
        shape = dyad_shape(group)
        if shape is None or not shape[0].words[0]:
            return 1.0
        name = Input("mode", group.name).name
        return trace.position(name) if group.name in modes_vary else trace.parameter(name)

    angles = motion.angles = Angles(structure.groups, dimensions, motion.poses)
    placer = GroupTracer(dimensions, drivers, motion.poses, angles, iterations=iterations, mode=mode)
    for group in structure.groups:
        motion.placed[group.name] = placer.place(group)
    if rates:
        _add_rates(motion)
    _judge(motion)
    return motion


def _add_rates(motion: MotionTrace) -> None:
    mover = RateTracer(motion.dimensions, motion.drivers, motion.poses, motion.states)
    for placed in motion.placed.values():
        mover.move(placed)


def _judge(motion: MotionTrace) -> None:
    """Outcome of the position: the first group that is out of reach or singular, or has a pair that does not fit."""
    outcome: Scalar = 0.0
    valid: Mask = True
    sizes = [(joint.joined, joint.fits(motion.dimensions)) for joint in motion.mechanism.joints.values()]
    doubtful = [(joined, fits) for joined, fits in sizes if fits is not True]
    for number, placed in reversed(list(enumerate(motion.placed.values(), 1))):
        fits: Mask = True
        for joined, each in doubtful:
            if not set(placed.group.links).isdisjoint(joined):
                fits = motion.trace.logic("and", fits, each)
        good = motion.trace.logic("and", placed.valid, fits)
        if good is True:
            continue
        lost = select(motion.trace.logic("and", placed.reached, fits), -float(number), float(number))
        outcome = select(good, outcome, lost)
        valid = motion.trace.logic("and", good, valid)
    motion.valid, motion.outcome = valid, outcome


Rates = Mapping[TreeJoint, Scalar]


class RateTracer:
    """Traces rates group after group into ``states``; keeps the chain coordinates' rates in ``found``.

    The same three lines serve every group: the chains are run through with the unknown rates at zero, what is then
    missing at the cuts gives the right side, and the chains are run through again.
    """

    def __init__(
        self,
        dimensions: Dimensions,
        drivers: Mapping[str, DriverInput],
        poses: Mapping[str, Pose],
        states: dict[str, State],
    ) -> None:
        self.dimensions = dimensions
        self.drivers = drivers
        self.poses = poses
        self.states = states
        self.found: dict[TreeJoint, Scalar] = {}

    def move(self, placed: Placed) -> None:
        """Velocities and accelerations of a group's links, found and stored."""
        unknowns = placed.group.unknowns
        self._velocities(placed, dict.fromkeys(unknowns, 0.0))
        drift = [entry for cut in placed.cuts for entry in cut.drift(self.states)]
        rates = self._solved(placed, drift)
        self._velocities(placed, rates)
        self._accelerations(placed, dict.fromkeys(unknowns, 0.0))
        bend = [entry for cut in placed.cuts for entry in cut.bend(self.states)]
        seconds = self._solved(placed, bend)
        self._accelerations(placed, seconds)
        placed.rates, placed.seconds = rates, seconds

    def _solved(self, placed: Placed, gap: Sequence[Scalar]) -> Rates:
        solution = product(placed.inverse, [-entry for entry in gap])
        return dict(zip(placed.group.unknowns, solution, strict=True))

    def _velocities(self, placed: Placed, rates: Rates) -> None:
        for step in placed.group.tree:
            parent = self.states[step.parent]
            rate = self._rate(step, parent.omega, rates)
            self.found[step] = rate
            pair = pair_of(step, self.dimensions)
            self.states[step.child] = pair.rates(parent, self.poses[step.child], rate)

    def _accelerations(self, placed: Placed, seconds: Rates) -> None:
        for step in placed.group.tree:
            parent, child = self.states[step.parent], self.states[step.child]
            second = self._second(step, parent.alpha, seconds)
            pair = pair_of(step, self.dimensions)
            self.states[step.child] = pair.accelerate(parent, child, self.found[step], second)

    def _rate(self, step: TreeJoint, carried: Scalar, rates: Rates) -> Scalar:
        if step.driver is None:
            return rates.get(step, 0.0)
        return self._with_drive(step, self.drivers[step.driver].rate, carried)

    def _second(self, step: TreeJoint, carried: Scalar, seconds: Rates) -> Scalar:
        if step.driver is None:
            return seconds.get(step, 0.0)
        return self._with_drive(step, self.drivers[step.driver].second, carried)

    def _with_drive(self, step: TreeJoint, value: Scalar, carried: Scalar) -> Scalar:
        """A driver's rate as the chain counts it: absolute for a pin, of the block for a guide."""
        if step.slides:
            return value
        assert step.driver is not None
        own = step.child == self.dimensions.mechanism.drivers[step.driver].link
        return carried + value if own else carried - value


class MotionOutputs:
    """Looks outputs up by name in a :class:`MotionTrace`."""

    def __init__(self, motion: MotionTrace) -> None:
        self.motion = motion
        self.mechanism = motion.mechanism
        self._points: dict[str, tuple[Vec, Vec, Vec]] = {}

    def value(self, name: str) -> Scalar:
        """The traced value of an output, by its row; raises KeyError for one that is not of the motion."""
        output = Output.of_row(name)
        found = self.of(output)
        return found if not isinstance(found, Vec) else found.x if output.component == "x" else found.y

    def of(self, output: Output) -> Scalar | Vec:
        """The traced value of an output, of a vector with all components."""
        kind, owner, motion = output.kind, output.owner, self.motion
        match KINDS[kind].of:
            case "point":
                if owner not in self._points:
                    self._points[owner] = self.point(owner)
                return self._points[owner][POINT.index(kind)]
            case "guide":
                return self.slide(owner)[SLIDE.index(kind)]
            case "joint" if kind == "reaction_place":
                return motion.reaction_place(owner)
            case "link" if kind == "direction":
                return motion.poses[owner].direction
            case "link" if kind == "turned_angle":
                return motion.angles(owner)
            case "link":
                state = motion.states[owner]
                return state.omega if kind == "angular_velocity" else state.alpha
            case "group":
                placed = motion.placed[owner]
                return placed.quality if kind == "quality" else placed.facts[output.on]
        return motion.outcome

    def point(self, key: str) -> tuple[Vec, Vec, Vec]:
        """Position, velocity, acceleration of ``C``, ``jaw.D`` or ``jaw.centre`` (the mass centre)."""
        if key.endswith(".@centre"):
            link = key.removesuffix(".@centre")
            return self.motion.point(link, self.motion.dimensions.centre(link))
        link, point = find_point(self.mechanism, key)
        link = self._cheapest(link, point)
        return self.motion.point(link, self.motion.dimensions.point(link, point))

    def _cheapest(self, link: str, point: str) -> str:
        """For a pin, the link that turns about a point at rest, if there is one."""
        links = self.mechanism.pin_links(point)
        if link not in links:
            return link
        if "frame" in links:
            return "frame"
        for name in links:
            if self.motion.states and self.motion.states.get(name) and self.motion.states[name].velocity == ZERO:
                return name
        order = list(self.motion.states)
        return min(links, key=order.index) if set(links) <= set(order) else link

    def slide(self, joint_name: str) -> tuple[Scalar, Scalar, Scalar]:
        """Displacement of a guide's block with its rates."""
        joint: Any = self.mechanism.joints[joint_name]
        dimensions, states = self.motion.dimensions, self.motion.states
        guide, block = states[joint.guide], states[joint.block]
        n = guide.pose.spin(joint.slide_direction(dimensions))
        start = guide.arm(dimensions.point(joint.guide, joint.through))
        at = dimensions.point(joint.block, joint.at)
        gap = block.pose.place + block.arm(at) - guide.pose.place
        rate = n.dot(block.velocity_of(at) - guide.velocity_at(gap))
        second = n.dot(block.acceleration_of(at) - guide.acceleration_at(gap))
        return n.dot(gap - start), rate, second

    @cached_property
    def standard(self) -> tuple[str, ...]:
        """What every motion result stores: pins and points with rates, rotation rates, the outcome."""
        names: list[str] = []
        for key in self.point_keys():
            names += (name for kind in POINT for name in row_names(kind, key))
        for link in self.mechanism.links:
            names += (row_name("angular_velocity", link), row_name("angular_acceleration", link))
        return (*names, row_name("outcome"))

    def point_keys(self) -> Iterable[str]:
        """Canonical names of all points of the moving links that the frame does not carry."""
        keys: dict[str, None] = {}
        for name, link in self.mechanism.links.items():
            for point in link.points:
                key = canonical(self.mechanism, name, point)
                if "frame" not in self.mechanism.pin_links(key):
                    keys[key] = None
        return keys
