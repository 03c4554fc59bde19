"""Dimensions of a mechanism as traced values: parameters of the program, or known zeros."""

from __future__ import annotations

from collections.abc import Set
from math import cos as cosine
from math import sin as sine

from linkwright.engine.trace import Scalar, Trace, cos, reciprocal, sin, sqrt
from linkwright.engine.vector import Vec
from linkwright.joints.prismatic import PrismaticJoint
from linkwright.joints.weld import WeldJoint
from linkwright.model.geometry import centre, local_points
from linkwright.model.mechanism import Link, Mechanism


class Dimensions:
    """Gives every dimension as a parameter of the trace.

    A dimension that is zero in the mechanism, and not among the ``free`` ones that are going to vary, is a
    known zero, so that what it multiplies is never computed.
    """

    def __init__(self, mechanism: Mechanism, trace: Trace, free: Set[str] = frozenset()) -> None:
        self.mechanism = mechanism
        self.trace = trace
        self.free = free
        self.nominal = mechanism.dimensions()
        self._points: dict[str, dict[str, Vec]] = {}

    def __call__(self, address: str) -> Scalar:
        """The dimension at an address (``crank.length``)."""
        expression = self.mechanism.expressions.get(address)
        if expression is not None and address not in self.free and self._follows(address):
            return self._from_expression(address)
        if self.nominal[address] == 0.0 and address not in self.free:
            return 0.0
        return self.trace.parameter(address)

    def _follows(self, address: str) -> bool:
        """Whether a dimension is an expression of something that varies."""
        expression = self.mechanism.expressions.get(address)
        if expression is None:
            return address in self.free
        return any(self._follows(name) for name in expression.names)

    def _from_expression(self, address: str) -> Scalar:
        from linkwright.kinematics.expressions import traced

        return traced(self.mechanism.expressions[address], self)

    def link(self, name: str) -> Link:
        """A link by name, the frame included."""
        return self.mechanism.frame if name == "frame" else self.mechanism.links[name]

    def point(self, link: str, point: str) -> Vec:
        """A point of a link, in the link's axes."""
        if link not in self._points:
            found = local_points(self.link(link), self, cos, sin)
            self._points[link] = {name: Vec(x, y) for name, (x, y) in found.items()}
        return self._points[link][point]

    def centre(self, link: str) -> Vec:
        """The mass centre of a link, in the link's axes."""
        first = next(iter(self.link(link).points))
        self.point(link, first)
        x, y = centre(self.link(link), {n: (v.x, v.y) for n, v in self._points[link].items()}, self)
        return Vec(x, y)

    def guide_direction(self, joint: PrismaticJoint) -> Vec:
        """Unit vector along a guide, in the axes of the link that carries it."""
        if joint.direction_points is None:
            return self._unit(f"{joint.name}.direction")
        start, end = (self.point(joint.guide, name) for name in joint.direction_points)
        d = end - start
        if isinstance(d.y, float) and d.y == 0.0 and not isinstance(d.x, float):
            nominal = self.link(joint.guide).points
            ahead = nominal[joint.direction_points[1]][0] > nominal[joint.direction_points[0]][0]
            if f"{joint.guide}.length" not in self.free and ahead:
                return Vec(1.0, 0.0)
        return d * reciprocal(sqrt(d.square))

    def block_direction(self, joint: PrismaticJoint) -> Vec:
        """Unit vector along the guide, in the axes of the block."""
        return self._unit(f"{joint.name}.block_angle")

    def weld_direction(self, joint: WeldJoint) -> Vec:
        """Unit vector of the second link's x axis in the first link's axes."""
        return self._unit(f"{joint.name}.angle")

    def _unit(self, address: str) -> Vec:
        angle = self(address)
        if not isinstance(angle, float) and not self._follows(address):
            turns = round(self.nominal[address] / (0.5 * _PI))
            if self.nominal[address] == turns * 0.5 * _PI:
                return _QUARTERS[turns % 4]
        if isinstance(angle, float):
            return Vec(cosine(angle), sine(angle))
        return Vec(cos(angle), sin(angle))


_PI = 3.141592653589793
_QUARTERS = (Vec(1.0, 0.0), Vec(0.0, 1.0), Vec(-1.0, 0.0), Vec(0.0, -1.0))
