"""Results in tables, one per subject: positions, links, points, joints, forces, loads."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.export.results import Results
from linkwright.words import say

#: Rates of a coordinate, by the unit of the coordinate.
UNITS = {"rad": ("rad", "rad/s", "rad/s²"), "m": ("m", "m/s", "m/s²")}


@dataclass(frozen=True)
class Column:
    """Values (n,) of one quantity of ``owner`` (a link, point, joint, driver, or the whole), in ``unit``."""

    owner: str
    quantity: str
    unit: str
    values: Floats

    @property
    def name(self) -> str:
        """Name with the unit, such as ``jaw.angle [rad]``."""
        return f"{'.'.join(filter(None, (self.owner, self.quantity)))} [{self.unit}]"

    def words(self, language: str) -> str:
        """The quantity in words."""
        return say(f"export.quantity.{self.quantity}", language)

    @property
    def turned(self) -> Column:
        """The same, angles in degrees."""
        if not self.unit.startswith("rad"):
            return self
        return replace(self, unit=self.unit.replace("rad", "°", 1), values=np.degrees(self.values))


@dataclass(frozen=True)
class Table:
    """Columns of one subject: ``positions``, ``links``, ``points``, ``joints``, ``forces`` or ``loads``."""

    subject: str
    columns: tuple[Column, ...]


def tables(results: Results) -> list[Table]:
    """All tables that have columns; ``positions`` (time and inputs) is the first."""
    found = [
        Table("positions", tuple(_positions(results))),
        Table("links", tuple(_links(results))),
        Table("points", tuple(_points(results))),
        Table("joints", tuple(_joints(results))),
        Table("forces", tuple(_forces(results))),
        Table("loads", tuple(_loads(results))),
    ]
    return [table for table in found if table.columns]


def wide(results: Results) -> dict[str, Column]:
    """All columns of all tables by name."""
    return {column.name: column for table in tables(results) for column in table.columns}


def _positions(results: Results) -> Iterator[Column]:
    motion = results.motion
    yield Column("", "time", "s", motion.time)
    for name, values in motion.inputs.items():
        yield Column(name, "", "rad" if motion.positions.rotary[name] else "m", values)


def _links(results: Results) -> Iterator[Column]:
    kinds = ("angle", "angular_velocity", "angular_acceleration")
    for name in results.mechanism.links:
        link = results.motion.link(name)
        rows = (link.angle, link.angular_velocity, link.angular_acceleration)
        for kind, unit, values in zip(kinds, UNITS["rad"], rows, strict=True):
            yield Column(name, kind, unit, values)


def _points(results: Results) -> Iterator[Column]:
    for name in results.motion.point_names():
        point = results.motion.point_of(name)
        for kind, unit in zip(("position", "velocity", "acceleration"), UNITS["m"], strict=True):
            values = getattr(point, kind)
            yield Column(name, f"{kind}.x", unit, values[:, 0])
            yield Column(name, f"{kind}.y", unit, values[:, 1])


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


def _forces(results: Results) -> Iterator[Column]:
    forces = results.forces
    if forces is None:
        return
    for name in results.mechanism.drivers:
        yield Column(
            name, "effort", "N·m" if forces.motion.positions.rotary[name] else "N", forces.driver_effort(name)
        )
    for name, joint in results.mechanism.joints.items():
        for link in joint.joined:
            if link != "frame":
                yield from _vector(f"{name} on {link}", "", "N", forces.reaction(name, on=link))
                if joint.couples:
                    yield Column(f"{name} on {link}", "couple", "N·m", forces.couple(name, on=link))
    yield from _vector("shaking_force", "", "N", forces.shaking_force, size=False)
    yield Column("", "shaking_moment", "N·m", forces.shaking_moment)
    yield Column("", "power_residual", "W", forces.power_residual)
    yield Column("", "balance_residual", "N", forces.balance_residual)


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
