"""The divided angles of a cam's sheet, and the follower's position relative to the cam at them.

Places are complex, m, in the cam's axes: the frame is turned back by the cam's angle, the inversion that profiles are
drawn by.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from linkwright.cams.curves import RollerCurve
from linkwright.cams.result import CamDesign
from linkwright.core.arrays import Complexes, Floats
from linkwright.laws.base import MotionLaw
from linkwright.laws.program import TURN, MotionProgram, Program

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
    for (start, end), (low, high), (own, _) in zip(ends, lifts, program.moved_by, strict=True):
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
