"""The model of a project of OpenLinkage's free designer: links, guides, dimensions, drivers, traced points, loads."""

from __future__ import annotations

import math
from fractions import Fraction

from linkwright.importers.foreign import Answers
from linkwright.importers.json_tree import Json
from linkwright.importers.layout import FRAME, Body, Drive, Force, Layout, Slide, free_name
from linkwright.importers.model_text import DEGREE, shortest
from linkwright.importers.open_linkage.project import FITTING, MM, USUAL_SPEED, Bar, Project, Stroke
from linkwright.importers.rigid import join_rigid
from linkwright.importers.settle import Apart, Distance, OnBar, OnLine
from linkwright.mechanism.link import Vec
from linkwright.units import number
from linkwright.words import Message, _


def read_designer(root: Json, answers: Answers) -> Layout | None:
    """The layout of a project of the free designer; None where it has no joints, or mistakes."""
    project = Project(root, answers)
    if not project.joints:
        root.remark("error", _("the project has no joints"), _("choose another file"), "import.empty")
    if root.remarks.failed:
        return None
    project.settle()
    return Designer(project).layout


class Designer:
    """Makes the layout of a project."""

    def __init__(self, project: Project) -> None:
        self.project = project
        self.layout = Layout(precision=1e-10 * project.size)
        fixed = [key for key in project.joints if project.fixed(key)]
        self.layout.frame.places |= {project.names[key]: project.places[key] for key in fixed}
        #: Links of the bodies, by the ids that these have in the file.
        self.plates: dict[str, str] = {}
        self.make_bodies()
        self.make_guides()
        self.make_dimensions()
        self.gone = join_rigid(self.layout, project.root.remarks)
        self.make_drives()
        self.make_tracers()
        self.make_loads()

    # -- links, guides, drivers

    def make_bodies(self) -> None:
        """A link for each bar that keeps its length, and for each body."""
        driven = {id(stroke.bar) for stroke in self.project.strokes}
        for bar in self.project.bars.values():
            if id(bar) not in driven:
                self.body(bar.name, bar.a, bar.b, length=bar.length, key=bar.key)
        for each in self.project.root.each("bodies"):
            joints = [joint.word for joint in each.each("jointIds")]
            if self.project.known(each, *joints) and joints:
                name = free_name(each.text("id"), self.layout.bodies, "B")
                self.plates[each.text("id")] = self.body(name, *joints, key=each.text("id")).name

    def body(self, name: str, *joints: str, length: float | None = None, key: str = "") -> Body:
        """A link of these joints."""
        places = {self.project.names[joint]: self.project.places[joint] for joint in joints}
        return self.layout.add(Body(name, places, length=length, key=key))

    def point(self, wanted: str) -> str:
        """A new name of a point."""
        taken = {point for body in self.layout.all for point in body.places}
        return free_name(wanted, taken)

    def block(self, joint: str, key: str = "") -> str:
        """A block of one joint."""
        return self.body(
            free_name(f"block_{key or self.project.names[joint]}", self.layout.bodies), joint, key=joint
        ).name

    def fixed_point(self, place: Vec, wanted: str) -> str:
        """A point of the frame at a place: one that is there, or a new one."""
        for name, each in self.layout.frame.places.items():
            if math.dist(each, place) <= FITTING * self.project.size:
                return name
        name = self.point(wanted)
        self.layout.frame.places[name] = place
        return name

    def slide(self, wanted: str, guide: str, through: str, line: float, block: str, at: str) -> None:
        """A guide."""
        name = free_name(wanted, [*self.project.names.values(), *(each.name for each in self.layout.slides)])
        self.layout.slides.append(Slide(name, guide, through, line, block, at))

    def make_guides(self) -> None:
        """A block and a guide for each joint that slides."""
        for key in self.project.joints:
            if not self.project.slides(key):
                continue
            name, line = self.project.names[key], self.project.line(key)
            if isinstance(line, OnLine):
                through = self.fixed_point(line.through, f"G_{name}")
                self.slide(f"guide_{name}", FRAME, through, line.angle, self.block(key), name)
            else:
                self.guide_on_bar(key, line)

    def guide_on_bar(self, key: str, line: OnBar) -> None:
        """A guide that moves with a bar."""
        bar = next(each for each in self.project.bars.values() if (each.a, each.b) == (line.a, line.b))
        if bar.name not in self.layout.bodies:
            message = _('the guide of "{key}" is on a bar whose length is driven', key=key)
            self.project.joints[key].remark(
                "error", message, _("put it on a rigid bar in OpenLinkage"), "import.guide"
            )
            return
        name, guide = self.project.names[key], self.layout.bodies[bar.name]
        (xa, ya), (xb, yb) = self.project.places[bar.a], self.project.places[bar.b]
        angle, through = math.atan2(yb - ya, xb - xa), self.project.names[bar.a]
        if line.offset:
            through = self.point(f"G_{name}")
            guide.places[through] = (xa - line.offset * math.sin(angle), ya + line.offset * math.cos(angle))
        self.slide(f"guide_{name}", guide.name, through, angle + line.angle, self.block(key), name)

    def make_dimensions(self) -> None:
        """Distances become links, equal heights and equal widths guides."""
        for json in self.project.root.each("dimensions"):
            a, b, key = json.text("a"), json.text("b"), json.text("id")
            wanted = self.project.dimension(json) if self.project.known(json, a, b) else None
            if isinstance(wanted, Distance):
                name = free_name(key, self.layout.bodies, "D")
                self.body(name, a, b, length=wanted.length, key=key)
                how = _('a link "{name}" holds it', name=name)
            elif wanted is not None and (self.project.fixed(a) or self.project.fixed(b)):
                how = self.level_with_frame(wanted, free_name(key, [], "D"))
            elif wanted is not None:
                how = self.level_on_carriage(wanted, free_name(key, [], "D"))
            else:
                continue
            json.remark("note", _('"{key}" is a dimension; {how}', key=key, how=how), "", "import.dimension")

    def level_with_frame(self, wanted: Apart, key: str) -> Message:
        """A moving joint at a height (or width) that a fixed joint gives: it moves on a fixed guide."""
        moving = wanted.b if self.project.fixed(wanted.a) else wanted.a
        still, sign = (wanted.a, 1) if moving == wanted.b else (wanted.b, -1)
        x, y = self.project.places[still]
        shift = sign * wanted.value
        place = (x + shift, y) if wanted.axis == 0 else (x, y + shift)
        angle = math.pi / 2 if wanted.axis == 0 else 0.0
        at, through = self.project.names[moving], self.fixed_point(place, f"G_{key}")
        self.slide(f"guide_{key}", FRAME, through, angle, self.block(moving, key), at)
        return _('a fixed guide "{name}" holds it', name=f"guide_{key}")

    def level_on_carriage(self, wanted: Apart, key: str) -> Message:
        """Two moving joints at one height: both move on a level carriage, which moves up and down (or likewise)."""
        level, across = (0.0, math.pi / 2) if wanted.axis == 1 else (math.pi / 2, 0.0)
        place, point = self.project.places[wanted.a], self.point(f"C_{key}")
        carriage = self.layout.add(Body(free_name(f"carriage_{key}", self.layout.bodies), {point: place}, key=key))
        through = self.fixed_point(place, f"G_{key}")
        self.slide(f"guide_{key}", FRAME, through, across, carriage.name, point)
        both = [
            body.name
            for body in self.layout.bodies.values()
            if {self.project.names[wanted.a], self.project.names[wanted.b]} <= set(body.places)
        ]
        joints = (wanted.a,) if both else (wanted.a, wanted.b)
        for joint in joints:
            block = both[0] if both else self.block(joint, f"{key}_{self.project.names[joint]}")
            self.slide(
                f"guide_{key}_{self.project.names[joint]}",
                carriage.name,
                point,
                level,
                block,
                self.project.names[joint],
            )
        return _('a carriage "{name}" without mass holds it', name=carriage.name)

    def holder(self, joint: str) -> str | None:
        """A body that has a joint; the frame's first; None: there is none."""
        name = self.project.names[joint]
        return next((body.name for body in self.layout.all if name in body.places), None)

    # -- what moves it

    @property
    def rate(self) -> float:
        """Speed of the phase, rad/s."""
        return USUAL_SPEED if self.project.answers.speed is None else abs(self.project.answers.speed)

    def make_drives(self) -> None:
        """Drivers; a project has no speed, so that one is asked for."""
        found = self.project.pivot()
        if found is not None:
            self.turning(*found)
        for stroke in self.project.strokes:
            self.stroking(stroke)
        if not self.layout.drives:
            message = _("the project drives nothing that moves")
            where = self.project.root.get("driverId") or self.project.root
            where.remark("warning", message, _("answer with --driver, the id of a bar"), "import.driver")
        elif self.project.answers.speed is None:
            message = _("a project has no speed; {speed} is taken, as the designer does", speed="42°/s")
            self.project.root.remark("note", message, _("answer with --speed, in rad/s"), "import.speed")

    def turning(self, bar: Bar, pivot: str, pin: str) -> None:
        """A bar that turns (positive clockwise as seen), or oscillates by a cosine."""
        body = self.gone.get(bar.name, bar.name)
        if body == FRAME:
            message = _('"{key}" cannot turn: it is rigid with the frame', key=bar.key)
            bar.json.remark("error", message, _("mend it in OpenLinkage"), "import.driver")
        drive = Drive(turn=body, about=self.project.names[pivot], speed=self.project.answers.speed or -USUAL_SPEED)
        if self.project.root.text("driverMode") == "oscillation":
            high, low = self.project.swing(bar)
            half = shortest((high - low) / 2 / DEGREE, 1e-12)
            drive.speed, drive.added = None, f"{half} deg*(1 - cos({self.turns(1.0)}))"
            self.layout.cycle = {"duration": self.duration([Fraction(1)])}
        self.layout.drives.append(drive)

    def turns(self, ratio: float) -> str:
        """The phase as an expression of the time."""
        return f"{shortest(self.rate * ratio / DEGREE, 1e-12)} deg*t/(1 s)"

    def duration(self, ratios: list[Fraction]) -> str:
        """Time after which all phases are whole turns."""
        common = math.lcm(*(each.denominator for each in ratios))
        return f"{number(2 * math.pi * common / self.rate)} s"

    def stroking(self, stroke: Stroke) -> None:
        """A bar whose length goes to and fro."""
        ends = [(self.holder(each), self.project.names[each]) for each in (stroke.bar.a, stroke.bar.b)]
        (one, a), (other, b) = ends
        if one is None or other is None:
            message = _('the bar "{key}" ends where nothing is', key=stroke.bar.key)
            stroke.bar.json.remark("error", message, _("add a bar there in OpenLinkage"), "import.driver")
            return
        name = free_name(stroke.name, self.layout.taken(), "A")
        self.layout.drives.append(Drive(name, between=((one, a), (other, b)), added=self.added(stroke)))
        ratios = [Fraction(each.ratio).limit_denominator(24) for each in self.project.strokes]
        self.layout.cycle = {"duration": self.duration(ratios)}

    def added(self, stroke: Stroke) -> str:
        """What a stroke adds to its length at the start, as an expression of the time."""
        phase, half = math.remainder(stroke.phase, 2 * math.pi), f"{shortest(stroke.half / MM, 1e-12)} mm"
        turns = self.turns(stroke.ratio)
        if abs(math.cos(phase)) < 1e-12:
            return f"{'-' if phase < 0 else ''}{half}*sin({turns})"
        shift = f" {'-' if phase < 0 else '+'} {shortest(abs(phase) / DEGREE, 1e-12)} deg" if phase else ""
        return f"{half}*({shortest(math.cos(phase), 1e-13)} - cos({turns}{shift}))"

    def make_tracers(self) -> None:
        """Points whose paths are drawn, some of them beside joints."""
        tracers = self.project.root.each("tracers")
        if not tracers and (found := self.project.root.get("tracerId")) is not None:  # versions 1 and 2
            self.trace(found, found.word)
        for each in tracers:
            if each.text("kind") == "joint":
                self.trace(each, each.text("jointId"))
            else:
                self.beside(each)

    def trace(self, json: Json, joint: str) -> None:
        """Traces a joint."""
        body = self.holder(joint) if joint in self.project.joints else None
        if body is None:
            self.project.skip(json, _("the traced joint is not there: left out"))
        elif body != FRAME:
            self.layout.traced.append(f"{body}.{self.project.names[joint]}")

    def beside(self, json: Json) -> None:
        """Traces a point of a bar or a body, in axes from its first joint towards the second, y to the right."""
        if json.text("kind") == "bar":
            bar = self.project.bars.get(json.text("barId"))
            joints, wanted = ([], "") if bar is None else ([bar.a, bar.b], bar.name)
        else:
            body = next(
                (each for each in self.project.root.each("bodies") if each.text("id") == json.text("bodyId")), json
            )
            joints = [each.word for each in body.each("jointIds")]
            wanted = self.plates.get(body.text("id"), "")
        name = self.gone.get(wanted, wanted)
        if len(joints) < 2 or name not in self.layout.bodies:
            self.project.skip(json, _("the traced bar or body is not there, or its length is driven: left out"))
            return
        (x0, y0), (x1, y1) = self.project.places[joints[0]], self.project.places[joints[1]]
        angle = math.atan2(y1 - y0, x1 - x0)
        cos, sin, x, y = math.cos(angle), math.sin(angle), json.number("localX") * MM, -json.number("localY") * MM
        point = self.point(json.text("id"))
        self.layout.bodies[name].places[point] = (x0 + x * cos - y * sin, y0 + x * sin + y * cos)
        self.layout.traced.append(f"{name}.{point}")

    def make_loads(self) -> None:
        """Forces, which the file has in kN with y down."""
        for each in self.project.root.each("loads"):
            joint = each.text("jointId")
            body = self.holder(joint) if joint in self.project.joints else None
            if body is None or body == FRAME:
                self.project.skip(each, _('the load "{key}" is on nothing that moves: left out', key=each.text("id")))
                continue
            name = free_name(each.text("id"), [force.name for force in self.layout.forces], "F")
            components = (each.number("fx", 0.0) * 1e3, -each.number("fy", 0.0) * 1e3)
            self.layout.forces.append(Force(name, body, self.project.names[joint], components))
