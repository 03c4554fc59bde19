"""A second reading of Linkage files (.linkage2), from the description of the format, for the solver of these tests.

Independent of the package. 96 units are an inch, y points up, a positive rpm is clockwise; links that hold only
anchors are the frame, a link that is fastened to another one moves with it, a connector with two limits stays on the
line, or the arc, between them.
"""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass, field

from tests.importers.planar import FRAME, Place, Planar

METRE = 0.0254 / 96
TURNS = -math.tau / 60


@dataclass
class Connector:
    """A connector: where it is (m), and in which bodies."""

    number: str
    name: str
    place: Place
    anchor: bool
    bodies: list[str] = field(default_factory=list)

    @property
    def on(self) -> str:
        """The body that it is followed on: the frame where it is an anchor."""
        return FRAME if self.anchor else next(iter(self.bodies), FRAME)


@dataclass
class ByHand:
    """What a file says, for the solver; ``rates``: of its inputs, rad/s; ``period``: of its actuators, s."""

    machine: Planar = field(default_factory=Planar)
    connectors: dict[str, Connector] = field(default_factory=dict)
    rates: list[float] = field(default_factory=list)
    period: float = 0.0


def by_hand(text: str) -> ByHand:
    """Reads a file."""
    root = ET.fromstring(re.sub(r'(=\s*"[^"]*")(?=\w)', r"\1 ", text))
    found = ByHand()
    for each in root.findall("connector"):
        if layer(each):
            number, place = each.get("id", ""), (float(each.get("x", 0)) * METRE, float(each.get("y", 0)) * METRE)
            found.connectors[number] = Connector(number, each.get("name", ""), place, each.get("anchor") == "true")
    links = [each for tag in ("Link", "element") for each in root.findall(tag) if layer(each)]
    links = [each for each in links if each.get("measurementelement") != "true"]
    bodies = bodies_of(found, links)
    for each in found.connectors.values():
        first, *others = dict.fromkeys([FRAME] * each.anchor + each.bodies)
        for other in others:
            found.machine.pin(first, other, each.place)
    for each in root.findall("connector"):
        if each.get("slider") == "true" and each.get("id") in found.connectors:
            slider(found, each)
        if each.get("input") == "true":
            turning(found, each)
    for each in links:
        if each.get("actuator") == "true":
            actuator(found, each)
    for ratio in root.iterfind("ratios/ratio"):
        coupled(found, ratio, {each.get("id"): (each, body) for each, body in zip(links, bodies, strict=True)})
    return found


def layer(element: ET.Element) -> bool:
    """Whether an element belongs to the mechanism, not to the drawing."""
    return bool(int(element.get("layer", "16")) & 16)


def bodies_of(found: ByHand, links: list[ET.Element]) -> list[str]:
    """The bodies of links: the frame, a body of its own, that of the link to which it is fastened."""
    bodies = []
    for place, link in enumerate(links):
        held = [found.connectors[each.get("id", "")] for each in link.findall("connector")]
        bodies.append(
            FRAME if held and all(each.anchor for each in held) and link.get("gear") != "true" else f"L{place}"
        )
    for place, link in enumerate(links):
        for attribute in ("fastenlink", "fasten"):
            if link.get(attribute):
                owner = next(k for k, each in enumerate(links) if each.get("id") == link.get(attribute))
                bodies[place] = bodies[owner]
        anchor = found.connectors.get(link.get("fastenconnector", ""))
        if anchor is not None and anchor.anchor:
            bodies[place] = FRAME
    for link, body in zip(links, bodies, strict=True):
        for each in link.findall("connector") if link.get("actuator") != "true" else ():
            found.connectors[each.get("id", "")].bodies.append(body)
    return bodies


def slider(found: ByHand, element: ET.Element) -> None:
    """A connector on the line or arc between its limits, which share a link."""
    limits = [found.connectors[each.get("id", "")] for each in element.findall("slidelimit")]
    if len(limits) < 2:
        return
    a, b = limits[:2]
    shared = [each for each in a.bodies if each in b.bodies] or ([FRAME] if a.anchor and b.anchor else [])
    if not shared:
        return
    guide, pin = shared[0], found.connectors[element.get("id", "")]
    radius = abs(float(element.get("slideradius", "0"))) * METRE
    if not radius:
        found.machine.slide(
            guide, pin.on, pin.place, math.atan2(b.place[1] - a.place[1], b.place[0] - a.place[0]), a.place
        )
        return
    half = math.dist(a.place, b.place) / 2
    radius = max(radius, half + 0.0009 * METRE)
    middle = ((a.place[0] + b.place[0]) / 2, (a.place[1] + b.place[1]) / 2)
    away = math.sqrt(radius**2 - half**2) / (2 * half)
    centres = [
        (middle[0] - side * away * (b.place[1] - a.place[1]), middle[1] + side * away * (b.place[0] - a.place[0]))
        for side in (1, -1)
    ]
    centre = min(centres, key=lambda each: abs(math.dist(each, pin.place) - radius))
    found.machine.distance(guide, centre, pin.on, pin.place, lambda _t: radius)


def turning(found: ByHand, element: ET.Element) -> None:
    """The links at an input turn."""
    rate = TURNS * float(element.get("rpm", "0"))
    connector = found.connectors[element.get("id", "")]
    found.rates.append(rate)
    for body in dict.fromkeys(connector.bodies):
        if body != FRAME:
            found.machine.turn(body, FRAME, lambda t: rate * t)


def actuator(found: ByHand, link: ET.Element) -> None:
    """A link of two connectors whose length goes to and fro at constant speed, longer first."""
    a, b = (found.connectors[each.get("id", "")] for each in link.findall("connector"))
    throw, cycles = float(link.get("throw", "0")) * METRE, float(link.get("cpm", "0"))
    length, period = math.dist(a.place, b.place), 60 / abs(cycles)
    gone, found.period = math.copysign(throw, cycles), max(found.period, period)

    def law(t: float) -> float:
        part = t / period % 1
        return length + gone * (2 * part if part <= 0.5 else 2 - 2 * part)

    found.machine.distance(a.on, a.place, b.on, b.place, law)


def coupled(found: ByHand, ratio: ET.Element, links: dict[str | None, tuple[ET.Element, str]]) -> None:
    """Two wheels on their common carrier."""
    (one, first), (two, second) = (
        (links[each.get("id")], float(each.get("size", "1"))) for each in ratio.findall("link")
    )
    centres = [found.connectors[each[0].find("connector").get("id", "")] for each in (one, two)]  # type: ignore[union-attr]
    common = [each for each in centres[0].bodies if each in centres[1].bodies]
    carrier = FRAME if all(each.anchor for each in centres) else common[0]
    sign = -1 if ratio.get("type") == "gears" else 1
    found.machine.coupled(one[1], two[1], carrier, sign * first / second)
