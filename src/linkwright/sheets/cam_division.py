"""The divided angles of a cam's sheet, and what is marked on its profile and its diagrams.

Places are complex, m, in the cam's axes: the frame is turned back by the cam's angle, the inversion that profiles are
drawn by.
"""

from __future__ import annotations

import cmath
import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from linkwright.cams.curves import RollerCurve
from linkwright.cams.result import CamDesign
from linkwright.core.arrays import Complexes, Floats
from linkwright.core.quantity import per_mm, significant
from linkwright.laws.base import MotionLaw
from linkwright.laws.program import TURN, MotionProgram, Program
from linkwright.pictures.labels import Name
from linkwright.pictures.picture import Picture, Runs, as_runs, indexed, joined
from linkwright.words import Message, Translate, _

Way = Literal["rise", "dwell", "fall"]
#: Largest step of the divided angles while the follower moves, and where the motion has no phases, rad.
_STEP, _PLAIN = math.radians(12.5), math.radians(15.0)
#: Most divided angles of one turn; the step grows where there would be more.
MOST = 40


@dataclass(frozen=True)
class Phase:
    """A part of the turn, rad, in which the follower rises, dwells or falls, with the names of its laws.

    ``symbol``: its angle in the notation of textbooks, empty where the turn is not one rise and one fall.
    """

    way: Way
    start: float
    end: float
    laws: tuple[str, ...]
    symbol: tuple[str, str] = ("", "")

    @property
    def angle(self) -> float:
        """How far the cam turns in it, rad."""
        return self.end - self.start


def phases(program: Program) -> tuple[Phase, ...]:
    """The phases of a program of segments, neighbours of one way as one; none of a motion without segments."""
    if not isinstance(program, MotionProgram):
        return ()
    found: list[Phase] = []
    lifts = itertools.pairwise(program.lift_at_edges)
    ends = itertools.pairwise(program.edges.tolist())
    for (start, end), (low, high), (own, _how) in zip(ends, lifts, program.moved_by, strict=True):
        law = _name(own)
        way: Way = "dwell" if own is None or high == low else "rise" if high > low else "fall"
        if found and found[-1].way == way:
            last = found.pop()
            laws = tuple(dict.fromkeys((*last.laws, law)))
            found.append(Phase(way, last.start, end, laws))
        else:
            found.append(Phase(way, start, end, (law,)))
    return _named(found)


def _name(law: MotionLaw | None) -> str:
    """The name of a law; of one that is made from another (turned round, cut, shifted) that one's."""
    while isinstance(inner := getattr(law, "law", None), MotionLaw):
        law = inner
    return "dwell" if law is None else law.key


def _named(found: Sequence[Phase]) -> tuple[Phase, ...]:
    """Φ, Φs, Φ′, Φs′ where the follower rises once and falls once."""
    ways = [each.way for each in found]
    if ways.count("rise") != 1 or ways.count("fall") != 1 or len(found) > 4:
        return tuple(found)
    symbols = {"rise": ("Φ", ""), "fall": ("Φ′", "")}
    named, high = [], ways.index("rise") > ways.index("fall")
    for each in found:
        if each.way != "dwell":
            high = each.way == "rise"
        symbol = symbols.get(each.way) or (("Φ", "s") if high else ("Φ′", "s"))
        named.append(Phase(each.way, each.start, each.end, each.laws, symbol))
    return tuple(named)


def divided(program: Program) -> Floats:
    """The divided angles, rad from 0 on, the full turn left out: an even number of equal parts while the follower
    moves, the ends of dwells; equal parts of the turn where there are no phases."""
    parts = phases(program)
    if not parts:
        return np.asarray(np.arange(round(TURN / _PLAIN)) * _PLAIN, dtype=np.float64)
    step = _STEP
    while len(found := _divided(program, step)) > MOST and step < 1.0:
        step *= 1.25
    return found


def _divided(program: Program, step: float) -> Floats:
    assert isinstance(program, MotionProgram)
    places: list[Floats] = []
    for low, high, segment in zip(program.edges, program.edges[1:], program.segments, strict=False):
        count = 1 if segment.dwells else 2 * math.ceil((high - low) / step / 2 - 1e-9)
        places.append(np.linspace(low, high, count, endpoint=False))
    return np.concatenate(places)


def widest_gap(places: Floats) -> tuple[float, float]:
    """The longest stretch of the turn between neighbouring places, rad; its end may lie beyond a turn."""
    after = np.append(places[1:], places[0] + TURN)
    k = int(np.argmax(after - places))
    return float(places[k]), float(after[k])


@dataclass(frozen=True)
class Inverted:
    """A follower at angles φ (n,) in the cam's axes.

    ``trace``: roller's centre, edge, or the point in which a flat face touches; ``rest``: where the same point would
    be without lift (of a flat face: the foot of its line); ``foot``: the pivot, or the point of the offset circle at
    which a translating follower's line touches it; ``along``: unit vector of the follower's motion with growing
    lift; ``face`` (n, 2): the ends of a flat face as far as it is used, empty for others.
    """

    trace: Complexes
    rest: Complexes
    foot: Complexes
    along: Complexes
    face: Complexes


def inverted(design: CamDesign, phi: Floats) -> Inverted:
    """The follower of a disc cam at angles φ (n,)."""
    cam, follower = design.cam, design.cam.follower
    base = cam.base_radius or 0.0
    back = np.exp(-1j * cam.turn * phi)
    lift = cam.program.curves(phi)[0]
    low, high = design.face or (0.0, 0.0)
    none = np.empty((0, 2), dtype=complex)
    if not follower.oscillating:
        height = follower.start_height(base) or 0.0
        offset = 0.0 if follower.kind == "flat" else follower.offset
        rest, along = (offset + 1j * height) * back, 1j * back
        trace = (offset + 1j * (height + lift)) * back
        if follower.kind != "flat":
            return Inverted(trace, rest, offset * back, along, none)
        face = np.stack([(end + 1j * (height + lift)) * back for end in (low, high)], axis=1)
        return Inverted(design.wall.contact(phi).point, rest, 0.0 * back, along, face)
    pivot, start = follower.pivot_distance or 0.0, follower.start_angle(base) or 0.0
    side = follower.side
    arm = -np.exp(-1j * side * (start + lift))
    if follower.kind != "flat":
        length = follower.arm or 0.0
        rest = (pivot - length * np.exp(-1j * side * start)) * back
        return Inverted((pivot + length * arm) * back, rest, pivot * back, -1j * side * arm * back, none)
    toward = 1j * side * arm * follower.face_offset
    face = np.stack([(pivot + toward + end * arm) * back for end in (low, high)], axis=1)
    point = design.wall.contact(phi).point
    lever = point - pivot * back
    return Inverted(point, face[:, 0], pivot * back, -1j * side * lever / np.abs(lever), face)


@dataclass(frozen=True)
class Sharpest:
    """The pressure angle nearest to its limit (the largest where there is none): value, limit and place in rad."""

    value: float
    limit: float | None
    place: float
    rising: bool


def sharpest(design: CamDesign) -> Sharpest | None:
    """The governing pressure angle of a cam; None where the follower feels none."""
    limits = design.cam.limits
    rise_limit = limits.pressure_angle
    fall_limit = rise_limit if limits.pressure_angle_fall is None else limits.pressure_angle_fall
    found = [
        Sharpest(abs(each.value), limit, each.place, rising)
        for each, limit, rising in (
            (design.pressure_angle_rise, rise_limit, True),
            (design.pressure_angle_fall, fall_limit, False),
        )
    ]
    worst = max(found, key=lambda each: each.value / (each.limit or math.pi / 2))
    return worst if worst.value > 1e-9 else None


def pitch_of(design: CamDesign, phi: Floats) -> Complexes:
    """The pitch curve of the first wall; the profile itself under a flat face."""
    wall = design.wall
    return wall.pitch(phi)[0] if isinstance(wall, RollerCurve) else wall.contact(phi).point


class Paper:
    """From places in the cam's axes, m, to millimetres of paper."""

    def __init__(self, reduction: float) -> None:
        self.factor = 1e3 / reduction

    def length(self, value: float) -> float:
        """A length, mm."""
        return self.factor * value

    def point(self, place: complex) -> Floats:
        """A point (2,), mm."""
        return self.factor * pair(place)

    def points(self, places: Complexes) -> Floats:
        """Points (n, 2), mm."""
        return np.asarray(self.factor * np.stack([places.real, places.imag], axis=-1))


def pair(place: complex) -> Floats:
    """A complex place as a point (2,)."""
    return np.array([complex(place).real, complex(place).imag])


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


def marked(picture: Picture, paper: Paper, design: CamDesign, translate: Translate, outer: float) -> list[Name]:
    """Draws the marks of a profile within the distance ``outer`` (m); gives their names."""
    return [
        *_steepest(picture, paper, design),
        *_tightest(picture, paper, design, outer),
        *_radii(picture, paper, design),
        *_turning(picture, paper, design),
        *_curves(picture, paper, design, translate),
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
    """r₀ to the roller's centre and r_b of the profile, where no follower is drawn; e of an offset."""
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


def _curves(picture: Picture, paper: Paper, design: CamDesign, translate: Translate) -> Iterator[Name]:
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
        yield Name(as_runs(translate(title)), [end], clear=0.6)


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
