"""The cam of a mechanism, as the design that the calculations of this room check."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from linkwright.cams.cam import Cam
from linkwright.cams.follower import Follower
from linkwright.cams.loading import CamLoading
from linkwright.core.arrays import Floats
from linkwright.joints.cam import CamJoint
from linkwright.laws.program import TURN, Program
from linkwright.laws.traced import LiftCurve
from linkwright.mechanism.mechanism import Mechanism


@dataclass(frozen=True, eq=False)
class TabledLift(Program):
    """A lift through the points of a table, as the mechanism runs on it."""

    lift: LiftCurve
    period: float = TURN

    @property
    def edges(self) -> Floats:
        return self.lift.edges

    @property
    def breaks(self) -> Floats:
        return self.lift.edges

    def curves(self, x: Any) -> tuple[Any, Any, Any, Any]:
        s, v, a, j = self.lift.derivatives(x, 3)
        return s, v, a, j


def cam_of(mechanism: Mechanism, name: str, *, speed: float = 0.0) -> Cam:
    """The cam of a joint, turned so that its follower rises upward (oscillating: so that its pivot is on the x axis).

    ``speed``: size of the cam's angular velocity, rad/s, where it is constant.

    Raises KeyError where there is no such joint, TypeError where it is no cam.
    """
    joint = mechanism.joints[name]
    if not isinstance(joint, CamJoint):
        raise TypeError(name)
    geometry = joint.geometry(mechanism)
    return Cam(
        program=joint.program or TabledLift(joint.lift),
        follower=_follower(joint, mechanism)
        if joint.side
        else Follower(joint.touch, roller_radius=joint.roller_radius, offset=-geometry.aside),
        base_radius=joint.base_radius,
        turn=joint.sense,
        closure="groove" if joint.closure == "groove" and joint.touch == "roller" else "force",
        loading=CamLoading(speed=abs(speed)),
        name=name,
    )


def _follower(joint: CamJoint, mechanism: Mechanism) -> Follower:
    """A follower that swings: looking from its pivot the left side is below the line to the cam."""
    carrier, own = mechanism.link(joint.carrier).points, mechanism.link(joint.follower).points
    line = np.subtract(carrier[joint.centre], carrier[joint.holder])
    arm = np.subtract(own[joint.at], own[joint.holder])
    return Follower(
        joint.touch,
        "oscillating",
        roller_radius=joint.roller_radius,
        pivot_distance=float(np.hypot(*line)),
        arm=float(np.hypot(*arm)),
        below=joint.side == "left",
    )
