"""Cams with their followers, gears in mesh and racks, drawn at true shape."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from linkwright.cams.curves import RollerCurve
from linkwright.cams.result import CamDesign
from linkwright.core.arrays import Floats
from linkwright.core.quantity import number
from linkwright.errors import require_language
from linkwright.gears.gear import Gear
from linkwright.gears.pair import GearPair
from linkwright.gears.rack import Rack
from linkwright.pictures.drawing import Box, Drawing, bounds, captioned
from linkwright.pictures.picture import Circle, Line, SvgNode
from linkwright.pictures.svg.element import element, path_data
from linkwright.pictures.symbols.base import SYMBOLS, Shape, joined, points, ring, vec, way
from linkwright.words import Message, _

GEARS_ACROSS = 760.0
#: Thickness of a ring outside its roots, modules.
RIM = 2.5


def draw_pair(pair: GearPair, pinion_angle: float = 0.0, language: str = "en") -> Drawing:
    """Outlines of both gears; rolling circles as chain lines, base circles thin, the path of contact thick."""
    require_language(language)
    outlines = pair.outlines(pinion_angle)
    centres = (np.zeros(2), np.array([pair.centre_sign, 0.0]))
    extent = [_extent(gear, at) for gear, at in zip((pair.pinion, pair.wheel), centres, strict=True)]
    scale = GEARS_ACROSS / float(np.hypot(*np.ptp(np.concatenate(extent), axis=0)))

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
    scale = GEARS_ACROSS / float(np.hypot(*np.ptp(outline, axis=0)))
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


CAM_ACROSS = 620.0
#: Half the length of the walls between which a stem slides, and their distance.
_GUIDE, _ROOM = 22.0, 5.0


def draw_cam(design: CamDesign, angle: float = 0.0, language: str = "en") -> Drawing:
    """Profiles, pitch curve as a chain line, base circle thin, follower and frame at an angle (rad) of the cam."""
    require_language(language)
    cam = design.cam
    barrel = cam.barrel_radius is not None
    walls = [
        _turned(design.profile(720, k), 0.0 if barrel else cam.turn * angle) for k in range(len(cam.walls))
    ]
    if cam.conjugate is not None and not cam.follower.oscillating:
        walls[1] = -walls[1]
    follower = _follower(design, angle)
    pitch = np.empty((0, 2))
    if cam.follower.kind != "flat":
        pitch = _turned(design.pitch_curve(), 0.0 if barrel else cam.turn * angle)
    cloud = np.concatenate([*walls, pitch, *follower.values()])
    scale = CAM_ACROSS / float(np.hypot(*np.ptp(cloud, axis=0)))

    def paper(places: Floats) -> Floats:
        return np.asarray(places) * (scale, -scale)

    content: list[SvgNode] = []
    for k, wall in enumerate(walls):
        filled = not barrel and k == 0 and cam.closure != "groove"
        content.append(Line(paper(wall), "lw-gear" if filled else "lw-ground", closed=not barrel))
    if len(pitch):
        content.append(Line(paper(pitch), "lw-pitch", closed=not barrel))
    if not barrel:
        content.append(Circle((0.0, 0.0), scale * (cam.base_radius or 0.0), "lw-hatch"))
    frame = _frame(follower, paper, turns=not barrel)
    content += frame.elements
    content += _drawn(follower, paper, scale * cam.follower.roller_radius, cam.follower.kind)
    if cam.conjugate is not None:
        content += _second(design, angle, paper, scale)
    pins = [(0.0, 0.0)] if not barrel else []
    pins += [vec(paper(place)) for place in follower.get("pivot", ())]
    content += [element for at in pins for element in SYMBOLS["pin"](at=at).elements]
    box = bounds([paper(cloud), *frame.ink])
    title = _("{name}", name=design.title).translate(language)
    return Drawing(captioned(content, box, [_line(design, angle, language)], title))


def _turned(places: Floats, angle: float) -> Floats:
    c, s = math.cos(angle), math.sin(angle)
    return np.asarray(places @ np.array([[c, s], [-s, c]]))


def _frame(follower: dict[str, Floats], paper: Callable[[Floats], Floats], *, turns: bool) -> Shape:
    """Supports of the cam and of an oscillating follower, and the guide of a translating one."""
    shapes = [SYMBOLS["fixed_pivot"]()] if turns else []
    for place in follower.get("pivot", ()):
        shapes.append(SYMBOLS["fixed_pivot"](at=vec(paper(place))))
    if "pivot" not in follower and "stem" in follower:
        first, last = paper(follower["stem"])
        guide = {"at": vec(0.35 * first + 0.65 * last), "along": way(first, last)[1]}
        ends = {"start": -_GUIDE, "end": _GUIDE, "height": _ROOM}
        shapes += [SYMBOLS["ground_guide"](**guide, **ends, side=side) for side in (-1, 1)]
    return joined(shapes)


def _follower(design: CamDesign, angle: float) -> dict[str, Floats]:
    """Places (n, 2) of the follower's parts in the frame: roller, arm, stem or face, pivot."""
    cam, follower = design.cam, design.cam.follower
    lift = float(cam.program.curves(np.array([angle]))[0][0])
    size = design.size
    if cam.barrel_radius is not None:
        at = np.array([cam.barrel_radius * angle, lift])
        return {"roller": _round(at, follower.roller_radius)}
    base = cam.base_radius or 0.0
    if not follower.oscillating:
        height = (follower.start_height(base) or 0.0) + lift
        tip = np.array([follower.offset, height])
        top = tip + np.array([0.0, 0.8 * size])
        if follower.kind == "flat":
            low, high = design.face or (0.0, 0.0)
            face = np.array([(low, height), (high, height)])
            return {"face": face, "stem": np.array([tip, top])}
        parts = {"stem": np.array([tip, top])}
    else:
        assert follower.pivot_distance is not None
        psi = (follower.start_angle(base) or 0.0) + lift
        pivot = np.array([follower.pivot_distance, 0.0])
        along = np.array([-math.cos(psi), follower.side * math.sin(psi)])
        if follower.kind == "flat":
            low, high = design.face or (0.0, 0.0)
            toward = np.array([-math.sin(psi), -follower.side * math.cos(psi)]) * follower.face_offset
            face = np.array([pivot + toward + low * along, pivot + toward + high * along])
            return {"face": face, "stem": np.array([pivot, pivot + toward, face[0]]), "pivot": pivot[None]}
        tip = pivot + (follower.arm or 0.0) * along
        parts = {"stem": np.array([pivot, tip]), "pivot": pivot[None]}
    return {**parts, "roller": _round(tip, follower.roller_radius)}


def _round(at: Floats, radius: float) -> Floats:
    """The corners of a roller's square, its centre in the middle."""
    corners = np.array([(-1, -1), (0, 0), (1, 1)])
    return np.asarray(at + radius * corners)


def _drawn(
    parts: dict[str, Floats], paper: Callable[[Floats], Floats], roller: float, kind: str
) -> list[SvgNode]:
    """Stem, face and roller."""
    found: list[SvgNode] = []
    if "stem" in parts:
        found.append(Line(paper(parts["stem"]), "lw-bar"))
    if "face" in parts:
        found.append(Line(paper(parts["face"]), "lw-bar"))
    if "roller" in parts and kind == "roller":
        x, y = paper(parts["roller"][1]).tolist()
        found += [Circle((x, y), roller, "lw-pin"), Circle((x, y), 2.0, "lw-point")]
    return found


def _second(
    design: CamDesign, angle: float, paper: Callable[[Floats], Floats], scale: float
) -> list[SvgNode]:
    """The second roller of a pair, rigid with the first."""
    wall = design.cam.walls[1]
    assert isinstance(wall, RollerCurve)
    at = wall.pitch(np.array([angle]))[0] * np.exp(1j * design.cam.turn * angle)
    if not design.cam.follower.oscillating:
        at = -at
    place = np.array([at[0].real, at[0].imag])
    x, y = paper(place).tolist()
    at_pin, roller = (x, y), scale * wall.follower.roller_radius
    parts: list[SvgNode] = [Circle(at_pin, roller, "lw-pin"), Circle(at_pin, 2.0, "lw-point")]
    pivot = design.cam.follower.pivot_distance
    if design.cam.follower.oscillating and pivot is not None:
        parts.insert(0, Line(paper(np.array([(pivot, 0.0), place])), "lw-bar"))
    return parts


def _line(design: CamDesign, angle: float, language: str) -> str:
    cam = design.cam
    degrees = number(angle, "angle")
    if cam.barrel_radius is not None:
        return _(
            "unrolled, R = {radius} mm, φ = {angle}°",
            radius=number(cam.barrel_radius, "length"),
            angle=degrees,
        ).translate(language)
    radius = number((cam.base_radius or 0.0), "length")
    return _("base circle r = {radius} mm, φ = {angle}°", radius=radius, angle=degrees).translate(language)
