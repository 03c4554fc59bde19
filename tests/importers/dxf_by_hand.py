"""An independent reading of DXF skeletons: group codes, layers as roles, positions by tests.importers.planar.

LINK_name: lines and polylines of one link; FRAME: circles, the fixed pins; GUIDE_name: a line that a link (or the
frame) carries; BLOCK_name: an outline whose centre slides on it; GEAR_name: a pitch circle; DRIVER: a text with rpm.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field

import numpy as np
from tests.importers.planar import FRAME, Place, Planar

#: Metres of a unit, by $INSUNITS.
UNITS = {0: 1e-3, 1: 0.0254, 4: 1e-3, 5: 1e-2, 6: 1.0}


@dataclass
class Item:
    """An entity: its kind, and values by group code."""

    kind: str
    values: dict[int, list[str]] = field(default_factory=dict)
    vertices: list[Item] = field(default_factory=list)

    def numbers(self, code: int) -> list[float]:
        return [float(each) for each in self.values.get(code, [])]

    def number(self, code: int, default: float = 0.0) -> float:
        return (self.numbers(code) or [default])[0]

    def text(self, code: int) -> str:
        return self.values.get(code, [""])[0]


@dataclass
class Drawn:
    """An entity where it is drawn: points of a line, or one centre with a radius, or one place with a text."""

    layer: str
    points: list[Place]
    radius: float = 0.0
    text: str = ""
    closed: bool = False


def items(text: str) -> list[Item]:
    """All entities and marks of sections, in their order; vertices belong to their polyline."""
    lines = [each.strip() for each in text.splitlines()]
    found: list[Item] = []
    for code, value in zip(lines[::2], lines[1::2], strict=False):
        if code == "0":
            found.append(Item(value))
        elif found:
            found[-1].values.setdefault(int(code), []).append(value)
    kept: list[Item] = []
    for each in found:
        if each.kind == "VERTEX":
            kept[-1].vertices.append(each)
        elif each.kind != "SEQEND":
            kept.append(each)
    return kept


class Drawing:
    """The entities of a text, blocks put where they are inserted, in metres."""

    def __init__(self, text: str) -> None:
        self.unit, section, block = 1e-3, "", ""
        self.blocks: dict[str, list[Item]] = {}
        self.drawn: list[Drawn] = []
        found = re.search(r"\$INSUNITS\s+70\s+(\d+)", text)
        if found:
            self.unit = UNITS[int(found[1])]
        for each in items(text):
            if each.kind == "SECTION":
                section = each.text(2)
            elif each.kind == "BLOCK":
                block = each.text(2)
            elif section == "BLOCKS" and each.kind != "ENDBLK":
                self.blocks.setdefault(block, []).append(each)
            elif section == "ENTITIES":
                self.drawn += self.place(each)

    def place(self, item: Item) -> list[Drawn]:
        flip = -1.0 if item.number(230, 1.0) < 0 else 1.0
        if item.kind == "INSERT":
            inner = [each for part in self.blocks[item.text(2)] for each in self.place(part)]
            return [self.inserted(each, item, flip) for each in inner]
        pairs = list(zip(item.numbers(10), item.numbers(20), strict=True))
        if item.kind == "LINE":
            flip = 1.0  # its ends are in the drawing's own axes
            pairs += zip(item.numbers(11), item.numbers(21), strict=True)
        if item.kind == "POLYLINE":
            pairs = [(each.number(10), each.number(20)) for each in item.vertices]
        if item.kind not in ("LINE", "POLYLINE", "LWPOLYLINE", "CIRCLE", "TEXT"):
            return []
        points = [(flip * x * self.unit, y * self.unit) for x, y in pairs]
        closed = bool(int(item.number(70)) & 1)
        return [Drawn(item.text(8), points, item.number(40) * self.unit, item.text(1), closed)]

    def inserted(self, each: Drawn, item: Item, flip: float) -> Drawn:
        angle, sx, sy = math.radians(item.number(50)), item.number(41, 1.0), item.number(42, 1.0)
        x0, y0 = item.number(10) * self.unit, item.number(20) * self.unit
        cos, sin = math.cos(angle), math.sin(angle)
        points = [
            (flip * (x0 + cos * sx * x - sin * sy * y), y0 + sin * sx * x + cos * sy * y) for x, y in each.points
        ]
        layer = item.text(8) if each.layer == "0" else each.layer
        return Drawn(layer, points, each.radius * abs(sx), each.text, each.closed)


def near(one: Place, other: Place) -> bool:
    return math.dist(one, other) < 1e-7


class Reading:
    """The machine of a drawing with layers."""

    def __init__(self, text: str) -> None:
        self.drawn = Drawing(text).drawn
        self.machine = Planar()
        self.places: dict[str, list[Place]] = {}
        for each in self.drawn:
            role, name = self.role(each)
            if role in ("LINK", "GEAR") and not each.text:
                self.hold(name, each.points)
            elif role == "FRAME" and each.radius:
                self.hold(FRAME, each.points)
            elif role == "BLOCK":
                self.hold(name, [self.centre(each)])
        self.pins()
        for each in self.drawn:
            if self.role(each)[0] == "GUIDE":
                self.guide(each)
        self.gears()
        self.driver()

    @staticmethod
    def role(each: Drawn) -> tuple[str, str]:
        role, _, name = each.layer.partition("_")
        name = name or "frame"
        return role.upper(), FRAME if name.lower() == "frame" else name

    @staticmethod
    def centre(each: Drawn) -> Place:
        """Of a circle, or of the corners of an outline."""
        x, y = np.mean(each.points, axis=0)
        return float(x), float(y)

    def hold(self, name: str, places: list[Place]) -> None:
        self.machine.body(name)
        self.places.setdefault(name, []).extend(places)

    def pins(self) -> None:
        """Each link is pinned to the first one that has the same place."""
        first: list[tuple[Place, str]] = []
        for name in sorted(self.places, key=lambda name: name != FRAME):
            for place in self.places[name]:
                other = next((body for at, body in first if near(at, place)), None)
                if other is None:
                    first.append((place, name))
                elif other != name:
                    self.machine.pin(other, name, place)

    def guide(self, each: Drawn) -> None:
        carrier, (p, q) = self.role(each)[1], each.points
        angle = math.atan2(q[1] - p[1], q[0] - p[0])

        def off(place: Place) -> float:
            return abs(math.cos(angle) * (place[1] - p[1]) - math.sin(angle) * (place[0] - p[0]))

        blocks = [(self.role(b)[1], self.centre(b)) for b in self.drawn if self.role(b)[0] == "BLOCK"]
        name, at = next((name, place) for name, place in blocks if name != carrier and off(place) < 1e-7)
        self.machine.slide(carrier, name, at, angle, p)
        self.machine.parallel(name, carrier)

    def gears(self) -> None:
        wheels = [(self.role(each)[1], each) for each in self.drawn if self.role(each)[0] == "GEAR"]
        for k, (a, one) in enumerate(wheels):
            for b, other in wheels[:k]:
                apart = math.dist(one.points[0], other.points[0])
                if abs(apart - one.radius - other.radius) < 1e-7:
                    self.machine.coupled(a, b, FRAME, -one.radius / other.radius)
                elif abs(apart - abs(one.radius - other.radius)) < 1e-7:
                    self.machine.coupled(a, b, FRAME, one.radius / other.radius)

    def driver(self) -> None:
        sign = next(each for each in self.drawn if self.role(each)[0] == "DRIVER" and each.text)
        found = re.search(r"(-?\d+(?:\.\d+)?) *rpm", sign.text)
        assert found is not None
        rate = float(found[1]) * math.pi / 30
        pin = min(self.places[FRAME], key=lambda place: math.dist(place, sign.points[0]))
        name = next(name for name, each in self.places.items() if name != FRAME and any(near(p, pin) for p in each))
        self.machine.turn(name, FRAME, lambda t: rate * t)

    def positions(self, times: list[float]) -> list[tuple[Place, np.ndarray]]:
        """Each place of a moving link at the start, and where it is at the times."""
        points = {
            f"{name} {k}": (name, place)
            for name, places in self.places.items()
            if name != FRAME
            for k, place in enumerate(places)
        }
        found = self.machine.positions(times, points, 4)
        return [(points[key][1], rows) for key, rows in found.items()]
