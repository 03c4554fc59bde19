"""A cam and its follower, drawn at true shape."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from linkwright.cams.curves import RollerCurve
from linkwright.cams.result import CamDesign
from linkwright.core.arrays import Floats
from linkwright.core.quantity import number
from linkwright.errors import require_language
from linkwright.pictures.drawing import Drawing, bounds, captioned
from linkwright.pictures.picture import Circle, Line, SvgNode
from linkwright.pictures.symbols.base import SYMBOLS, Shape, joined, vec, way
from linkwright.words import _

DIAGONAL = 620.0
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
    scale = DIAGONAL / float(np.hypot(*np.ptp(cloud, axis=0)))

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
