"""How a link hangs on another one: place, velocity and acceleration through a pin, a guide or a weld.

The chain's coordinate is the child's absolute rotation for a pin and the displacement of the block for a
guide; rates are their first and second derivatives. One class per kind; the chains never ask further.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from linkwright.engine.trace import Scalar
from linkwright.engine.vector import Vec
from linkwright.groups.base import Rotor
from linkwright.joints.prismatic import PrismaticJoint
from linkwright.joints.revolute import RevoluteJoint
from linkwright.joints.weld import WeldJoint
from linkwright.kinematics.dimensions import Dimensions
from linkwright.kinematics.pose import Pose, State
from linkwright.structure.group import TreeJoint

Coordinate = Rotor | Scalar | None


class Pair(Protocol):
    """One joint of an open chain, ready to be traced."""

    def place(self, parent: Pose, coordinate: Coordinate) -> Pose:
        """Pose of the child."""
        ...

    def rates(self, parent: State, pose: Pose, rate: Scalar) -> State:
        """Velocities of the child, from the chain coordinate's rate."""
        ...

    def accelerate(self, parent: State, child: State, rate: Scalar, second: Scalar) -> State:
        """Accelerations of the child, from the rate and second derivative of the coordinate."""
        ...


@dataclass(frozen=True)
class Pin:
    """A revolute joint; its coordinate is the child's rotor, its rate the child's angular velocity."""

    on_parent: Vec
    on_child: Vec

    def place(self, parent: Pose, coordinate: Coordinate) -> Pose:
        assert isinstance(coordinate, Rotor)
        return Pose(self.on_child, parent.point(self.on_parent), coordinate)

    def rates(self, parent: State, pose: Pose, rate: Scalar) -> State:
        return State(pose, parent.velocity_of(self.on_parent), rate)

    def accelerate(self, parent: State, child: State, rate: Scalar, second: Scalar) -> State:
        acceleration = parent.acceleration_of(self.on_parent)
        return State(child.pose, child.velocity, child.omega, acceleration, second)


@dataclass(frozen=True)
class Guide:
    """A prismatic joint; ``sign`` is -1 if the child carries the guide.

    ``on_parent``: the guide's point or the block's point of the parent; ``on_child`` of the child;
    ``direction``: of the guide, in the parent's axes; ``turned``: what the child's axes see of a vector
    that the parent's axes see as (1, 0).
    """

    on_parent: Vec
    on_child: Vec
    direction: Vec
    turned: Vec
    offset: Scalar
    sign: float

    def normal(self, parent: Pose) -> Vec:
        """The guide's direction, in frame axes, along which the child moves with a growing coordinate."""
        return parent.spin(self.direction) * self.sign

    def place(self, parent: Pose, coordinate: Coordinate) -> Pose:
        assert not isinstance(coordinate, Rotor) and coordinate is not None
        n = self.normal(parent)
        slid = parent.point(self.on_parent) + n * coordinate + n.perp * self.offset
        rotor = Rotor(parent.rotor.now, parent.rotor.local.turn(self.turned))
        return Pose(self.on_child, slid, rotor)

    def _arm(self, parent: State, child: Pose) -> Vec:
        return child.place - parent.pose.place

    def rates(self, parent: State, pose: Pose, rate: Scalar) -> State:
        carried = parent.velocity_at(self._arm(parent, pose))
        return State(pose, carried + self.normal(parent.pose) * rate, parent.omega)

    def accelerate(self, parent: State, child: State, rate: Scalar, second: Scalar) -> State:
        n = self.normal(parent.pose)
        carried = parent.acceleration_at(self._arm(parent, child.pose))
        coriolis = n.perp * (2.0 * (parent.omega * rate))
        return State(child.pose, child.velocity, child.omega, carried + coriolis + n * second, parent.alpha)


@dataclass(frozen=True)
class Fixed:
    """A weld: no coordinate."""

    on_parent: Vec
    on_child: Vec
    turned: Vec

    def place(self, parent: Pose, coordinate: Coordinate) -> Pose:
        rotor = Rotor(parent.rotor.now, parent.rotor.local.turn(self.turned))
        return Pose(self.on_child, parent.point(self.on_parent), rotor)

    def rates(self, parent: State, pose: Pose, rate: Scalar) -> State:
        return State(pose, parent.velocity_of(self.on_parent), parent.omega)

    def accelerate(self, parent: State, child: State, rate: Scalar, second: Scalar) -> State:
        acceleration = parent.acceleration_of(self.on_parent)
        return State(child.pose, child.velocity, child.omega, acceleration, parent.alpha)


def pair_of(step: TreeJoint, dimensions: Dimensions) -> Pin | Guide | Fixed:
    """The traced form of a chain's joint."""
    joint = dimensions.mechanism.joints[step.joint]
    if isinstance(joint, RevoluteJoint):
        return Pin(dimensions.point(step.parent, joint.name), dimensions.point(step.child, joint.name))
    if isinstance(joint, WeldJoint):
        turn = dimensions.weld_direction(joint)
        turned = turn.conjugate if step.child == joint.links[1] else turn
        return Fixed(dimensions.point(step.parent, joint.at), dimensions.point(step.child, joint.at), turned)
    assert isinstance(joint, PrismaticJoint)
    on_guide, on_block = dimensions.guide_direction(joint), dimensions.block_direction(joint)
    through = dimensions.point(joint.guide, joint.through)
    at = dimensions.point(joint.block, joint.at)
    offset = dimensions(f"{joint.name}.offset")
    if step.child == joint.block:
        return Guide(through, at, on_guide, on_guide.conjugate.turn(on_block), offset, 1.0)
    return Guide(at, through, on_block, on_block.conjugate.turn(on_guide), offset, -1.0)
