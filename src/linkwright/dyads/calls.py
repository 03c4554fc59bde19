"""The calls of the teaching texts' subprograms (bark, rrrk, … barf, rrrf, …) that solve a machine.

Points and links get numbers as in those texts: t(k) is the direction of the line of link k. What the subprograms take
for granted, that an inner pin moves on the guide's line itself, is arranged by auxiliary points next to the guides.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from itertools import zip_longest

from linkwright.dyads.plan import Guide, Pin, Plan, Step
from linkwright.dyads.script import ZERO
from linkwright.kinematics.names import canonical
from linkwright.mechanism.link import centre
from linkwright.words import _

_MOTION = ("t", "w", "e", "p", "vp", "ap")
_FORCES = ("p", "vp", "ap", "t", "w", "e", "fr")
#: Formal arguments, as the texts print them.
FORMAL = {
    "bark": ("n1", "n2", "n3", "k", "r1", "r2", "gam", *_MOTION),
    "rrrk": ("m", "n1", "n2", "n3", "k1", "k2", "r1", "r2", *_MOTION),
    "rrpk": ("m", "n1", "n2", "n3", "k1", "k2", "k3", "r1", "r2", "vr2", "ar2", *_MOTION),
    "rprk": ("m", "n1", "n2", "k1", "k2", "r1", "r2", "vr2", "ar2", *_MOTION),
    "prpk": ("n1", "n2", "n3", "k1", "k2", "k3", "k4", "r1", "vr1", "ar1", "r2", "vr2", "ar2", *_MOTION),
    "rppk": (
        "n1",
        "n2",
        "n3",
        "n4",
        "k1",
        "k2",
        "k3",
        "r1",
        "gam1",
        "gam2",
        "r2",
        "vr2",
        "ar2",
        "r3",
        "vr3",
        "ar3",
        *_MOTION,
    ),
    "barf": ("n1", "ns1", "nn1", "k1", "p", "ap", "e", "fr", "tb"),
    "rrrf": ("n1", "n2", "n3", "ns1", "ns2", "nn1", "nn2", "nexf", "k1", "k2", *_FORCES),
    "rrpf": ("n1", "n2", "n3", "ns1", "ns2", "nn1", "nn2", "nexf", "k1", "k2", *_FORCES),
    "rprf": ("n1", "n2", "ns1", "ns2", "nn1", "nn2", "nexf", "k1", "k2", *_FORCES, "fk", "pk"),
    "prpf": ("n1", "n2", "n3", "ns1", "ns2", "nn1", "nn2", "nexf", "k1", "k2", "k3", "k4", *_FORCES, "fk", "pk"),
    "rppf": ("n1", "n2", "n3", "n4", "ns1", "ns2", "nn1", "nn2", "nexf", "k1", "k2", "k3", *_FORCES, "fk", "pk"),
}


@dataclass(frozen=True)
class Call:
    """One call: the subprogram, the step that it belongs to (None: a further point), the links, actual arguments."""

    name: str
    step: Step | None
    links: tuple[str, ...]
    actual: tuple[str, ...]

    @property
    def formal(self) -> tuple[str, ...]:
        """The formal arguments."""
        return FORMAL[self.name]

    @property
    def text(self) -> str:
        """The call as a line of a program."""
        return f"{self.name}({', '.join(self.actual)})"


@dataclass(frozen=True)
class NumberedPoint:
    """A point: its number, its name, the links that carry it, its place where it is fixed, m."""

    number: int
    name: str
    links: tuple[str, ...]
    place: complex | None


@dataclass(frozen=True)
class NumberedLink:
    """A link, or a guide that needs a direction of its own: its number and name, and what t(k) is.

    ``line``: the direction from a point to another, by their numbers; ``along``: that of this guide; else ``angle``
    (rad) from the direction of the link ``against`` (0: the frame).
    """

    number: int
    name: str
    line: tuple[int, int] | None = None
    along: str = ""
    against: int = 0
    angle: float = 0.0


@dataclass
class Calls:
    """Numbers and calls of a machine; ``others``: the steps that have no subprogram; ``notes``: what else to say."""

    points: list[NumberedPoint] = field(default_factory=list)
    links: list[NumberedLink] = field(default_factory=list)
    motion: list[Call] = field(default_factory=list)
    forces: list[Call] = field(default_factory=list)
    others: list[Step] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)


def calls(plan: Plan, numbers: Mapping[str, int], *, forces: bool) -> Calls:
    """The calls for a plan; ``numbers``: of the moving links; ``forces``: whether there is anything to carry."""
    return _Caller(plan, numbers, forces).made()


class _Caller:
    """Numbers points and writes calls, step by step."""

    def __init__(self, plan: Plan, numbers: Mapping[str, int], forces: bool) -> None:
        self.plan, self.mechanism, self.numbers, self.with_forces = plan, plan.mechanism, numbers, forces
        self.found = Calls()
        self.axes = dict(plan.axes)
        self.at: dict[str, int] = {}
        #: Points whose motion is known.
        self.solved: set[int] = set()
        self.guides: dict[str, int] = {}
        self.centres: dict[str, int] = {}
        #: Points of a link at which later groups or loads act.
        self.loaded: dict[str, list[int]] = {}

    def made(self) -> Calls:
        """Everything, in solving order and then from the last group to the first."""
        for step in self.plan.steps:
            self._links(step)
        for step in self.plan.steps:
            if step.kind in ("", "weld", "slider"):
                self.found.others.append(step)
                for link in step.links:
                    self._others(step, link)
                continue
            self._motion(step)
        if self.with_forces:
            self._loads()
            for step in reversed(self.plan.steps):
                if step.kind not in ("", "weld", "slider"):
                    self._forces(step)
        return self.found

    # numbers ----------------------------------------------------------------------------------
    def _point(self, link: str, point: str) -> int:
        """The number of a point of a link; a new one where it has none."""
        key = canonical(self.mechanism, link, point)
        links = self.mechanism.pin_links(point) or (link,)
        fixed = link == "frame" or "frame" in links
        return self._numbered(key, key, links, self.plan.local("frame", point) if fixed else None)

    def _numbered(self, key: str, name: str, links: tuple[str, ...], place: complex | None = None) -> int:
        if key not in self.at:
            self.at[key] = len(self.at) + 1
            self.found.points.append(NumberedPoint(self.at[key], name, links, place))
            if place is not None:
                self.solved.add(self.at[key])
        return self.at[key]

    def _links(self, step: Step) -> None:
        for link in step.group.links:
            self.found.links.append(NumberedLink(self.numbers[link], link))

    def _guide(self, guide: Guide) -> int:
        """The number of a guide's direction: that of its link where it is the link's own line, else a further one."""
        lean = guide.angle - self.axes[guide.link].lean
        if guide.link != "frame" and abs(math.remainder(lean, 2 * math.pi)) < ZERO:
            return self.numbers[guide.link]
        if guide.joint not in self.guides:
            number = len(self.found.links) + 1
            self.guides[guide.joint] = number
            against = 0 if guide.link == "frame" else self.numbers[guide.link]
            self.found.links.append(NumberedLink(number, guide.joint, against=against, angle=lean))
        return self.guides[guide.joint]

    def _reference(self, guide: Guide, offset: float) -> int:
        """The point from which the slide on a guide counts; off the guide where the inner pin's path is."""
        link, axes = guide.link, self.axes[guide.link]
        place = guide.local + offset * 1j * cmath.exp(1j * guide.angle)
        named = self._named(link, place)
        if named is not None:
            return self._point(link, named)
        key = f"{guide.joint}:{link}"
        if key in self.at:
            return self.at[key]
        name = _("off guide {guide}", guide=guide.joint) if offset else _("on guide {guide}", guide=guide.joint)
        number = self._numbered(key, name, (link,), place if link == "frame" else None)
        if link != "frame":
            self._bark(link, [(number, axes.along(place))])
        return number

    def _named(self, link: str, place: complex) -> str | None:
        """A named point of a link at a place."""
        size = self.mechanism.size
        points = self.mechanism.link(link).points.items()
        return next((name for name, (x, y) in points if abs(complex(x, y) - place) < 1e-12 * size), None)

    # motion -----------------------------------------------------------------------------------
    def _base(self, step: Step, i: int) -> int:
        """The number of the point at which the line of a link begins."""
        link, outer = step.links[i], step.outer[i]
        if isinstance(outer, Pin):
            return self._point(link, outer.joint)
        if step.kind in ("RRP", "PRP"):
            return self._point(link, step.inner)
        return self._start(link)

    def _at(self, link: str, place: complex) -> int:
        named = self._named(link, place)
        if named is not None:
            return self._point(link, named)
        return self._numbered(f"{link}:{place:.9g}", _("point of {link}", link=link), (link,))

    def _motion(self, step: Step) -> None:
        made = getattr(self, f"_{step.kind.lower()}")(step)
        if made:
            self._add(self.found.motion, f"{step.kind.lower()}k", step, step.links, made)
            self.solved |= {int(made[name]) for name in ("n3", "n4") if name in made}
        for i, link in enumerate(step.links):
            self._line(step, i)
            self._further(link, self._base(step, i))

    def _add(
        self, into: list[Call], name: str, step: Step | None, links: tuple[str, ...], arguments: dict[str, str]
    ) -> None:
        actual = tuple(arguments.get(formal, formal) for formal in FORMAL[name])
        into.append(Call(name, step, links, actual))

    def _bar(self, step: Step) -> dict[str, str]:
        self._point(step.links[0], step.outer[0].joint)
        return {}

    def _rrr(self, step: Step) -> dict[str, str]:
        n1, n2 = (self._point(link, outer.joint) for link, outer in zip(step.links, step.outer, strict=True))
        n3 = self._point(step.links[0], step.inner)
        r1, r2 = step.lengths
        return self._bound(step, n1=n1, n2=n2, n3=n3, r1=length(r1), r2=length(r2), m=_sign(step.mode == "left"))

    def _rrp(self, step: Step) -> dict[str, str]:
        n1, guide = self._point(step.links[0], step.outer[0].joint), step.guides[0]
        n2, k3 = self._reference(guide, step.offsets[0]), self._guide(guide)
        n3 = self._point(step.links[0], step.inner)
        sign = _sign(step.mode == "forward")
        return self._bound(step, m=sign, n1=n1, n2=n2, n3=n3, k3=k3, r1=length(step.lengths[0]))

    def _rpr(self, step: Step) -> dict[str, str]:
        n1, n2 = (self._point(link, outer.joint) for link, outer in zip(step.links, step.outer, strict=True))
        across = sum(step.offsets)
        if step.mode == "backward":
            across = -across
            for link in step.links:
                self.axes[link] = replace(self.axes[link], lean=self.axes[link].lean + math.pi)
            self.found.notes.append(
                _(
                    "t(k) of {links} points against the file's guide, since the subprogram counts the slide positive",
                    links=", ".join(step.links),
                )
            )
        return self._bound(step, m=_sign(across <= ZERO), n1=n1, n2=n2, r1=length(abs(across)))

    def _prp(self, step: Step) -> dict[str, str]:
        n1, n2 = (self._reference(guide, h) for guide, h in zip(step.guides, step.offsets, strict=True))
        k3, k4 = (self._guide(guide) for guide in step.guides)
        return self._bound(step, n1=n1, n2=n2, n3=self._point(step.links[0], step.inner), k3=k3, k4=k4)

    def _rpp(self, step: Step) -> dict[str, str]:
        """Link 1 of the text is the one on the pin, link 2 the one on the outer guide."""
        block, arm = step.links
        guide, across = step.guides[0], step.offsets[1]
        n1, n2, k3 = (
            self._point(arm, step.pins[0].joint),
            self._reference(guide, step.offsets[0]),
            self._guide(guide),
        )
        n4 = self._start(block)
        n3 = (
            n1
            if abs(across) < ZERO
            else self._numbered(f"foot:{arm}", _("foot of {link} on its guide", link=arm), (arm,))
        )
        turn = math.pi if abs(across) < ZERO else math.pi - math.copysign(0.5 * math.pi, across)
        self.axes[block] = replace(self.axes[block], lean=self.axes[block].lean + step.angle)
        self.axes[arm] = replace(self.axes[arm], lean=self.axes[arm].lean + turn - math.pi)
        return {
            "n1": str(n1),
            "n2": str(n2),
            "n3": str(n3),
            "n4": str(n4),
            "k1": str(self.numbers[arm]),
            "k2": str(self.numbers[block]),
            "k3": str(k3),
            "r1": length(abs(across)),
            "gam1": angle(turn),
            "gam2": angle(step.angle),
        }

    def _bound(self, step: Step, **values: object) -> dict[str, str]:
        links = {f"k{i}": str(self.numbers[link]) for i, link in enumerate(step.links, 1)}
        return links | {name: str(value) for name, value in values.items()}

    def _line(self, step: Step, i: int) -> None:
        """Notes what the direction of a link is: from point to point, or that of a guide."""
        link = step.links[i]
        at = next(n for n, each in enumerate(self.found.links) if each.name == link)
        own, base = self.found.links[at], self._base(step, i)
        line, along = None, ""
        if step.kind == "bar":
            ahead = self._ahead(link)
            line, along = ((base, ahead), "") if ahead else (None, "")
        elif step.kind in ("RRR", "RRP") and isinstance(step.outer[i], Pin):
            line = base, self._point(link, step.inner)
        elif step.kind == "RPP" and i == 1 and abs(step.offsets[1]) > ZERO:
            line = base, self.at[f"foot:{link}"]
        else:
            along = step.inner if step.kind in ("RPR", "RPP") else step.outer[i].joint
        self.found.links[at] = replace(own, line=line, along=along)

    def _ahead(self, link: str) -> int:
        """A point of a link that lies ahead on its line; 0 where it has none."""
        axes = self.axes[link]
        for name in self.mechanism.links[link].points:
            place = axes.along(self.plan.local(link, name))
            if place.real > ZERO and abs(place.imag) < ZERO:
                return self._point(link, name)
        return 0

    def _others(self, step: Step, link: str) -> None:
        """Pins of a link that has no subprogram: others may need them, and they are known."""
        for joint in step.group.joints:
            if joint.turns and link in (joint.a, joint.b):
                self.solved.add(self._point(link, joint.joint))

    def _further(self, link: str, base: int) -> None:
        """Further points of a link, and its mass centre."""
        part, axes = self.mechanism.links[link], self.axes[link]
        wanted = [(self._point(link, name), axes.along(self.plan.local(link, name))) for name in part.points]
        if self.with_forces and part.mass:
            place = complex(*centre(part, part.points, self.mechanism.dimension))
            named = self._named(link, place)
            if named is None:
                self.centres[link] = self._numbered(f"{link}:centre", _("mass centre of {link}", link=link), (link,))
            else:
                self.centres[link] = self._point(link, named)
            wanted.append((self.centres[link], axes.along(place)))
        self._bark(link, [each for each in dict(wanted).items() if each[0] not in self.solved], base)

    def _bark(self, link: str, points: list[tuple[int, complex]], base: int | None = None) -> None:
        """Calls of bark for points of a link: one on its line and one off it each."""
        points = [each for each in points if abs(each[1]) > ZERO]
        self.solved |= {each[0] for each in points}
        ahead = [each for each in points if abs(each[1].imag) < ZERO and each[1].real > 0]
        off_line = [each for each in points if each not in ahead]
        for one, two in zip_longest(ahead, off_line):
            values = {"n1": self._start(link) if base is None else base, "k": self.numbers[link]}
            values |= {"n2": one[0] if one else 0, "n3": two[0] if two else 0}
            texts = {name: str(value) for name, value in values.items()}
            texts["r1"] = length(one[1].real) if one else "0"
            texts |= (
                {"r2": length(abs(two[1])), "gam": angle(cmath.phase(two[1]))} if two else {"r2": "0", "gam": "0"}
            )
            self._add(self.found.motion, "bark", None, (link,), texts)

    def _start(self, link: str) -> int:
        """The number of the point at which the line of a solved link begins."""
        return self._at(link, self.axes[link].origin)

    # forces -----------------------------------------------------------------------------------
    def _loads(self) -> None:
        """Points at which loads of the model act."""
        for load in self.mechanism.loads.values():
            at = load.named_points[0] if load.acts_on and load.named_points else None
            if at is not None and at.link in self.mechanism.links:
                self.loaded.setdefault(at.link, []).append(-self._point(at.link, at.point))
            else:
                self.found.notes.append(
                    _(
                        "the load {load} is not a force at a point of a link; add it in the subprogram of "
                        "external forces",
                        load=load.name,
                    )
                )

    def _forces(self, step: Step) -> None:
        values = {f"k{i}": str(self.numbers[link]) for i, link in enumerate(step.links, 1)}
        acting = [self._acting(link) for link in step.links]
        values |= {f"ns{i}": str(self.centres.get(link, 0)) for i, link in enumerate(step.links, 1)}
        values |= {f"nn{i}": str(abs(each)) for i, each in enumerate(acting, 1)}
        values["nexf"] = str(next((-each for each in acting if each < 0), 0))
        for name, value in self._places(step).items():
            values[name] = str(value)
        if step.kind == "RPP":
            for one, two in (("k1", "k2"), ("ns1", "ns2"), ("nn1", "nn2")):
                values[one], values[two] = values[two], values[one]
        self._add(self.found.forces, f"{step.kind.lower()}f", step, step.links, values)
        for i, outer in enumerate(step.outer):
            if outer.link != "frame":
                place = self._point(outer.link, outer.joint) if isinstance(outer, Pin) else self._base(step, i)
                self.loaded.setdefault(outer.link, []).append(place)

    def _places(self, step: Step) -> dict[str, int]:
        """The points of a group, as its kinematic subprogram has them."""
        if step.kind == "bar":
            return {"n1": self._base(step, 0)}
        own = next(call for call in self.found.motion if call.step == step)
        names = zip(own.formal, own.actual, strict=True)
        return {name: int(value) for name, value in names if name[0] == "n" or name in ("k3", "k4")}

    def _acting(self, link: str) -> int:
        """The point at which a further force acts on a link, negative for a load of the model; 0 for none."""
        found = list(dict.fromkeys(self.loaded.get(link, [])))
        if len(found) > 1:
            points = ", ".join(str(abs(each)) for each in found)
            self.found.notes.append(
                _(
                    "several forces act on {link} (points {points}); the subprogram takes one, so add "
                    "the others up there",
                    link=link,
                    points=points,
                )
            )
        return found[0] if found else 0


def length(value: float) -> str:
    """A length in m, to six digits."""
    return f"{value:.6g}" if abs(value) > ZERO else "0"


def angle(value: float) -> str:
    """An angle in rad, to six digits."""
    return f"{value:.6g}" if abs(value) > ZERO else "0"


def _sign(positive: bool) -> str:
    return "1" if positive else "-1"
