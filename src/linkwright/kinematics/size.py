"""The size of a mechanism, against which lengths are judged."""

from __future__ import annotations

import math

import numpy as np

from linkwright.mechanism.mechanism import Mechanism


def mechanism_size(mechanism: Mechanism) -> float:
    """A power of two in metres, not below the largest coordinate, offset or stroke.

    A power of two, so that dividing by it does not round, and so that small changes of a design do not change it.
    """
    links = [*mechanism.links.values(), mechanism.frame]
    reach = [abs(c) for link in links for point in link.points.values() for c in point]
    reach += [abs(c) for point in mechanism.drawing.values() for c in point]
    reach += [abs(getattr(joint, "offset", 0.0)) for joint in mechanism.joints.values()]
    for driver in mechanism.drivers.values():
        if mechanism.joints[driver.joint].coordinate == "slide":
            reach.append(abs(float(driver.law.coordinate(np.zeros(1))[0][0])))
    largest = max([*reach, 0.0])
    return 2.0 ** math.frexp(largest)[1] if largest > 0.0 else 1.0
