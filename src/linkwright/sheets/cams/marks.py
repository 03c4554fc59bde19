"""What is marked on a cam's profile: radii, names of curves, sense of turning, governing angle and radius."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator

import numpy as np

from linkwright.cams.result import CamDesign
from linkwright.core.arrays import Complexes, Floats
from linkwright.core.quantity import per_mm, significant
from linkwright.pictures.labels import Name
from linkwright.pictures.picture import Picture, Runs, as_runs, indexed, joined
from linkwright.sheets.cams.division import Paper, divided, inverted, pair, pitch_of, sharpest, widest_gap
from linkwright.words import Message, Translate, _


def equal(symbol: Runs, value: float, unit: str, digits: int = 4) -> Runs:
    """``r₀ = 40.43 mm``"""
    gap = "" if unit in ("", "°") else " "
    return joined(symbol, f" = {significant(value, digits)}{gap}{unit}")


def graphical(index: str, value: float, unit: str) -> Runs:
    """``μ_s = 0.5 mm/mm``: a quantity per millimetre of paper; ``unit`` empty for a plain number."""
    over = per_mm(unit)
    gap = "" if over[0] in "°/" else " "
    return joined(indexed("μ", index), f" = {significant(value)}{gap}{over}")


#: Gap of the followers below which they are close together, rad.
_CLOSE = math.radians(50)
#: Distance from a break of the motion at which its curvature is that of a side, rad.
_SIDE_STEP = 1e-9
#: Length of the lines of the pressure angle and radius of its arc, mm.
_ARM, _ARC = 24.0, 17.0
#: Distance of names from what they mean, and how far leaders reach beyond the base circle, mm.
_CLEAR, _LEADER = 1.2, 9.0


def marked(picture: Picture, paper: Paper, design: CamDesign, say: Translate, outer: float) -> list[Name]:
    """Draws the marks of a profile within the distance ``outer`` (m); gives their names."""
    return [
        *_steepest(picture, paper, design),
        *_tightest(picture, paper, design, outer),
        *_radii(picture, paper, design),
        *_turning(picture, paper, design),
        *_curves(picture, paper, design, say),
    ]


def _free(design: CamDesign) -> tuple[float, float]:
    """The directions between which the paper shows no follower, from the first on counter-clockwise, rad; where the
    followers are close together, of four gaps, so that the middles of quarters lie between them."""
    cam = design.cam
    places = divided(cam.program)
    start, end = widest_gap(places)
    if end - start < _CLOSE:
        end = start + 4 * (end - start)
    first = cmath.phase(inverted(design, np.zeros(1)).trace[0])
    ends = (first - cam.turn * start, first - cam.turn * end)
    return min(ends), max(ends)


def _steepest(picture: Picture, paper: Paper, design: CamDesign) -> Iterator[Name]:
    """The governing pressure angle between the normal and the way of the follower, at its position."""
    found = sharpest(design)
    if found is None:
        return
    phi = np.array([found.place])
    at, contact = inverted(design, phi), design.wall.contact(phi)
    start, along, normal = paper.point(at.trace[0]), complex(at.along[0]), complex(contact.normal[0])
    roller = paper.length(design.cam.follower.roller_radius)
    yield Name(indexed("α", "max"), angle_between(picture, start, along, normal, roller), clear=_CLEAR)


def angle_between(picture: Picture, start: Floats, along: complex, normal: complex, roller: float) -> list[Floats]:
    """Draws the angle at a place from the way of the follower to the normal, that one as far back as to the profile
    of a ``roller`` (mm); gives the places where its name may be."""
    picture.line([start - (roller + 7.0) * pair(normal), start + _ARM * pair(normal)], "thin")
    picture.arrow(start, start + _ARM * pair(along), "thin")
    first = cmath.phase(along)
    turned = math.remainder(cmath.phase(normal) - first, 2 * math.pi)
    picture.arc(start, _ARC, first, first + turned)
    if _ARC * abs(turned) > 6.0:
        for angle, way in ((first, -1.0), (first + turned, 1.0)):
            ray = cmath.exp(1j * angle)
            picture.head(start + _ARC * pair(ray), pair(way * math.copysign(1.0, turned) * 1j * ray), 2.2)
    middle = cmath.exp(1j * (first + 0.5 * turned))
    return [start + reach * pair(middle) for reach in (_ARC + 1.0, _ARM, 0.6 * _ARC)]


def _tightest(picture: Picture, paper: Paper, design: CamDesign, outer: float) -> Iterator[Name]:
    """The smallest radius of curvature of the first wall, from its centre to the profile."""
    radius = design.smallest_radius
    if radius is None or radius.value > 2 * outer:
        return
    contact = design.wall.contact(radius.place + np.array([-_SIDE_STEP, 0.0, _SIDE_STEP]))
    side = int(np.argmin(np.abs(contact.curvature - 1.0 / radius.value)))
    if not math.isclose(float(contact.curvature[side]), 1.0 / radius.value, rel_tol=1e-5):
        return  # it is on another wall
    point, inward = paper.point(contact.point[side]), -complex(contact.normal[side])
    centre = point + paper.length(radius.value) * pair(inward)
    picture.arrow(centre, point, "thin")
    for way in ((1.2, 0.0), (0.0, 1.2)):
        picture.line([centre - np.array(way), centre + np.array(way)])
    yield Name(indexed("ρ", "min"), [point + share * (centre - point) for share in (0.5, 0.7, 0.3)], clear=_CLEAR)


def _radii(picture: Picture, paper: Paper, design: CamDesign) -> Iterator[Name]:
    """r₀ to the roller's centre and r_b of the profile, where no follower stands; e of an offset."""
    cam = design.cam
    base, roller = cam.base_radius or 0.0, cam.follower.roller_radius
    low, high = _free(design)
    shown = [("0", base + roller, 0.375), ("b", base, 0.625)] if roller else [("0", base, 0.5)]
    for index, radius, share in shown:
        ray = cmath.exp(1j * (low + share * (high - low)))
        tip = paper.length(radius) * pair(ray)
        picture.arrow((0.0, 0.0), tip, "thin")
        yield Name(indexed("r", index), [share * tip for share in (0.72, 0.58, 0.86)], clear=_CLEAR)
    if not cam.follower.oscillating and cam.follower.kind != "flat" and cam.follower.offset:
        ray = cmath.exp(1j * (low + 0.5 * (high - low)))
        edge = paper.length(abs(cam.follower.offset)) * pair(ray)
        yield Name(as_runs("e"), [edge], clear=_CLEAR)


def _turning(picture: Picture, paper: Paper, design: CamDesign) -> Iterator[Name]:
    """The arrow of the cam's turning within its base circle."""
    cam = design.cam
    radius = max(0.55 * paper.length(cam.base_radius or 0.0), 8.0)
    low, high = _free(design)
    middle = 0.5 * (low + high) + math.pi
    half = 0.45 * cam.turn
    picture.arc((0.0, 0.0), radius, middle - half, middle + half, "thick")
    tip = cmath.exp(1j * (middle + half))
    picture.head(radius * pair(tip), pair(1j * cam.turn * tip))
    places = [radius * pair(cmath.exp(1j * (middle + turn))) for turn in (0.0, 0.2, -0.2)]
    yield Name(indexed("ω", "1" if cam.follower.oscillating else ""), places, clear=_CLEAR)


def _curves(picture: Picture, paper: Paper, design: CamDesign, say: Translate) -> Iterator[Name]:
    """The names of profile and pitch curve, with leaders from near the ends of the free directions."""
    phi = np.linspace(0.0, 2 * math.pi, 721)[:-1]
    low, high = _free(design)
    curves: list[tuple[Message, Complexes, float]] = [(_("profile"), design.wall.contact(phi).point, 0.125)]
    if design.cam.follower.kind == "roller":
        curves.append((_("pitch curve"), pitch_of(design, phi), 0.875))
    far = paper.length((design.cam.base_radius or 0.0) + design.cam.follower.roller_radius)
    for title, curve, share in curves:
        ray = cmath.exp(1j * (low + share * (high - low)))
        point = curve[int(np.argmin(np.abs(np.angle(curve / ray))))]
        end = (max(far, paper.length(abs(point))) + _LEADER) * pair(ray)
        picture.line([paper.point(point), end])
        yield Name(as_runs(say(title)), [end], clear=0.6)


def checks_text(design: CamDesign) -> Runs:
    """``α_max = 30° ≤ [α] = 30° (δ = 24.4°), ρ_min = 14.2 mm``"""
    found, radius = sharpest(design), design.smallest_radius
    parts: list[Runs] = []
    if found is not None:
        degrees = math.degrees(found.value)
        angle = equal(indexed("α", "max"), degrees, "°")
        if found.limit is not None:
            relation = "≤" if degrees <= math.degrees(found.limit) + 5e-4 else ">"
            angle = joined(angle, f" {relation} [α] = {significant(math.degrees(found.limit))}°")
        parts.append(joined(angle, f" (δ = {significant(math.degrees(found.place))}°)"))
    if radius is not None:
        parts.append(equal(indexed("ρ", "min"), 1e3 * radius.value, "mm"))
    return joined(*(part for k, each in enumerate(parts) for part in (((",  ", 0),) if k else (), each)))
