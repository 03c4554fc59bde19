"""The prismatic joint: a block on a straight guide."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar

from linkwright.fields.base import Field, Quantity
from linkwright.fields.references import Direction, LinkName, PointName
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.trace import Scalar, reciprocal, sqrt
from linkwright.joints.base import JOINTS, Entry, Joint
from linkwright.joints.ends import Ends, Hung
from linkwright.joints.lower_pair import SlidingJoint
from linkwright.joints.revolute import FRICTION
from linkwright.words import _
from linkwright.words.message import together

if TYPE_CHECKING:
    from linkwright.elements import Sizes, TreeJoint


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
            "guide": LinkName(required=True, doc=_("the link that carries the guide")),
            "through": PointName("guide", required=True, doc=_("point of the guide link on the guide line")),
            "direction": Direction(required=True, doc=_("an angle in the guide link's axes, or two points [P, Q]")),
            "block": LinkName(required=True, doc=_("the link that slides")),
            "at": PointName("block", required=True, doc=_("point of the block that follows the line")),
            "offset": Quantity(
                "length", doc=_("normal distance of the point from the line, left positive (default 0)")
            ),
            "block_angle": Quantity("angle", doc=_("direction of the line in the block's axes (default 0)")),
            "friction": FRICTION,
        }

    @classmethod
    def read(cls, entry: Entry) -> Joint | None:
        if not cls._points_differ(entry):
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
            problem = _("{points} are at the same place", code="model.same_place", points=together(direction))
            entry.finding("direction", problem, _("name two points with different positions"), "range")
        return joint.aligned(links[guide].points)

    @classmethod
    def unpinned(cls, values: Mapping[str, Any]) -> tuple[str, Sequence[str]] | None:
        at, guide = values.get("at"), values.get("guide")
        return (at, (guide,)) if at and guide and at == values.get("through") else None

    @staticmethod
    def _points_differ(entry: Entry) -> bool:
        """Whether guide and block, and their points, are different ones."""
        guide, block, point = (entry.values[key] for key in ("guide", "block", "at"))
        if guide == block:
            entry.finding(
                "block",
                _('guide and block are both "{guide}"', code="model.guide_is_block", guide=guide),
                _("name two different links"),
            )
            return False
        others = [owner for owner in entry.reader.names.owners(point) if owner not in (guide, block)]
        if point == entry.values["through"] and others:
            problem = _(
                '"{point}" names a point of the guide and of the block, and {others} has it too',
                code="model.point_on_both",
                point=point,
                others=tuple(others),
            )
            entry.finding("at", problem, _("rename the point of the guide"), "ambiguous")
            return False
        return True

    def written(self) -> dict[str, Any]:
        return {**super().written(), "direction": Direction().written(self.direction_points or self.direction)}

    # motion -----------------------------------------------------------------------------------

    def residual(self, at: Ends) -> list[Scalar]:
        """The block's distance from the guide's line; what keeps the rotation is another joint."""
        gap = at.point(self.block, self.at) - at.point(self.guide, self.through)
        along = at.vector(self.guide, self.slide_direction(at.dimensions))
        return [along.perp.dot(gap) - at.dimension(f"{self.name}.offset")]

    def hang(self, at: Ends, step: TreeJoint, coordinate: Scalar) -> Hung:
        own, other = self.slide_direction(at.dimensions), at.unit(f"{self.name}.block_angle")
        start, end, sign = self.through, self.at, 1.0
        if step.child != self.block:
            own, other, start, end, sign = other, own, end, start, -1.0
        along = at.vector(step.parent, own) * sign
        slid = at.point(step.parent, start) + along * coordinate + along.perp * at.dimension(f"{self.name}.offset")
        return Hung(at.local(step.child, end), slid, own.conjugate.turn(other))

    def slide_direction(self, dimensions: Sizes) -> Vec:
        if self.direction_points is None:
            return dimensions.unit(f"{self.name}.direction")
        start, end = (dimensions.point(self.guide, name) for name in self.direction_points)
        d = end - start
        if isinstance(d.y, float) and d.y == 0.0 and not isinstance(d.x, float):
            (x0, _unused), (x1, _unused2) = (
                dimensions.link(self.guide).points[each] for each in self.direction_points
            )
            if f"{self.guide}.length" not in dimensions.free and x1 > x0:
                return Vec(1.0, 0.0)
        return d * reciprocal(sqrt(d.square))

    def turned(self, step: TreeJoint, dimensions: Sizes) -> Scalar:
        along: Scalar
        if self.direction_points is None:
            along = dimensions(f"{self.name}.direction")
        else:
            along = self.slide_direction(dimensions).angle(round(self.direction / math.pi))
        turn = along - dimensions(f"{self.name}.block_angle")
        return turn if step.child == self.block else -turn
