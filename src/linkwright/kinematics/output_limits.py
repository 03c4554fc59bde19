"""The limit positions of a machine's output, of the one that is named or of the last one that goes to and fro."""

from __future__ import annotations

import numpy as np

from linkwright.core.search import first_largest
from linkwright.errors import RequestError
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
        raise RequestError("picture.no_limit_positions", name=name)
    values = np.array([each.value for each in found])
    high, low = found[first_largest(values)], found[first_largest(-values)]
    return (high,) if high is low else (high, low)


def _last_to_and_fro(motion: Motion) -> str:
    joints = motion.mechanism.joints
    driven = {driver.joint for driver in motion.mechanism.drivers.values()}
    for group in reversed(motion.structure.groups):
        for link in reversed(group.links):
            for name, joint in joints.items():
                if name in driven or not {"frame", link} <= set(joint.joined):
                    continue
                if joint.coordinate == "slide":
                    return name
                angle = motion.link(link).angle
                if np.nanmax(angle) - np.nanmin(angle) < 1.9 * np.pi:
                    return link
    raise RequestError("picture.none_to_and_fro", name=motion.mechanism.name)
