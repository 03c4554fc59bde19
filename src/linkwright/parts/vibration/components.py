"""What a vibrating system consists of: its masses, springs and dampers, where they start, and what shakes them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.errors import Finding, fault
from linkwright.fields.base import Quantities, Quantity, Text
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.tables import Listed, Named, Table
from linkwright.parts.fields import AnyQuantity
from linkwright.units import DIMENSIONS
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

    def findings(self, masses: Mapping[str, float]) -> list[Finding]:
        """What is wrong with it, on these masses."""
        forms = [n for n in ("force", "base", "unbalance") if getattr(self, n) is not None]
        forms += ["table"] if self.times else []
        if len(forms) != 1 or (forms[0] != "table" and self.frequency is None):
            return [
                fault(
                    "excitation_form",
                    "excitation",
                    _("the excitation is neither complete nor unique"),
                    _("give one of force, base, unbalance with frequency or speed, or a table"),
                )
            ]
        if 0.0 in (self.force, self.base):
            return [
                fault(
                    "no_amplitude",
                    f"excitation.{forms[0]}",
                    _("an amplitude of zero shakes nothing"),
                    _("give another amplitude, or leave the excitation out"),
                )
            ]
        if forms[0] != "base" and self.on not in masses:
            return [
                fault(
                    "no_such_mass",
                    "excitation.on",
                    _('there is no mass "{name}"'),
                    _("one of: {known}"),
                    name=self.on,
                    known=tuple(masses),
                )
            ]
        times, forces = self.times, self.forces
        falling = any(b <= a for a, b in pairwise(times))
        if times and (len(times) != len(forces) or len(times) < 2 or falling):
            return [
                fault(
                    "table",
                    "excitation.table",
                    _("the measured force must be a table of increasing times"),
                    _("give as many forces as times, two or more, times increasing"),
                )
            ]
        return []


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


@dataclass(frozen=True)
class Connector:
    """A spring or damper ``between`` two masses, or a mass and ``ground``; its ``rate`` N/m, N·s/m (N·m/rad …)."""

    between: tuple[str, ...]
    rate: float

    def findings(self, key: str, masses: Mapping[str, float]) -> list[Finding]:
        """What is wrong with it, between these masses and the ground."""
        known = [GROUND, *masses]
        if len(self.between) != 2 or self.between[0] == self.between[-1]:
            return [
                fault(
                    "two_ends",
                    f"{key}.between",
                    _("a spring or damper needs two different ends"),
                    _("write between: [ground, body]"),
                )
            ]
        found = [
            fault(
                "no_such_mass",
                f"{key}.between",
                _('there is no mass "{name}"'),
                _("one of: {known}"),
                name=end,
                known=tuple(known),
            )
            for end in self.between
            if end not in known
        ]
        return (
            [
                *found,
                fault("rate_negative", key, _("a negative stiffness or damping"), _("give a value of zero or more")),
            ]
            if self.rate < 0
            else found
        )


@dataclass(frozen=True)
class Start:
    """Displacement (m, rad) and velocity (m/s, rad/s) of a mass at the time zero."""

    displacement: float = 0.0
    velocity: float = 0.0


def _tie(between: tuple[str, ...], rate: tuple[float, Any]) -> dict[str, Any]:
    return {"between": between, "rate": rate}


TIE = {"between": Listed(Text(), "[ground, body]", required=True, doc="two masses, or ground and a mass")}
SPRING = Table(
    {
        **TIE,
        "rate": AnyQuantity(either("stiffness"), required=True, key="stiffness", doc="N/m, or N·m/rad of a shaft"),
    },
    _tie,
)
DAMPER = Table(
    {**TIE, "rate": AnyQuantity(either("damping"), required=True, key="damping", doc="N·s/m, or N·m·s/rad")}, _tie
)
START = {
    "displacement": AnyQuantity(either("displacement"), doc="at the time zero, m or rad"),
    "velocity": AnyQuantity(either("velocity"), doc="at the time zero, m/s or rad/s"),
}


@dataclass(frozen=True)
class MassesField(Named):
    """Masses by name; moments of inertia among them, as files had them before, are a warning."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        found = super().read(reader, node, place, siblings)
        if any(each is not None and each[1] == DIMENSIONS["inertia"] for each in (found or {}).values()):
            reader.old_key(node, place, "masses", "inertias")
        return found


GROUND = "ground"


def mixed_findings(data: Mapping[str, Any], where: Mapping[str, str], turning: bool) -> list[Finding]:
    """Findings where straight and turning motion, or wrong units, come together."""
    kinds = TURNING if turning else STRAIGHT
    values = {f"{where.get(n, 'masses')}.{n}": (kind, "mass") for n, (_unused, kind) in data["masses"].items()}
    for what, key in (("springs", "stiffness"), ("dampers", "damping")):
        values |= {f"{what}.{n}.{key}": (t["rate"][1], key) for n, t in data.get(what, {}).items()}
    for name, start in data.get("start", {}).items():
        values |= {f"start.{name}.{word}": (kind, word) for word, (_unused, kind) in start.items()}
    shaken = data.get("excitation") or {}
    values |= {f"excitation.{key}": (shaken[key][1], key) for key in ("force", "base") if key in shaken}
    table = (shaken.get("table") or {}).get("forces", ())
    values |= {f"excitation.table.force.{i}": (kind, "force") for i, (_unused, kind) in enumerate(table)}
    found = [
        fault(
            "mixed",
            key,
            _("straight and turning motion, or units of another kind, stand together: a {needed} is needed here"),
            _("give all masses in kg with N/m and N·s/m, or all in kg·m² with N·m/rad and N·m·s/rad"),
            needed=kinds[word].replace("_", " "),
        )
        for key, (kind, word) in values.items()
        if kind != DIMENSIONS[kinds[word]]
    ]
    if turning and "unbalance" in shaken:
        found.append(
            fault(
                "turning_unbalance",
                "excitation.unbalance",
                _("a rotor's unbalance shakes masses, not discs"),
                _("give the torque on the disc"),
            )
        )
    return found
