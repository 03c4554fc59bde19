"""A group's joints in the trace: those of its chains, its cuts, and the Jacobian of the cuts' equations."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from linkwright.elements.topology import Connection, Group, TreeJoint
from linkwright.formula.trace import Scalar
from linkwright.joints.ends import Angles
from linkwright.joints.pose import Pose, Rotor
from linkwright.kinematics.dimensions import Dimensions
from linkwright.kinematics.equation import ChainPair, Equation

Coordinate = Rotor | Scalar | None


def cut_of(connection: Connection, dimensions: Dimensions, angles: Angles) -> Equation:
    """The equation of a cut joint."""
    return Equation(dimensions.mechanism.joints[connection.joint], connection, dimensions, angles)


def pair_of(step: TreeJoint, dimensions: Dimensions) -> ChainPair:
    """The traced form of a chain's joint."""
    if step not in dimensions.pairs:
        joint = dimensions.mechanism.joints[step.joint]
        dimensions.pairs[step] = ChainPair(joint, step, dimensions)
    return dimensions.pairs[step]


def jacobian(
    group: Group, cuts: Sequence[Equation], poses: Mapping[str, Pose], dimensions: Dimensions
) -> list[list[Scalar]]:
    """Rows: equations of the cuts; columns: the unknown chain coordinates.

    How a unit rate of a coordinate moves and turns the anchor of an end, times the derivatives of the rows by it.
    """
    steps = group.unknowns
    matrix: list[list[Scalar]] = []
    for cut in cuts:
        rows: list[list[Scalar]] = [[0.0] * len(steps) for _ in range(cut.rows)]
        for end, parts in cut.parts(poses).items():
            tip = poses[end].place
            for step, turn in _turning(group, end):
                pivot = poses[step.child].place
                shift = (tip - pivot).perp if step.turns else pair_of(step, dimensions).normal(poses[step.parent])
                k = steps.index(step)
                for row, (x, y, about) in zip(rows, parts, strict=True):
                    row[k] = row[k] + (x * shift.x + y * shift.y + about * turn)
                if step.turns:
                    tip = pivot
        matrix += rows
    return matrix


def _turning(group: Group, end: str) -> Iterator[tuple[TreeJoint, float]]:
    """The unknown joints from an end inwards, and whether they turn it.

    1 for the first that turns, as the coordinate of a pin is the absolute rotation of its link; else 0.
    """
    first = 1.0
    for step in group.path(end):
        if step.free:
            yield step, first if step.turns else 0.0
            first = 0.0 if step.turns else first
