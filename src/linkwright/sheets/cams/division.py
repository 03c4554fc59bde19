"""The divided angles of a cam's sheet: where the follower is drawn, and the phases of its motion."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import Literal

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
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
