"""Designs of a sweep that are solved alone, each as a machine by itself."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from linkwright.applied_loads.strokes import TURN
from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.search import first_largest
from linkwright.cycle.summary import Summary
from linkwright.designs.traced_outputs import Traced
from linkwright.errors import LinkwrightError
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.design import Design
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.positions import Positions
from linkwright.kinematics.solve import MotionRun
from linkwright.kinetostatics.named_outputs import Quantity
from linkwright.kinetostatics.programs import words_name
from linkwright.kinetostatics.run import run_forces
from linkwright.kinetostatics.solver import ForceSolver
from linkwright.words import _

#: What a summary is of values at positions; extremes skip those that do not exist.
OF_VALUES: Mapping[str, Callable[[Floats], Any]] = {
    "min": np.fmin.reduce,
    "max": np.fmax.reduce,
    "mean": np.mean,
    "rms": lambda values: np.sqrt(np.mean(values * values)),
    "range": lambda values: np.fmax.reduce(values) - np.fmin.reduce(values),
    "peak": lambda values: np.fmax.reduce(np.abs(values)),
}


def changes_of(columns: Mapping[str, Floats], index: int) -> dict[str, float]:
    """The varied dimensions of one design."""
    return {address: float(column[index]) for address, column in columns.items()}


def motion_alone(traced: Traced, changes: Mapping[str, float]) -> Motion:
    """The motion of a design in the assembly of the mechanism as it is; positions that are not reached are marked."""
    design = Design(traced.mechanism, traced.solver.assembly.modes, changes)
    positions = over_cycle(design.mechanism, traced.positions.steps)
    return MotionRun(traced.solver.for_design(design), positions).solve("mark")


def places_in(motion: Motion, positions: Positions) -> Indices:
    """Where the positions of others are among those of a motion, (n,), whose driver may turn the other way."""
    places = np.arange(positions.count)
    ways = (np.diff(next(iter(each.coordinates.values()))[0][:2]) for each in (motion.positions, positions))
    return -places % positions.count if positions.closed and np.prod([*ways]) < 0.0 else places


def outputs_alone(motion: Motion, quantities: Iterable[Quantity]) -> dict[str, Floats]:
    """Outputs of a motion, or of its forces, by their names, (n,) each, NaN where it is not reached.

    Raises LinkwrightError where its forces cannot be found.
    """
    asked = {each.name: each for each in quantities}
    words = [name for name, each in asked.items() if not each.output.of_course]
    names = tuple(map(words_name, words))
    if all(each.output.of_motion for each in asked.values()):
        values = ForceSolver(motion.solver).evaluate(names, motion, {}) if names else np.empty((0, motion.steps))
    else:
        values = run_forces(motion, False).evaluate(names)
    found = dict(zip(words, np.where(motion.ok, values, np.nan), strict=True))
    return {name: found[name] if name in found else _of_course(motion, each) for name, each in asked.items()}


def _of_course(motion: Motion, quantity: Quantity) -> Floats:
    """What only the course of a motion tells; an angle on the turn on which programs have it."""
    values = motion.read(quantity.output)
    if quantity.reference is None or not motion.ok.any():
        return values
    middle = 0.5 * (np.nanmin(values) + np.nanmax(values))
    return values + TURN * np.round((quantity.reference - middle) / TURN)


def summary_of(summary: Summary, values: Floats, reached: Flags, inputs: Floats) -> float:
    """A summary of an output over the positions that are reached; NaN where there are none."""
    found = values[reached]
    if not len(found):
        return np.nan
    if summary.kind in ("argmin", "argmax"):
        return float(inputs[reached][first_largest(found if summary.kind == "argmax" else -found)])
    return float(OF_VALUES[summary.kind](found))


def sentence_of(traced: Traced, changes: Mapping[str, float]) -> str:
    """Why a design cannot pass its cycle."""
    try:
        motion = motion_alone(traced, changes)
    except LinkwrightError as error:
        return error.sentence
    return (
        _("it could not be tracked from position to position together with the others; give more steps")
        if motion.complete
        else motion.refusal().sentence
    )
