"""The joints of open chains as traced pairs."""

from __future__ import annotations

from linkwright.engine.trace import Scalar
from linkwright.joints.base import Pair
from linkwright.joints.pose import Rotor
from linkwright.kinematics.dimensions import Dimensions
from linkwright.structure.group import TreeJoint

Coordinate = Rotor | Scalar | None


def pair_of(step: TreeJoint, dimensions: Dimensions) -> Pair:
    """The traced form of a chain's joint."""
    return dimensions.mechanism.joints[step.joint].hang(step, dimensions)
