"""The four-bar and the six-bar leg of OpenLinkage: dimensions, assembly modes and the input angle, y up, mm."""

from __future__ import annotations

import math

from linkwright.importers.foreign import Answers
from linkwright.importers.json_tree import Json
from linkwright.importers.layout import Body, Drive, Layout
from linkwright.importers.model_text import RPM
from linkwright.importers.settle import meeting
from linkwright.mechanism.link import Vec
from linkwright.words import _

MM = 1e-3


def beside(start: Vec, end: Vec, ratio: float, offset: float) -> Vec:
    """A point at a ratio of the way, moved to the left by an offset (m)."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    length = math.hypot(dx, dy)
    return start[0] + ratio * dx - offset * dy / length, start[1] + ratio * dy + offset * dx / length


class Parameters:
    """The dimensions of one file, m, and what else both kinds have: input angle and speed."""

    def __init__(self, root: Json, answers: Answers) -> None:
        self.root = root
        self.given = root.get("parameters") or root
        self.layout = Layout(precision=1e-12)
        self.answers = answers
        self.angle = root.number("inputAngle", 0.0)

    def length(self, key: str) -> float:
        """A length that must be positive."""
        found = self.given.number(key) * MM
        if found <= 0:
            message = _('"{key}" must be positive', key=key)
            (self.given.get(key) or self.given).remark("error", message, _("mend it here"), "import.value")
        return found or MM

    def place(self, key: str) -> float:
        """A coordinate."""
        return self.given.number(key) * MM

    def body(self, name: str, places: dict[str, Vec], length: float, key: str) -> None:
        """A link of two points and those that go with them."""
        self.layout.add(Body(name, places, length=length, key=key))

    def drive(self, body: str, about: str, usual: float) -> None:
        """The input link turns anticlockwise; where no speed is given, the usual one (rpm) is taken."""
        speed = self.answers.speed
        if speed is None:
            speed = self.root.number("speed", usual) * RPM
            if "speed" not in self.root:
                message = _("the file gives no speed; {speed} is taken", speed=f"{usual:g} rpm")
                self.root.remark("note", message, _("answer with --speed, in rad/s"), "import.speed")
        self.layout.drives.append(Drive(turn=body, about=about, speed=speed))

    def begun(self, found: object, angle: float) -> None:
        """Remarks that the machine begins at another angle than the file says; there is none: an error."""
        place = self.root.get("inputAngle") or self.root
        if found is None:
            message = _("the links do not meet at any input angle")
            place.remark("error", message, _("change the lengths in OpenLinkage"), "import.assembly")
        elif angle != self.angle:
            message = _(
                "the links do not meet at an input angle of {given}°; it begins at {taken}°, where they do",
                given=self.angle,
                taken=angle,
            )
            place.remark("warning", message, _("set another angle in OpenLinkage"), "import.assembly")

    def nearest_angles(self) -> list[float]:
        """The input angle (deg) and all others in steps of 1°, the nearest first."""
        return [self.angle, *(self.angle + sign * step for step in range(1, 181) for sign in (1, -1))]


def crank_pin(radius: float, degrees: float) -> Vec:
    """Where the crank's pin is; whole quarters of a turn are exact."""
    quarters = {0.0: (1.0, 0.0), 90.0: (0.0, 1.0), 180.0: (-1.0, 0.0), 270.0: (0.0, -1.0)}
    angle = math.radians(degrees)
    cos, sin = quarters.get(degrees % 360.0, (math.cos(angle), math.sin(angle)))
    return radius * cos, radius * sin


def read_four_bar(root: Json, answers: Answers) -> Layout | None:
    """The four-bar O A B Q with its coupler point P."""
    read = Parameters(root, answers)
    ground, crank, coupler, output = (read.length(key) for key in ("ground", "input", "coupler", "output"))
    left, o, q = root.text("assemblyMode", "open") != "crossed", (0.0, 0.0), (ground, 0.0)
    for angle in read.nearest_angles():
        a = crank_pin(crank, angle)
        b = meeting(a, coupler, q, output, left)
        if b is not None:
            break
    read.begun(b, angle)
    if b is None:
        return None
    ratio, offset = read.given.number("couplerPointRatio", 0.0), read.given.number("couplerPointOffset", 0.0) * MM
    layout = read.layout
    layout.name = "Four-bar"
    layout.frame.places |= {"O": o, "Q": q}
    read.body("input", {"O": o, "A": a}, crank, "parameters.input")
    read.body("coupler", {"A": a, "B": b, "P": beside(a, b, ratio, offset)}, coupler, "parameters.coupler")
    read.body("output", {"Q": q, "B": b}, output, "parameters.output")
    layout.traced.append("coupler.P")
    read.drive("input", "O", usual=18)
    return layout


def read_leg(root: Json, answers: Answers) -> Layout | None:
    """The six-bar leg: a four-bar O A B F, at its pin B a dyad B C R, the foot P on the link B C."""
    read = Parameters(root, answers)
    keys = ("groundPivot", "crank", "firstCoupler", "firstRocker", "secondCoupler", "secondRocker")
    ground, crank, first, rocker, second, last = (read.length(key) for key in keys)
    o, f, r = (0.0, 0.0), (ground, 0.0), (read.place("rearPivotX"), read.place("rearPivotY"))
    for angle in read.nearest_angles():
        a = crank_pin(crank, angle)
        b = meeting(a, first, f, rocker, left=True)
        c = None if b is None else meeting(b, second, r, last, left=False)
        if c is not None:
            break
    read.begun(c, angle)
    if b is None or c is None:
        return None
    foot = beside(b, c, read.given.number("footRatio", 1.0), read.given.number("footOffset", 0.0) * MM)
    layout = read.layout
    layout.name = "Six-bar leg"
    layout.frame.places |= {"O": o, "F": f, "R": r}
    read.body("crank", {"O": o, "A": a}, crank, "parameters.crank")
    read.body("first_coupler", {"A": a, "B": b}, first, "parameters.firstCoupler")
    read.body("first_rocker", {"F": f, "B": b}, rocker, "parameters.firstRocker")
    read.body("second_coupler", {"B": b, "C": c, "P": foot}, second, "parameters.secondCoupler")
    read.body("second_rocker", {"R": r, "C": c}, last, "parameters.secondRocker")
    layout.traced.append("second_coupler.P")
    read.drive("crank", "O", usual=14)
    return layout
