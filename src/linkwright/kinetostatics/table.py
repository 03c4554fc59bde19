"""Results as named columns with units: motions and forces."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import POINT, Output, row_name, row_names
from linkwright.core.table import dataframe
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.link_balance import load_outputs, motion_outputs
from linkwright.mechanism.mechanism import named_outputs

if TYPE_CHECKING:
    import pandas


_RESULTANTS = (*row_names("shaking_force"), *map(row_name, ("shaking_moment", "power_of_forces", "power")))


def results_of(motion: Motion, forces: Forces | None) -> dict[Output, Floats]:
    """All results of a motion, and of its forces where there are some, (n,) each, SI."""
    return motion_results(motion) if forces is None else force_results(forces)


def force_columns(forces: Forces) -> dict[str, Floats]:
    """All results of forces and their motion as named columns (n,), names with units."""
    return columns(force_results(forces))


def force_frame(forces: Forces) -> pandas.DataFrame:
    """All results of forces and their motion as a table over the first driver's coordinate; needs pandas."""
    return dataframe(force_columns(forces), index=input_column(forces.motion))


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
    applied = 0.0 if motion.by_law else _largest_load(forces)
    forces.solver.programs.checks.require_balance(forces.balance_residual, forces.rows, motion, applied)
    found[Output("power_residual")] = forces.power_residual
    found[Output("balance_residual")] = forces.balance_residual
    return found


def _largest_load(forces: Forces) -> Floats:
    """The largest force on a link, or moment over the machine's size, of loads, (n,) N."""
    rows = np.abs(forces.fetch(load_outputs(forces))).reshape(-1, 3, forces.steps)
    rows[:, 2] /= forces.mechanism.size
    return np.asarray(rows.max(axis=(0, 1), initial=0.0))


def motion_results(motion: Motion) -> dict[Output, Floats]:
    """Time, inputs, links, guides and points of a motion, (n,) each."""
    found = {Output("time"): motion.time}
    motion.evaluate_together(directions(motion))
    for name, q in motion.inputs.items():
        found[_input(motion, name)] = q
    firsts = [Output("angle", name) for name in motion.mechanism.links]
    firsts += [Output("displacement", name) for name in motion.mechanism.guides]
    found |= {each: motion.read(each) for first in firsts for each in first.course}
    for name in motion.point_names():
        for kind in POINT:
            values = motion.vector(kind, name)
            found |= {Output(kind, name, axis): values[:, k] for k, axis in enumerate("xy")}
    named = named_outputs(motion.mechanism.outputs).values()
    return found | {each: motion.read(each) for each in named}


def motion_columns(motion: Motion) -> dict[str, Floats]:
    """All results of a motion as named columns (n,), names with units."""
    return columns(motion_results(motion))


def motion_frame(motion: Motion) -> pandas.DataFrame:
    """All results of a motion as a table over the first driver's coordinate; needs pandas."""
    return dataframe(motion_columns(motion), index=input_column(motion))


def columns(found: Mapping[Output, Floats]) -> dict[str, Floats]:
    """Results by column names such as ``jaw.angle [rad]``."""
    return {each.heading: values for each, values in found.items()}


def directions(motion: Motion) -> Iterator[str]:
    """Names of the outputs that the columns of links take their angles from."""
    return (name for link in motion.mechanism.links for name in row_names("direction", link))


def input_column(motion: Motion) -> str | None:
    """The column of the first driver's coordinate; None without a driver."""
    name = next(iter(motion.inputs), None)
    return None if name is None else _input(motion, name).heading


def _input(motion: Motion, driver: str) -> Output:
    return Output("input", driver, slides=not motion.positions.rotary[driver])
