"""DXF skeletons: lines as links, circles as pins, layers as roles; what a drawing leaves open is asked."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from itertools import combinations

from linkwright import units
from linkwright.core.data import Plain
from linkwright.errors import Severity
from linkwright.importers.dxf_entities import DrawingFile, Entity, away_from, crossing, extent, read_entities, scaled
from linkwright.importers.foreign import READERS, Answers, ForeignFormat, ForeignText
from linkwright.importers.layout import FRAME, Body, Drive, Layout, Remarks, Slide, Wheels, free_name
from linkwright.importers.rigid import join_rigid
from linkwright.mechanism.link import Vec
from linkwright.units import UNITS, number
from linkwright.words import Message, _

#: Distance of ends that are one pin, and of a text from the pin that it names, as shares of the drawing's size.
ONE, NEAR = 1e-4, 0.06
#: Speed of a driver for which none is given, rad/s: 60 rpm.
USUAL_SPEED = 2 * math.pi
_ROLE = re.compile(r"(link|frame|guide|block|gear|driver)(?:[_\- ]+(.*))?", re.IGNORECASE)
_RATE = re.compile(r"([-+]?\d+(?:\.\d*)?)\s*(rpm|r/min|rad/s|deg/s|°/s|mm/s|m/s)", re.IGNORECASE)
_MASS = re.compile(r"(?:m\s*=\s*)?(\d+(?:\.\d*)?)\s*kg(?!\s*[·*.]?\s*m)")
_INERTIA = re.compile(r"J\s*=\s*(\d+(?:\.\d*)?(?:e[-+]?\d+)?)")


class Skeleton:
    """Makes a layout of the entities of a drawing."""

    def __init__(self, drawing: DrawingFile, answers: Answers, remarks: Remarks, name: str) -> None:
        self.answers, self.remarks = answers, remarks
        self.colours = drawing.colours
        unit = answers.unit or drawing.unit
        if unit is None:
            unit = "mm"
            message = _("the drawing does not state its unit; millimetres are taken")
            self.remark("warning", message, _("answer with --unit"), "import.dxf.unit")
        factor = UNITS[unit][0]
        self.entities = [scaled(each, factor) for each in drawing.entities]
        self.size = extent(self.entities)
        self.layout = Layout(name=name, unit=unit, precision=1e-10 * self.size)
        self.places: dict[str, Vec] = {}
        self.texts = [each for each in self.entities if each.kind == "text"]
        self.wide = 0.0

    def remark(self, severity: Severity, message: Message, remedy: Message | str, code: str, key: str = "") -> None:
        """Notes what is ambiguous, or not read."""
        self.remarks.remark(severity, message, remedy, code, key=key)

    def read(self) -> Layout | None:
        """The layout; None, with errors among the remarks, where there is no machine in the drawing."""
        roles = [(role(each.layer), each) for each in self.entities]
        layered = any(kind in ("link", "frame") for (kind, _name), _each in roles)
        if layered:
            self.by_layers(roles)
        else:
            self.by_lines()
        if not self.layout.bodies:
            message = _("the drawing holds no links")
            remedy = _("draw each link on a layer LINK_name, the pins of the frame as circles on FRAME")
            self.remark("error", message, remedy, "import.dxf.no_links")
            return None
        self.fix()
        if not self.layout.frame.places:
            message = _("the drawing does not say what is fixed")
            remedy = _("draw the pins of the frame as circles on the layer FRAME, or answer with --fixed LINK")
            self.remark("error", message, remedy, "import.dxf.no_frame")
            return None
        gone = join_rigid(self.layout, self.remarks)
        self.told_apart()
        self.drive(gone)
        return self.layout

    # -- points

    def point(self, place: Vec) -> str:
        """The name of the point at a place: one name for all that lie within the tolerance."""
        for name, known in self.places.items():
            away = math.dist(place, known)
            if away <= ONE * self.size:
                self.wide = max(self.wide, away)
                return name
        self.places[name := f"{len(self.places)}"] = place
        return name

    def extend(self, body: Body, places: Sequence[Vec]) -> None:
        """Adds points to a body."""
        for place in places:
            name = self.point(place)
            body.places.setdefault(name, self.places[name])

    def told_apart(self) -> None:
        """Names the points: by the text next to each, else by letters; says how far ends lay apart."""
        if self.wide > 1e-9 * self.size:
            away = number(self.wide / UNITS[self.layout.unit][0], 3)
            message = _("ends up to {away} {unit} apart are taken as one pin", away=away, unit=self.layout.unit)
            remedy = _("draw them at one place, with object snap")
            self.remark("note", message, remedy, "import.dxf.apart")
        used = {name for body in self.layout.all for name in body.places}
        named: dict[str, str] = {}
        short = [each for each in self.texts if re.fullmatch(r"[^\W\d][\w']{0,7}", each.text.strip())]
        pairs = sorted(
            (math.dist(text.places[0], self.places[name]), k, name) for k, text in enumerate(short) for name in used
        )
        for distance, k, name in pairs:
            text = short[k].text.strip()
            if distance <= NEAR * self.size and name not in named and text not in named.values():
                named[name] = text
        for name in sorted(used - named.keys(), key=int):
            wanted = "O1" if name in self.layout.frame.places else "A"
            named[name] = next(each for each in _names(wanted) if each not in named.values())
        for body in self.layout.all:
            body.places = {named[name]: place for name, place in body.places.items()}
        for slide in self.layout.slides:
            slide.through, slide.at = named[slide.through], named[slide.at]

    # -- drawings with layers

    def by_layers(self, roles: Sequence[tuple[tuple[str, str], Entity]]) -> None:
        """Links, frame, guides, blocks and wheels by the layers' names."""
        for (kind, name), each in roles:
            if kind == "link" and each.kind != "text":
                body = self.layout.bodies.get(name) or self.layout.add(
                    Body(name, colour=self.colours.get(each.layer, ""), key=each.layer)
                )
                self.extend(body, each.places)
            elif kind == "frame" and each.kind in ("circle", "point"):
                self.extend(self.layout.frame, each.places)
            elif kind == "" and each.kind != "text":
                message = _("what lies on the layer {layer} has no role", layer=each.layer)
                remedy = _("layers with a role are FRAME, LINK_name, GUIDE_name, BLOCK_name, GEAR_name, DRIVER")
                self.remark("note", message, remedy, "import.dxf.no_role", key=each.key)
        for (kind, name), each in roles:
            if kind == "block":
                self.block(name, each)
        for (kind, name), each in roles:
            if kind == "guide" and each.kind == "line":
                self.guide(name, each)
        self.wheels([(name, each) for (kind, name), each in roles if kind == "gear" and each.kind == "circle"])
        for (kind, name), each in roles:
            if kind == "link" and each.kind == "text" and name in self.layout.bodies:
                self.masses(self.layout.bodies[name], each.text)

    def block(self, name: str, each: Entity) -> None:
        """A slider: a closed outline around its point, or a circle; part of the link of its name."""
        xs, ys = zip(*each.places, strict=True)
        centre = ((min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2)
        body = self.layout.bodies.get(name) or self.layout.add(Body(name, key=each.layer))
        self.extend(body, [centre])

    def guide(self, name: str, each: Entity) -> None:
        """A guide line of the frame or of a link, and the block on it: that of a BLOCK layer, or a pin in a slot."""
        carrier = name or FRAME
        if carrier != FRAME and carrier not in self.layout.bodies:
            message = _("the guide belongs to {name}, and there is no layer LINK_{name}", name=name)
            self.remark("error", message, _("name the link that carries it"), "import.dxf.no_carrier", key=each.key)
            return
        start, end = each.places[0], each.places[-1]
        guide = self.layout.body(carrier)
        held = self.on_guide(guide, start, end)
        if not held:
            message = _("nothing slides on the guide")
            remedy = _("draw the link's end or the block's centre on the line of the guide")
            self.remark("warning", message, remedy, "import.dxf.idle_guide", key=each.key)
            return
        best = min(held.values())
        at, *others = [point for point, rank in held.items() if rank == best]
        if others:
            message = _("{count} pins lie on the guide, and one of them is taken", count=1 + len(others))
            remedy = _("mark the one that slides by an outline on a layer BLOCK_name around it")
            self.remark("warning", message, remedy, "import.dxf.which_slides", key=each.key)
        bodies = [body for body in self.layout.bodies.values() if at in body.places and body is not guide]
        body = next((body for body in bodies if self.blocked(body)), None)
        if body is None:
            body = self.layout.add(Body(free_name("slider", self.layout.bodies), {at: self.places[at]}))
        through = self.point(start)
        guide.places.setdefault(through, self.places[through])
        direction = math.atan2(end[1] - start[1], end[0] - start[0])
        taken = [slide.name for slide in self.layout.slides]
        name = free_name(f"guide_{body.name}", [*taken, *self.layout.bodies])
        self.layout.slides.append(Slide(name, carrier, through, direction, body.name, at))

    def on_guide(self, guide: Body, start: Vec, end: Vec) -> dict[str, int]:
        """The pins of other bodies on a guide's line, each with its rank: 0 of a block, 1 of a link, 2 of the frame;
        3 more beyond the line's ends."""
        found = {}
        reach = math.dist(start, end)
        for point, place in self.places.items():
            bodies = [body for body in self.layout.all if point in body.places and body is not guide]
            if bodies and point not in guide.places and away_from(place, start, end) <= ONE * self.size:
                fixed = point in self.layout.frame.places
                beyond = max(math.dist(place, start), math.dist(place, end)) > (1 + 1e-9) * reach
                found[point] = 3 * beyond + (0 if any(map(self.blocked, bodies)) else 1 + fixed)
        return found

    def blocked(self, body: Body) -> bool:
        """Whether a block is drawn for a link."""
        return any(role(each.layer) == ("block", body.name) for each in self.entities)

    def wheels(self, circles: Sequence[tuple[str, Entity]]) -> None:
        """Wheels by their pitch circles; two that touch mesh."""
        wheels = []
        for name, each in circles:
            body = self.layout.bodies.get(name) or self.layout.add(
                Body(name or free_name("wheel", self.layout.bodies))
            )
            self.extend(body, each.places)
            wheels.append((body.name, each))
        for (a, one), (b, other) in combinations(wheels, 2):
            away = math.dist(one.places[0], other.places[0])
            external = math.isclose(away, one.radius + other.radius, rel_tol=1e-3)
            if a != b and (external or math.isclose(away, abs(one.radius - other.radius), rel_tol=1e-3)) and away:
                unit = self.layout.unit
                radii = [f"{number(each.radius / UNITS[unit][0], 12)} {unit}" for each in (one, other)]
                values: Plain = {"links": [a, b], "radii": radii}
                values |= {} if external else {"mesh": "internal"}
                self.layout.wheels.append(Wheels(free_name(f"{a}_{b}", self.layout.bodies), "gear", values))

    def masses(self, body: Body, text: str) -> None:
        """Mass and moment of inertia from a text on a link's layer."""
        if (found := _MASS.search(text)) is not None:
            body.mass = float(found[1])
        if (found := _INERTIA.search(text)) is not None:
            body.inertia = float(found[1])

    # -- drawings without layers

    def by_lines(self) -> None:
        """Every line and polyline a link, common ends pins, a circle where only one line ends a pin of the frame."""
        lines = [each for each in self.entities if each.kind == "line"]
        for number_, each in enumerate(lines, 1):
            body = self.layout.add(Body(free_name(f"link{number_}", self.layout.bodies), key=each.key))
            self.extend(body, each.places)
        for each in self.entities:
            if each.kind == "arc":
                message = _("an arc may be a wheel, a roller or a bent link, and is not read")
                remedy = _("draw links by straight lines, wheels as circles on layers GEAR_name")
                self.remark("warning", message, remedy, "import.dxf.arc", key=each.key)
            if each.kind == "circle":
                at = self.point(each.places[0])
                ends = [body for body in self.layout.bodies.values() if at in body.places]
                if len(ends) == 1 and self.answers.fixed is None:
                    self.layout.frame.places[at] = self.places[at]
        if self.layout.frame.places and self.answers.fixed is None:
            message = _("circles where only one line ends are taken as pins of the frame")
            remedy = _("use the layers FRAME and LINK_name, or answer with --fixed LINK")
            self.remark("warning", message, remedy, "import.dxf.fixed_by_circles")
        for one, other in combinations(lines, 2):
            if crossing(one, other):
                message = _("two lines cross without a common end: no pin is taken there")
                remedy = _("for a pin end both lines there, or use polylines with a vertex")
                self.remark("note", message, remedy, "import.dxf.crossing", key=f"{one.key}; {other.key}")

    # -- what is fixed, what is driven

    def fix(self) -> None:
        """Makes a link the frame that the user names."""
        wanted = self.answers.fixed
        if wanted is None or wanted.lower() == FRAME:
            return
        body = self.layout.bodies.get(wanted) or self.layout.bodies.get(role(wanted)[1])
        if body is None:
            message = _("there is no link {name}", name=wanted)
            remedy = _("the drawing has {names}", names=tuple(self.layout.bodies))
            self.remark("error", message, remedy, "import.dxf.no_such_link")
            return
        del self.layout.bodies[body.name]
        self.layout.frame.places |= body.places
        for slide in self.layout.slides:
            slide.guide = FRAME if slide.guide == body.name else slide.guide

    def drive(self, gone: dict[str, str]) -> None:
        """The driver: as the user says, by the layer DRIVER, else the shortest link on the frame."""
        signs = [each for each in self.entities if role(each.layer)[0] == "driver"]
        rate = next((found for each in signs if (found := _RATE.search(each.text)) is not None), None)
        speed = self.answers.speed
        if speed is None and rate is not None:
            speed = float(rate[1]) * units.unit(rate[2].lower())[0]
        frame, bodies = self.layout.frame.places, self.layout.bodies
        hinged = {name: [p for p in body.places if p in frame] for name, body in bodies.items()}
        turning = {name: points[0] for name, points in hinged.items() if points}
        sliding = {each.name: each for each in self.layout.slides}
        wanted = self.answers.driver and gone.get(self.answers.driver, self.answers.driver)
        if wanted is None and signs and rate is not None and rate[2].lower() in ("mm/s", "m/s"):
            wanted = min(sliding, key=lambda name: self.off(signs, bodies[sliding[name].block]), default=None)
        elif wanted is None and signs and turning:
            wanted = min(turning, key=lambda name: (self.off(signs, bodies[name], turning[name]), name))
        named = {**{each: each for each in (*turning, *sliding)}, **{pin: name for name, pin in turning.items()}}
        wanted = named.get(wanted or "")
        if wanted is None:
            if self.answers.driver is not None or not turning:
                message = _("nothing is driven")
                remedy = _("answer with --driver, one of {names}", names=(*turning, *sliding))
                self.remark("warning", message, remedy, "import.dxf.no_driver")
                return
            wanted = min(turning, key=lambda name: _length(bodies[name]))
            message = _("nothing is marked as driven; the shortest link on the frame, {name}, is taken", name=wanted)
            remedy = _("put a text such as n=60 rpm on the layer DRIVER at its pin, or answer with --driver")
            self.remark("warning", message, remedy, "import.dxf.driver")
        if speed is None:
            message = _("the speed of the driver is not given; 60 rpm, or 0.1 m/s, is taken")
            remedy = _("put a text such as n=60 rpm on the layer DRIVER, or answer with --speed")
            self.remark("warning", message, remedy, "import.dxf.speed")
        if wanted in sliding:
            self.layout.drives.append(Drive(slide=wanted, speed=0.1 if speed is None else speed))
        else:
            speed = USUAL_SPEED if speed is None else speed
            self.layout.drives.append(Drive(turn=wanted, about=turning[wanted], speed=speed))

    def off(self, signs: Sequence[Entity], body: Body, pin: str | None = None) -> float:
        """Distance of the nearest sign from a body's pin, or from its points, m."""
        places = [body.places[pin]] if pin is not None else list(body.places.values())
        return min(math.dist(each.places[0], place) for each in signs for place in places)


def role(layer: str) -> tuple[str, str]:
    """What a layer is for (link, frame, guide, block, gear, driver; empty: nothing), and the name behind it."""
    found = _ROLE.fullmatch(layer.strip())
    if found is None or (found[1].lower() in ("link", "block") and not found[2]):
        return "", layer
    kind, name = found[1].lower(), (found[2] or "").strip()
    if not name or (kind == "guide" and name.lower() == FRAME):
        return kind, ""
    return kind, free_name(name, (), "link")


def _length(body: Body) -> float:
    return max((math.dist(*each) for each in combinations(body.places.values(), 2)), default=0.0)


def _names(wanted: str) -> Iterator[str]:
    """O1, O2, … of the frame; A, B, …, Z, A1, … of links."""
    letters = [chr(code) for code in range(ord("A"), ord("Z") + 1) if chr(code) != "O"]
    number_ = 1
    if wanted == "A":
        yield from letters
        while True:
            yield from (f"{letter}{number_}" for letter in letters)
            number_ += 1
    while True:
        yield f"O{number_}"
        number_ += 1


def _read(source: ForeignText, answers: Answers, remarks: Remarks) -> Layout | None:
    drawing = read_entities(source.binary or source.text.encode(), remarks)
    if drawing is None:
        return None
    name = source.name.rpartition(".")[0].replace("_", " ") or "Mechanism"
    return Skeleton(drawing, answers, remarks, name).read()


def _recognised(source: ForeignText) -> bool:
    start = source.text[:4000].lstrip()
    return start.startswith(("0\nSECTION", "0\r\nSECTION", "999", "AutoCAD Binary DXF")) or "\nSECTION" in start


READERS.register("dxf")(ForeignFormat(_("DXF skeleton"), (".dxf",), _recognised, _read))
