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
from linkwright.pictures.drawing import Drawing, Sketch
from linkwright.pictures.picture import Vec
from linkwright.pictures.svg import element, path_data
from linkwright.pictures.symbols.base import ring, vec, way
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

    sketch = Sketch()
    gears = ((pair.wheel, outlines[1], centres[1]), (pair.pinion, outlines[0], centres[0]))
    for gear, outline, at in gears:
        _body(sketch, gear, paper(outline), vec(paper(at)), scale)
    for gear, _unused, at in gears:
        _circles(sketch, pair, gear, vec(paper(at)), scale)
    sketch.line(paper(contact_line(pair)), "lw-input-line")
    sketch.write_below(_lines(pair, language))
    sketch.notes += map(str, pair.findings)
    title = _("Gear pair {first} : {second}", first=pair.pinion.teeth, second=pair.wheel.teeth)
    return sketch.drawing(title.translate(language))


def draw_rack(rack: Rack, language: str = "en") -> Drawing:
    """The outline of a rack and its datum line, on which pinions without profile shift roll."""
    require_language(language)
    outline = rack.outline()
    scale = GEARS_ACROSS / float(np.hypot(*np.ptp(outline, axis=0)))
    paper, sketch = outline * (scale, -scale), Sketch()
    sketch.line(paper, "lw-gear", closed=True)
    sketch.line([(paper[:, 0].min() - 12.0, 0.0), (paper[:, 0].max() + 12.0, 0.0)], "lw-pitch")
    line = _(
        "z = {teeth}, m = {module} mm, p = {pitch} mm, α = {angle}°",
        teeth=rack.teeth,
        module=number(rack.module, "length"),
        pitch=number(rack.pitch, "length", 7),
        angle=number(rack.pressure_angle, "angle"),
    )
    sketch.write_below([line.translate(language)])
    return sketch.drawing(_("Rack of {teeth} teeth", teeth=rack.teeth).translate(language))


def contact_line(pair: GearPair) -> Floats:
    """The path of contact, (2, 2) m: on the common tangent of the base circles through the pitch point."""
    alpha, base = pair.working_pressure_angle, 0.5 * pair.pinion.base_diameter
    foot = base * np.array([math.cos(alpha), math.sin(alpha)])
    along = np.array([math.sin(alpha), -math.cos(alpha)])
    return np.array([foot + length * along for length in pair.path_of_contact])


def _body(sketch: Sketch, gear: Gear, outline: Floats, at: Vec, scale: float) -> None:
    if not gear.internal:
        sketch.line(outline, "lw-gear", closed=True)
        return
    rim = ring(at, scale * _outer_radius(gear), 180)
    data = path_data(outline, closed=True) + path_data(rim, closed=True)
    sketch.draw([element("path", {"class": "lw-gear", "fill-rule": "evenodd", "d": data})], [rim])


def _circles(sketch: Sketch, pair: GearPair, gear: Gear, at: Vec, scale: float) -> None:
    rolling = 0.5 * gear.base_diameter / math.cos(pair.working_pressure_angle)
    sketch.circle(at, scale * rolling, "lw-pitch")
    sketch.circle(at, 0.5 * scale * gear.base_diameter, "lw-hatch")
    for arm in ((6.0, 0.0), (0.0, 6.0)):
        sketch.line([np.subtract(at, arm), np.add(at, arm)], "lw-hatch")


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
    texts = [each.translate(language) if isinstance(each, Message) else each for each in pair.findings]
    return [numbers, *texts]


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
    walls = [_turned(design.profile(720, k), 0.0 if barrel else cam.turn * angle) for k in range(len(cam.walls))]
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

    sketch = Sketch()
    for k, wall in enumerate(walls):
        filled = not barrel and k == 0 and cam.closure != "groove"
        sketch.line(paper(wall), "lw-gear" if filled else "lw-ground", closed=not barrel)
    if len(pitch):
        sketch.line(paper(pitch), "lw-pitch", closed=not barrel)
    if not barrel:
        sketch.circle((0.0, 0.0), scale * (cam.base_radius or 0.0), "lw-hatch")
    _frame(sketch, follower, paper, turns=not barrel)
    for part in ("stem", "face"):
        if part in follower:
            sketch.line(paper(follower[part]), "lw-bar")
    if "roller" in follower and cam.follower.kind == "roller":
        _roller(sketch, paper(follower["roller"][1]), scale * cam.follower.roller_radius)
    if cam.conjugate is not None:
        _second(sketch, design, angle, paper, scale)
    for at in ([np.zeros(2)] if not barrel else []) + [paper(place) for place in follower.get("pivot", ())]:
        sketch.put("pin", at=vec(at))
    sketch.write_below([_line(design, angle, language)])
    return sketch.drawing(_("{name}", name=design.title).translate(language))


def _turned(places: Floats, angle: float) -> Floats:
    c, s = math.cos(angle), math.sin(angle)
    return np.asarray(places @ np.array([[c, s], [-s, c]]))


def _frame(sketch: Sketch, follower: dict[str, Floats], paper: Callable[[Floats], Floats], *, turns: bool) -> None:
    """Supports of the cam and of an oscillating follower, and the guide of a translating one."""
    if turns:
        sketch.put("fixed_pivot")
    for place in follower.get("pivot", ()):
        sketch.put("fixed_pivot", at=vec(paper(place)))
    if "pivot" not in follower and "stem" in follower:
        first, last = paper(follower["stem"])
        guide = {"at": vec(0.35 * first + 0.65 * last), "along": way(first, last)[1]}
        for side in (-1, 1):
            sketch.put("ground_guide", **guide, start=-_GUIDE, end=_GUIDE, height=_ROOM, side=side)


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


def _roller(sketch: Sketch, at: Floats, radius: float) -> None:
    sketch.circle(vec(at), radius, "lw-pin")
    sketch.circle(vec(at), 2.0, "lw-point")


def _second(sketch: Sketch, design: CamDesign, angle: float, paper: Callable[[Floats], Floats], scale: float) -> None:
    """The second roller of a pair, rigid with the first."""
    wall = design.cam.walls[1]
    assert isinstance(wall, RollerCurve)
    at = wall.pitch(np.array([angle]))[0] * np.exp(1j * design.cam.turn * angle)
    if not design.cam.follower.oscillating:
        at = -at
    place = np.array([at[0].real, at[0].imag])
    pivot = design.cam.follower.pivot_distance
    if design.cam.follower.oscillating and pivot is not None:
        sketch.line(paper(np.array([(pivot, 0.0), place])), "lw-bar")
    _roller(sketch, paper(place), scale * wall.follower.roller_radius)


def _line(design: CamDesign, angle: float, language: str) -> str:
    cam = design.cam
    degrees = number(angle, "angle")
    if cam.barrel_radius is not None:
        return _(
            "unrolled, R = {radius} mm, φ = {angle}°", radius=number(cam.barrel_radius, "length"), angle=degrees
        ).translate(language)
    radius = number((cam.base_radius or 0.0), "length")
    return _("base circle r = {radius} mm, φ = {angle}°", radius=radius, angle=degrees).translate(language)
