"""The free designer of OpenLinkage: joints, bars, bodies and dimensions on a drawing whose y points down, mm.

The designer moves joints until lengths fit and stores what comes of it, so lengths count and coordinates tell near
which assembly; the machine begins where the designer begins on loading a project.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from linkwright.importers.foreign import Answers
from linkwright.importers.json_tree import Json
from linkwright.importers.layout import FRAME, Body, Drive, Force, Layout, Slide, free_name
from linkwright.importers.model_text import DEGREE, shortest
from linkwright.importers.rigid import join_rigid
from linkwright.importers.settle import Apart, Constraint, Distance, OnBar, OnLine, Turned, settle
from linkwright.mechanism.link import Vec
from linkwright.units import number
from linkwright.words import Message, _

MM = 1e-3
#: Speed of the phase at which the designer plays a machine, unless its slider is moved: 42°/s, clockwise as seen.
USUAL_SPEED = 42 * DEGREE
#: What lengths may be off in a file without a word, as a share of the machine's size.
FITTING = 1e-9
#: Share of a bar's length by which it is drawn longer or shorter than what a solver leaves.
ASTRAY = 0.01


@dataclass
class Bar:
    """A bar between two joints, m; ``low``, ``high``: lengths of a telescopic one."""

    key: str
    name: str
    a: str
    b: str
    length: float
    telescopic: bool
    json: Json

    @property
    def low(self) -> float:
        """Its minimum length."""
        return max(MM, self.json.number("minLength", 0.7 * self.length / MM) * MM)

    @property
    def high(self) -> float:
        """Its maximum length."""
        return max(self.low, self.json.number("maxLength", 1.3 * self.length / MM) * MM)


@dataclass
class Stroke:
    """The motion of a driven telescopic bar: its length at a phase (rad) is low + (high − low)(½ − ½ cos phase)."""

    name: str
    bar: Bar
    phase: float
    ratio: float = 1.0

    @property
    def half(self) -> float:
        """Half the way, m."""
        return (self.bar.high - self.bar.low) / 2

    @property
    def start(self) -> float:
        """The length at the start, m."""
        return self.bar.low + self.half * (1 - math.cos(self.phase))


class Designer:
    """Reads one project; all coordinates are turned over, so that y points up."""

    def __init__(self, root: Json, answers: Answers) -> None:
        self.root, self.answers = root, answers
        self.layout = Layout()
        self.joints: dict[str, Json] = {}
        self.names: dict[str, str] = {}
        self.places: dict[str, Vec] = {}
        self.bars: dict[str, Bar] = {}
        self.strokes: list[Stroke] = []
        self.gone: dict[str, str] = {}

    def read(self) -> Layout | None:
        """The layout; None where there is nothing to read."""
        self.read_joints()
        self.read_bars()
        self.find_strokes()
        if not self.joints:
            self.root.remark("error", _("the project has no joints"), _("choose another file"), "import.empty")
        if self.root.remarks.failed:
            return None
        self.settle()
        self.make_bodies()
        self.make_guides()
        self.make_dimensions()
        self.gone = join_rigid(self.layout)
        for old, new in self.gone.items():
            message = _("{old} and {new} cannot move against each other and are one link", old=old, new=new)
            self.root.remark("note", message, "", "import.joined")
        self.make_drives()
        self.make_tracers()
        self.make_loads()
        return self.layout

    # -- what the file has

    def read_joints(self) -> None:
        """Joints by their ids; each is a point of the model."""
        for each in self.root.each("joints"):
            key = each.text("id")
            if key in self.joints:
                self.skip(each, _('the joint "{key}" is there twice; the first one is read', key=key))
                continue
            self.joints[key] = each
            self.names[key] = free_name(key, self.names.values(), "J")
            self.places[key] = (each.number("x") * MM, -each.number("y") * MM)
        self.size = max((math.hypot(*each) for each in self.places.values()), default=1.0) or 1.0
        self.layout.precision = 1e-10 * self.size
        self.layout.frame.places |= {self.names[key]: self.places[key] for key in self.joints if self.fixed(key)}

    def fixed(self, key: str) -> bool:
        """Whether a joint is part of the frame."""
        return self.joints[key].flag("fixed")

    def skip(self, json: Json, message: Message) -> None:
        """A warning about something that is left out."""
        json.remark("warning", message, _("mend it in OpenLinkage"), "import.skipped")

    def known(self, json: Json, *keys: str) -> bool:
        """Whether something names joints that exist, and no one twice."""
        missing = [key for key in keys if key not in self.joints]
        if missing or len(set(keys)) < len(keys):
            self.skip(json, _('"{key}" needs joints that are there: left out', key=json.text("id")))
        return not missing and len(set(keys)) == len(keys)

    def read_bars(self) -> None:
        """Bars by their ids."""
        for each in self.root.each("bars"):
            key, a, b = each.text("id"), each.text("a"), each.text("b")
            if self.known(each, a, b) and not (self.fixed(a) and self.fixed(b)):
                name = free_name(key, [bar.name for bar in self.bars.values()], "L")
                length = each.number("length", math.dist(self.places[a], self.places[b]) / MM) * MM
                self.bars[key] = Bar(key, name, a, b, length, each.text("type") == "telescopic", each)

    # -- where the machine begins

    def find_strokes(self) -> None:
        """The telescopic bars that are driven."""
        mode, driver = self.root.text("driverMode"), self.answers.driver or self.root.text("driverId")
        actuators = self.root.each("hydraulicActuators")
        if mode == "length" and driver in self.bars and self.bars[driver].telescopic:
            bar = self.bars[driver]
            ratio = (bar.length - bar.low) / max(bar.high - bar.low, 1e-7)
            self.strokes.append(Stroke("driver", bar, math.acos(1 - 2 * min(1.0, max(0.0, ratio)))))
        for each in actuators if mode == "hydraulic" else ():
            found = self.bars.get(each.text("barId"))
            if found is None or not found.telescopic:
                self.skip(each, _('the actuator "{key}" moves nothing', key=each.text("id")))
                continue
            if not each.flag("enabled", default=True):
                message = _('the actuator "{key}" is switched off', key=each.text("id"))
                each.remark("note", message, _("switch it on in OpenLinkage"), "import.switched_off")
                continue
            phase, ratio = each.number("phaseOffset", 0.0), each.number("cycleRatio", 1.0)
            self.strokes.append(Stroke(each.text("id"), found, phase, ratio))
            if "forceLimit" in each:
                message = _("a limit of the actuator's force ({limit} kN) is not read", limit=each.text("forceLimit"))
                each.remark("note", message, _("compare it with the driver's force"), "import.force_limit")
        for bar in self.bars.values():
            if bar.telescopic and all(bar is not stroke.bar for stroke in self.strokes):
                message = _('nothing drives the telescopic bar "{key}"; it keeps its length', key=bar.key)
                bar.json.remark("note", message, _("drive it in OpenLinkage"), "import.telescopic")

    def pivot(self) -> tuple[Bar, str, str] | None:
        """The bar that turns, its fixed joint and its moving one."""
        bar = self.bars.get(self.answers.driver or self.root.text("driverId"))
        if bar is None or self.root.text("driverMode", "rotation") not in ("rotation", "oscillation"):
            return None
        if self.fixed(bar.a) == self.fixed(bar.b):
            return None
        return (bar, bar.a, bar.b) if self.fixed(bar.a) else (bar, bar.b, bar.a)

    def swing(self, bar: Bar) -> tuple[float, float]:
        """The largest and the smallest angle of an oscillating bar, as the designer counts them (clockwise)."""
        return bar.json.number("maxAngle", math.pi / 3), bar.json.number("minAngle", -math.pi / 3)

    def settle(self) -> None:
        """Puts the joints where all lengths fit, at the phase at which the designer begins."""
        constraints: list[Constraint] = []
        driven = {id(stroke.bar): stroke for stroke in self.strokes}
        for bar in self.bars.values():
            drawn, stroke = math.dist(self.places[bar.a], self.places[bar.b]), driven.get(id(bar))
            if stroke is not None:
                constraints.append(Distance(bar.a, bar.b, stroke.start, drawn))
                continue
            constraints.append(Distance(bar.a, bar.b, bar.length))
            if abs(drawn - bar.length) > ASTRAY * bar.length:
                values = {"drawn": f"{drawn / MM:.6g}", "length": f"{bar.length / MM:.6g}"}
                message = _(
                    '"{key}" is drawn {drawn} mm long; its length of {length} mm is taken', key=bar.key, **values
                )
                remedy = _("solve it in OpenLinkage, and export it again")
                bar.json.remark("warning", message, remedy, "import.length")
        for body in self.root.each("bodies"):
            constraints += [Distance(*pair) for pair in self.pairs(body)]
        constraints += [self.line(key) for key in self.joints if self.slides(key)]
        constraints += [each for json in self.root.each("dimensions") if (each := self.dimension(json)) is not None]
        if found := self.pivot():
            bar, pivot, pin = found
            (x0, y0), (x1, y1) = self.places[pivot], self.places[pin]
            drawn = math.atan2(y1 - y0, x1 - x0)
            angle = -self.swing(bar)[0] if self.root.text("driverMode") == "oscillation" else drawn
            constraints.append(Turned(pivot, pin, bar.length, angle, drawn))
        fixed = [key for key in self.joints if self.fixed(key)]
        settled, wrong = settle(self.places, fixed, constraints)
        if wrong > FITTING * self.size:
            message = _(
                "the lengths do not fit together: {wrong} mm are left at the nearest assembly",
                wrong=f"{wrong / MM:.3g}",
            )
            self.root.remark("warning", message, _("solve it in OpenLinkage, and export it again"), "import.assembly")
        else:
            self.places = settled

    def pairs(self, body: Json) -> list[tuple[str, str, float]]:
        """Distances of a body's joints; from the drawing where the file has too few."""
        joints = [each.word for each in body.each("jointIds") if each.word in self.joints]
        given = [(each.text("a"), each.text("b"), each.number("length") * MM) for each in body.each("pairs")]
        found = [each for each in given if each[0] in joints and each[1] in joints]
        if len(found) < 2 * len(joints) - 3:
            have = {frozenset(each[:2]) for each in found}
            missing = [(a, b) for k, a in enumerate(joints) for b in joints[:k] if frozenset((a, b)) not in have]
            found += [(a, b, math.dist(self.places[a], self.places[b])) for a, b in missing]
        return found

    def slides(self, key: str) -> bool:
        """Whether a joint moves on a guide."""
        return "slider" in self.joints[key] and not self.fixed(key)

    def line(self, key: str) -> OnLine | OnBar:
        """The guide line of a joint."""
        slider = self.joints[key].get("slider")
        assert slider is not None
        bar, angle = self.bars.get(slider.text("referenceBarId")), -slider.number("angle", 0.0)
        if bar is not None:
            return OnBar(key, bar.a, bar.b, angle, -slider.number("offset", 0.0) * MM)
        through = (slider.number("originX") * MM, -slider.number("originY") * MM)
        if "referenceBarId" in slider:
            message = _('the bar "{key}" is not there, or fixed', key=slider.text("referenceBarId"))
            self.skip(slider, _("{what}: the guide is fixed", what=message))
        return OnLine(key, through, angle)

    def dimension(self, json: Json) -> Apart | Distance | None:
        """What a dimension demands."""
        a, b, kind = json.text("a"), json.text("b"), json.text("type")
        if not (a in self.joints and b in self.joints) or (self.fixed(a) and self.fixed(b)):
            return None
        value = json.number("value") * MM
        if kind == "distance":
            return Distance(a, b, value)
        return Apart(a, b, 1, -value) if kind == "horizontal" else Apart(a, b, 0, value)

    # -- links, guides, drivers

    def make_bodies(self) -> None:
        """A link for each bar that keeps its length, and for each body."""
        driven = {id(stroke.bar) for stroke in self.strokes}
        for bar in self.bars.values():
            if id(bar) not in driven:
                self.body(bar.name, bar.a, bar.b, length=bar.length, key=bar.key)
        for each in self.root.each("bodies"):
            joints = [joint.word for joint in each.each("jointIds")]
            if self.known(each, *joints) and joints:
                self.body(free_name(each.text("id"), self.layout.bodies, "B"), *joints, key=each.text("id"))

    def body(self, name: str, *joints: str, length: float | None = None, key: str = "") -> Body:
        """A link of these joints."""
        places = {self.names[joint]: self.places[joint] for joint in joints}
        return self.layout.add(Body(name, places, length=length, key=key))

    def point(self, wanted: str) -> str:
        """A new name of a point."""
        taken = {point for body in self.layout.all for point in body.places}
        return free_name(wanted, taken)

    def block(self, joint: str, key: str = "") -> str:
        """A block of one joint."""
        return self.body(free_name(f"block_{key or self.names[joint]}", self.layout.bodies), joint, key=joint).name

    def fixed_point(self, place: Vec, wanted: str) -> str:
        """A point of the frame at a place: one that is there, or a new one."""
        for name, each in self.layout.frame.places.items():
            if math.dist(each, place) <= FITTING * self.size:
                return name
        name = self.point(wanted)
        self.layout.frame.places[name] = place
        return name

    def slide(self, wanted: str, guide: str, through: str, line: float, block: str, at: str) -> None:
        """A guide."""
        name = free_name(wanted, [*self.names.values(), *(each.name for each in self.layout.slides)])
        self.layout.slides.append(Slide(name, guide, through, line, block, at))

    def make_guides(self) -> None:
        """A block and a guide for each joint that slides."""
        for key in self.joints:
            if not self.slides(key):
                continue
            name, line = self.names[key], self.line(key)
            if isinstance(line, OnLine):
                through = self.fixed_point(line.through, f"G_{name}")
                self.slide(f"guide_{name}", FRAME, through, line.angle, self.block(key), name)
            else:
                self.guide_on_bar(key, line)

    def guide_on_bar(self, key: str, line: OnBar) -> None:
        """A guide that moves with a bar."""
        bar = next(each for each in self.bars.values() if (each.a, each.b) == (line.a, line.b))
        if bar.name not in self.layout.bodies:
            message = _('the guide of "{key}" is on a bar whose length is driven', key=key)
            self.joints[key].remark("error", message, _("put it on a rigid bar in OpenLinkage"), "import.guide")
            return
        name, guide = self.names[key], self.layout.bodies[bar.name]
        (xa, ya), (xb, yb) = self.places[bar.a], self.places[bar.b]
        angle, through = math.atan2(yb - ya, xb - xa), self.names[bar.a]
        if line.offset:
            through = self.point(f"G_{name}")
            guide.places[through] = (xa - line.offset * math.sin(angle), ya + line.offset * math.cos(angle))
        self.slide(f"guide_{name}", guide.name, through, angle + line.angle, self.block(key), name)

    def make_dimensions(self) -> None:
        """Distances become links, equal heights and equal widths guides."""
        for json in self.root.each("dimensions"):
            a, b, key = json.text("a"), json.text("b"), json.text("id")
            wanted = self.dimension(json) if self.known(json, a, b) else None
            if isinstance(wanted, Distance):
                name = free_name(key, self.layout.bodies, "D")
                self.body(name, a, b, length=wanted.length, key=key)
                how = _('a link "{name}" holds it', name=name)
            elif wanted is not None and (self.fixed(a) or self.fixed(b)):
                how = self.level_with_frame(wanted, free_name(key, [], "D"))
            elif wanted is not None:
                how = self.level_on_carriage(wanted, free_name(key, [], "D"))
            else:
                continue
            json.remark("note", _('"{key}" is a dimension; {how}', key=key, how=how), "", "import.dimension")

    def level_with_frame(self, wanted: Apart, key: str) -> Message:
        """A moving joint at a height (or width) that a fixed joint gives: it moves on a fixed guide."""
        moving = wanted.b if self.fixed(wanted.a) else wanted.a
        still, sign = (wanted.a, 1) if moving == wanted.b else (wanted.b, -1)
        x, y = self.places[still]
        shift = sign * wanted.value
        place = (x + shift, y) if wanted.axis == 0 else (x, y + shift)
        angle = math.pi / 2 if wanted.axis == 0 else 0.0
        at, through = self.names[moving], self.fixed_point(place, f"G_{key}")
        self.slide(f"guide_{key}", FRAME, through, angle, self.block(moving, key), at)
        return _('a fixed guide "{name}" holds it', name=f"guide_{key}")

    def level_on_carriage(self, wanted: Apart, key: str) -> Message:
        """Two moving joints at one height: both move on a level carriage, which moves up and down (or likewise)."""
        level, across = (0.0, math.pi / 2) if wanted.axis == 1 else (math.pi / 2, 0.0)
        place, point = self.places[wanted.a], self.point(f"C_{key}")
        carriage = self.layout.add(Body(free_name(f"carriage_{key}", self.layout.bodies), {point: place}, key=key))
        through = self.fixed_point(place, f"G_{key}")
        self.slide(f"guide_{key}", FRAME, through, across, carriage.name, point)
        both = [
            body.name
            for body in self.layout.bodies.values()
            if {self.names[wanted.a], self.names[wanted.b]} <= set(body.places)
        ]
        joints = (wanted.a,) if both else (wanted.a, wanted.b)
        for joint in joints:
            block = both[0] if both else self.block(joint, f"{key}_{self.names[joint]}")
            self.slide(f"guide_{key}_{self.names[joint]}", carriage.name, point, level, block, self.names[joint])
        return _('a carriage "{name}" without mass holds it', name=carriage.name)

    def holder(self, joint: str) -> str | None:
        """A body that has a joint; the frame's first; None: there is none."""
        name = self.names[joint]
        return next((body.name for body in self.layout.all if name in body.places), None)

    # -- what moves it

    @property
    def rate(self) -> float:
        """Speed of the phase, rad/s."""
        return USUAL_SPEED if self.answers.speed is None else abs(self.answers.speed)

    def make_drives(self) -> None:
        """Drivers; a project has no speed, so that one is asked for."""
        found = self.pivot()
        if found is not None:
            self.turning(*found)
        for stroke in self.strokes:
            self.stroking(stroke)
        if not self.layout.drives:
            message = _("the project drives nothing that moves")
            where = self.root.get("driverId") or self.root
            where.remark("warning", message, _("answer with --driver, the id of a bar"), "import.driver")
        elif self.answers.speed is None:
            message = _("a project has no speed; {speed} is taken, as the designer does", speed="42°/s")
            self.root.remark("note", message, _("answer with --speed, in rad/s"), "import.speed")

    def turning(self, bar: Bar, pivot: str, pin: str) -> None:
        """A bar that turns (positive clockwise as seen), or oscillates by a cosine."""
        body = self.gone.get(bar.name, bar.name)
        if body == FRAME:
            message = _('"{key}" cannot turn: it is rigid with the frame', key=bar.key)
            bar.json.remark("error", message, _("mend it in OpenLinkage"), "import.driver")
        drive = Drive(turn=body, about=self.names[pivot], speed=self.answers.speed or -USUAL_SPEED)
        if self.root.text("driverMode") == "oscillation":
            high, low = self.swing(bar)
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
        ends = [(self.holder(each), self.names[each]) for each in (stroke.bar.a, stroke.bar.b)]
        (one, a), (other, b) = ends
        if one is None or other is None:
            message = _('the bar "{key}" ends where nothing is', key=stroke.bar.key)
            stroke.bar.json.remark("error", message, _("add a bar there in OpenLinkage"), "import.driver")
            return
        name = free_name(stroke.name, self.layout.taken(), "A")
        self.layout.drives.append(Drive(name, between=((one, a), (other, b)), added=self.added(stroke)))
        ratios = [Fraction(each.ratio).limit_denominator(24) for each in self.strokes]
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
        tracers = self.root.each("tracers")
        if not tracers and (found := self.root.get("tracerId")) is not None:  # versions 1 and 2
            self.trace(found, found.word)
        for each in tracers:
            if each.text("kind") == "joint":
                self.trace(each, each.text("jointId"))
            else:
                self.beside(each)

    def trace(self, json: Json, joint: str) -> None:
        """Traces a joint."""
        body = self.holder(joint) if joint in self.joints else None
        if body is None:
            self.skip(json, _("the traced joint is not there: left out"))
        elif body != FRAME:
            self.layout.traced.append(f"{body}.{self.names[joint]}")

    def beside(self, json: Json) -> None:
        """Traces a point of a bar or a body, in axes from its first joint towards the second, y to the right."""
        if json.text("kind") == "bar":
            bar = self.bars.get(json.text("barId"))
            joints, wanted = ([], "") if bar is None else ([bar.a, bar.b], bar.name)
        else:
            body = next((each for each in self.root.each("bodies") if each.text("id") == json.text("bodyId")), json)
            joints, wanted = [each.word for each in body.each("jointIds")], body.text("id")
        name = self.gone.get(wanted, wanted)
        if len(joints) < 2 or name not in self.layout.bodies:
            self.skip(json, _("the traced bar or body is not there, or its length is driven: left out"))
            return
        (x0, y0), (x1, y1) = self.places[joints[0]], self.places[joints[1]]
        angle = math.atan2(y1 - y0, x1 - x0)
        cos, sin, x, y = math.cos(angle), math.sin(angle), json.number("localX") * MM, -json.number("localY") * MM
        point = self.point(json.text("id"))
        self.layout.bodies[name].places[point] = (x0 + x * cos - y * sin, y0 + x * sin + y * cos)
        self.layout.traced.append(f"{name}.{point}")

    def make_loads(self) -> None:
        """Forces, which the file has in kN with y down."""
        for each in self.root.each("loads"):
            joint = each.text("jointId")
            body = self.holder(joint) if joint in self.joints else None
            if body is None or body == FRAME:
                self.skip(each, _('the load "{key}" is on nothing that moves: left out', key=each.text("id")))
                continue
            name = free_name(each.text("id"), [force.name for force in self.layout.forces], "F")
            components = (each.number("fx", 0.0) * 1e3, -each.number("fy", 0.0) * 1e3)
            self.layout.forces.append(Force(name, body, self.names[joint], components))


def read_designer(root: Json, answers: Answers) -> Layout | None:
    """The layout of a project of the free designer."""
    return Designer(root, answers).read()
