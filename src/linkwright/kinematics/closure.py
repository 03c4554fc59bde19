"""Closure of a group at its cut joints: residuals, Jacobian, and the linear equations of the rates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from linkwright.engine.trace import Scalar
from linkwright.engine.vector import Vec
from linkwright.joints.prismatic import PrismaticJoint
from linkwright.joints.revolute import RevoluteJoint
from linkwright.kinematics.dimensions import Dimensions
from linkwright.kinematics.pairs import Guide, pair_of
from linkwright.kinematics.pose import Pose, State
from linkwright.structure.group import Connection, Group, TreeJoint


@dataclass(frozen=True)
class PinCut:
    """A pin that was cut: the point on ``a`` and the point on ``b`` must coincide (two equations)."""

    connection: Connection
    on_a: Vec
    on_b: Vec

    @property
    def rows(self) -> int:
        return 2

    def residual(self, poses: Mapping[str, Pose]) -> list[Scalar]:
        gap = poses[self.connection.a].point(self.on_a) - poses[self.connection.b].point(self.on_b)
        return [gap.x, gap.y]

    def column(self, shift: Vec, end: str, poses: Mapping[str, Pose]) -> list[Scalar]:
        """Rows of the Jacobian for a coordinate that shifts this end of the cut by ``shift``."""
        sign = 1.0 if end == self.connection.a else -1.0
        return [shift.x * sign, shift.y * sign]

    def point(self, end: str) -> Vec:
        return self.on_a if end == self.connection.a else self.on_b

    def drift(self, states: Mapping[str, State]) -> list[Scalar]:
        """Relative velocity of the two ends."""
        a, b = states[self.connection.a], states[self.connection.b]
        gap = a.velocity_of(self.on_a) - b.velocity_of(self.on_b)
        return [gap.x, gap.y]

    def bend(self, states: Mapping[str, State]) -> list[Scalar]:
        """Relative acceleration of the two ends."""
        a, b = states[self.connection.a], states[self.connection.b]
        gap = a.acceleration_of(self.on_a) - b.acceleration_of(self.on_b)
        return [gap.x, gap.y]

    def force_on(self, end: str, multipliers: Sequence[Scalar], poses: Mapping[str, Pose]) -> Vec:
        """Force on one end from the multipliers of the rows."""
        force = Vec(multipliers[0], multipliers[1])
        return force if end == self.connection.a else -force

    def place(self, end: str, poses: Mapping[str, Pose]) -> Vec:
        """Where that force acts."""
        return poses[end].point(self.point(end))


@dataclass(frozen=True)
class GuideCut:
    """A guide that was cut; its rotation is prevented elsewhere, so only the normal distance is left."""

    connection: Connection
    through: Vec
    at: Vec
    direction: Vec
    offset: Scalar

    @property
    def rows(self) -> int:
        return 1

    def _normal(self, poses: Mapping[str, Pose]) -> Vec:
        return poses[self.connection.a].spin(self.direction).perp

    def residual(self, poses: Mapping[str, Pose]) -> list[Scalar]:
        a, b = poses[self.connection.a], poses[self.connection.b]
        return [self._normal(poses).dot(b.point(self.at) - a.point(self.through)) - self.offset]

    def column(self, shift: Vec, end: str, poses: Mapping[str, Pose]) -> list[Scalar]:
        sign = 1.0 if end == self.connection.b else -1.0
        return [self._normal(poses).dot(shift) * sign]

    def point(self, end: str) -> Vec:
        return self.at

    def drift(self, states: Mapping[str, State]) -> list[Scalar]:
        a, b = states[self.connection.a], states[self.connection.b]
        place = b.pose.point(self.at)
        gap = b.velocity_of(self.at) - a.velocity_at(place - a.pose.place)
        return [a.pose.spin(self.direction).perp.dot(gap)]

    def bend(self, states: Mapping[str, State]) -> list[Scalar]:
        a, b = states[self.connection.a], states[self.connection.b]
        arm = b.pose.point(self.at) - a.pose.place
        n = a.pose.spin(self.direction)
        slide = n.dot(b.velocity_of(self.at) - a.velocity_at(arm))
        gap = b.acceleration_of(self.at) - a.acceleration_at(arm)
        return [n.perp.dot(gap) - 2.0 * (a.omega * slide)]

    def force_on(self, end: str, multipliers: Sequence[Scalar], poses: Mapping[str, Pose]) -> Vec:
        force = self._normal(poses) * multipliers[0]
        return force if end == self.connection.b else -force

    def place(self, end: str, poses: Mapping[str, Pose]) -> Vec:
        return poses[self.connection.b].point(self.at)


Cut = PinCut | GuideCut


def cut_of(connection: Connection, dimensions: Dimensions) -> Cut:
    """The traced form of a cut joint."""
    joint = dimensions.mechanism.joints[connection.joint]
    if isinstance(joint, RevoluteJoint):
        return PinCut(
            connection,
            dimensions.point(connection.a, joint.name),
            dimensions.point(connection.b, joint.name),
        )
    assert isinstance(joint, PrismaticJoint)
    return GuideCut(
        connection,
        dimensions.point(joint.guide, joint.through),
        dimensions.point(joint.block, joint.at),
        dimensions.guide_direction(joint),
        dimensions(f"{joint.name}.offset"),
    )


def jacobian(
    group: Group, cuts: Sequence[Cut], poses: Mapping[str, Pose], dimensions: Dimensions
) -> list[list[Scalar]]:
    """Rows: equations of the cuts; columns: the unknown chain coordinates."""
    steps = group.unknowns
    matrix: list[list[Scalar]] = []
    for cut in cuts:
        rows: list[list[Scalar]] = [[0.0] * len(steps) for _ in range(cut.rows)]
        for end in (cut.connection.a, cut.connection.b):
            tip: Vec | None = None
            for step in group.path(end):
                if step.free:
                    if tip is None:
                        shift = _end_shift(step, end, cut, poses, dimensions)
                    else:
                        shift = _shift(step, tip, poses, dimensions)
                    for row, entry in zip(rows, cut.column(shift, end, poses), strict=True):
                        row[steps.index(step)] = row[steps.index(step)] + entry
                    if step.kind == "revolute" and step.free:
                        tip = poses[step.child].place
        matrix += rows
    return matrix


def _shift(step: TreeJoint, tip: Vec, poses: Mapping[str, Pose], dimensions: Dimensions) -> Vec:
    """How a unit rate of a chain coordinate moves ``tip``, the next free pin or the cut.

    The coordinate of a pin is the absolute rotation of its link, so it turns only what lies before the next
    free pin of the chain.
    """
    if step.kind == "prismatic":
        pair = pair_of(step, dimensions)
        assert isinstance(pair, Guide)
        return pair.normal(poses[step.parent])
    return (tip - poses[step.child].place).perp


def _end_shift(step: TreeJoint, end: str, cut: Cut, poses: Mapping[str, Pose], dimensions: Dimensions) -> Vec:
    """The same for the last part of a chain, up to the cut itself."""
    pose = poses[step.child]
    if step.kind == "revolute" and step.child == end and isinstance(cut, PinCut):
        return pose.spin(cut.point(end) - pose.anchor).perp
    return _shift(step, cut.place(end, poses), poses, dimensions)
