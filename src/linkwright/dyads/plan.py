"""How a mechanism is solved by the functions of this package, one group after the other.

Each link gets a :class:`Axes`: where the functions see its line, in the axes of the model file. Points in the plane
are complex numbers here.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from linkwright.core.arrays import Indices
from linkwright.dyads.motion import DyadMotion, prp, rpp, rpr, rrp, rrr
from linkwright.dyads.values import Line, State
from linkwright.elements import Group, TreeJoint
from linkwright.errors import LinkwrightError
from linkwright.joints.lower_pair import SlidingJoint
from linkwright.kinematics.groups import dyad_shape
from linkwright.kinematics.motion import Motion
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

#: Share of the mechanism's size up to which a function's positions are those of the solver.
AGREEING = 1e-7
MODES = {"RRR": ("left", "right"), "RRP": ("forward", "backward"), "RPR": ("forward", "backward")}


@dataclass(frozen=True)
class Axes:
    """A link's line: its origin in the axes of the file, m, and its direction from their x axis, rad."""

    origin: complex = 0j
    lean: float = 0.0

    def along(self, local: complex) -> complex:
        """Coordinates of a point of the link, along the line and to its left."""
        return (local - self.origin) * cmath.exp(-1j * self.lean)


@dataclass(frozen=True)
class Pin:
    """An outer pin: the joint, the known link that carries it, the place on that link."""

    joint: str
    link: str
    local: complex


@dataclass(frozen=True)
class Guide:
    """An outer guide: the joint, the known link, a point of the line and its direction in that link's axes."""

    joint: str
    link: str
    local: complex
    angle: float


@dataclass(frozen=True)
class Slid:
    """The displacement that the file means, from the slide of a function: sign · slide + shift, m."""

    joint: str
    sign: float
    shift: float


@dataclass(frozen=True)
class Step:
    """One step of the solution.

    ``kind``: ``bar``, ``slider``, ``weld``, a dyad's signature, or empty for a group without a function, with the
    ``reason``; ``links``: first and second; ``outer``: their outer joints in that order; ``inner``: the inner joint;
    ``lengths``, ``offsets``, ``angle``, ``mode``: arguments of the function; ``sign``: of a driver's coordinate.
    """

    number: int
    group: Group
    kind: str
    links: tuple[str, ...]
    outer: tuple[Pin | Guide, ...] = ()
    inner: str = ""
    lengths: tuple[float, ...] = ()
    offsets: tuple[float, ...] = ()
    angle: float = 0.0
    mode: str = ""
    sign: float = 1.0
    slides: tuple[Slid, ...] = ()
    reason: str = ""

    @property
    def pins(self) -> tuple[Pin, ...]:
        """Its outer pins."""
        return tuple(each for each in self.outer if isinstance(each, Pin))

    @property
    def guides(self) -> tuple[Guide, ...]:
        """Its outer guides."""
        return tuple(each for each in self.outer if isinstance(each, Guide))


@dataclass
class Plan:
    """All steps in solving order, and the axes of every link."""

    mechanism: Mechanism
    steps: list[Step] = field(default_factory=list)
    axes: dict[str, Axes] = field(default_factory=lambda: {"frame": Axes()})

    def local(self, link: str, point: str) -> complex:
        """A point of a link, in the axes of the file."""
        return complex(*self.mechanism.link(link).points[point])

    @property
    def others(self) -> list[Step]:
        """The groups without a function."""
        return [step for step in self.steps if not step.kind]


def plan(motion: Motion, rows: Sequence[int] | None = None) -> Plan:
    """The steps that solve a motion; assembly modes are those that give its positions, at ``rows`` or everywhere."""
    made = Plan(motion.mechanism)
    chosen = range(motion.steps) if rows is None else rows
    reached = np.array([i for i in chosen if motion.ok[i]], dtype=np.intp)
    for number, group in enumerate(motion.structure.groups, 1):
        step = _Planner(made, motion, reached).step(number, group)
        made.steps.append(step)
        if not step.kind:
            made.axes |= {link: _own_axes(made, link) for link in group.links}
    return made


def _own_axes(made: Plan, link: str) -> Axes:
    """Axes of a link that no function places: those of the file, from its first point."""
    return Axes(made.local(link, next(iter(made.mechanism.links[link].points))))


class _Planner:
    """Plans one step."""

    def __init__(self, made: Plan, motion: Motion, rows: Indices) -> None:
        self.plan, self.motion, self.rows = made, motion, rows
        self.mechanism = made.mechanism

    def step(self, number: int, group: Group) -> Step:
        """The step of a group; one without a kind where no function fits it."""
        shape = dyad_shape(group)
        if len(group.links) == 1 and not group.cuts:
            return self._single(number, group)
        if shape is None or len(group.links) != 2 or group.drivers:
            return Step(number, group, "", group.links, reason=_why(group))
        dyad, ends = shape
        found: Step = getattr(self, f"_{dyad.signature.lower()}")(Step(number, group, dyad.signature, ()), ends)
        return self._with_mode(found)

    # driven links -----------------------------------------------------------------------------
    def _single(self, number: int, group: Group) -> Step:
        (tree,) = group.tree
        link = tree.child
        step = Step(number, group, "bar", (link,))
        if tree.connection.rigid:
            weld = self.mechanism.welds[tree.joint]
            pin = Pin(tree.joint, tree.parent, self.plan.local(tree.parent, weld.at))
            self.plan.axes[link] = Axes(self.plan.local(link, weld.at))
            return replace(step, kind="weld", outer=(pin,), angle=weld.turn_of(link, self.mechanism))
        if tree.turns:
            own = self.mechanism.drivers[tree.driver or ""].link == link
            self.plan.axes[link] = Axes(self.plan.local(link, tree.joint))
            return replace(step, outer=(self._pin(tree.joint, tree.parent),), sign=1.0 if own else -1.0)
        guide = self.mechanism.guides[tree.joint]
        mine = guide.at if guide.block == link else guide.through
        found, offset, slid, lean = self._on_guide(guide, link, self.plan.local(link, mine))
        self.plan.axes[link] = Axes(self.plan.local(link, mine), lean)
        return replace(step, kind="slider", outer=(found,), offsets=(offset,), sign=slid.sign, slides=(slid,))

    # dyads ------------------------------------------------------------------------------------
    def _rrr(self, step: Step, ends: tuple[str, str]) -> Step:
        inner = step.group.cuts[0].joint
        outer, lengths = [], []
        for link in ends:
            tree = self._tree(step.group, link)
            outer.append(self._pin(tree.joint, tree.parent))
            lengths.append(self._bar(link, tree.joint, inner))
        return replace(step, links=ends, outer=tuple(outer), inner=inner, lengths=tuple(lengths))

    def _rrp(self, step: Step, ends: tuple[str, str]) -> Step:
        inner = step.group.cuts[0].joint
        rod, block = ends
        tree, slide = self._tree(step.group, rod), self._tree(step.group, block)
        length = self._bar(rod, tree.joint, inner)
        place = self.plan.local(block, inner)
        found, offset, slid, lean = self._on_guide(self.mechanism.guides[slide.joint], block, place)
        self.plan.axes[block] = Axes(place, lean)
        outer = (self._pin(tree.joint, tree.parent), found)
        return replace(
            step, links=ends, outer=outer, inner=inner, lengths=(length,), offsets=(offset,), slides=(slid,)
        )

    def _rpr(self, step: Step, ends: tuple[str, str]) -> Step:
        joint = self.mechanism.guides[next(tree.joint for tree in step.group.tree if tree.slides)]
        links = (joint.guide, joint.block)
        pins = {tree.child: self._pin(tree.joint, tree.parent) for tree in step.group.tree if tree.turns}
        cut = step.group.cuts[0]
        mine, known = (cut.a, cut.b) if cut.a in links else (cut.b, cut.a)
        pins[mine] = self._pin(cut.joint, known)
        p, q = (self.plan.local(link, pins[link].joint) for link in links)
        guide, block = Axes(p, joint.direction), Axes(q, joint.block_angle)
        self.plan.axes |= {links[0]: guide, links[1]: block}
        ahead = guide.along(self.plan.local(links[0], joint.through))
        behind = -block.along(self.plan.local(links[1], joint.at))
        slid = Slid(joint.name, 1.0, -(ahead.real + behind.real))
        offsets = (ahead.imag + joint.offset, behind.imag)
        outer = tuple(pins[link] for link in links)
        return replace(step, links=links, outer=outer, inner=joint.name, offsets=offsets, slides=(slid,))

    def _prp(self, step: Step, ends: tuple[str, str]) -> Step:
        inner = step.group.cuts[0].joint
        outer, offsets, slides = [], [], []
        for link in ends:
            joint = self.mechanism.guides[self._tree(step.group, link).joint]
            place = self.plan.local(link, inner)
            found, offset, slid, lean = self._on_guide(joint, link, place)
            self.plan.axes[link] = Axes(place, lean)
            outer.append(found)
            offsets.append(offset)
            slides.append(slid)
        return replace(
            step, links=ends, outer=tuple(outer), inner=inner, offsets=tuple(offsets), slides=tuple(slides)
        )

    def _rpp(self, step: Step, ends: tuple[str, str]) -> Step:
        outward, inward = step.group.tree
        first, second = outward.child, inward.child
        inner = self.mechanism.guides[inward.joint]
        carries = inner.guide == first
        place = self.plan.local(first, inner.through if carries else inner.at)
        heading, lean_2 = (inner.direction, inner.block_angle) if carries else (inner.block_angle, inner.direction)
        found, offset, slid, lean = self._on_guide(self.mechanism.guides[outward.joint], first, place)
        cut = step.group.cuts[0]
        pin = self._pin(cut.joint, cut.other(second))
        q = self.plan.local(second, cut.joint)
        self.plan.axes |= {first: Axes(place, lean), second: Axes(q, lean_2)}
        away = -self.plan.axes[second].along(self.plan.local(second, inner.at if carries else inner.through))
        across = away.imag + (inner.offset if carries else -inner.offset)
        sign = 1.0 if carries else -1.0
        slides = (slid, Slid(inner.name, sign, -sign * away.real))
        return replace(
            step,
            links=(first, second),
            outer=(found, pin),
            inner=inner.name,
            offsets=(offset, across),
            angle=heading - lean,
            slides=slides,
        )

    # what they share --------------------------------------------------------------------------
    @staticmethod
    def _tree(group: Group, link: str) -> TreeJoint:
        return next(tree for tree in group.tree if tree.child == link)

    def _pin(self, joint: str, link: str) -> Pin:
        return Pin(joint, link, self.plan.local(link, joint))

    def _bar(self, link: str, pin: str, inner: str) -> float:
        """The length of a link between two pins; its line goes from one to the other."""
        start, end = self.plan.local(link, pin), self.plan.local(link, inner)
        self.plan.axes[link] = Axes(start, cmath.phase(end - start))
        return abs(end - start)

    def _on_guide(self, joint: SlidingJoint, mine: str, place: complex) -> tuple[Guide, float, Slid, float]:
        """A guide on a known link, the offset of a place of my link from it, the file's displacement, and the
        direction of the guide in my link's axes; my link may carry the guide and the known one the block."""
        known = joint.block if joint.guide == mine else joint.guide
        through, at = self.plan.local(joint.guide, joint.through), self.plan.local(joint.block, joint.at)
        if joint.block == mine:
            away = (place - at) * cmath.exp(-1j * joint.block_angle)
            guide = Guide(joint.name, known, through, joint.direction)
            return guide, joint.offset + away.imag, Slid(joint.name, 1.0, -away.real), joint.block_angle
        away = (place - through) * cmath.exp(-1j * joint.direction)
        guide = Guide(joint.name, known, at, joint.block_angle)
        return guide, away.imag - joint.offset, Slid(joint.name, -1.0, away.real), joint.direction

    def _with_mode(self, step: Step) -> Step:
        """The step with the mode that gives the positions of the motion; one without a kind where none does."""
        for mode in MODES.get(step.kind, ("",)):
            tried = replace(step, mode=mode)
            try:
                found = solved(tried, [self._known(outer) for outer in step.outer])
            except LinkwrightError:
                continue
            if self._agrees(tried, found):
                return tried
        reason = (
            _("its assembly mode changes over the cycle, at a change point")
            if step.kind in MODES
            else _("one of the positions is singular")
        )
        return Step(step.number, step.group, "", step.group.links, reason=reason)

    def _known(self, outer: Pin | Guide) -> State | Line:
        """An outer joint as the motion has it."""
        line = line_of(self.motion, outer.link, outer.local, self.rows)
        if isinstance(outer, Pin):
            return line.point(0.0)
        return line.line(0.0, 0.0, outer.angle)

    def _agrees(self, step: Step, found: DyadMotion) -> bool:
        for link, line in zip(step.links, (found.first, found.second), strict=True):
            own = line_of(self.motion, link, self.plan.axes[link].origin, self.rows)
            gap = np.abs(np.subtract(own.point(0.0).position, line.point(0.0).position)).max(initial=0.0)
            turn = np.abs(
                np.exp(1j * (np.asarray(own.angle) + self.plan.axes[link].lean)) - np.exp(1j * np.asarray(line.angle))
            )
            if not (gap <= AGREEING * self.mechanism.size and turn.max(initial=0.0) <= AGREEING):
                return False
        return True


def solved(step: Step, outer: Sequence[State | Line]) -> DyadMotion:
    """The motion of a dyad from the motion of its outer joints, in the order of the step."""
    a, b = outer
    match step.kind:
        case "RRR":
            return rrr(a, b, step.lengths[:2], step.mode)  # type: ignore[arg-type]
        case "RRP":
            return rrp(a, _line(b), step.lengths[0], step.offsets[0], step.mode)
        case "RPR":
            return rpr(a, b, step.offsets[:2], step.mode)  # type: ignore[arg-type]
        case "PRP":
            return prp(_line(a), _line(b), step.offsets[:2])  # type: ignore[arg-type]
    return rpp(b, _line(a), step.angle, step.offsets[:2])  # type: ignore[arg-type]


def _line(value: State | Line) -> Line:
    assert isinstance(value, Line)
    return value


def line_of(motion: Motion, link: str, local: complex, rows: Iterable[int] | Indices) -> Line:
    """The x axis of a link of a solved motion through one of its places, at some positions."""
    chosen = list(rows)
    if link == "frame":
        return Line((local.real, local.imag))
    point = next(iter(motion.mechanism.links[link].points))
    at, turning = motion.point(f"{link}.{point}"), motion.link(link)
    origin = State(at.position[chosen], at.velocity[chosen], at.acceleration[chosen])
    rates = turning.angular_velocity[chosen], turning.angular_acceleration[chosen]
    away = local - complex(*motion.mechanism.links[link].points[point])
    return Line(origin, turning.angle[chosen], *rates).line(away.real, away.imag)


def _why(group: Group) -> str:
    """Why no function fits a group."""
    if any(cut.higher for cut in group.cuts):
        return _("it is closed by a higher pair (gear, belt, rack or cam)")
    if group.drivers:
        return _("its driver acts between two of its own links")
    if len(group.unknowns) > 2:
        return _("it is a group of more than two links")
    return _("its joints are not those of a dyad")
