"""Forces as named columns with units."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from linkwright.core.outputs import row_name, row_names
from linkwright.kinematics.cycle import Floats
from linkwright.kinematics.table import directions
from linkwright.kinetostatics.link_balance import load_outputs, motion_outputs

if TYPE_CHECKING:
    from linkwright.kinetostatics.forces import Forces

_RESULTANTS = (*row_names("shaking_force"), *map(row_name, ("shaking_moment", "power_of_forces", "power")))


def columns(forces: Forces) -> dict[str, Floats]:
    """Motion columns, then efforts, reactions on every link, couples, shaking force, residuals."""
    motion = forces.motion
    motion.evaluate_together((*directions(motion), *motion_outputs(forces)))
    forces.fetch((*_RESULTANTS, *load_outputs(forces)))
    found = dict(motion.columns())
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
