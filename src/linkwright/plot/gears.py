"""Gears in mesh, drawn with their circles and the path of contact; racks with their datum line."""

from __future__ import annotations

import math

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import number
from linkwright.errors import require_language
from linkwright.gears.gear import Gear
from linkwright.gears.pair import GearPair
from linkwright.gears.rack import Rack
from linkwright.pictures.drawing import Box, Drawing, bounds, captioned
from linkwright.pictures.picture import Circle, Line, SvgNode
from linkwright.pictures.svg.element import element, path_data
from linkwright.pictures.symbols.base import points, ring, vec
from linkwright.words import Message, _

DIAGONAL = 760.0
#: Thickness of a ring outside its roots, modules.
RIM = 2.5


def draw_pair(pair: GearPair, pinion_angle: float = 0.0, language: str = "en") -> Drawing:
    """Outlines of both gears; rolling circles as chain lines, base circles thin, the path of contact thick."""
    require_language(language)
    outlines = pair.outlines(pinion_angle)
    centres = (np.zeros(2), np.array([pair.centre_sign, 0.0]))
    extent = [_extent(gear, at) for gear, at in zip((pair.pinion, pair.wheel), centres, strict=True)]
    scale = DIAGONAL / float(np.hypot(*np.ptp(np.concatenate(extent), axis=0)))

    def paper(places: Floats) -> Floats:
        return np.asarray(places) * (scale, -scale)

    content: list[SvgNode] = []
    gears = ((pair.wheel, outlines[1], centres[1]), (pair.pinion, outlines[0], centres[0]))
    for gear, outline, at in gears:
        content.append(_body(gear, paper(outline), paper(at), scale))
    for gear, _unused, at in gears:
        content += _circles(pair, gear, vec(paper(at)), scale)
    content.append(Line(paper(contact_line(pair)), "lw-input-line"))
    box = bounds([paper(each) for each in extent])
    title = _("Gear pair {first} : {second}", first=pair.pinion.teeth, second=pair.wheel.teeth).translate(
        language
    )
    return Drawing(captioned(content, box, _lines(pair, language), title), tuple(map(str, pair.findings)))


def draw_rack(rack: Rack, language: str = "en") -> Drawing:
    """The outline of a rack and its datum line, on which pinions without profile shift roll."""
    require_language(language)
    outline = rack.outline()
    scale = DIAGONAL / float(np.hypot(*np.ptp(outline, axis=0)))
    paper = outline * (scale, -scale)
    box = bounds([paper])
    datum = points([(box[0] - 12.0, 0.0), (box[2] + 12.0, 0.0)])
    line = _(
        "z = {teeth}, m = {module} mm, p = {pitch} mm, α = {angle}°",
        teeth=rack.teeth,
        module=number(rack.module, "length"),
        pitch=number(rack.pitch, "length", 7),
        angle=number(rack.pressure_angle, "angle"),
    ).translate(language)
    content = [Line(paper, "lw-gear", closed=True), Line(datum, "lw-pitch")]
    wider: Box = (box[0] - 12.0, box[1], box[2] + 12.0, box[3])
    return Drawing(
        captioned(content, wider, [line], _("Rack of {teeth} teeth", teeth=rack.teeth).translate(language))
    )


def contact_line(pair: GearPair) -> Floats:
    """The path of contact, (2, 2) m: on the common tangent of the base circles through the pitch point."""
    alpha, base = pair.working_pressure_angle, 0.5 * pair.pinion.base_diameter
    foot = base * np.array([math.cos(alpha), math.sin(alpha)])
    along = np.array([math.sin(alpha), -math.cos(alpha)])
    return np.array([foot + length * along for length in pair.path_of_contact])


def _body(gear: Gear, outline: Floats, at: Floats, scale: float) -> SvgNode:
    if not gear.internal:
        return Line(outline, "lw-gear", closed=True)
    rim = ring(vec(at), scale * _outer_radius(gear), 180)
    data = path_data(outline, closed=True) + path_data(rim, closed=True)
    return element("path", {"class": "lw-gear", "fill-rule": "evenodd", "d": data})


def _circles(pair: GearPair, gear: Gear, at: tuple[float, float], scale: float) -> list[SvgNode]:
    rolling = 0.5 * gear.base_diameter / math.cos(pair.working_pressure_angle)
    arm = 6.0
    return [
        Circle(at, scale * rolling, "lw-pitch"),
        Circle(at, 0.5 * scale * gear.base_diameter, "lw-hatch"),
        Line(points([(at[0] - arm, at[1]), (at[0] + arm, at[1])]), "lw-hatch"),
        Line(points([(at[0], at[1] - arm), (at[0], at[1] + arm)]), "lw-hatch"),
    ]


def _lines(pair: GearPair, language: str) -> list[str]:
    numbers = _(
        "z = {first} : {second}, m = {module} mm, a = {distance} mm, working pressure angle "
        "{angle}°, contact ratio {ratio}",
        first=pair.pinion.teeth,
        second=pair.wheel.teeth,
        module=number(pair.pinion.module, "length"),
        distance=number(pair.centre_distance, "length", 7),
        angle=number(pair.working_pressure_angle, "angle"),
        ratio=f"{pair.contact_ratio:.4g}",
    ).translate(language)
    said = [each.say(language) if isinstance(each, Message) else each for each in pair.findings]
    return [numbers, *said]


def _outer_radius(gear: Gear) -> float:
    return 0.5 * gear.root_diameter + RIM * gear.module


def _extent(gear: Gear, at: Floats) -> Floats:
    radius = _outer_radius(gear) if gear.internal else 0.5 * gear.tip_diameter
    return np.array([at - radius, at + radius])
