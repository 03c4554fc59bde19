"""What all actuators have in common: when they act, the coordinate that they act along, and their registry.

A kind is one file with one frozen dataclass, registered under the word of its key ``kind``::

    @ACTUATORS.register("brake")
    @dataclass(frozen=True, kw_only=True)
    class Brake(AlongCoordinate):
        torque: float = base.quantity("torque", minimum=0, doc="…")

An actuator is a load: its ``wrenches`` are traced with those of the loads. What switches it is a plain
``select(a < b, …)`` with a - b continuous in the state (no selection by the sign of a rate), since runs find the
instant from the zero of that. Reading with all findings, JSON Schema,
addresses of dimensions (``actuators.NAME.FIELD``) and writing follow from the declared fields.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Self

from linkwright.applied_loads import base
from linkwright.applied_loads.base import LinkPoint, Load, read_kind
from linkwright.applied_loads.site import Site, Wrench
from linkwright.fields.base import Field
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.trace import Scalar, select, sqrt
from linkwright.registry import Registry
from linkwright.words import _

Report = Callable[[str, str, str], None]


@dataclass(frozen=True, kw_only=True)
class Actuator(Load):
    """What acts on a mechanism only where its motion follows from the forces; in a prescribed motion it is left out.

    ``drives``: whether it can move a machine; ``brakes``: whether all that it does is to oppose the motion.
    ``begin``, ``until``: the time, s, from which and up to which it acts (keys ``from`` and ``until``); always
    without.
    """

    section: ClassVar[str] = "actuators"
    drives: ClassVar[bool] = True
    brakes: ClassVar[bool] = False
    begin: float | None = base.quantity(
        "time", default=None, key="from", doc=_("time at which it begins to act (default: from the beginning)")
    )
    until: float | None = base.quantity(
        "time", default=None, doc=_("time at which it ceases to act (default: never)")
    )

    @classmethod
    def fields(cls) -> dict[str, Field]:
        """The keys of a file by their names: first where it acts, those about the time last."""
        return dict(sorted(super().fields().items(), key=lambda each: _rank(each[0])))

    def fields_with_values(self) -> Iterator[tuple[str, Field, Any]]:
        yield from sorted(super().fields_with_values(), key=lambda each: _rank(each[0]))

    @classmethod
    def check(cls, values: Mapping[str, Any], report: Report) -> None:
        begin, until = (values.get(name) for name in TIMES)
        if begin is not None and until is not None and until <= begin:
            problem = _(
                "it ceases to act at {until:g} s, before it begins at {begin:g} s",
                code="actuators.times_exchanged",
                until=until,
                begin=begin,
            )
            report("until", problem, _("give a time after from"))

    def at_limit(self) -> Self:
        """The same where all is asked of it that it has: one that is controlled at its limit."""
        return self

    def within_times(self, site: Site, effort: Scalar, otherwise: Scalar = 0.0) -> Scalar:
        """An effort while the actuator acts, another one, or none, before and after."""
        if self.begin is not None:
            effort = select(site.time < site.dimension("from"), otherwise, effort)
        if self.until is not None:
            effort = select(site.time < site.dimension("until"), effort, otherwise)
        return effort


#: Fields that say where an actuator acts, and when.
WHERE, TIMES = ("on", "against", "along", "between"), ("begin", "until")


def _rank(field: str) -> int:
    return WHERE.index(field) if field in WHERE else len(WHERE) + (field in TIMES)


@dataclass(frozen=True, kw_only=True)
class AlongLine(Actuator):
    """An actuator along a line, with a force (N) and a rate (m/s) whose product is its power.

    ``along``: a prismatic joint, the force pushes its block in the direction of its guide; ``between``: two points,
    the force pushes them apart.
    """

    exactly_one: ClassVar[tuple[tuple[str, ...], ...]] = (("along", "between"),)
    along: str | None = base.joint("slide", default=None, doc=_("the prismatic joint along which it pushes"))
    between: tuple[LinkPoint, LinkPoint] | None = base.points(
        default=None, doc=_("the two points that it pushes apart, [link.point, link.point]")
    )

    @classmethod
    def check(cls, values: Mapping[str, Any], report: Report) -> None:
        super().check(values, report)
        base.check_between(values, report)

    @property
    def rotary(self) -> bool:
        """Whether its effort is a torque."""
        return False

    def rate(self, site: Site) -> Scalar:
        """The rate of its coordinate, rad/s or m/s."""
        if self.along is not None:
            return site.guide(self.along)[2]
        a, b = self._ends
        apart = site.velocity(b.link, b.point) - site.velocity(a.link, a.point)
        return self._line(site)[2].dot(apart)

    def second(self, site: Site) -> Scalar:
        """The rate of its rate, rad/s² or m/s²; of two points there is none."""
        assert self.along is not None
        return site.sliding_second(self.along)

    def sense(self, site: Site) -> Scalar:
        """1 or -1: the sense in which it drives, that of a driver of this coordinate where there is one."""
        if self.along is None:
            return 1.0
        guide = site.motion.mechanism.guides[self.along]
        return site.drive_sense(guide.block, guide.guide)

    def acting(self, site: Site, effort: Scalar) -> list[Wrench]:
        """The wrenches of an effort along its coordinate."""
        if self.along is not None:
            joint = site.motion.mechanism.guides[self.along]
            direction, place, _unused = site.guide(self.along)
            force = direction * effort
            return [Wrench(joint.block, force, place), Wrench(joint.guide, -force, place)]
        a, b = self._ends
        start, end, direction = self._line(site)
        force = direction * effort
        return [Wrench(b.link, force, end), Wrench(a.link, -force, start)]

    @property
    def _ends(self) -> tuple[LinkPoint, LinkPoint]:
        assert self.between is not None
        return self.between

    def _line(self, site: Site) -> tuple[Vec, Vec, Vec]:
        """Its two ends and the unit vector from the first to the second."""
        a, b = self._ends
        start, end = site.place(a.link, a.point), site.place(b.link, b.point)
        between = end - start
        return start, end, between * (1.0 / sqrt(between.square))


@dataclass(frozen=True, kw_only=True)
class AlongCoordinate(AlongLine):
    """An actuator that turns a link, or one along a line.

    ``on``: a link that turns against the link ``against``; the torque (N·m) on it is counter-clockwise positive, and
    ``against`` takes the opposite one.
    """

    exactly_one: ClassVar[tuple[tuple[str, ...], ...]] = (("on", "along", "between"),)
    on: str | None = base.link(moving=True, default=None, doc=_("the link that it turns"))
    against: str = base.link(default="frame", doc=_("the link that takes the opposite torque (default: frame)"))

    @classmethod
    def check(cls, values: Mapping[str, Any], report: Report) -> None:
        super().check(values, report)
        check_against(values, report)

    @property
    def rotary(self) -> bool:
        return self.on is not None

    def rate(self, site: Site) -> Scalar:
        return super().rate(site) if self.on is None else site.turning(self.on, self.against)

    def second(self, site: Site) -> Scalar:
        return super().second(site) if self.on is None else site.turning_second(self.on, self.against)

    def sense(self, site: Site) -> Scalar:
        return super().sense(site) if self.on is None else site.drive_sense(self.on, self.against)

    def acting(self, site: Site, effort: Scalar) -> list[Wrench]:
        if self.on is None:
            return super().acting(site, effort)
        return [Wrench(self.on, torque=effort), Wrench(self.against, torque=-effort)]


def check_against(values: Mapping[str, Any], report: Report) -> None:
    """For ``Load.check``: a link is not turned against itself, and ``against`` goes with ``on``."""
    on, against = values.get("on"), values.get("against")
    if on is not None and on == against:
        problem = _('it acts on and against the same link "{link}"', code="actuators.same_links", link=on)
        report("against", problem, _("name another link"))
    if on is None and against is not None:
        problem = _("against goes with on, and there is none", code="actuators.against_alone")
        report("against", problem, _("remove it, or name the link that turns: on: LINK"))


def check_effort(values: Mapping[str, Any], report: Report) -> None:
    """For ``Load.check``: a torque goes with a link that turns, a force with a guide or two points."""
    rotary = values.get("on") is not None
    wrong = "force" if rotary else "torque"
    if values.get(wrong) is None:
        return
    problem, remedy = (
        (
            _("a force does not turn a link", code="actuators.force_on_link"),
            _("write torque: …, or along: GUIDE or between: [A, B] instead of on"),
        )
        if rotary
        else (
            _("a torque does not push along a line", code="actuators.torque_along"),
            _("write force: …, or on: LINK instead"),
        )
    )
    report(wrong, problem, remedy)


ACTUATORS: Registry[type[Actuator]] = Registry(
    _("actuator kind"), "linkwright.actuators", entry_points="linkwright.actuators", attribute="kind"
)

_LOAD = _("it is a load: write it under loads")
#: What some take for a kind of actuator, by its meaning, and the message that says where it belongs.
ELSEWHERE = {
    "spring": _LOAD,
    "damper": _LOAD,
    "pressure": _("the force of a hydraulic or pneumatic cylinder is kind: cylinder"),
    "input": _("motors are kind: induction, dc, servo or curve"),
}


def read_actuator(reader: Reader, node: Node, place: Place, name: str) -> Actuator | None:
    """The actuator at a node of a file, or None after findings."""
    found = read_kind(reader, node, place, name, ACTUATORS, ELSEWHERE, _("the actuator has no kind"))
    assert found is None or isinstance(found, Actuator)
    return found
