"""The link-freedom/constraint graph of a mechanism.

Unknowns are the three freedoms of every moving link and the two of every pin that joins three links
or more; equations are what joints and drivers demand. A guide's demand on the rotation touches only
rotations, so a loop of guides that fixes a rotation twice is found here and counted once.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from linkwright.core.linear_sums import SMALL, LinearSums
from linkwright.joints.base import Joint
from linkwright.mechanism.mechanism import Mechanism

FRAME = "frame"
#: Prefix of a driver's name where it is the source of a demand.
DRIVER = "driver "


@dataclass(frozen=True)
class Equation:
    """One demand: its source (joint or driver), the bodies it touches, and whether only rotations."""

    source: str
    bodies: tuple[str, ...]
    rotation_only: bool = False


class Classes:
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


@dataclass
class ConstraintGraph:
    """Bodies (links and shared pins) with their freedoms, and the equations between them."""

    freedoms: dict[str, int]
    equations: list[Equation]
    redundant: list[str] = field(default_factory=list)
    rotations: Classes = field(default_factory=Classes)
    sums: LinearSums[str] = field(default_factory=LinearSums)

    @classmethod
    def of(cls, mechanism: Mechanism) -> ConstraintGraph:
        """The graph of a mechanism with its drivers."""
        graph = cls(dict.fromkeys(mechanism.links, 3), [])
        for joint in sorted(mechanism.joints.values(), key=lambda each: not each.ties):
            graph.add(joint, mechanism)
        for driver in mechanism.drivers.values():
            turning = mechanism.joints[driver.joint].coordinate == "turn"
            if turning:
                graph.rotations.join(driver.link, driver.relative_to)
            graph.demand(f"{DRIVER}{driver.name}", (driver.link, driver.relative_to), rotation_only=turning)
        return graph

    def add(self, joint: Joint, mechanism: Mechanism) -> None:
        """The demands of a joint: a sum of rotations, the one row of another higher pair, or those of a lower pair on
        rotations and places of its links. A pin of three links or more is a body of its own."""
        name, links = joint.name, joint.joined
        if joint.rotations_only:
            self.sum_rotations(name, joint.sums(mechanism)[0])
        elif joint.higher:
            self.demand(name, links)
        elif len(links) > 2:
            self.freedoms[pin := f"pin {name}"] = 2
            for link in links:
                self.demand(name, (link, pin), 2)
        else:
            if joint.ties:
                self.hold_rotation(name, *joint.ties)
            self.demand(name, links, 3 - joint.freedoms - bool(joint.ties))

    def hold_rotation(self, source: str, a: str, b: str) -> None:
        """The demand that two links keep their angle to each other, noted as redundant if others hold it already."""
        if self.rotations.join(a, b):
            self.sums.add({link: sign for link, sign in ((a, 1.0), (b, -1.0)) if link != FRAME})
            self.demand(source, (a, b), rotation_only=True)
        else:
            self.redundant.append(source)

    def sum_rotations(self, source: str, factors: Mapping[str, float]) -> None:
        """The demand that Σ factor · rotation of a link is constant; redundant if others hold it already."""
        nonzero = {link: factor for link, factor in factors.items() if link != FRAME and abs(factor) > SMALL}
        if self.sums.add(nonzero):
            self.demand(source, tuple(nonzero), rotation_only=True)
        else:
            self.redundant.append(source)

    def demand(self, source: str, bodies: tuple[str, ...], times: int = 1, *, rotation_only: bool = False) -> None:
        """Adds a demand of a joint or driver on bodies; ``rotation_only``: it touches only their rotations."""
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
