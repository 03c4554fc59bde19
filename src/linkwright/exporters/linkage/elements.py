"""Elements of a file of Linkage: connectors, links, pairs of wheels, and their text."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass, field

from linkwright.mechanism.link import Vec
from linkwright.units import number

#: Length of a unit of the file, 96 to the inch, m.
PIXEL = 0.0254 / 96
#: The layer of the mechanism.
LAYER = "16"


@dataclass
class Connector:
    """A connector at a place (m); ``rpm``: of an input, clockwise; ``limits``: between which it slides."""

    number: int
    name: str
    place: Vec
    anchor: bool
    rpm: float | None = None
    limits: tuple[int, int] | None = None


@dataclass
class LinkElement:
    """A link by its connectors; an actuator has a ``throw`` (m) and a ``rate`` in cycles a minute."""

    number: int
    name: str
    connectors: list[int]
    colour: str = ""
    gear: bool = False
    fastened_link: int | None = None
    fastened_connector: int | None = None
    throw: float | None = None
    rate: float = 0.0


@dataclass
class Ratio:
    """Two wheels by their links; ``radii``: the sizes are a chain's radii, m."""

    gears: bool
    links: tuple[int, int]
    sizes: tuple[float, float]
    radii: bool = False


@dataclass
class Elements:
    """All elements of a file."""

    connectors: list[Connector] = field(default_factory=list)
    links: list[LinkElement] = field(default_factory=list)
    ratios: list[Ratio] = field(default_factory=list)

    def connector(self, name: str, place: Vec, *, anchor: bool) -> Connector:
        """A new connector; its name is changed where another one has it."""
        taken = {each.name for each in self.connectors}
        found, count = name, 1
        while found in taken:
            count += 1
            found = f"{name}_{count}"
        self.connectors.append(Connector(len(self.connectors), found, place, anchor))
        return self.connectors[-1]

    def link(self, name: str, connectors: list[int]) -> LinkElement:
        """A new link."""
        self.links.append(LinkElement(len(self.links), name, connectors))
        return self.links[-1]

    def content(self) -> bytes:
        """The file; lengths with all their digits."""
        root = ET.Element("linkage2")
        ET.SubElement(root, "program", zoom="1", xoffset="0", yoffset="0", scalefactor="1", units="Millimeters")
        for connector in self.connectors:
            _connector(root, connector)
        for link in self.links:
            _link(root, link)
        if self.ratios:
            ratios = ET.SubElement(root, "ratios")
            for ratio in self.ratios:
                kind, radii = "gears" if ratio.gears else "chain", "true" if ratio.radii else "false"
                element = ET.SubElement(ratios, "ratio", type=kind, sizeassize=radii)
                for index, size in zip(ratio.links, ratio.sizes, strict=True):
                    ET.SubElement(element, "link", id=str(index), size=number(size / PIXEL if ratio.radii else size))
        ET.indent(root)
        return ET.tostring(root, encoding="unicode").encode() + b"\n"


def _connector(root: ET.Element, connector: Connector) -> None:
    x, y = (number(each / PIXEL + 0.0) for each in connector.place)
    element = ET.SubElement(root, "connector", id=str(connector.number), name=connector.name, layer=LAYER, x=x, y=y)
    if connector.anchor:
        element.set("anchor", "true")
    if connector.rpm is not None:
        element.set("input", "true")
        element.set("rpm", number(connector.rpm))
    if connector.limits is not None:
        element.set("slider", "true")
        for limit in connector.limits:
            ET.SubElement(element, "slidelimit", id=str(limit))


def _link(root: ET.Element, link: LinkElement) -> None:
    element = ET.SubElement(root, "Link", id=str(link.number))
    if link.name:
        element.set("name", link.name)
    element.set("layer", LAYER)
    if link.throw is not None:
        element.attrib |= {"actuator": "true", "throw": number(link.throw / PIXEL), "cpm": number(link.rate)}
    if link.fastened_link is not None:
        element.set("fastenlink", str(link.fastened_link))
    if link.fastened_connector is not None:
        element.set("fastenconnector", str(link.fastened_connector))
    if link.gear:
        element.set("gear", "true")
    if link.colour:
        red, green, blue = (int(link.colour[k : k + 2], 16) for k in (1, 3, 5))
        element.set("color", str(red | green << 8 | blue << 16))
    for each in link.connectors:
        ET.SubElement(element, "connector", id=str(each))
