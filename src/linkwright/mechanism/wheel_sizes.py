"""Sizes of wheels: what the pairs of a mechanism say of their teeth, radii and ratios, and how large discs are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import singledispatch

from linkwright.joints.base import Joint
from linkwright.joints.cam import CamJoint
from linkwright.joints.gear import GearPair
from linkwright.joints.rack import RackPair
from linkwright.joints.toothed import WheelPair
from linkwright.mechanism.cam_shape import CamShape
from linkwright.mechanism.mechanism import Mechanism


@dataclass(frozen=True)
class WheelSizes:
    """A pair with wheels on its ``links``: ``teeth``, pitch ``radii`` (m), centre ``distance``
    (m), ``ratio`` on the carrier, ``module`` (m) and ``pressure_angle`` (rad), as far as it has them; ``involute``:
    whether these are two gears whose teeth follow from number and module."""

    links: tuple[str, ...]
    teeth: tuple[float, ...] | None
    radii: tuple[float, ...]
    distance: float | None = None
    ratio: float | None = None
    module: float | None = None
    pressure_angle: float | None = None
    involute: bool = False


@singledispatch
def wheel_sizes(joint: Joint, mechanism: Mechanism) -> WheelSizes | None:
    """The sizes of a pair with wheels; None of any other joint."""
    return None


@wheel_sizes.register
def of_wheels(joint: WheelPair, mechanism: Mechanism) -> WheelSizes:
    """Sizes of two wheels on a carrier."""
    radii = tuple(abs(each) for each in joint.arms(mechanism))
    return WheelSizes(joint.links, joint.teeth, radii, abs(joint.line(mechanism)), joint.transmission)


@wheel_sizes.register
def _(joint: GearPair, mechanism: Mechanism) -> WheelSizes:
    sizes, angle = of_wheels(joint, mechanism), joint.pressure_angle
    return replace(sizes, module=joint.module, pressure_angle=angle, involute=joint.involute)


@wheel_sizes.register
def _(joint: RackPair, mechanism: Mechanism) -> WheelSizes:
    teeth, angle = None if joint.teeth is None else (joint.teeth,), joint.pressure_angle
    return WheelSizes(joint.joined, teeth, (joint.radius,), module=joint.module, pressure_angle=angle)


def disc_radii(joint: Joint, mechanism: Mechanism) -> Mapping[str, float]:
    """How far the wheels and cams of a joint reach from their centres, m, by the names of their links."""
    if isinstance(joint, CamJoint):
        return {joint.cam: CamShape.of(joint, mechanism).reach} if joint.centre else {}
    sizes = wheel_sizes(joint, mechanism)
    return {} if sizes is None else dict(zip(sizes.links, sizes.radii, strict=False))
