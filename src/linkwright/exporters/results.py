"""What is exported: a motion with its forces and metrics, and their tables, one per subject."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from linkwright.analysis.evaluate import MetricsTable
from linkwright.core.arguments import STEPS, require
from linkwright.core.arrays import Floats
from linkwright.core.outputs import KINDS, NAMED
from linkwright.core.table import Column
from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.kinetostatics.table import results_of
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _, pgettext

if TYPE_CHECKING:
    from linkwright.topology import Structure


@dataclass(frozen=True)
class Results:
    """A motion and, where they were solved, its forces; ``language`` is that of headings (``en`` or ``zh``)."""

    motion: Motion
    forces: Forces | None = None
    language: str = "en"

    @classmethod
    def of(cls, source: Mechanism | Motion | Forces, steps: int = STEPS, language: str = "en") -> Results:
        """The results of a motion or of forces as they are; a mechanism is solved first over ``steps``.

        Forces are solved where the mechanism has masses or loads. Raises LinkwrightError for another type.
        """
        if isinstance(source, Forces):
            return cls(source.motion, source, language)
        if isinstance(source, Motion):
            return cls(source, None, language)
        require(source, Mechanism, Motion, Forces)
        motion = solve_motion(source, steps=steps)
        return cls(motion, solve_forces(motion) if source.has_loads else None, language)

    @property
    def mechanism(self) -> Mechanism:
        """What was solved."""
        return self.motion.mechanism

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes of motion and forces."""
        return (*self.motion.notes, *(self.forces.notes if self.forces is not None else ()))

    @property
    def structure(self) -> Structure:
        """Its Assur groups."""
        return self.motion.structure

    @cached_property
    def metrics(self) -> MetricsTable:
        """Metrics; none where positions were not reached."""
        from linkwright.analysis import metrics

        if not self.motion.complete:
            return MetricsTable(self.mechanism.name, ())
        return metrics(self.motion if self.forces is None else self.forces)

    def first_ok(self) -> int:
        """Index of the first position that was reached; raises LinkwrightError if there is none."""
        if not self.motion.ok.any():
            raise LinkwrightError(
                _(
                    "no position of {name!r} was reached, so there is nothing to export",
                    code="export.nothing_reached",
                    name=self.mechanism.name,
                )
            )
        return int(self.motion.ok.argmax())

    def index(self, position: int | None) -> int:
        """Index of a position, of the first that was reached where none is named.

        Raises LinkwrightError where there is no such position, or it was not reached.
        """
        if position is None:
            return self.first_ok()
        steps = self.motion.steps
        if not -steps <= position < steps:
            raise RequestError(
                _(
                    "position {position} does not exist; there are the positions 0 to {last}",
                    code="export.no_position",
                    position=position,
                    last=steps - 1,
                )
            )
        if not self.motion.ok[position]:
            raise LinkwrightError(
                _(
                    "position {position} cannot be drawn: {sentence}",
                    code="export.not_drawn",
                    position=position,
                    sentence=self.motion.outcomes[position].sentence,
                )
            )
        return position % steps


def seconds(motion: Motion) -> float:
    """Duration of the motion, s; 1 s where there is none."""
    if motion.positions.period:
        return float(motion.positions.period)
    return float(np.ptp(motion.time)) or 1.0


#: Rates of a coordinate, by the unit of the coordinate.
UNITS = {"rad": ("rad", "rad/s", "rad/s²"), "m": ("m", "m/s", "m/s²")}
SUBJECTS = ("positions", "links", "points", "joints", "forces", "loads", "outputs")
#: The table of outputs by what they belong to, and by their kind; those of guides stand among all joints.
OF_OWNER = {"motion": "positions", "link": "links", "point": "points", "joint": "forces", "machine": "forces"}
OF_KIND = {"input": "positions", "effort": "forces", **dict.fromkeys(NAMED, "outputs")}
#: Quantities of columns in words.
QUANTITIES = {
    "time": _("time"),
    "angle": _("angle"),
    "angular_velocity": _("angular velocity"),
    "angular_acceleration": _("angular acceleration"),
    "position.x": _("position x"),
    "position.y": _("position y"),
    "velocity.x": _("velocity x"),
    "velocity.y": _("velocity y"),
    "acceleration.x": _("acceleration x"),
    "acceleration.y": _("acceleration y"),
    "displacement": _("displacement"),
    "velocity": _("velocity"),
    "acceleration": _("acceleration"),
    "relative_angle": _("relative angle"),
    "relative_velocity": _("relative angular velocity"),
    "relative_acceleration": _("relative angular acceleration"),
    "rate": _("rate"),
    "second_rate": _("second rate"),
    "effort": _("driver effort"),
    "x": _("force x"),
    "y": _("force y"),
    "magnitude": _("force"),
    "direction": _("direction of the force"),
    "couple": pgettext("export", "couple"),
    "shaking_force": _("shaking force"),
    "shaking_moment": _("shaking moment"),
    "power_residual": _("power residual"),
    "balance_residual": _("balance residual"),
    "force.x": _("force x"),
    "force.y": _("force y"),
    "force.magnitude": _("force"),
    "moment": _("moment about the origin"),
    "place.x": _("acts at x"),
    "place.y": _("acts at y"),
}


@dataclass(frozen=True)
class Subject:
    """Columns of one subject: ``positions``, ``links``, ``points``, ``joints``, ``forces`` or ``loads``."""

    subject: str
    columns: tuple[Column, ...]


def tables(results: Results) -> list[Subject]:
    """All tables that have columns; ``positions`` (time and inputs) is the first."""
    named = results_of(results.motion, results.forces)
    found: dict[str, list[Column]] = {subject: [] for subject in SUBJECTS}
    for output, values in named.items():
        subject = OF_KIND.get(output.kind) or OF_OWNER.get(KINDS[output.kind].of)
        if subject is not None:
            alone = output.kind in ("input", "named")
            owner, quantity = (output.owner, "") if alone else (output.place, output.quantity)
            found[subject].append(Column(owner, quantity, output.unit, values))
    found["joints"] += _joints(results)
    found["loads"] += _loads(results)
    return [Subject(subject, tuple(columns)) for subject, columns in found.items() if columns]


def wide(results: Results) -> dict[str, Column]:
    """All columns of all tables by name."""
    return {column.heading: column for table in tables(results) for column in table.columns}


def _joints(results: Results) -> Iterator[Column]:
    """Displacement of guides; angle of the second link of a pin against its first."""
    for name, joint in results.mechanism.joints.items():
        if not joint.coordinate:
            continue
        pin = joint.coordinate == "turn"
        motion = results.motion.joint(name)
        kinds = ("displacement", "velocity", "acceleration")
        if pin:
            kinds = ("relative_angle", "relative_velocity", "relative_acceleration")
        rows = (motion.displacement, motion.velocity, motion.acceleration)
        for kind, unit, values in zip(kinds, UNITS["rad" if pin else "m"], rows, strict=True):
            yield Column(name, kind, unit, values)


def _loads(results: Results) -> Iterator[Column]:
    if results.forces is None:
        return
    for name in results.mechanism.loads:
        load = results.forces.load(name)
        yield from _vector(name, "force", "N", load.force)
        yield Column(name, "moment", "N·m", load.moment)
        yield from _vector(name, "place", "m", load.place, size=False)


def _vector(owner: str, kind: str, unit: str, values: Floats, *, size: bool = True) -> Iterator[Column]:
    before = f"{kind}." if kind else ""
    yield Column(owner, f"{before}x", unit, values[:, 0])
    yield Column(owner, f"{before}y", unit, values[:, 1])
    if size:
        yield Column(owner, f"{before}magnitude", unit, np.hypot(values[:, 0], values[:, 1]))
