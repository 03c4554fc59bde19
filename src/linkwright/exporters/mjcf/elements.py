"""The XML elements of bodies, of what closes their loops, and of numbers in them."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping, Sequence

from linkwright.elements import Connection
from linkwright.exporters.mjcf.bodies import Body, Chains, Vec, rider, span
from linkwright.exporters.mjcf.couplings import Coupling
from linkwright.exporters.mjcf.loops import Loop, cut_name
from linkwright.fields.colour import as_rgb
from linkwright.mechanism.link import Link
from linkwright.words.characters import printable

#: Smallest mass of a body as a share of the largest one.
MIN_MASS = 1e-3
#: Inertia of a driver against all that it moves; a heavy driver keeps its speed.
HEAVY = 1e5


def numbers(values: Iterable[float]) -> str:
    """Numbers with all their digits, separated by spaces."""
    return " ".join(repr(float(value) + 0.0).removesuffix(".0") for value in values)


def written(root: ET.Element) -> bytes:
    """The indented XML document."""
    ET.indent(root)
    for element in root.iter():
        for name, value in element.attrib.items():
            element.attrib[name] = printable(value)
    return b'<?xml version="1.0" encoding="utf-8"?>\n' + ET.tostring(root, encoding="unicode").encode() + b"\n"


def compiler(chains: Chains) -> ET.Element:
    """Angles in rad; MuJoCo moves no massless body, so that all get a smallest mass and moment of inertia."""
    links = chains.mechanism.links.values()
    mass = MIN_MASS * (max((link.mass for link in links), default=0.0) or 1.0)
    inertias = [link.inertia or mass * (span(link) or 0.1 * size(chains)) ** 2 / 12 for link in links]
    bounds = {"boundmass": numbers([mass]), "boundinertia": numbers([min(inertias, default=mass)])}
    return ET.Element("compiler", {"angle": "radian", "autolimits": "true", **bounds})


def size(chains: Chains) -> float:
    """Largest distance between two points of a link, m; 1 where no link has two."""
    links = [*chains.mechanism.links.values(), chains.mechanism.frame]
    return max(map(span, links), default=0.0) or 1.0


def world(chains: Chains, reflected: dict[str, float]) -> ET.Element:
    """The world with all bodies; ``reflected``: the inertia that each driver moves, kg·m² or kg."""
    large = size(chains)
    found = {"frame": ET.Element("worldbody")}
    ET.SubElement(found["frame"], "light", pos=numbers((0, 0, 5 * large)), dir="0 0 -1", directional="true")
    _sites(found["frame"], chains.mechanism.frame, large)
    for body in chains.bodies:
        found[body.name] = ET.SubElement(
            found[body.parent],
            "body",
            name=body.name,
            pos=numbers((*body.place, 0.0)),
            quat=numbers((math.cos(body.turn / 2), 0, 0, math.sin(body.turn / 2))),
        )
        _joint(found[body.name], body, chains.index, reflected)
        _matter(found[body.name], body, large)
    return found["frame"]


def _joint(parent: ET.Element, body: Body, index: int, reflected: dict[str, float]) -> None:
    each = body.coordinate
    if each is None:
        return
    attributes = {
        "name": each.name,
        "type": "slide" if each.slides else "hinge",
        "ref": numbers([each.values[index]]),
        "pos": numbers((*each.at, 0.0)),
        "axis": numbers((*each.axis, 0.0) if each.slides else (0.0, 0.0, each.axis[0])),
    }
    if each.driver is not None:
        attributes["armature"] = numbers([HEAVY * reflected[each.driver]])
    ET.SubElement(parent, "joint", attributes)


def _matter(parent: ET.Element, body: Body, large: float) -> None:
    """Mass, points and shape of a body; a rider has none."""
    link = body.link
    place, mass, inertia = ((0.0, 0.0), 0.0, 0.0) if link is None else (link.centre, link.mass, link.inertia)
    matter = {"pos": numbers((*place, 0.0)), "mass": numbers([mass]), "diaginertia": numbers([inertia] * 3)}
    ET.SubElement(parent, "inertial", matter)
    if link is not None:
        _sites(parent, link, large)
        _shape(parent, link, large)


def _sites(body: ET.Element, link: Link, large: float) -> None:
    for point, place in link.points.items():
        small = numbers([0.008 * large])
        ET.SubElement(body, "site", name=f"{link.name}.{point}", pos=numbers((*place, 0.0)), size=small)


def _shape(body: ET.Element, link: Link, large: float) -> None:
    """A capsule between each two points, or a box at the only one, in the colour of the link."""
    colour = as_rgb(link.colour)
    paint = {"rgba": numbers((*(round(each / 255, 4) for each in bytes.fromhex(colour[1:])), 1.0))} if colour else {}
    places = list(link.points.values())
    pairs = list(zip(places, places[1:] + (places[:1] if len(places) > 2 else []), strict=False))
    apart = [(a, b) for a, b in pairs if math.dist(a, b) > 1e-3 * large]
    for a, b in apart:
        ends = numbers((*a, 0.0, *b, 0.0))
        ET.SubElement(body, "geom", {"type": "capsule", "fromto": ends, "size": numbers([0.012 * large]), **paint})
    if not apart:
        half = numbers((0.04 * large, 0.025 * large, 0.012 * large))
        centre: Vec = places[0] if places else (0.0, 0.0)
        ET.SubElement(body, "geom", {"type": "box", "pos": numbers((*centre, 0.0)), "size": half, **paint})


def equality(chains: Chains, loops: Sequence[Loop]) -> ET.Element:
    """Couplings of joints, and for each cut joint its constraint, which is off where couplings close the loop."""
    found = ET.Element("equality")
    for loop in loops:
        for each in loop.couplings:
            found.append(_coupling(f"{each.dependent}({each.independent})", each))
        for cut in loop.cuts:
            off = {"active": "false"} if loop.couplings else {}
            found.append(_constraint(chains, cut, off))
    return found


def _coupling(name: str, each: Coupling, off: Mapping[str, str] | None = None) -> ET.Element:
    names = {"name": name, "joint1": each.dependent, "joint2": each.independent}
    return ET.Element("joint", {**names, "polycoef": numbers(each.factors), **(off or {})})


def _constraint(chains: Chains, cut: Connection, off: Mapping[str, str]) -> ET.Element:
    """A ``connect`` for a cut pin, a ``weld`` to the rider of a cut guide and for a cut weld; a higher pair ties two
    joints to each other, or keeps the sum of more of them, a tendon."""
    name = cut_name(cut)
    if cut.turns:
        sites = {"site1": f"{cut.a}.{cut.joint}", "site2": f"{cut.b}.{cut.joint}"}
        return ET.Element("connect", {"name": name, **sites, **off})
    if cut.higher:
        factors = chains.factors(cut)
        if len(factors) != 2:
            kept = {"tendon1": cut.joint, "polycoef": "0 0 0 0 0"}
            return ET.Element("tendon", {"name": name, **kept, **off})
        # the joint with the smaller factor first: MuJoCo weighs both alike, and the other order would be softer
        (y, small), (x, large) = sorted(factors.items(), key=lambda each: abs(each[1]))
        return _coupling(name, Coupling(y, x, (0.0, -large / small, 0.0, 0.0, 0.0)), off)
    first, second = (link if link != "frame" else "world" for link in (rider(cut) if cut.slides else cut.a, cut.b))
    return ET.Element("weld", {"name": name, "body1": first, "body2": second, **off})


def tendons(chains: Chains) -> ET.Element:
    """For each higher pair of more than two coordinates their sum, as a tendon of fixed factors."""
    found = ET.Element("tendon")
    for cut in chains.cuts:
        if cut.higher and len(factors := chains.factors(cut)) != 2:
            tendon = ET.SubElement(found, "fixed", name=cut.joint)
            for name, factor in factors.items():
                ET.SubElement(tendon, "joint", joint=name, coef=numbers([factor]))
    return found
