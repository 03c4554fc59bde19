"""What a file of Linkage says: its connectors, links and ratios with their lines, lengths in m."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from linkwright.importers.layout import Remarks
from linkwright.importers.xml_tree import Element, parse_xml
from linkwright.mechanism.link import Vec
from linkwright.words import _

#: Length of a unit of the file (96 to the inch), m.
PIXEL = 0.0254 / 96
#: Digits after the point that the program writes.
DECIMALS = 6
#: Bit of the layer on which the mechanism is; all else is drawing.
MECHANISM = 16
#: Cycles a minute of an actuator that does not say them.
DEFAULT_RATE = 15.0

_LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
_ATTRIBUTE = re.compile(r'([\w:.-]+\s*=\s*)"([^"]*)"(?=(\w?))')
_BACKGROUND = re.compile(r"<background[^>]*>\s*[^<\s]")
_ENTITY = re.compile(r"&(?!(?:#\d+|#x[0-9a-fA-F]+|amp|lt|gt|quot|apos);)")


@dataclass
class Connector:
    """A pin or a point; ``limits``: the connectors between which it slides, on an arc of ``radius`` where not 0."""

    number: int
    line: int
    name: str
    place: Vec
    anchor: bool
    input: bool
    rpm: float
    slider: bool
    limits: tuple[int, ...]
    radius: float
    draw: bool
    circle: bool
    manual: bool
    fastened: int | None
    shown_only: bool

    @property
    def shown(self) -> str:
        """How the program shows it: by its name or its letter."""
        letter, turns = _LETTERS[self.number % 52], self.number // 52
        return self.name or (f"{letter}{turns}" if turns else letter)


@dataclass
class LinkElement:
    """A link; ``rate``: cycles a minute of an actuator, ``throw``: how much it extends (None: not given)."""

    number: int
    line: int
    name: str
    connectors: list[int]
    held: list[int]
    fastened_link: int | None
    fastened_connector: int | None
    gear: bool
    actuator: bool
    throw: float | None
    rate: float
    manual: bool
    colour: str
    shown_only: bool
    measure: bool

    @property
    def key(self) -> str:
        """What findings call it."""
        return self.name or f'Link id="{self.number}"'


@dataclass
class Ratio:
    """Two wheels by the ids of their links and their sizes; ``radii``: the sizes of a chain's wheels are radii, m."""

    line: int
    gears: bool
    radii: bool
    links: list[int]
    sizes: list[float]


@dataclass
class LinkageFile:
    """A file; of elements that share an id the first one is meant."""

    inches: bool = False
    precise: bool = False
    connectors: dict[int, Connector] = field(default_factory=dict)
    links: list[LinkElement] = field(default_factory=list)
    ratios: list[Ratio] = field(default_factory=list)

    def link(self, number: int | None) -> LinkElement | None:
        """The first link of an id."""
        return next((each for each in self.links if each.number == number), None)


def read_file(text: str, remarks: Remarks) -> LinkageFile | None:
    """The file of a text; None, with an error among the remarks, where it is none."""
    root = parse_xml(mended(text, remarks), remarks)
    if root is None:
        return None
    if root.tag != "linkage2":
        message = _("the root is <{tag}>, and not <linkage2>", tag=root.tag)
        remarks.remark("error", message, _("give a file of Linkage"), "import.linkage_root", line=root.line)
        return None
    file = LinkageFile()
    for each in root.all("program"):
        file.inches = each.get("units").lower() == "inches"
        if _integer(each.get("scalefactor")) not in (0, 1):
            message = _("the scale {scale} of the drawing is left out", scale=each.get("scalefactor"))
            remedy = _("lengths are those of the file, 96 to the inch")
            remarks.remark("note", message, remedy, "import.linkage_scale", line=each.line)
    for each in root.all("background") if _BACKGROUND.search(text) else ():
        message = _("the picture in the background is left out")
        remarks.remark("note", message, _("keep it with the other file"), "import.linkage_background", line=each.line)
    places = [each.get(name) for each in root.all("connector") for name in ("x", "y")]
    file.precise = any(len(each.partition(".")[2]) > DECIMALS for each in places)
    for each in root.all("connector"):
        connector = _connector(each, remarks)
        if connector.number in file.connectors:
            message = _("the id {id} is already taken; this connector is left out", id=connector.number)
            remedy = _("give it an id of its own")
            remarks.remark("warning", message, remedy, "import.linkage_id", line=each.line, key=connector.shown)
        file.connectors.setdefault(connector.number, connector)
    file.links = [_link(each, remarks) for each in root.all("Link", "element")]
    file.ratios = [_ratio(each, remarks) for ratios in root.all("ratios") for each in ratios.all("ratio")]
    return file


def mended(text: str, remarks: Remarks) -> str:
    """The text with what the program writes although it is no XML: attributes without a blank between them, & and <
    in names."""
    stuck: list[int] = []

    def mend(found: re.Match[str]) -> str:
        if found[3]:
            stuck.append(text.count("\n", 0, found.start()) + 1)
        value = _ENTITY.sub("&amp;", found[2]).replace("<", "&lt;")
        return f'{found[1]}"{value}"' + (" " if found[3] else "")

    text = text if text.lstrip().startswith("<") else text.lstrip("\x00\ufeff")
    repaired = _ATTRIBUTE.sub(mend, text)
    for line in dict.fromkeys(stuck):
        message = _(
            "two attributes stand without a blank between them, so that this is no XML; read as if it were there"
        )
        remarks.remark("note", message, _("write a blank"), "import.linkage_blank", line=line)
    return repaired


def _connector(element: Element, remarks: Remarks) -> Connector:
    x, y = (number(element, name, remarks) * PIXEL for name in ("x", "y"))
    return Connector(
        number=_integer(element.get("id")),
        line=element.line,
        name=element.get("name").strip(),
        place=(x, y),
        anchor=element.get("anchor") == "true",
        input=element.get("input") == "true",
        rpm=number(element, "rpm", remarks),
        slider=element.get("slider") == "true",
        limits=tuple(_integer(each.get("id")) for each in element.all("slidelimit"))[:2],
        radius=number(element, "slideradius", remarks) * PIXEL,
        draw=element.get("draw") == "true",
        circle=number(element, "drawcircle", remarks) != 0,
        manual=element.get("alwaysmanual") == "true",
        fastened=_reference(element, "fasten", "fastenlink"),
        shown_only=_shown_only(element),
    )


def _link(element: Element, remarks: Remarks) -> LinkElement:
    rate = number(element, "cpm", remarks) if element.get("cpm") else DEFAULT_RATE
    return LinkElement(
        number=_integer(element.get("id")),
        line=element.line,
        name=element.get("name").strip(),
        connectors=list(dict.fromkeys(_ids(element, "connector"))),
        held=list(_ids(element, "fastenconnector")),
        fastened_link=_reference(element, "fastenlink"),
        fastened_connector=_reference(element, "fastenconnector"),
        gear=element.get("gear") == "true",
        actuator=element.get("actuator") == "true",
        throw=number(element, "throw", remarks) * PIXEL if element.get("throw") else None,
        rate=rate,
        manual=element.get("alwaysmanual") == "true",
        colour=_colour(element.get("color")),
        shown_only=_shown_only(element),
        measure=element.get("measurementelement") == "true",
    )


def _ratio(element: Element, remarks: Remarks) -> Ratio:
    wheels = list(element.all("link"))
    radii = element.get("sizeassize") == "true" and element.get("type") != "gears"
    return Ratio(
        line=element.line,
        gears=element.get("type") == "gears",
        radii=radii,
        links=[_integer(each.get("id")) for each in wheels],
        sizes=[number(each, "size", remarks) * (PIXEL if radii else 1.0) for each in wheels],
    )


def number(element: Element, name: str, remarks: Remarks) -> float:
    """The number in an attribute; 0 where it is missing, and, with an error, where it is none."""
    text = element.get(name).strip()
    try:
        value = float(text or 0)
    except ValueError:
        value = math.nan
    if math.isfinite(value):
        return value
    message = _("{name} is no number: {text}", name=name, text=text)
    remarks.remark("error", message, _("write a number"), "import.linkage_number", line=element.line, key=name)
    return 0.0


def _integer(text: str) -> int:
    """The integer with which a text begins; 0 where there is none."""
    found = re.match(r"\s*[+-]?\d+", text)
    return int(found[0]) if found else 0


def _ids(element: Element, tag: str) -> Iterator[int]:
    return (_integer(each.get("id")) for each in element.all(tag))


def _reference(element: Element, *names: str) -> int | None:
    """The id in the first of some attributes that is there."""
    return next((_integer(element.get(name)) for name in names if element.get(name)), None)


def _shown_only(element: Element) -> bool:
    """Whether an element is not on the layer of the mechanism."""
    layer = _integer(element.get("layer")) or MECHANISM
    return not layer & MECHANISM


def _colour(text: str) -> str:
    """A colour from its number, whose lowest byte is red; empty where there is none."""
    value = _integer(text)
    return f"#{value & 255:02x}{value >> 8 & 255:02x}{value >> 16 & 255:02x}" if text.strip().isdigit() else ""
