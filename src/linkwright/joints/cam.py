"""Cam and follower: the follower's coordinate is the lift over the cam's angle."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar

from linkwright.core.quantity import shown
from linkwright.elements import Drawing, Model, Sizes
from linkwright.fields.base import Field, Quantity, Word
from linkwright.fields.references import LinkName, PointName
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.trace import Scalar, acos, asin, select, sqrt
from linkwright.joints.base import JOINTS, Entry, HigherPair, Joint, Kinks, LackingError, Report, Size
from linkwright.joints.cam_geometry import Geometry
from linkwright.joints.ends import Ends
from linkwright.laws.program_fields import ProgramField
from linkwright.words import _, pgettext

if TYPE_CHECKING:
    from linkwright.core.arrays import Flags, Floats
    from linkwright.elements import Connection, Group
    from linkwright.laws.program import MotionProgram
    from linkwright.laws.traced import LiftCurve

TOUCH = ("roller", "knife", "flat")
Points = tuple[float, ...]


def _lift(values: Mapping[str, Any]) -> str:
    """Dimension of the lift: an angle where the follower oscillates."""
    return "angle" if values.get("side") is not None else "length"


@JOINTS.register("cam")
@dataclass(frozen=True)
class CamJoint(HigherPair):
    """Link ``cam`` turns about a pin on a carrier and moves link ``follower``, guided or pinned on the same carrier.

    The lift f over the cam's angle φ = ±(θ_c - θ_k - ``phase``) moves a guided follower along its guide from where
    its point ``at`` (roller's centre, edge, point of the face) is d above the cam's centre, d² = (r_b + r_r)² - e² (a
    flat face: d = r_b). With ``side`` the follower oscillates: its arm, from its pivot to ``at``, lies to the
    ``left`` or ``right`` of the line from the pivot to the cam's centre, and the lift is the angle by which it turns
    away from the angle ψ₀ of the base circle. The multiplier is the force along the way of ``at`` (of an oscillating
    flat face: over the distance of the axes); contact force and pressure angle follow from it. ``half_turns``: the
    angle between the line of a pivot to the cam's centre and the follower's arm, in half turns.
    """

    letter: ClassVar[str] = "C"
    couples: ClassVar[bool] = True
    uneven: ClassVar[bool] = True
    cam: str
    follower: str
    at: str
    touch: str
    base_radius: float
    roller_radius: float
    phase: float
    turn: str
    side: str
    closure: str
    curve: str
    program: MotionProgram | None = None
    angles: Points = ()
    lifts: Points = ()
    carrier: str = ""
    centre: str = ""
    holder: str = ""
    half_turns: int = 0

    @property
    def joined(self) -> tuple[str, ...]:
        return (self.follower, self.cam)

    @property
    def turning(self) -> tuple[str, ...]:
        return (self.follower, self.carrier) if self.side and self.carrier else ()

    @property
    def sense(self) -> float:
        """1 where the program runs on while the cam turns counter-clockwise."""
        return -1.0 if self.turn == "clockwise" else 1.0

    @property
    def kinks(self) -> Kinks:
        edges = tuple(self.sense * float(edge) for edge in self.lift.edges[:-1])
        return Kinks(self.cam, self.carrier, f"{self.name}.phase", edges)

    @cached_property
    def lift(self) -> LiftCurve:
        """The lift over the cam's angle."""
        from linkwright.laws.traced import LiftCurve

        return LiftCurve.read(self.curve)

    # the model file ---------------------------------------------------------------------------
    @classmethod
    def fields(cls) -> Mapping[str, Field]:
        from linkwright.fields.base import Quantities

        return {
            "cam": LinkName(required=True, doc=_("the link with the cam, pinned on the carrier")),
            "follower": LinkName(required=True, doc=_("the link that is guided or pinned on the same carrier")),
            "at": PointName("follower", required=True, doc=_("the roller's centre, the edge, a point of the face")),
            "touch": Word(TOUCH, required=True, doc=_("what touches the cam")),
            "side": Word(
                ("left", "right"), doc=_("of the ray pivot to cam, where the arm of an oscillating follower lies")
            ),
            "base_radius": Quantity(
                "length", above=0, required=True, doc=pgettext("key", "radius of the base circle")
            ),
            "roller_radius": Quantity("length", above=0, doc=_("radius of the roller")),
            "phase": Quantity("angle", doc=_("angle of the cam's x axis to the carrier's where the program begins")),
            "turn": Word(("counterclockwise", "clockwise"), doc=_("turn of the cam in which the program runs on")),
            "closure": Word(
                ("force", "groove"), doc=_("what keeps the contact: what presses it (default), a groove")
            ),
            "program": ProgramField(_lift, "angle", doc=_("segments over one turn of the cam")),
            "angles": Quantities("angle", doc=_("angles of a table of the lift, increasing within a turn")),
            "lifts": Quantities(
                "length",
                doc=_("lifts of the table, between them a periodic spline; four equal ones or more are a rest"),
            ),
        }

    @classmethod
    def read(cls, entry: Entry) -> Joint | None:
        from linkwright.laws.traced import LiftCurve

        values, name = entry.values, entry.name
        program, angles, lifts = values.get("program"), values.get("angles"), values.get("lifts")
        if values["cam"] == values["follower"]:
            entry.finding("follower", _("a cam cannot be its own follower"), _("give two links"), "reference")
        elif (program is None) == (angles is None):
            entry.finding(
                "program",
                _("the lift of the cam is missing, or set twice"),
                _("give program: or angles: with lifts:, one of them"),
                "missing-key",
            )
        elif program is None and not _is_table(angles, lifts):
            entry.finding(
                "angles",
                _("the table of the lift is none"),
                _("give as many lifts as angles, eight or more, the angles increasing from 0 to below 360 deg"),
                "range",
            )
        elif (values["touch"] == "roller") != (values.get("roller_radius") is not None):
            entry.finding(
                "roller_radius",
                _("a roller and its radius go together"),
                _("write touch: roller and roller_radius: 10 mm, or neither"),
                "missing-key",
            )
        else:
            attributes: dict[str, Any] = {
                key: values[key] for key in ("cam", "follower", "at", "touch", "base_radius")
            }
            attributes |= {key: values.get(key) or 0.0 for key in ("roller_radius", "phase")}
            attributes |= {key: values.get(key) or "" for key in ("turn", "side", "closure")}
            if program is not None:
                return cls(name, **attributes, curve=LiftCurve.of(program).text, program=program)
            x, y = tuple(angles or ()), tuple(lifts or ())
            return cls(name, **attributes, curve=LiftCurve.through(x, y).text, angles=x, lifts=y)
        return None

    def settled(self, mechanism: Model, report: Report) -> Joint:
        for name, pin in mechanism.joints.items():
            if pin.coordinate != "turn" or self.cam not in pin.joined:
                continue
            for carrier in pin.joined:
                holder = self._held(mechanism, carrier) if carrier not in (self.cam, self.follower) else ""
                if holder:
                    found = replace(self, carrier=carrier, centre=name, holder=holder)
                    held = found._check(mechanism, report)
                    return replace(found, half_turns=round((held.own - held.along) / math.pi))
        problem, remedy = (
            (
                _("the oscillating follower {follower!r} has no pin on a link on which the cam {cam!r} turns"),
                _("give that link a point that {follower!r} has as well: its pivot"),
            )
            if self.side
            else (
                _("the follower {follower!r} has no guide on a link on which the cam {cam!r} turns"),
                _(
                    "add a prismatic joint between them; for an oscillating follower say on which side "
                    "its arm lies: side: left"
                ),
            )
        )
        values = {"follower": self.follower, "cam": self.cam}
        report("follower", problem.format(**values), remedy.format(**values))
        return self

    def _held(self, mechanism: Model, carrier: str) -> str:
        """The guide or the pin that holds the follower on a carrier; empty where there is none."""
        for name, joint in mechanism.joints.items():
            if self.side and joint.coordinate == "turn" and {self.follower, carrier} <= set(joint.joined):
                return name
            if not self.side and joint.coordinate == "slide" and set(joint.ties) == {self.follower, carrier}:
                return name
        return ""

    def _check(self, mechanism: Model, report: Report) -> Geometry:
        found = Geometry.of(self, mechanism)
        if not found.reach > 0:
            remedy = (
                _(
                    "take a base_radius above {minimum} and below {maximum}, or change the distance of "
                    "follower and cam"
                )
                if found.maximum < math.inf
                else _("take a base_radius above {minimum}, or bring follower and cam nearer")
            )
            minimum, maximum = (shown(each, "length", 5) for each in (found.minimum, found.maximum))
            report(
                "base_radius",
                _("the follower does not reach the base circle"),
                remedy.format(minimum=minimum, maximum=maximum),
            )
        return found

    def written(self) -> dict[str, Any]:
        if self.program is None:
            return super().written()
        program = ProgramField("angle" if self.side else "length", "angle").written(self.program)
        return {**replace(self, program=None).written(), "program": program}

    def dimensions(self) -> Mapping[str, float]:
        found = {"base_radius": self.base_radius, "phase": self.phase}
        if self.touch == "roller":
            found["roller_radius"] = self.roller_radius
        return {f"{self.name}.{key}": value for key, value in found.items()}

    def rotation_sum(self, drawing: Drawing) -> tuple[Mapping[str, float], float] | None:
        """That of an oscillating follower, as its row has it at the cam's angle."""
        cam, carrier = drawing.angle(self.cam), drawing.angle(self.carrier) if self.carrier else None
        if not self.side or cam is None or carrier is None:
            return None
        side, held = (1.0 if self.side == "left" else -1.0), self.geometry(drawing.mechanism)
        lift = float(self._lifted(cam - carrier)[0])
        return {self.follower: 1.0, self.carrier: -1.0}, self._between(held) - side * (held.start + lift)

    # motion -----------------------------------------------------------------------------------
    @classmethod
    def linear(cls, group: Group, cut: Connection) -> bool:
        """In the follower's coordinate, unless something that the group turns carries it about."""
        return group.carried_steadily(cut)

    def residual(self, at: Ends) -> list[Scalar]:
        """The follower's coordinate is the lift."""
        lift, radius = self._lift(at)[0], self.radius(at.dimensions)
        if not self.side:
            way, gap = self._way(at)
            aside = at.still(gap.cross(way))
            height = radius if self.touch == "flat" else sqrt(radius * radius - aside * aside)
            return [way.dot(gap) - height - lift]
        scale, start, side, arm, line = self._swung(at)
        between = arm.turn(line.conjugate).angle(self.half_turns)
        turned = at.rotation(self.follower) - at.rotation(self.carrier) + between
        return [scale * (side * turned - start - lift)]

    def held(self, at: Ends, force: Scalar, size: Size) -> list[tuple[Scalar, Scalar]]:
        """Where the cam pushes follows from the slope of the lift.

        On a guide the part of the contact force across it, on a pivot all of it, with the moments of the couples.
        """
        _unused, rate = self._lift(at)
        if not self.side:
            way, gap = self._way(at)
            across = force * (rate - gap.cross(way)) / way.dot(gap)
            return [] if self.touch == "flat" else [(way.perp.dot(gap), across)]
        scale, _unused2, side, reach, _unused3 = self._swung(at)
        own, driven = scale * side, scale * rate
        pivot, centre = at.point(self.follower, self.holder), at.point(self.cam, self.centre)
        if self.touch == "flat":
            normal = at.vector(self.follower, reach).perp * side
            push = normal * (force * (own - driven) / (centre - pivot).cross(normal))
        else:
            a, b = (at.point(self.follower, self.at) - each for each in (pivot, centre))
            push = (b * own - a * driven) * (force / a.cross(b))
        return [((pivot - centre).x, push.x), ((pivot - centre).y, push.y)]

    def place(self, at: Ends, link: str) -> Vec:
        """On a guide the cam's centre; on a pivot this, of the cam its centre."""
        pivot = self.side and link == self.follower
        return at.point(link, self.holder) if pivot else at.point(self.cam, self.centre)

    def _ways(self, at: Ends) -> tuple[Vec, Vec]:
        """The follower's way in its own axes and in the carrier's."""
        guide = at.dimensions.mechanism.guides[self.holder]
        on_guide, on_block = guide.slide_direction(at.dimensions), at.unit(f"{guide.name}.block_angle")
        return (on_block, on_guide) if guide.block == self.follower else (-on_guide, -on_block)

    def _lift(self, at: Ends) -> tuple[Scalar, Scalar]:
        """f and its derivative by the cam's rotation; a follower on a guide turns with the carrier."""
        own, there = (Vec(1.0, 0.0), Vec(1.0, 0.0)) if self.side else self._ways(at)
        against, phase = self.carrier if self.side else self.follower, at.unit(f"{self.name}.phase")
        phi = at.angle_from(self.cam, against, own.turn(there.conjugate).turn(phase)) * self.sense
        lift, rate = at.function(phi, lambda x: self.lift.traced(select(x < 0.0, x + 2.0 * math.pi, x)))
        return lift, rate * self.sense

    def _way(self, at: Ends) -> tuple[Vec, Vec]:
        """The follower's way, and the line from the cam's centre to ``at``."""
        gap = at.point(self.follower, self.at) - at.point(self.cam, self.centre)
        return at.vector(self.follower, self._ways(at)[0]), gap

    def _swung(self, at: Ends) -> tuple[Scalar, Scalar, float, Vec, Vec]:
        """Of a follower on a pivot: m per rad, ψ₀, the side, its arm, and the line to the cam's centre."""
        arm = at.local(self.follower, self.at) - at.local(self.follower, self.holder)
        line = at.local(self.carrier, self.centre) - at.local(self.carrier, self.holder)
        radius, c, side = self.radius(at.dimensions), sqrt(line.square), 1.0 if self.side == "left" else -1.0
        if self.touch == "flat":
            return c, asin(radius / c), side, arm, line
        reach = line.square + arm.square - radius * radius
        return sqrt(arm.square), acos(reach / (2.0 * c * sqrt(arm.square))), side, arm, line

    def gains(self, mechanism: Model) -> tuple[Mapping[str, float], Mapping[str, float]]:
        """The follower's coordinate, as the lift gains nothing over full turns of the cam."""
        return ({self.follower: 1.0, self.carrier: -1.0}, {}) if self.side else ({}, {self.holder: 1.0})

    def _lifted(self, turn: Any) -> tuple[Any, Any, Any]:
        """The lift with two derivatives by the cam's angle to its carrier."""
        lift, slope, bend = self.lift.curves(self.sense * (turn - self.phase))
        return lift, slope * self.sense, bend

    def _between(self, held: Geometry) -> float:
        """The angle from the line of a pivot to the cam's centre to the follower's arm in its axes, rad."""
        nominal = math.pi * self.half_turns
        return nominal + math.remainder(held.own - held.along - nominal, 2.0 * math.pi)

    def pulls(self, force: Callable[[], Floats]) -> Flags | None:
        if self.closure == "groove":
            return None
        push = force()
        none: Flags = push < -1e-9 * max(float(abs(push).max(initial=0.0)), 1e-12)
        return none

    def sums(self, mechanism: Model) -> tuple[Mapping[str, float], Mapping[str, float], float]:
        raise LackingError(
            _(
                "the lift of a cam is not a sum of rotations and displacements, which is all that can be "
                "used here: exports to MuJoCo and Modelica, and worked solutions of a cam within a loop, "
                "take gears, racks and belts only",
                code="joints.cam_sums",
            )
        )

    def tied(self, mechanism: Model) -> tuple[Mapping[str, float], Mapping[str, float]]:
        """With a slope of the lift that no sizes of wheels have: the golden section, m of the base circle or rad."""
        slope = 0.5 * (math.sqrt(5.0) - 1.0) * (1.0 if self.side else self.base_radius)
        if self.side:
            return {self.follower: 1.0, self.cam: -slope, self.carrier: slope - 1.0}, {}
        return {self.cam: -slope, self.carrier: slope}, {self.holder: 1.0}

    @property
    def seats(self) -> tuple[tuple[str, str], ...]:
        return ((self.follower, self.holder),) if self.side else ((self.cam, self.centre),)

    def geometry(self, mechanism: Model) -> Geometry:
        """Directions and distances of cam and follower on their carrier."""
        return Geometry.of(self, mechanism)

    def radius(self, dimensions: Sizes) -> Scalar:
        """Radius of the base circle and the roller together, traced, m."""
        base = dimensions(f"{self.name}.base_radius")
        return base + dimensions(f"{self.name}.roller_radius") if self.touch == "roller" else base


def _is_table(angles: Points | None, lifts: Points | None) -> bool:
    if not angles or not lifts or len(angles) != len(lifts) or len(angles) < 8:
        return False
    rising = all(a < b for a, b in itertools.pairwise(angles))
    return rising and angles[0] >= 0 and angles[-1] < 6.283185307179586
