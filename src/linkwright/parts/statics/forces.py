"""Forces and lines in the plane and in space, as they are given."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.errors import Finding, fault
from linkwright.fields.base import Quantities, Quantity, Text, file_key, quantity_schema
from linkwright.fields.nodes import Node
from linkwright.fields.nodes import Sequence as SequenceNode
from linkwright.fields.reading import Place, Reader
from linkwright.fields.tables import Either, Listed, Named, Table
from linkwright.words import _, pgettext

#: A sum smaller than this share of its largest part is zero but for rounding.
ZERO = 1e-12


_COMPONENTS = _("the number of components is {count}, not two or three as a vector needs")


_VECTOR = _("give a vector of any length, such as [1, 0, 0]")


def spatial(vector: ArrayLike) -> Floats:
    """Three components of two or three."""
    found = np.asarray(vector, dtype=float)
    return np.concatenate([found, np.zeros(3 - len(found))])


@dataclass(frozen=True)
class Components(Quantities):
    """Two or three components."""

    def shape(self) -> dict[str, object]:
        return {**super().shape(), "minItems": 2, "maxItems": 3}


@dataclass(frozen=True)
class Direction(Components):
    """A vector of any length, or in the plane its angle from the x-axis."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> tuple[float, ...] | None:
        if isinstance(node, SequenceNode):
            return super().read(reader, node, place, siblings)
        angle = reader.quantity(node, place, "angle")
        if angle is None:
            return None
        return tuple(0.0 if abs(c) < ZERO else c for c in (math.cos(angle), math.sin(angle)))

    def shape(self) -> dict[str, object]:
        return {"anyOf": [super().shape(), quantity_schema("angle")]}


DIRECTION = Direction(
    "dimensionless",
    key="direction",
    old="along",
    form="[2, 3, 6]",
    doc="direction: a vector of any length, or in the plane an angle from the x-axis",
)
START = Components("length", key="from", doc="a point of the line of action, instead of a direction")
END = Components("length", key="to", doc="the point of this line to which the force points")


class Line:
    """A direction: a vector ``along`` of any length, or the way from the point ``start`` to the point ``end``, m."""

    along: tuple[float, ...]
    start: tuple[float, ...]
    end: tuple[float, ...]

    @property
    def directed(self) -> bool:
        """Whether a direction is given."""
        return bool(self.along or self.start or self.end)

    @property
    def way(self) -> Floats:
        """Unit vector of the given direction, (3,)."""
        way = spatial(self.along) if self.along else spatial(self.end) - spatial(self.start)
        return np.asarray(way / np.linalg.norm(way))

    def line_findings(self, key: str) -> list[Finding]:
        """What is wrong with the direction."""
        found = [
            fault(
                "components", f"{key}.{word}", _COMPONENTS, _("give two (in the plane) or three"), count=len(vector)
            )
            for word, vector in (("direction", self.along), ("from", self.start), ("to", self.end))
            if vector and len(vector) not in (2, 3)
        ]
        if found:
            return found
        if bool(self.start) != bool(self.end) or (self.along and self.start):
            return [
                fault(
                    "line_form",
                    key,
                    _("the line has no direction, or more than one"),
                    _("give direction: [2, 3, 6], or two points from: and to:"),
                )
            ]
        if self.along and not any(self.along):
            return [fault("no_direction", f"{key}.direction", _("the direction is zero"), _VECTOR)]
        if self.start and np.array_equal(spatial(self.start), spatial(self.end)):
            return [fault("no_direction", f"{key}.to", _("the direction is zero"), _VECTOR)]
        return []


@dataclass(frozen=True)
class Force(Line):
    """A force: its components ``force`` (2 or 3) N, or its ``size`` N ``along`` a direction; ``at`` (2 or 3) m.

    The direction may be given by two points of the line of action, from ``start`` to ``end``. A force with a
    direction alone has an unknown magnitude, which equilibrium gives.
    """

    force: tuple[float, ...] = file_key(Components("force", doc="components"), ())
    size: float | None = file_key(
        Quantity("force", key="magnitude", old="size", doc="magnitude, with direction; default: unknown"), None
    )
    along: tuple[float, ...] = file_key(DIRECTION, ())
    at: tuple[float, ...] = file_key(
        Components("length", doc="point of application; default: the origin"), (0.0, 0.0)
    )
    start: tuple[float, ...] = file_key(START, ())
    end: tuple[float, ...] = file_key(END, ())

    @property
    def unknown(self) -> bool:
        """Whether its magnitude is to be found."""
        return self.size is None and not self.force

    @property
    def vector(self) -> Floats:
        """Components, (3,) N; of an unknown force zero."""
        if self.force:
            return spatial(self.force)
        return (self.size or 0.0) * self.unit

    @property
    def unit(self) -> Floats:
        """Unit vector of its direction, (3,); zero without a direction."""
        if self.directed:
            return self.way
        size = float(np.linalg.norm(spatial(self.force)))
        return spatial(self.force) / (size or 1.0)

    @property
    def place(self) -> Floats:
        """Point of application, (3,) m."""
        return spatial(self.at)

    def findings(self, key: str) -> list[Finding]:
        """What is wrong with it."""
        found = []
        if bool(self.force) == self.directed or (self.force and self.size is not None):
            found.append(
                fault(
                    "force_form",
                    key,
                    _("a force is neither complete nor unique"),
                    _(
                        "write its components [Fx, Fy, Fz], or magnitude and direction; direction alone "
                        "where the magnitude is sought"
                    ),
                )
            )
        found += self.line_findings(key)
        for name, vector in (("force", self.force), ("at", self.at)):
            if vector and len(vector) not in (2, 3):
                found.append(
                    fault(
                        "components",
                        f"{key}.{name}",
                        _COMPONENTS,
                        _("give two (in the plane) or three"),
                        count=len(vector),
                    )
                )
        return found


@dataclass(frozen=True)
class ForceField(Either):
    """A force as ``[Fx, Fy, Fz]``, or as a table with its place, or with its magnitude and direction."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        found = super().read(reader, node, place, siblings)
        return Force(force=found) if isinstance(found, tuple) else found


FORCES = Named(
    ForceField(Components("force", form="[0 N, 40 N, 60 N]"), Table.of(Force)),
    _("force"),
    doc="forces by name: [Fx, Fy, Fz], {magnitude: …, direction: […]}, or {direction: […]} where it is sought",
)
COUPLES = Named(
    Components("torque"), _("couple"), doc="couples by name: [Mx, My, Mz]; in the plane [0 N·m, 0 N·m, M]"
)


@dataclass(frozen=True)
class Along(Line):
    """A line along which a force is resolved: ``of`` the name of a force, of the resultant unless given."""

    along: tuple[float, ...] = file_key(DIRECTION, ())
    start: tuple[float, ...] = file_key(START, ())
    end: tuple[float, ...] = file_key(END, ())
    of: str = file_key(Text(doc="name of the force; default: the resultant"), "")


LINES = Named(
    Table.of(Along),
    _("direction"),
    doc="lines along which a force is resolved, by name: {of: F, direction: [2, 3, 6]}",
)
PAIRS = Named(
    Listed(Text(), "[F1, F2]"), pgettext("nouns", "angle"), doc="angles between two forces, by name: [F1, F2]"
)


def direction_angles(vector: Floats) -> Floats:
    """Angles (3,) rad of a vector against the axes x, y, z; NaN for a vector without direction."""
    size = float(np.linalg.norm(vector))
    return np.arccos(np.clip(vector / size, -1.0, 1.0)) if size else np.full(3, np.nan)
