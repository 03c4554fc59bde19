"""A group's joints in the trace: those of its chains, its cuts, and the Jacobian of the cuts' equations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from linkwright.elements.topology import Connection, Group, TreeJoint
from linkwright.engine.trace import Scalar
from linkwright.engine.vector import Vec
from linkwright.joints.base import Cut, Pair
from linkwright.joints.pose import Pose, Rotor
from linkwright.kinematics.dimensions import Dimensions


def cut_of(connection: Connection, dimensions: Dimensions) -> Cut:
    """The traced form of a cut joint."""
    return dimensions.mechanism.joints[connection.joint].cut(connection, dimensions)


def jacobian(
    group: Group, cuts: Sequence[Cut], poses: Mapping[str, Pose], dimensions: Dimensions
) -> list[list[Scalar]]:
    """Rows: equations of the cuts; columns: the unknown chain coordinates."""
    steps = group.unknowns
    matrix: list[list[Scalar]] = []
    for cut in cuts:
        rows: list[list[Scalar]] = [[0.0] * len(steps) for _ in range(cut.rows)]
        for end in cut.ends:
            tip: Vec | None = None
            for step in group.path(end):
                if step.free:
                    if tip is None:
                        shift = _end_shift(step, end, cut, poses, dimensions)
                    else:
                        shift = _shift(step, tip, poses, dimensions)
                    turn = 1.0 if tip is None and step.turns else 0.0
                    for row, entry in zip(rows, cut.column(shift, turn, end, poses), strict=True):
                        row[steps.index(step)] = row[steps.index(step)] + entry
                    if step.turns:
                        tip = poses[step.child].place
        matrix += rows
    return matrix


def _shift(step: TreeJoint, tip: Vec, poses: Mapping[str, Pose], dimensions: Dimensions) -> Vec:
    """How a unit rate of a chain coordinate moves ``tip``, the next free pin or the cut.

    The coordinate of a pin is the absolute rotation of its link, so it turns only what lies before the next
    free pin of the chain.
    """
    if step.slides:
        return pair_of(step, dimensions).normal(poses[step.parent])
    return (tip - poses[step.child].place).perp


def _end_shift(step: TreeJoint, end: str, cut: Cut, poses: Mapping[str, Pose], dimensions: Dimensions) -> Vec:
    """The same for the last part of a chain, up to the cut itself."""
    if step.turns and step.child == end:
        return cut.arm(end, poses).perp
    return _shift(step, cut.place(end, poses), poses, dimensions)


Coordinate = Rotor | Scalar | None


def pair_of(step: TreeJoint, dimensions: Dimensions) -> Pair:
    """The traced form of a chain's joint."""
    return dimensions.mechanism.joints[step.joint].hang(step, dimensions)
