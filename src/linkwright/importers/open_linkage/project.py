"""The free designer of OpenLinkage: joints, bars, bodies and dimensions on a drawing whose y points down, mm.

The designer moves joints until lengths fit and stores what comes of it, so lengths count and coordinates tell near
which assembly; the machine begins where the designer begins on loading a project.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from linkwright.importers.foreign import Answers
from linkwright.importers.json_tree import Json
from linkwright.importers.layout import free_name
from linkwright.importers.model_text import DEGREE
from linkwright.importers.settle import Apart, Constraint, Distance, OnBar, OnLine, Turned, settle
from linkwright.mechanism.link import Vec
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


class Project:
    """What one project has; all coordinates are turned over, so that y points up."""

    def __init__(self, root: Json, answers: Answers) -> None:
        self.root, self.answers = root, answers
        self.joints: dict[str, Json] = {}
        self.names: dict[str, str] = {}
        self.places: dict[str, Vec] = {}
        self.bars: dict[str, Bar] = {}
        self.still: dict[str, tuple[str, str]] = {}
        self.strokes: list[Stroke] = []
        self.read_joints()
        self.read_bars()
        self.lost_guides()
        self.find_strokes()

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
            if not self.known(each, a, b):
                continue
            if self.fixed(a) and self.fixed(b):
                self.still[key] = (a, b)
            else:
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
        wanted, angle = slider.text("referenceBarId"), -slider.number("angle", 0.0)
        offset = -slider.number("offset", 0.0) * MM
        if wanted in self.bars:
            return OnBar(key, self.bars[wanted].a, self.bars[wanted].b, angle, offset)
        if wanted in self.still:  # its line, which does not move
            (xa, ya), (xb, yb) = (self.places[each] for each in self.still[wanted])
            bar = math.atan2(yb - ya, xb - xa)
            return OnLine(key, (xa - offset * math.sin(bar), ya + offset * math.cos(bar)), bar + angle)
        return OnLine(key, (slider.number("originX") * MM, -slider.number("originY") * MM), angle)

    def lost_guides(self) -> None:
        """Warnings about guides on bars that are not there: their lines are fixed where the file has them."""
        for joint in self.joints.values():
            wanted = "" if (slider := joint.get("slider")) is None else slider.text("referenceBarId")
            if wanted and wanted not in self.bars and wanted not in self.still:
                self.skip(joint, _('the bar "{key}" is not there: the guide is fixed', key=wanted))

    def dimension(self, json: Json) -> Apart | Distance | None:
        """What a dimension demands."""
        a, b, kind = json.text("a"), json.text("b"), json.text("type")
        if not (a in self.joints and b in self.joints) or (self.fixed(a) and self.fixed(b)):
            return None
        value = json.number("value") * MM
        if kind == "distance":
            return Distance(a, b, value)
        return Apart(a, b, 1, -value) if kind == "horizontal" else Apart(a, b, 0, value)
