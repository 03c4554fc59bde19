"""The link-freedom/constraint graph of a mechanism.

Unknowns are the three freedoms of every moving link and the two of every pin that joins three links
or more; equations are what joints and drivers demand. A guide's demand on the rotation touches only
rotations, so a loop of guides that fixes a rotation twice is seen here and counted once.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from linkwright.joints.prismatic import PrismaticJoint
from linkwright.joints.revolute import RevoluteJoint
from linkwright.joints.weld import WeldJoint
from linkwright.model.mechanism import Mechanism

FRAME = "frame"


@dataclass(frozen=True)
class Equation:
    """One demand: its source (joint or driver), the bodies it touches, and whether only rotations."""

    source: str
    bodies: tuple[str, ...]
    rotation_only: bool = False


@dataclass
class ConstraintGraph:
    """Bodies (links and shared pins) with their freedoms, and the equations between them."""

    freedoms: dict[str, int]
    equations: list[Equation]
    redundant: list[str] = field(default_factory=list)

    @classmethod
    def of(cls, mechanism: Mechanism) -> ConstraintGraph:
        """The graph of a mechanism with its drivers."""
        graph = cls(dict.fromkeys(mechanism.links, 3), [])
        rotations = _Classes()
        for joint in sorted(mechanism.joints.values(), key=lambda j: isinstance(j, RevoluteJoint)):
            graph._add_joint(joint, rotations)
        for driver in mechanism.drivers.values():
            joint = mechanism.joints[driver.joint]
            turning = isinstance(joint, RevoluteJoint)
            if turning:
                rotations.join(driver.link, driver.relative_to)
            graph._demand(f"driver {driver.name}", (driver.link, driver.relative_to), turning)
        return graph

    def _add_joint(self, joint: object, rotations: _Classes) -> None:
        if isinstance(joint, RevoluteJoint):
            if len(joint.links) == 2:
                self._demand(joint.name, joint.links, False, 2)
                return
            pin = f"pin {joint.name}"
            self.freedoms[pin] = 2
            for link in joint.links:
                self._demand(joint.name, (link, pin), False, 2)
        elif isinstance(joint, PrismaticJoint | WeldJoint):
            ends = (joint.guide, joint.block) if isinstance(joint, PrismaticJoint) else joint.links
            if rotations.join(*ends):
                self._demand(joint.name, ends, True)
            else:
                self.redundant.append(joint.name)
            self._demand(joint.name, ends, False, 1 if isinstance(joint, PrismaticJoint) else 2)

    def _demand(self, source: str, bodies: tuple[str, ...], rotation_only: bool, times: int = 1) -> None:
        moving = tuple(body for body in bodies if body != FRAME)
        self.equations.extend([Equation(source, moving, rotation_only)] * times)

    def places(self) -> tuple[dict[str, int], list[str]]:
        """First place (column) of every body, and the body of every place."""
        first: dict[str, int] = {}
        owners: list[str] = []
        for body, count in self.freedoms.items():
            first[body] = len(owners)
            owners += [body] * count
        return first, owners

    def choices(self) -> list[list[int]]:
        """The places that every equation may determine; the last place of a link is its rotation."""
        first, _ = self.places()
        rows = []
        for equation in self.equations:
            row: list[int] = []
            for body in equation.bodies:
                span = range(first[body], first[body] + self.freedoms[body])
                row += [span[-1]] if equation.rotation_only else list(span)
            rows.append(row)
        return rows


class _Classes:
    """Links whose rotations are tied to each other (union-find)."""

    def __init__(self) -> None:
        self.parent: dict[str, str] = {}

    def root(self, name: str) -> str:
        while (above := self.parent.get(name, name)) != name:
            self.parent[name] = self.parent.get(above, above)
            name = above
        return name

    def join(self, a: str, b: str) -> bool:
        """Ties two rotations; False if they already were."""
        a, b = self.root(a), self.root(b)
        self.parent[a] = b
        return a != b
