"""The weld: two links made one."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

from linkwright.core.dataclass import dataclass
from linkwright.engine.trace import Scalar
from linkwright.engine.vector import Vec
from linkwright.fields.base import Field, Quantity, Text
from linkwright.fields.references import LinkNames
from linkwright.joints.base import JOINTS, Entry, Joint
from linkwright.joints.lower import RigidJoint
from linkwright.joints.pose import Pose, Rotor, State
from linkwright.joints.revolute import Pin

if TYPE_CHECKING:
    from linkwright.elements.topology import Connection, TreeJoint
    from linkwright.kinematics.closed_loops import Body, LoopBuilder
    from linkwright.kinematics.constraint_system import ConstraintSystem, Place, Row
    from linkwright.kinematics.dimensions import Dimensions
    from linkwright.structure.constraints import ConstraintGraph
    from linkwright.structure.decompose import Grouping


@JOINTS.register("weld")
@dataclass(frozen=True)
class WeldJoint(RigidJoint):
    """Two links made one; :class:`RigidJoint` says what its fields mean."""

    letter: ClassVar[str] = "W"

    def dimensions(self) -> Mapping[str, float]:
        return {f"{self.name}.angle": self.angle}

    # the model file ---------------------------------------------------------------------------
    @classmethod
    def fields(cls) -> Mapping[str, Field]:
        return {
            "links": LinkNames(required=True, doc="the two links [a, b]"),
            "at": Text(required=True, doc="their common point"),
            "angle": Quantity("angle", doc="angle of b's x axis to a's (default 0)"),
        }

    @classmethod
    def read(cls, entry: Entry) -> Joint | None:
        held, place, at = entry.node.get("at") or entry.node, entry.place.child("at"), entry.values["at"]
        found = [entry.reader.point_of(held, place, at, each) for each in entry.values["links"]]
        return cls(entry.name, **entry.values) if all(found) else None

    @classmethod
    def unpinned(cls, given: Mapping[str, Any]) -> tuple[str, Sequence[str]] | None:
        at, links = given.get("at"), given.get("links")
        if not at or not isinstance(links, list) or len(links) != 2:
            return None
        return at, sorted(links, key=lambda link: link != "frame")

    # structure --------------------------------------------------------------------------------
    def constrain(self, graph: ConstraintGraph) -> None:
        graph.hold_rotation(self.name, *self.links)
        graph.demand(self.name, self.links, 2)

    def connections(self, grouping: Grouping, links: frozenset[str]) -> Iterable[Connection]:
        if grouping.within(self.links, links):
            yield self.between(*self.links, grouping.driver(self.name))

    # motion -----------------------------------------------------------------------------------
    def hang(self, step: TreeJoint, dimensions: Dimensions) -> Fixed:
        turn = dimensions.unit(f"{self.name}.angle")
        turned = turn.conjugate if step.child == self.links[1] else turn
        return Fixed(dimensions.point(step.parent, self.at), dimensions.point(step.child, self.at), turned)

    def turned(self, step: TreeJoint, dimensions: Dimensions) -> Scalar:
        turn = dimensions(f"{self.name}.angle")
        return turn if step.child == self.links[1] else -turn

    def hang_in_loop(self, build: LoopBuilder, step: TreeJoint, group: str) -> Body:
        parent = build.bodies[step.parent]
        turn = self.angle if step.child == self.links[1] else -self.angle
        place, anchor = build.place(step.parent, self.at), build.local(step.child, self.at)
        return build.body(parent.rotation, parent.offset + turn, anchor, place)

    def rows(
        self, system: ConstraintSystem, kept: tuple[str, ...], places: Mapping[str, Place]
    ) -> Iterable[Row]:
        yield system.rotation(self.name, *self.links, self.angle, places)
        yield from system.pin(self.name, *self.links, self.at, places)


@dataclass(frozen=True)
class Fixed(Pin):
    """A weld of a chain: a pin that turns with the parent, no coordinate."""

    turned: Vec

    def place(self, parent: Pose, coordinate: Rotor | Scalar | None) -> Pose:
        rotor = Rotor(parent.rotor.now, parent.rotor.local.turn(self.turned))
        return Pose(self.on_child, parent.point(self.on_parent), rotor)

    def rates(self, parent: State, pose: Pose, rate: Scalar) -> State:
        return super().rates(parent, pose, parent.omega)

    def accelerate(self, parent: State, child: State, rate: Scalar, second: Scalar) -> State:
        return super().accelerate(parent, child, rate, parent.alpha)
