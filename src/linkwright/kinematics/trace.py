"""The motion of a mechanism, traced along its solving order into one program."""

from __future__ import annotations

from collections.abc import Set
from dataclasses import dataclass, field

from linkwright.core.inputs import Input
from linkwright.elements.topology import Group
from linkwright.formula.trace import Mask, Scalar, Trace, select
from linkwright.formula.vector import Vec
from linkwright.joints.pose import FRAME_POSE, FRAME_STATE, Pose, State
from linkwright.kinematics.angles import Angles
from linkwright.kinematics.dimensions import Dimensions, DriverInput, driver_input
from linkwright.kinematics.equation import reaction_place
from linkwright.kinematics.groups import GroupTracer, Placed, dyad_shape
from linkwright.kinematics.rates import RateTracer
from linkwright.kinematics.rest import moving, pace_name
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
        """A rate, with its own rate, of an ``angle`` or a ``length``, zero at rest."""
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
