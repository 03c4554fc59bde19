"""What shakes a system of masses: a harmonic force, an unbalance, the ground, or a measured force."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.fields.base import Quantities, Quantity, Text
from linkwright.fields.tables import Listed, Table
from linkwright.parts.fields import AnyQuantity
from linkwright.words import _


@dataclass(frozen=True)
class Excitation:
    """What shakes the system: ``force`` (amplitude, N or N·m) or ``unbalance`` (kg·m) ``on`` a mass, or the motion
    ``base`` of the ground (amplitude, m or rad), each with its ``frequency`` (rad/s); or forces at ``times``.
    """

    on: str = ""
    force: float | None = None
    base: float | None = None
    unbalance: float | None = None
    frequency: float | None = None
    times: tuple[float, ...] = ()
    forces: tuple[float, ...] = ()


def excitation_of(values: Mapping[str, Any]) -> Excitation:
    """The excitation of what a file gives: quantities with their dimensions."""
    own = {name: value[0] if name in ("force", "base") else value for name, value in values.items()}
    hertz, speed, table = (own.pop(name, None) for name in ("hertz", "speed", "table"))
    found = {"times": table["times"], "forces": tuple(f for f, _ in table["forces"])} if table else {}
    return Excitation(**own, **found, frequency=2 * math.pi * hertz if hertz is not None else speed)


#: Dimensions of everything in straight and in turning motion.
STRAIGHT = {
    "mass": "mass",
    "stiffness": "stiffness",
    "damping": "damping",
    "force": "force",
    "base": "length",
    "displacement": "length",
    "velocity": "velocity",
}
TURNING = {
    "mass": "inertia",
    "stiffness": "torsional_stiffness",
    "damping": "torsional_damping",
    "force": "torque",
    "base": "angle",
    "displacement": "angle",
    "velocity": "angular_velocity",
}


def either(word: str) -> tuple[str, str]:
    """The dimensions of a value in straight and in turning motion."""
    return STRAIGHT[word], TURNING[word]


EXCITATION = {
    "on": Text(doc="the mass on which it acts"),
    "force": AnyQuantity(either("force"), doc="amplitude of a harmonic force (or torque)"),
    "base": AnyQuantity(either("base"), doc="amplitude of the motion of the ground"),
    "unbalance": Quantity("mass_moment", above=0.0, doc="mass times eccentricity of a rotor"),
    "hertz": Quantity("frequency", above=0.0, key="frequency", doc="frequency"),
    "speed": Quantity("angular_velocity", above=0.0, doc="or speed of the rotor"),
    "table": Table(
        {
            "times": Quantities("time", required=True, key="time", doc=_("increasing times")),
            "forces": Listed(
                AnyQuantity(either("force")),
                "[0 N, 20 N]",
                required=True,
                key="force",
                doc="measured force (or torque) at each time",
            ),
        },
        doc="a measured force: {time: […], force: […]}",
    ),
}


def sampled_force(excitation: Excitation | None, end: float, step: float) -> tuple[Floats, Floats]:
    """Times (t,) to the end, at most a step between them, those of a measured force among them, and that force.

    The force is zero before and after its table; a time at which it jumps is listed twice.
    """
    times, forces = (
        np.array(each) for each in ((excitation.times, excitation.forces) if excitation is not None else ((), ()))
    )
    knots, values = [0.0], [0.0]
    for k in np.flatnonzero((times >= 0.0) & (times < end)):
        zero = [0.0] if forces[k] else []
        sides = [*(zero if k == 0 and times[k] > 0 else []), forces[k], *(zero if k == len(times) - 1 else [])]
        knots += [times[k]] * len(sides)
        values += sides
    if len(times) and times[0] < 0.0:
        values[0] = float(np.interp(0.0, times, forces, right=0.0))
    knots.append(end)
    values.append(float(np.interp(end, times, forces, left=0.0, right=0.0)) if len(times) else 0.0)
    counts = np.maximum(np.ceil(np.diff(knots) / step - 1e-9), 1).astype(int)
    place = np.concatenate([*(k + np.arange(n) / n for k, n in enumerate(counts)), [len(counts)]])
    return np.interp(place, np.arange(len(knots)), knots), np.interp(place, np.arange(len(knots)), values)
