"""Balance of every link, from the results alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from linkwright.kinematics.cycle import Floats

if TYPE_CHECKING:
    from linkwright.kinetostatics.forces import Forces


def balance_residual(forces: Forces) -> Floats:
    """Largest |Σ joint forces - demand| of any link, (n,) N; the demand is m (a - g) minus the applied loads."""
    worst = np.zeros(forces.steps)
    for link in forces.mechanism.links:
        total = np.zeros((forces.steps, 2))
        for name, joint in forces.mechanism.joints.items():
            if link in joint.joined:
                total += forces.reaction(name, on=link)
        total += _driver_forces(forces, link)
        fx, fy = forces._fetch((f"own:{link}|x", f"own:{link}|y"))
        gap = np.hypot(total[:, 0] - fx, total[:, 1] - fy)
        worst = np.maximum(worst, gap)
    return worst


def _driver_forces(forces: Forces, link: str) -> Floats:
    total = np.zeros((forces.steps, 2))
    for name, driver in forces.mechanism.drivers.items():
        joint = forces.mechanism.joints[driver.joint]
        if joint.kind != "prismatic" or link not in joint.joined:
            continue
        sign = 1.0 if link == joint.joined[1] else -1.0
        total += sign * forces.driver_effort(name)[:, None] * forces._guide_direction(driver.joint)
    return total
