"""Forces as results by their outputs."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output, row_name, row_names
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.table import columns, directions, motion_results
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.link_balance import load_outputs, motion_outputs

_RESULTANTS = (*row_names("shaking_force"), *map(row_name, ("shaking_moment", "power_of_forces", "power")))


def results_of(motion: Motion, forces: Forces | None) -> dict[Output, Floats]:
    """All results of a motion, and of its forces where there are some, (n,) each, SI."""
    return motion_results(motion) if forces is None else force_results(forces)


def force_columns(forces: Forces) -> dict[str, Floats]:
    """All results of forces and their motion as named columns (n,), names with units."""
    return columns(force_results(forces))


def force_results(forces: Forces) -> dict[Output, Floats]:
    """The results of the motion, then efforts, reactions on every link, couples, shaking force, residuals, (n,).

    Raises SelfCheckError where they leave a link out of balance.
    """
    motion = forces.motion
    motion.evaluate_together((*directions(motion), *motion_outputs(forces)))
    forces.fetch((*_RESULTANTS, *load_outputs(forces)))
    found = motion_results(motion)
    for name in forces.mechanism.drivers:
        found[Output("effort", name, slides=not motion.positions.rotary[name])] = forces.driver_effort(name)
    for name, joint in forces.mechanism.joints.items():
        for link in joint.joined:
            if link == "frame":
                continue
            force = forces.reaction(name, on=link)
            found |= {Output("reaction", name, axis, link): force[:, k] for k, axis in enumerate("xy")}
            found[Output("reaction", name, on=link)] = np.hypot(force[:, 0], force[:, 1])
            found[Output("reaction_direction", name, on=link)] = forces.direction(name, on=link)
            if joint.couples:
                found[Output("couple", name, on=link)] = forces.couple(name, on=link)
    found |= {Output("shaking_force", "", axis): forces.shaking_force[:, k] for k, axis in enumerate("xy")}
    found[Output("shaking_moment")] = forces.shaking_moment
    forces.solver.programs.checks.require_balance(forces.balance_residual, forces.rows, motion)
    found[Output("power_residual")] = forces.power_residual
    found[Output("balance_residual")] = forces.balance_residual
    return found
