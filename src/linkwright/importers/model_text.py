"""The text of a model file for a layout, as a person would write it: one link a line, short numbers, a drawing."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from linkwright.core.data import Plain
from linkwright.files.write import flow, scalar
from linkwright.importers.layout import FRAME, Body, Drive, Force, Layout, Slide, Wheels
from linkwright.mechanism.link import Vec
from linkwright.units import UNITS, number

#: Turns of an angle (rad) and of a rate (rad/s) in the units that people write.
DEGREE, RPM = math.pi / 180, math.pi / 30
#: Rounding of results of arithmetic, as a share of the machine's size.
ROUNDING = 1e-14


def shortest(value: float, tolerance: float = 0.0) -> str:
    """The shortest decimal number within a tolerance of a value; 0: the one that reads back as the same float."""
    if not tolerance or not math.isfinite(value):
        return number(value + 0.0)
    if abs(value) <= tolerance:
        return "0"
    for digits in range(1, 18):
        text = f"{value:.{digits}g}"
        if abs(float(text) - value) <= tolerance:
            return number(float(text) + 0.0)
    return number(value + 0.0)


def turning(speed: float) -> str:
    """A rate of turning (rad/s) in the unit in which it is the shorter number."""
    written = (f"{shortest(speed / RPM, 1e-12)} rpm", f"{shortest(speed, 1e-13)} rad/s")
    return min(written, key=lambda text: len(text.split()[0]))


class Writer:
    """Writes one layout; lengths in its unit, within its precision."""

    def __init__(self, layout: Layout) -> None:
        self.layout = layout
        self.factor = UNITS[layout.unit][0]
        self.size = (
            max((math.hypot(*each) for body in layout.all for each in body.places.values()), default=1.0) or 1.0
        )
        self.tolerance = max(layout.precision, ROUNDING * self.size)
        self.drawn = layout.drawing()

    def text(self) -> str:
        """The whole file."""
        layout = self.layout
        data: Plain = {"format": 1, "name": layout.name or "Mechanism"}
        data |= {"source": layout.source} if layout.source else {}
        data["frame"] = {"points": self.places(layout.frame.places)}
        data["links"] = {body.name: self.link(body) for body in layout.bodies.values()}
        data["joints"] = dict(self.joints())
        data["drawing"] = self.places({name: each for name, each in self.drawn.items() if name not in self.further()})
        data |= self.drivers()
        data["cycle"] = layout.cycle
        data["gravity"] = [f"{number(each)} m/s²" if each else 0 for each in layout.gravity]
        data["loads"] = {**{force.name: self.force(force) for force in layout.forces}, **layout.loads}
        data = {key: value for key, value in data.items() if value not in ({}, [], [0, 0], None)}
        return "\n".join(self.lines(data)) + "\n"

    def lines(self, data: Plain) -> Iterator[str]:
        """One line for each entry of a section; the frame and the driver on one."""
        for key, value in data.items():
            if isinstance(value, dict) and key not in ("driver", "frame", "cycle"):
                yield f"{key}:"
                yield from (f"  {scalar(name)}: {flow(each)}" for name, each in value.items())
            else:
                yield f"{key}: {flow(value)}"

    def length(self, metres: float, tolerance: float | None = None) -> str:
        """A length with its unit."""
        within = self.tolerance if tolerance is None else tolerance
        return f"{shortest(metres / self.factor, within / self.factor)} {self.layout.unit}"

    def angle(self, radians: float, arm: float) -> str:
        """An angle in degrees, written so that a point at the end of an arm (m) stays within the precision."""
        turned = math.remainder(radians, 2 * math.pi)
        return f"{shortest(turned / DEGREE, self.tolerance / max(arm, self.tolerance) / DEGREE)} deg"

    def places(self, places: Mapping[str, Vec]) -> Plain:
        """Coordinates with their units."""
        return {name: [self.length(each) for each in place] for name, place in places.items()}

    # -- links

    def link(self, body: Body) -> Plain:
        """A link by its points in the drawing; by its own length or coordinates where these say otherwise."""
        points = list(body.places)
        found: Plain = {"points": points}
        if body.length is not None and len(points) > 1:
            further = {name: place for name, place in self.own_places(body).items() if name in points[2:]}
            found = {"points": points[:2], "length": self.length(body.length)}
            found |= {"also": self.places(further)} if further else {}
        elif len(points) > 1 and not self.as_drawn(body):
            found["points"] = self.places(self.own_places(body))
        for key, value, unit in (("mass", body.mass, "kg"), ("inertia", body.inertia, "kg·m²")):
            found |= {key: f"{number(value)} {unit}"} if value else {}
        if body.centre is not None:
            named = next((name for name, each in body.places.items() if self.same(each, body.centre)), None)
            within = max(self.tolerance, self.layout.centre_precision)
            found["mass_centre"] = named or [self.length(each, within) for each in self.turned(body, body.centre)]
        return found | ({"colour": body.colour} if body.colour else {})

    def further(self) -> set[str]:
        """Points of links with a length that no other link has: their own coordinates say where they are."""
        points = [name for body in self.layout.all for name in body.places]
        behind = [
            name for body in self.layout.bodies.values() if body.length is not None for name in list(body.places)[2:]
        ]
        return {name for name in behind if points.count(name) == 1}

    def as_drawn(self, body: Body) -> bool:
        """Whether the body's points are where the drawing has them, its first two apart."""
        first, second = list(body.places.values())[:2]
        places = {**self.drawn, **self.layout.frame.places}
        return first != second and all(self.same(places[name], each) for name, each in body.places.items())

    def same(self, one: Vec, other: Vec) -> bool:
        """Whether two places are one within the precision."""
        return math.dist(one, other) <= self.tolerance

    def own_places(self, body: Body) -> dict[str, Vec]:
        """The body's points in its own axes."""
        return {name: self.turned(body, each) for name, each in body.places.items()}

    def turned(self, body: Body, place: Vec) -> Vec:
        """A place of the frame in a body's axes: from its first point, along its x axis."""
        origin = next(iter(body.places.values()))
        dx, dy = place[0] - origin[0], place[1] - origin[1]
        cos, sin = math.cos(self.axis(body.name)), math.sin(self.axis(body.name))
        return cos * dx + sin * dy, cos * dy - sin * dx

    def axis(self, name: str) -> float:
        """Angle of a link's x axis at the start, rad; of a block of one point the line's on which it slides."""
        if name == FRAME:
            return 0.0
        body = self.layout.bodies[name]
        if not body.spread:
            line = next((each for each in self.layout.slides if each.block == name), None)
            return 0.0 if line is None else self.line(line)
        return body.axis

    def line(self, slide: Slide) -> float:
        """Angle of a guide line at the start, rad."""
        if isinstance(slide.direction, float | int):
            return slide.direction
        (x0, y0), (x1, y1) = (self.layout.body(slide.guide).places[each] for each in slide.direction)
        return math.atan2(y1 - y0, x1 - x0)

    # -- joints

    def joints(self) -> Iterator[tuple[str, Plain]]:
        """Guides and wheels."""
        for slide in self.layout.slides:
            yield slide.name, self.guide(slide)
        for each in self.layout.wheels:
            yield each.name, {"kind": each.kind, **each.values, **self.phase(each)}

    def phase(self, wheels: Wheels) -> Plain:
        """The phase of two wheels of which one has its centre only, so that the drawing does not show how it lies."""
        values = wheels.values
        links = values.get("links", [])
        if "phase" in values or all(name == FRAME or self.layout.body(name).spread for name in links):
            return {}
        first, second = values.get("teeth") or [float(each.split()[0]) for each in values.get("radii", "11")]
        opposed = wheels.kind in ("gear", "rolling") and values.get("mesh") != "internal"
        ratio = values.get("ratio") or (-1 if opposed or values.get("run") == "crossed" else 1) * first / second
        a, b, carrier = (self.axis(each) for each in (*links, values.get("carrier", FRAME)))
        phase = math.remainder(b - carrier - ratio * (a - carrier), 2 * math.pi)
        return {"phase": self.angle(phase, self.size)} if abs(phase) * self.size > self.tolerance else {}

    def guide(self, slide: Slide) -> Plain:
        """A prismatic joint; offset and the line's angle in the block follow from where things lie."""
        line, guide = self.line(slide), self.layout.body(slide.guide)
        direction = list(slide.direction) if isinstance(slide.direction, tuple) else []
        found: Plain = {"kind": "prismatic", "guide": slide.guide, "through": slide.through}
        found["direction"] = direction or self.angle(line - self.axis(slide.guide), self.size)
        found |= {"block": slide.block, "at": slide.at}
        through, at = guide.places[slide.through], self.layout.body(slide.block).places[slide.at]
        offset = slide.offset
        if offset is None:
            offset = math.cos(line) * (at[1] - through[1]) - math.sin(line) * (at[0] - through[0])
        if abs(offset) > self.tolerance:
            found["offset"] = self.length(offset)
        turned = slide.block_angle
        if turned is None:
            turned = math.remainder(line - self.axis(slide.block), 2 * math.pi)
        if abs(turned) * self.size > self.tolerance:
            found["block_angle"] = self.angle(turned, self.size)
        return found

    # -- drivers and loads

    def drivers(self) -> Plain:
        """The one driver, or all by name."""
        found = {each.name: self.driver(each) for each in self.layout.drives}
        if len(found) == 1:
            return {"driver": next(iter(found.values()))}
        return {"drivers": found} if found else {}

    def driver(self, drive: Drive) -> Plain:
        """One driver with its law; it begins where the machine lies."""
        start, rotary = self.coordinate(drive), drive.turn is not None
        began = self.angle(start, self.size) if rotary else self.length(start)
        if drive.table is not None:
            times, values, interpolation = drive.table
            written = [self.angle_sum(start, each) if rotary else self.length(start + each) for each in values]
            law: Plain = {"table": {"time": [f"{number(each)} s" for each in times], "position": written}}
            law["table"]["interpolation"] = interpolation
        elif drive.added is not None:
            minus = drive.added.startswith("-")
            law = {"position": f"{began} - {drive.added[1:]}" if minus else f"{began} + {drive.added}"}
        elif drive.speed is None:
            law = {"free": True}
        else:
            law = {"speed": turning(drive.speed) if rotary else f"{self.length(drive.speed)}/s"}
        if drive.table is None and drive.added is None and not began.startswith("0 "):
            law["start"] = began
        return {**self.driven(drive), **law}

    def angle_sum(self, start: float, added: float) -> str:
        """The sum of two angles in degrees, not brought into one turn."""
        begun = math.remainder(start, 2 * math.pi)
        return f"{shortest((begun + added) / DEGREE, self.tolerance / self.size / DEGREE)} deg"

    def driven(self, drive: Drive) -> Plain:
        """What a driver moves."""
        if drive.turn is not None:
            found: Plain = {"turn": drive.turn, "about": drive.about}
            return found | ({"relative_to": drive.against} if drive.against != FRAME else {})
        if drive.between is not None:
            return {"between": [".".join(each) for each in drive.between]}
        return {"slide": drive.slide}

    def coordinate(self, drive: Drive) -> float:
        """The coordinate of a driver at the start: rad or m."""
        if drive.turn is not None:
            return self.axis(drive.turn) - self.axis(drive.against)
        if drive.between is not None:
            return math.dist(*(self.layout.body(body).places[point] for body, point in drive.between))
        slide = next(each for each in self.layout.slides if each.name == drive.slide)
        through = self.layout.body(slide.guide).places[slide.through]
        at, line = self.layout.body(slide.block).places[slide.at], self.line(slide)
        return math.cos(line) * (at[0] - through[0]) + math.sin(line) * (at[1] - through[1])

    def force(self, force: Force) -> Plain:
        """A force by its components, or by its direction in the body with which it turns."""
        found: Plain = {"kind": "force", "on": force.on, "at": force.at}
        if not force.follows:
            return found | {"components": [f"{number(each)} N" if each else 0 for each in force.components]}
        x, y = force.components
        direction = math.remainder(math.atan2(y, x) - self.axis(force.on), 2 * math.pi)
        found["in_link"] = f"{shortest(direction / DEGREE, 1e-10)} deg"
        return found | {"magnitude": f"{shortest(math.hypot(x, y), 1e-12)} N"}


def model_text(layout: Layout) -> str:
    """The text of a model file for a layout."""
    return Writer(layout).text()
