"""The prismatic joint: a block on a straight guide."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, ClassVar

from linkwright.core.dataclass import dataclass
from linkwright.engine.trace import Scalar, reciprocal, sqrt
from linkwright.engine.vector import Vec
from linkwright.fields.base import Field, Quantity
from linkwright.fields.references import Direction, LinkName, PointName
from linkwright.joints.base import JOINTS, Angles, Cut, Entry, Joint, Poses, States
from linkwright.joints.lower import SlidingJoint
from linkwright.joints.pose import Pose, Rotor, State
from linkwright.joints.revolute import FRICTION
from linkwright.words.sentence import Sentence, together

if TYPE_CHECKING:
    from linkwright.elements.model import Sizes
    from linkwright.elements.topology import Connection, TreeJoint
    from linkwright.kinematics.closed_loops import Body, LoopBuilder
    from linkwright.kinematics.constraint_system import ConstraintSystem, Place, Row
    from linkwright.kinematics.dimensions import Dimensions
    from linkwright.structure.constraints import ConstraintGraph
    from linkwright.structure.decompose import Grouping


@JOINTS.register("prismatic")
@dataclass(frozen=True)
class PrismaticJoint(SlidingJoint):
    """A straight guide with its block; :class:`SlidingJoint` says what its fields mean."""

    letter: ClassVar[str] = "P"

    def dimensions(self) -> Mapping[str, float]:
        found = {f"{self.name}.offset": self.offset, f"{self.name}.block_angle": self.block_angle}
        if self.direction_points is None:
            found[f"{self.name}.direction"] = self.direction
        if self.friction:
            found[f"{self.name}.friction"] = self.friction
        return found

    def aligned(self, points: Mapping[str, tuple[float, float]]) -> PrismaticJoint:
        if self.direction_points is None:
            return self
        (px, py), (qx, qy) = (points[name] for name in self.direction_points)
        turned = math.remainder(math.atan2(qy - py, qx - px) - self.direction, 2.0 * math.pi)
        return replace(self, direction=self.direction + turned)

    # the model file ---------------------------------------------------------------------------
    @classmethod
    def fields(cls) -> Mapping[str, Field]:
        return {
            "guide": LinkName(required=True, doc="the link that carries the guide"),
            "through": PointName("guide", required=True, doc="point of the guide link on the guide line"),
            "direction": Direction(
                required=True, doc="an angle in the guide link's axes, or two points [P, Q]"
            ),
            "block": LinkName(required=True, doc="the link that slides"),
            "at": PointName("block", required=True, doc="point of the block that follows the line"),
            "offset": Quantity(
                "length", doc="normal distance of the point from the line, left positive (default 0)"
            ),
            "block_angle": Quantity("angle", doc="direction of the line in the block's axes (default 0)"),
            "friction": FRICTION,
        }

    @classmethod
    def read(cls, entry: Entry) -> Joint | None:
        if not cls._apart(entry):
            return None
        name, values, links = entry.name, entry.values, entry.links
        guide, direction = values["guide"], values.pop("direction")
        if isinstance(direction, float):
            return cls(name, direction=direction, direction_points=None, **values)
        joint = cls(name, direction=0.0, direction_points=direction, **values)
        if guide not in links:
            return joint
        first, second = (links[guide].points.get(each) for each in direction)
        if first is None or second is None:
            return joint
        if math.dist(first, second) == 0:
            problem = Sentence("model.same_place", points=together(direction))
            entry.say("direction", problem, Sentence("model.points_apart"), "range")
        return joint.aligned(links[guide].points)

    @classmethod
    def unpinned(cls, given: Mapping[str, Any]) -> tuple[str, Sequence[str]] | None:
        at, guide = given.get("at"), given.get("guide")
        return (at, (guide,)) if at and guide and at == given.get("through") else None

    @staticmethod
    def _apart(entry: Entry) -> bool:
        """Whether guide and block, and their points, are different ones."""
        guide, block, point = (entry.values[key] for key in ("guide", "block", "at"))
        if guide == block:
            entry.say("block", Sentence("model.guide_is_block", guide=guide), Sentence("model.two_links"))
            return False
        others = [owner for owner in entry.reader.names.owners(point) if owner not in (guide, block)]
        if point == entry.values["through"] and others:
            problem = Sentence("model.point_on_both", point=point, others=tuple(others))
            entry.say("at", problem, Sentence("model.rename_point"), "ambiguous")
            return False
        return True

    def written(self) -> dict[str, Any]:
        return {
            **super().written(),
            "direction": Direction().written(self.direction_points or self.direction),
        }

    # structure --------------------------------------------------------------------------------
    def constrain(self, graph: ConstraintGraph) -> None:
        graph.hold_rotation(self.name, self.guide, self.block)
        graph.demand(self.name, (self.guide, self.block), 1)

    def connections(self, grouping: Grouping, links: frozenset[str]) -> Iterable[Connection]:
        if grouping.within((self.guide, self.block), links):
            yield self.between(self.guide, self.block, grouping.driver(self.name))

    # motion -----------------------------------------------------------------------------------
    def hang(self, step: TreeJoint, dimensions: Dimensions) -> Guide:
        on_guide, on_block = self.slide_direction(dimensions), dimensions.unit(f"{self.name}.block_angle")
        through = dimensions.point(self.guide, self.through)
        at = dimensions.point(self.block, self.at)
        offset = dimensions(f"{self.name}.offset")
        if step.child == self.block:
            return Guide(through, at, on_guide, on_guide.conjugate.turn(on_block), offset, 1.0)
        return Guide(at, through, on_block, on_block.conjugate.turn(on_guide), offset, -1.0)

    def cut(self, connection: Connection, dimensions: Dimensions) -> GuideCut:
        return GuideCut(
            connection,
            dimensions.point(self.guide, self.through),
            dimensions.point(self.block, self.at),
            self.slide_direction(dimensions),
            dimensions(f"{self.name}.offset"),
        )

    def slide_direction(self, dimensions: Sizes) -> Vec:
        if self.direction_points is None:
            return dimensions.unit(f"{self.name}.direction")
        start, end = (dimensions.point(self.guide, name) for name in self.direction_points)
        d = end - start
        if isinstance(d.y, float) and d.y == 0.0 and not isinstance(d.x, float):
            (x0, _), (x1, _) = (dimensions.link(self.guide).points[each] for each in self.direction_points)
            if f"{self.guide}.length" not in dimensions.free and x1 > x0:
                return Vec(1.0, 0.0)
        return d * reciprocal(sqrt(d.square))

    def turned(self, step: TreeJoint, dimensions: Dimensions) -> Scalar:
        along: Scalar
        if self.direction_points is None:
            along = dimensions(f"{self.name}.direction")
        else:
            along = self.slide_direction(dimensions).angle(round(self.direction / math.pi))
        turn = along - dimensions(f"{self.name}.block_angle")
        return turn if step.child == self.block else -turn

    def hang_in_loop(self, build: LoopBuilder, step: TreeJoint, group: str) -> Body:
        parent = build.bodies[step.parent]
        key = ("drive", step.driver) if step.driver else build.unknown("slide", self.name, group)
        outward = step.child == self.block
        on_parent, on_child = (self.through, self.at) if outward else (self.at, self.through)
        sign = 1.0 if outward else -1.0
        place = dict(build.place(step.parent, on_parent))
        along = parent.offset + (self.direction if outward else self.block_angle)
        build.slide(place, key, parent.rotation, sign * cmath.exp(1j * along), self.offset)
        turn = parent.offset + sign * (self.direction - self.block_angle)
        return build.body(parent.rotation, turn, build.local(step.child, on_child), place)

    def close_loop(self, build: LoopBuilder, cut: Connection, group: str) -> None:
        start, guide = dict(build.place(self.guide, self.through)), build.bodies[self.guide]
        along = cmath.exp(1j * (guide.offset + self.direction))
        build.slide(start, build.unknown("slide", self.name, group), guide.rotation, along, self.offset)
        build.loop(group, start, build.place(self.block, self.at))

    def rows(
        self, system: ConstraintSystem, kept: tuple[str, ...], places: Mapping[str, Place]
    ) -> Iterable[Row]:
        turn = self.direction - self.block_angle
        yield system.rotation(self.name, self.guide, self.block, turn, places)
        yield system.along(self, places, across=True)


@dataclass(frozen=True)
class Guide:
    """A prismatic joint of a chain; ``sign`` is -1 if the child carries the guide.

    ``on_parent``: the guide's point or the block's point of the parent; ``on_child`` of the child;
    ``direction``: of the guide, in the parent's axes; ``turned``: what the child's axes see of a vector
    that the parent's axes see as (1, 0).
    """

    on_parent: Vec
    on_child: Vec
    direction: Vec
    turned: Vec
    offset: Scalar
    sign: float

    def normal(self, parent: Pose) -> Vec:
        """The guide's direction, in frame axes, along which the child moves with a growing coordinate."""
        return parent.spin(self.direction) * self.sign

    def place(self, parent: Pose, coordinate: Rotor | Scalar | None) -> Pose:
        assert not isinstance(coordinate, Rotor) and coordinate is not None
        n = self.normal(parent)
        slid = parent.point(self.on_parent) + n * coordinate + n.perp * self.offset
        rotor = Rotor(parent.rotor.now, parent.rotor.local.turn(self.turned))
        return Pose(self.on_child, slid, rotor)

    def _arm(self, parent: State, child: Pose) -> Vec:
        return child.place - parent.pose.place

    def rates(self, parent: State, pose: Pose, rate: Scalar) -> State:
        carried = parent.velocity_at(self._arm(parent, pose))
        return State(pose, carried + self.normal(parent.pose) * rate, parent.omega)

    def accelerate(self, parent: State, child: State, rate: Scalar, second: Scalar) -> State:
        n = self.normal(parent.pose)
        carried = parent.acceleration_at(self._arm(parent, child.pose))
        coriolis = n.perp * (2.0 * (parent.omega * rate))
        return State(child.pose, child.velocity, child.omega, carried + coriolis + n * second, parent.alpha)


@dataclass(frozen=True)
class GuideCut(Cut):
    """A guide that was cut; its rotation is prevented elsewhere, so only the normal distance is left."""

    through: Vec
    at: Vec
    direction: Vec
    offset: Scalar

    @property
    def on(self) -> str:
        return self.connection.b

    def _normal(self, poses: Poses) -> Vec:
        return poses[self.connection.a].spin(self.direction).perp

    def residual(self, poses: Poses, angles: Angles) -> list[Scalar]:
        a, b = poses[self.connection.a], poses[self.connection.b]
        return [self._normal(poses).dot(b.point(self.at) - a.point(self.through)) - self.offset]

    def column(self, shift: Vec, turn: Scalar, end: str, poses: Poses) -> list[Scalar]:
        sign = 1.0 if end == self.connection.b else -1.0
        return [self._normal(poses).dot(shift) * sign]

    def drift(self, states: States) -> list[Scalar]:
        a, b = states[self.connection.a], states[self.connection.b]
        place = b.pose.point(self.at)
        gap = b.velocity_of(self.at) - a.velocity_at(place - a.pose.place)
        return [a.pose.spin(self.direction).perp.dot(gap)]

    def bend(self, states: States) -> list[Scalar]:
        a, b = states[self.connection.a], states[self.connection.b]
        arm = b.pose.point(self.at) - a.pose.place
        n = a.pose.spin(self.direction)
        slide = n.dot(b.velocity_of(self.at) - a.velocity_at(arm))
        gap = b.acceleration_of(self.at) - a.acceleration_at(arm)
        return [n.perp.dot(gap) - 2.0 * (a.omega * slide)]

    def place(self, end: str, poses: Poses) -> Vec:
        return poses[self.connection.b].point(self.at)

    def force_on(self, end: str, multipliers: Sequence[Scalar], poses: Poses) -> tuple[Vec, Scalar]:
        force = self._normal(poses) * multipliers[0]
        return (force if end == self.connection.b else -force), 0.0
