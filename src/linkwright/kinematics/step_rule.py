"""What a step must fulfil so that a group without closed form keeps its assembly: one rule for one machine, for many
and for pages.

A step is predicted with the exact rates of two orders and corrected by Newton's method. It counts if the determinants
keep their signs, the correction, of third order small, is small against the step, and both ends' exact rates fit one
quintic. Where a step can be halved, doubt halves it.
"""

from __future__ import annotations

from dataclasses import field

from linkwright.core.dataclass import dataclass
from linkwright.core.inputs import Input
from linkwright.elements.topology import TreeJoint
from linkwright.formula.trace import Mask, Scalar, absolute, maximum, minimum, reciprocal, select
from linkwright.formula.vector import Vec
from linkwright.joints.pose import Rotor
from linkwright.kinematics.closure import Coordinate
from linkwright.kinematics.groups import Placed, carried, moved, state_name
from linkwright.kinematics.trace import MotionTrace

#: Largest correction, and largest misfit of both ends' rates, as share of the step.
CORRECTION, MISFIT = 0.1, 0.01
#: Largest change of a coordinate in one step, rad or share of the size.
LARGEST = 0.3
#: What a correction and a misfit may be beside these shares: rounding; and where steps cannot be halved, as where a
#: cam's rise begins behind a dwell: no other assembly of the same sign of the determinant is so near.
ROUNDING, ROOM = 1e-10, 1e-4


def doubt(change: Scalar, correction: Scalar, misfit: Scalar, room: Scalar) -> Scalar:
    """Of a step's largest change, correction and misfit: below 1 the step counts."""
    return maximum(
        correction * reciprocal(CORRECTION * change + room), misfit * reciprocal(MISFIT * change + room)
    )


@dataclass
class StepRule:
    """Whether a traced position is on the assembly of the one before, and what is carried to the next.

    ``kept``: the truth value; ``margin``: 1 far from being refused, 0 at the edge; ``following``: values of the
    states at the next position; ``begin``: the states at the first position, beside the chain coordinates, as values
    or as the names of the coordinates that they repeat.
    """

    motion: MotionTrace
    step: Scalar
    kept: Mask = True
    margin: Scalar = 1.0
    following: dict[str, Scalar] = field(default_factory=dict)
    begin: dict[str, float | str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        trace = self.motion.trace
        begun = self._state("begun", 0.0, 1.0)
        self.following |= self.motion.angles.carried
        for placed in self.motion.placed.values():
            if placed.coordinates:
                self._judge(placed, trace.compare("less", begun, 0.5))

    def _state(self, name: str, begin: float | str, following: Scalar) -> Scalar:
        """A state of the rule: its value from the position before."""
        self.begin[name], self.following[name] = begin, following
        return self.motion.trace.field_input(name)

    def _judge(self, placed: Placed, first: Mask) -> None:
        trace = self.motion.trace
        change: Scalar = 0.0
        correction: Scalar = 0.0
        misfit: Scalar = 0.0
        predicted: dict[TreeJoint, Coordinate] = {}
        for joint, value in placed.coordinates.items():
            way, off, gap, predicted[joint] = self._coordinate(placed, joint, value)
            change, correction, misfit = (
                maximum(old, absolute(new)) for old, new in ((change, way), (correction, off), (misfit, gap))
            )
        self.following |= carried(placed.group, predicted)
        sign = select(trace.compare("less", placed.determinant, 0.0), -1.0, 1.0)
        before = self._state(f"sign:{placed.group.name}", 0.0, sign)
        off = doubt(change, correction, misfit, ROOM)
        kept = trace.logic("and", trace.compare("less", 0.0, before * sign), trace.compare("less", off, 1.0))
        kept = trace.logic("and", kept, trace.compare("less", change, LARGEST))
        self.kept = trace.logic("and", self.kept, trace.logic("or", first, kept))
        self.margin = minimum(self.margin, select(first, 1.0, 1.0 - off))

    def _coordinate(
        self, placed: Placed, joint: TreeJoint, value: Coordinate
    ) -> tuple[Scalar, Scalar, Scalar, Coordinate]:
        """Change since the position before, correction, misfit of both ends' rates (rad, shares); the next start."""
        name, h = state_name(placed.group, joint), self.step
        rate, second = placed.rates[joint], placed.seconds[joint]
        rate_before = self._state(Input("rate", name).name, 0.0, rate)
        second_before = self._state(Input("second", name).name, 0.0, second)
        predicted = moved(value, h * rate + 0.5 * (h * h) * second)
        if isinstance(value, Rotor):
            scale = 1.0
            start = Vec(*(self.motion.trace.field_input(f"{name}.{axis}") for axis in "xy"))
            before = Vec(
                self._state(f"before:{name}.x", f"{name}.x", value.now.x),
                self._state(f"before:{name}.y", f"{name}.y", value.now.y),
            )
            way, off = _angle(before, value.now), _angle(start, value.now)
        else:
            assert value is not None
            scale = 1.0 / self.motion.mechanism.size if joint.slides else 1.0
            state = f"{name}.s" if joint.slides else f"{name}.angle"
            way = value - self._state(f"before:{state}", state, value)
            off = value - self.motion.trace.field_input(state)
        quintic = 0.5 * h * (rate + rate_before) + (h * h * (1.0 / 12.0)) * (second_before - second)
        return way * scale, off * scale, (way - quintic) * scale, predicted


def _angle(a: Vec, b: Vec) -> Scalar:
    """The angle from one unit vector to another, rad; to 2e-6 of itself below 0.3 rad."""
    half = a.cross(b) * reciprocal(1.0 + a.dot(b))
    square = half * half
    return 2.0 * half * (1.0 - square * (1.0 / 3.0 - square * 0.2))
