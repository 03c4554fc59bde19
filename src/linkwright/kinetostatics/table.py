"""Forces as named columns with units."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from linkwright.kinematics.cycle import Floats

if TYPE_CHECKING:
    from linkwright.kinetostatics.forces import Forces


def columns(forces: Forces) -> dict[str, Floats]:
    """Motion columns, then efforts, reactions on every link, couples, shaking force, residuals."""
    found = dict(forces.motion.columns())
    for name in forces.mechanism.drivers:
        unit = "N·m" if forces.motion.positions.rotary[name] else "N"
        found[f"{name}.effort [{unit}]"] = forces.driver_effort(name)
    for name, joint in forces.mechanism.joints.items():
        for link in joint.joined:
            if link == "frame":
                continue
            force = forces.reaction(name, on=link)
            found[f"{name} on {link}.x [N]"], found[f"{name} on {link}.y [N]"] = force[:, 0], force[:, 1]
            found[f"{name} on {link}.magnitude [N]"] = np.hypot(force[:, 0], force[:, 1])
            if joint.couples:
                found[f"{name} on {link}.couple [N·m]"] = forces.couple(name, on=link)
    found["shaking_force.x [N]"], found["shaking_force.y [N]"] = forces.shaking_force.T
    found["shaking_moment [N·m]"] = forces.shaking_moment
    found["power_residual [W]"] = forces.power_residual
    found["balance_residual [N]"] = forces.balance_residual
    return found
