"""The model of a machine of pins: joints put where its drivers begin, links, guides, drivers."""

from __future__ import annotations

import math
from itertools import combinations

from linkwright.importers.foreign import Answers
from linkwright.importers.layout import FRAME, Body, Drive, Layout, Slide, free_name
from linkwright.importers.pylinkage.pin_plan import Driver, Line, PinPlan
from linkwright.importers.rigid import join_rigid
from linkwright.importers.settle import Constraint, Distance, OnLine, Turned, meeting, settle
from linkwright.mechanism.link import Vec
from linkwright.units import UNITS, number
from linkwright.words import _

#: Time of a step, s, where no speed is given.
STEP = 0.01
#: Difference (rad) of the driver's angle from the drawing within which it is the drawn one, written with few digits.
DRAWN = 1e-6


def build(plan: PinPlan, answers: Answers) -> Layout | None:
    """The layout of a plan, with its findings."""
    return Builder(plan, answers).read()


class Builder:
    """Puts the joints where the machine begins, and makes links, guides and drivers."""

    def __init__(self, plan: PinPlan, answers: Answers) -> None:
        self.plan, self.answers = plan, answers
        self.unit = answers.unit or "mm"
        self.layout = Layout(unit=self.unit)
        self.names: dict[str, str] = {}
        self.at: dict[str, Vec] = {}
        self.bodies: dict[int, str] = {}

    def read(self) -> Layout | None:
        """The layout; None where it cannot be assembled."""
        plan, factor = self.plan, UNITS[self.unit][0]
        for key, joint in plan.joints.items():
            if joint.place is None and joint.tracked is None:
                message = _('"{key}" has no place, so that its links have no lengths', key=key)
                joint.json.remark("error", message, _("give its position"), "import.no_place")
            elif joint.place is not None:
                self.at[key] = (joint.place[0] * factor, joint.place[1] * factor)
            self.names[key] = free_name(joint.name, self.names.values(), "P")
        if plan.root.remarks.failed:
            return None
        self.size = max((math.hypot(*each) for each in self.at.values()), default=1.0) or 1.0
        self.layout.precision = 1e-10 * self.size
        self.drawn = dict(self.at)
        if not self.begin(factor):
            return None
        self.track(factor)
        self.make_bodies()
        self.make_guides()
        gone = join_rigid(self.layout, self.plan.root.remarks)
        self.bodies = {member: gone.get(name, name) for member, name in self.bodies.items()}
        self.make_drives()
        self.say_unit()
        return self.layout

    # -- where the machine begins

    def length(self, a: str, b: str) -> float:
        """The distance of two joints of a member, m: as given, or as drawn."""
        factor = UNITS[self.unit][0]
        given = self.plan.lengths.get((a, b), self.plan.lengths.get((b, a)))
        return math.dist(self.drawn[a], self.drawn[b]) if given is None else given * factor

    def begin(self, factor: float) -> bool:
        """Puts the drivers' pins at their angles, and the rest where the lengths put it."""
        constraints = list(self.constraints(factor))
        fixed = [key for key, joint in self.plan.joints.items() if joint.ground and key in self.at]
        if any(isinstance(each, Turned) and abs(each.angle - each.drawn) > DRAWN for each in constraints):
            self.jump(constraints)
        settled, wrong = settle(self.at, fixed, constraints)
        self.at = settled
        if wrong <= 1e-9 * self.size:
            return True
        where = self.plan.drivers[0].json if self.plan.drivers else self.plan.root
        message = _("the links do not meet where the driver begins")
        where.remark("error", message, _("change initial_angle or the positions"), "import.assembly")
        return False

    def constraints(self, factor: float) -> list[Constraint]:
        """What the joints' places must hold at the start."""
        found: list[Constraint] = []
        for member in self.plan.members:
            held = [key for key in member.joints if self.plan.joints[key].tracked is None]
            found += [Distance(a, b, self.length(a, b)) for a, b in combinations(held, 2) if not self.fixed(a, b)]
        for key, joint in self.plan.joints.items():
            if joint.line is not None and joint.line.joints is None:
                x, y = joint.line.through
                found.append(OnLine(key, (x * factor, y * factor), joint.line.angle))
        for driver in self.plan.drivers:
            (x0, y0), (x1, y1) = self.at[driver.motor], self.at[driver.pin]
            drawn = math.atan2(y1 - y0, x1 - x0)
            wanted = drawn if driver.initial is None else driver.initial
            if abs(math.remainder(wanted - drawn, 2 * math.pi)) <= DRAWN:
                wanted = drawn
            wanted = drawn + math.remainder(wanted - drawn, 2 * math.pi)
            found.append(Turned(driver.motor, driver.pin, self.length(driver.motor, driver.pin), wanted, drawn))
        return found

    def fixed(self, *joints: str) -> bool:
        """Whether all of these joints are parts of the frame."""
        return all(self.plan.joints[key].ground for key in joints)

    def jump(self, constraints: list[Constraint]) -> None:
        """Puts the drivers' pins at once where they begin, and each joint that two lengths place at the place nearest
        to the drawn one, as pylinkage does at its first step; what remains is led there."""
        known = {key for key, joint in self.plan.joints.items() if joint.ground}
        lines = {each.point: each for each in constraints if isinstance(each, OnLine)}
        moved = dict(self.at)
        for each in constraints:
            if isinstance(each, Turned):
                (x, y), r = moved[each.pivot], each.length
                moved[each.point] = (x + r * math.cos(each.angle), y + r * math.sin(each.angle))
                known.add(each.point)
        spans = [each for each in constraints if isinstance(each, Distance)]
        waiting = [key for key, joint in self.plan.joints.items() if key not in known and joint.tracked is None]
        while waiting:
            for key in waiting:
                ways = [
                    (each.b if each.a == key else each.a, each.length) for each in spans if key in (each.a, each.b)
                ]
                circles = [(moved[other], length) for other, length in ways if other in known]
                choices = _choices(circles, lines.get(key))
                if choices:
                    _away, moved[key] = min((math.dist(place, self.at[key]), place) for place in choices)
                    known.add(key)
                    waiting.remove(key)
                    break
            else:
                return
        self.at = moved
        for each in constraints:
            if isinstance(each, Turned):
                each.drawn = each.angle

    def track(self, factor: float) -> None:
        """Places of the joints that only watch; one without its two joints stands still."""
        for key, joint in self.plan.joints.items():
            tracked = joint.tracked
            if tracked is None:
                continue
            (x, y), (x1, y1) = self.at[tracked.first], self.at[tracked.second]
            angle, distance = math.atan2(y1 - y, x1 - x) + tracked.angle, tracked.distance * factor
            self.at[key] = (x + distance * math.cos(angle), y + distance * math.sin(angle))
            member = self.plan.holder(tracked.first, tracked.second)
            if member is None:
                message = _(
                    '"{key}" watches "{first}" and "{second}", which no link holds both: left out',
                    key=key,
                    first=tracked.first,
                    second=tracked.second,
                )
                joint.json.remark("warning", message, _("watch two joints of one link"), "import.skipped")
            elif key not in member.joints:
                member.joints.append(key)

    # -- links, guides, drivers

    def make_bodies(self) -> None:
        """A link for each member that moves; fixed joints are points of the frame."""
        layout = self.layout
        layout.frame.places |= {
            self.names[key]: self.at[key] for key, joint in self.plan.joints.items() if joint.ground
        }
        for member in self.plan.members:
            held = list(dict.fromkeys(key for key in member.joints if key in self.at))
            held.sort(key=lambda key: self.plan.joints[key].tracked is not None)
            if len(held) < 2 or self.fixed(*held):
                continue
            name = free_name(member.name, layout.bodies, "link")
            places = {self.names[key]: self.at[key] for key in held}
            given = (held[0], held[1]) in self.plan.lengths or (held[1], held[0]) in self.plan.lengths
            length = self.length(held[0], held[1]) if given else None
            layout.add(Body(name, places, length=length, key=member.json.key))
            self.bodies[id(member)] = name
            layout.traced += [
                f"{name}.{self.names[key]}" for key in held if self.plan.joints[key].tracked is not None
            ]

    def make_guides(self) -> None:
        """A block and a guide for each joint that slides."""
        for key, joint in self.plan.joints.items():
            if joint.line is None or joint.ground:
                continue
            name = self.names[key]
            guide, through, direction = self.guide(key, joint.line)
            if not guide:
                continue
            block = self.layout.add(
                Body(free_name(f"block_{name}", self.layout.bodies), {name: self.at[key]}, key=key)
            )
            taken = [*self.names.values(), *(each.name for each in self.layout.slides)]
            self.layout.slides.append(
                Slide(free_name(f"guide_{name}", taken), guide, through, direction, block.name, name)
            )

    def guide(self, key: str, line: Line) -> tuple[str, str, float | tuple[str, str]]:
        """The body that carries a line, a point on it and its direction; no body: an error."""
        if line.joints is not None:
            first, second = line.joints
            member = self.plan.holder(first, second)
            carrier = FRAME if self.fixed(first, second) else self.bodies.get(id(member), "")
            if not carrier:
                message = _('"{key}" slides on a line through two joints that no link holds both', key=key)
                self.plan.joints[key].json.remark("error", message, _("take two joints of one link"), "import.guide")
            return carrier, self.names[first], (self.names[first], self.names[second])
        factor, frame = UNITS[self.unit][0], self.layout.frame.places
        place = (line.through[0] * factor, line.through[1] * factor)
        for name, each in frame.items():
            if math.dist(each, place) <= 1e-9 * self.size:
                return FRAME, name, line.angle
        name = free_name(f"G_{self.names[key]}", [*self.names.values(), *frame])
        frame[name] = place
        return FRAME, name, line.angle

    def make_drives(self) -> None:
        """Drivers; a step has no time in the file, so that it is asked for."""
        drivers = self.plan.drivers
        if not drivers:
            message = _("the file drives nothing")
            self.plan.root.remark("warning", message, _("add a driver in pylinkage"), "import.driver")
            return
        speed, first = self.answers.speed, drivers[0].rate
        scale = 1 / STEP if speed is None or not first else (speed if drivers[0].arc is None else abs(speed)) / first
        if speed is None:
            message = _("speeds are in rad a step, and a step has no time: {step} are taken", step="0.01 s")
            drivers[0].json.remark("note", message, _("answer with --speed, in rad/s"), "import.speed")
        for driver in drivers:
            wanted = "driver" if len(drivers) == 1 else f"driver_{driver.member.name}"
            name = free_name(wanted, self.layout.taken())
            body = self.bodies.get(id(driver.member), FRAME)
            if body == FRAME:
                message = _('"{key}" cannot turn: it is rigid with the frame', key=driver.member.name)
                driver.json.remark("error", message, _("mend it here"), "import.driver")
                continue
            drive = Drive(name, turn=body, about=self.names[driver.motor])
            if driver.arc is None:
                drive.speed = driver.rate * scale
            else:
                self.swing(drive, driver, abs(driver.rate * scale))
            self.layout.drives.append(drive)

    def swing(self, drive: Drive, driver: Driver, rate: float) -> None:
        """To the end of the arc, back to its begin, and to where it was, all at one speed."""
        assert driver.arc is not None and driver.initial is not None
        low, high = driver.arc
        ways = [each for each in (high - driver.initial, low - high, driver.initial - low) if abs(each) > 1e-12]
        times, angles = [0.0], [0.0]
        for way in ways:
            times.append(round(times[-1] + abs(way) / rate, 12))
            angles.append(angles[-1] + way)
        angles[-1] = 0.0
        drive.table = (times, angles, "linear")
        self.layout.cycle = {"duration": f"{number(times[-1])} s"}

    def say_unit(self) -> None:
        """A note that there are no units, unless the unit is answered."""
        if self.answers.unit is None:
            message = _("the file has no units: {unit} are taken", unit=self.unit)
            self.plan.root.remark("note", message, _("answer with --unit"), "import.unit")


def _choices(circles: list[tuple[Vec, float]], line: OnLine | None) -> list[Vec]:
    """Where two circles, or a circle and a line, meet; none: there are too few of them, or they do not meet."""
    if line is not None and circles:
        (x, y), r = circles[0]
        cos, sin = math.cos(line.angle), math.sin(line.angle)
        dx, dy = x - line.through[0], y - line.through[1]
        foot, off = cos * dx + sin * dy, cos * dy - sin * dx
        half = r * r - off * off
        ends = (foot - math.sqrt(half), foot + math.sqrt(half)) if half >= 0 else ()
        return [(line.through[0] + each * cos, line.through[1] + each * sin) for each in ends]
    if len(circles) < 2:
        return []
    (one, r), (other, s) = circles[:2]
    found = [meeting(one, r, other, s, left) for left in (True, False)]
    return [each for each in found if each is not None]
