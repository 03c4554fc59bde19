"""The mechanism as a load sees it, over a traced motion."""

from __future__ import annotations

from linkwright.engine.trace import Scalar, cos, sin
from linkwright.engine.vector import Vec
from linkwright.joints.prismatic import PrismaticJoint
from linkwright.kinematics.trace import MotionTrace
from linkwright.loads.base import Load
from linkwright.model.signal_fields import Output


def limit_name(output: Output, kind: str) -> str:
    """Name of the parameter that holds the input of an output's limit."""
    return f"limit:{output}:{kind}"


def guide_state(motion: MotionTrace, joint: str) -> tuple[Vec, Vec, Scalar]:
    """Of a prismatic joint: the guide's unit vector, the block's point, the sliding velocity."""
    prismatic = motion.mechanism.joints[joint]
    assert isinstance(prismatic, PrismaticJoint)
    guide, block = motion.states[prismatic.guide], motion.states[prismatic.block]
    direction = guide.pose.spin(motion.dimensions.guide_direction(prismatic))
    at = motion.dimensions.point(prismatic.block, prismatic.at)
    place = block.pose.place + block.arm(at)
    relative = block.velocity_of(at) - guide.velocity_at(place - guide.pose.place)
    return direction, place, direction.dot(relative)


class TracedSite:
    """One load's view; see :class:`linkwright.loads.site.Site`.

    ``along_input``: the magnitude is traced over the input (see ``loads.along_input``); else one that varies is an
    input of the program per position.
    """

    def __init__(self, motion: MotionTrace, load: Load, *, along_input: bool = False) -> None:
        self.motion = motion
        self.load = load
        self.along_input = along_input

    def place(self, link: str, point: str) -> Vec:
        state = self.motion.states[link]
        return state.pose.place + state.arm(self.motion.dimensions.point(link, point))

    def velocity(self, link: str, point: str) -> Vec:
        state = self.motion.states[link]
        return state.velocity_of(self.motion.dimensions.point(link, point))

    def axis(self, link: str) -> Vec:
        return self.motion.states[link].pose.direction

    def omega(self, link: str) -> Scalar:
        return self.motion.states[link].omega

    def guide(self, joint: str) -> tuple[Vec, Vec, Scalar]:
        return guide_state(self.motion, joint)

    def dimension(self, field: str) -> Scalar:
        return self.motion.dimensions(f"loads.{self.load.name}.{field}")

    def magnitude(self) -> Scalar:
        from linkwright.loads.magnitude import is_constant

        if is_constant(self.load):
            return self.dimension("magnitude")
        if self.along_input:
            from linkwright.loads.along_input import magnitude

            return magnitude(self.load, self)
        return self.motion.trace.field_input(f"load:{self.load.name}")

    @property
    def input(self) -> Scalar:
        """The first driver's coordinate."""
        return self.motion.trace.position("input")

    @property
    def speed(self) -> Scalar:
        """Its constant rate."""
        return self.motion.trace.parameter(f"{next(iter(self.motion.mechanism.drivers))}.speed")

    def named(self, name: str) -> Scalar:
        """A parameter of the model, ``t`` or ``input``."""
        if name in self.motion.mechanism.parameters:
            return self.motion.dimensions(name)
        return self.input if name == "input" else self.motion.trace.position("time")

    def limit(self, output: Output, kind: str) -> Scalar:
        """The input at which an output has its only ``max`` or ``min``: a number per design, found before."""
        return self.motion.trace.parameter(limit_name(output, kind))

    def direction(self, angle: Scalar) -> Vec:
        return Vec(cos(angle), sin(angle))
