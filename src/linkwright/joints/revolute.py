"""The revolute joint: any number of links on one pin."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, ClassVar

from linkwright.core.dataclass import dataclass
from linkwright.engine.trace import Scalar
from linkwright.engine.vector import Vec
from linkwright.fields.base import Field, Quantity
from linkwright.joints.base import JOINTS, Angles, Cut, Entry, Joint, Poses, States
from linkwright.joints.lower import TurningJoint
from linkwright.joints.pose import Pose, Rotor, State

if TYPE_CHECKING:
    from linkwright.elements.topology import Connection, TreeJoint
    from linkwright.kinematics.closed_loops import Body, LoopBuilder
    from linkwright.kinematics.constraint_system import ConstraintSystem, Place, Row
    from linkwright.kinematics.dimensions import Dimensions
    from linkwright.structure.constraints import ConstraintGraph
    from linkwright.structure.decompose import Grouping

FRICTION = Quantity("dimensionless", minimum=0, doc="coefficient of Coulomb friction (default 0)")


@JOINTS.register("revolute")
@dataclass(frozen=True)
class RevoluteJoint(TurningJoint):
    """A pin: the kind that points of one name imply."""

    letter: ClassVar[str] = "R"

    def dimensions(self) -> Mapping[str, float]:
        given = {f"{self.name}.friction": self.friction} if self.friction else {}
        return given if self.pin_radius is None else {f"{self.name}.pin_radius": self.pin_radius, **given}

    # the model file ---------------------------------------------------------------------------
    @classmethod
    def fields(cls) -> Mapping[str, Field]:
        return {"pin_radius": Quantity("length", above=0, doc="radius of the pin"), "friction": FRICTION}

    @classmethod
    def read(cls, entry: Entry) -> Joint | None:
        pins = entry.reader.names.pins
        if entry.name not in pins:
            entry.reader.known(entry.node, entry.place, "pin", entry.name, list(pins))
            return None
        return cls(entry.name, pins[entry.name], **entry.values)

    # structure --------------------------------------------------------------------------------
    @property
    def pairs(self) -> int:
        """A pin of k links is k - 1 pairs."""
        return len(self.links) - 1

    def constrain(self, graph: ConstraintGraph) -> None:
        if len(self.links) == 2:
            graph.demand(self.name, self.links, 2)
            return
        pin = f"pin {self.name}"
        graph.freedoms[pin] = 2
        for link in self.links:
            graph.demand(self.name, (link, pin), 2)

    def connections(self, grouping: Grouping, links: frozenset[str]) -> Iterable[Connection]:
        """On the frame, or on a link next to it, if one of them is solved."""
        mine = [link for link in self.links if link in links]
        pairs = {frozenset((d.link, d.relative_to)): d.name for d in grouping.drivers.get(self.name, ())}
        present = grouping.firm(self.links) + mine
        used: list[str] = []
        for pair, driver in pairs.items():
            if pair <= set(present) and any(link in links for link in pair):
                a, b = sorted(pair, key=present.index)
                used.append(b)
                yield self.between(a, b, driver)
        base = present[0]
        for link in mine:
            if link != base and link not in used:
                yield self.between(base, link)

    # motion -----------------------------------------------------------------------------------
    def hang(self, step: TreeJoint, dimensions: Dimensions) -> Pin:
        return Pin(dimensions.point(step.parent, self.name), dimensions.point(step.child, self.name))

    def cut(self, connection: Connection, dimensions: Dimensions) -> PinCut:
        a, b = connection.a, connection.b
        return PinCut(connection, dimensions.point(a, self.name), dimensions.point(b, self.name))

    def hang_in_loop(self, build: LoopBuilder, step: TreeJoint, group: str) -> Body:
        place, anchor = build.place(step.parent, self.name), build.local(step.child, self.name)
        if step.driver is None:
            return build.body(build.free_rotation(step.child, group), 0.0, anchor, place)
        parent = build.bodies[step.parent]
        sign = 1.0 if step.child == build.mechanism.drivers[step.driver].link else -1.0
        return build.body(build.driven(parent.rotation, step.driver, sign), parent.offset, anchor, place)

    def close_loop(self, build: LoopBuilder, cut: Connection, group: str) -> None:
        build.loop(group, build.place(cut.a, self.name), build.place(cut.b, self.name))

    @property
    def seats(self) -> tuple[tuple[str, str], ...]:
        return ((self.links[-1], self.name),)

    def rows(
        self, system: ConstraintSystem, kept: tuple[str, ...], places: Mapping[str, Place]
    ) -> Iterable[Row]:
        for other in kept[1:]:
            yield from system.pin(self.name, kept[0], other, self.name, places)


@dataclass(frozen=True)
class Pin:
    """A revolute joint of a chain; its coordinate is the child's rotor, its rate the child's angular velocity."""

    on_parent: Vec
    on_child: Vec

    def place(self, parent: Pose, coordinate: Rotor | Scalar | None) -> Pose:
        assert isinstance(coordinate, Rotor)
        return Pose(self.on_child, parent.point(self.on_parent), coordinate)

    def normal(self, parent: Pose) -> Vec:
        raise TypeError("no displacement")

    def rates(self, parent: State, pose: Pose, rate: Scalar) -> State:
        return State(pose, parent.velocity_of(self.on_parent), rate)

    def accelerate(self, parent: State, child: State, rate: Scalar, second: Scalar) -> State:
        acceleration = parent.acceleration_of(self.on_parent)
        return State(child.pose, child.velocity, child.omega, acceleration, second)


@dataclass(frozen=True)
class PinCut(Cut):
    """A pin that was cut: the point on ``a`` and the point on ``b`` must coincide (two equations)."""

    on_a: Vec
    on_b: Vec

    @property
    def rows(self) -> int:
        return 2

    def residual(self, poses: Poses, angles: Angles) -> list[Scalar]:
        gap = poses[self.connection.a].point(self.on_a) - poses[self.connection.b].point(self.on_b)
        return [gap.x, gap.y]

    def column(self, shift: Vec, turn: Scalar, end: str, poses: Poses) -> list[Scalar]:
        sign = 1.0 if end == self.connection.a else -1.0
        return [shift.x * sign, shift.y * sign]

    def point(self, end: str) -> Vec:
        """The cut's point in the axes of one end."""
        return self.on_a if end == self.connection.a else self.on_b

    def drift(self, states: States) -> list[Scalar]:
        """Relative velocity of the two ends."""
        a, b = states[self.connection.a], states[self.connection.b]
        gap = a.velocity_of(self.on_a) - b.velocity_of(self.on_b)
        return [gap.x, gap.y]

    def bend(self, states: States) -> list[Scalar]:
        """Relative acceleration of the two ends."""
        a, b = states[self.connection.a], states[self.connection.b]
        gap = a.acceleration_of(self.on_a) - b.acceleration_of(self.on_b)
        return [gap.x, gap.y]

    def place(self, end: str, poses: Poses) -> Vec:
        return poses[end].point(self.point(end))

    def arm(self, end: str, poses: Poses) -> Vec:
        pose = poses[end]
        return pose.spin(self.point(end) - pose.anchor)

    def force_on(self, end: str, multipliers: Sequence[Scalar], poses: Poses) -> tuple[Vec, Scalar]:
        force = Vec(multipliers[0], multipliers[1])
        return (force if end == self.connection.a else -force), 0.0
