"""Positions at which an output turns back."""

from __future__ import annotations

import numpy as np

from linkwright.errors import LinkwrightError
from linkwright.joints.prismatic import PrismaticJoint
from linkwright.kinematics.motion import Motion
from linkwright.plot.svg.element import Floats


def limit_positions(motion: Motion, output: str | None = None) -> tuple[int, int]:
    """Indices of the positions with the largest and the smallest displacement or angle of an output.

    ``output``: a link or a guide; by default the last in solving order that goes to and fro.
    Raises LinkwrightError where nothing does.
    """
    values = _course(motion, output) if output is not None else _default(motion)
    return int(np.nanargmax(values)), int(np.nanargmin(values))


def _course(motion: Motion, output: str) -> Floats:
    if isinstance(motion.mechanism.joints.get(output), PrismaticJoint):
        return motion.joint(output).displacement
    return motion.link(output).angle


def _default(motion: Motion) -> Floats:
    driven = {driver.joint for driver in motion.mechanism.drivers.values()}
    for group in reversed(motion.structure.groups):
        for link in reversed(group.links):
            for name, joint in motion.mechanism.joints.items():
                if name in driven or set(joint.joined) != {"frame", link}:
                    continue
                values = _course(motion, name if isinstance(joint, PrismaticJoint) else link)
                if isinstance(joint, PrismaticJoint) or np.nanmax(values) - np.nanmin(values) < 1.9 * np.pi:
                    return values
    raise LinkwrightError(
        f"no link of {motion.mechanism.name!r} on the frame goes to and fro, so there are no limit positions; "
        "name a link or a guide: overlay='limits:coupler'"
    )
