"""The two limit positions of an output."""

from __future__ import annotations

import numpy as np

from linkwright.errors import RequestError
from linkwright.joints.prismatic import PrismaticJoint
from linkwright.kinematics.limits import LimitPosition, limit_positions
from linkwright.kinematics.motion import Motion


def limits_of(motion: Motion, output: str | None = None) -> tuple[LimitPosition, ...]:
    """The reversals of an output with its largest and its smallest value, exact in the input.

    ``output``: a link, a guide or a point's coordinate; by default the last link or block on the frame, in
    solving order, that goes to and fro. Raises LinkwrightError where nothing turns back.
    """
    name = output or _last_to_and_fro(motion)
    found = limit_positions(motion, name)
    if not found:
        raise RequestError(f'"{name}" does not turn back in this motion, so it has no limit positions')
    high, low = max(found, key=lambda each: each.value), min(found, key=lambda each: each.value)
    return (high,) if high is low else (high, low)


def _last_to_and_fro(motion: Motion) -> str:
    joints = motion.mechanism.joints
    driven = {driver.joint for driver in motion.mechanism.drivers.values()}
    for group in reversed(motion.structure.groups):
        for link in reversed(group.links):
            for name, joint in joints.items():
                if name in driven or not {"frame", link} <= set(joint.joined):
                    continue
                if isinstance(joint, PrismaticJoint):
                    return name
                angle = motion.link(link).angle
                if np.nanmax(angle) - np.nanmin(angle) < 1.9 * np.pi:
                    return link
    raise RequestError(
        f"no link of {motion.mechanism.name!r} on the frame goes to and fro, so there are no limit positions; "
        "name a link or a guide, such as limits:coupler"
    )
