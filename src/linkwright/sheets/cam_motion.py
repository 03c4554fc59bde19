"""Lift, velocity and acceleration of a cam's follower above one another over the cam's angle."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.cams.result import CamDesign
from linkwright.core.arrays import Floats
from linkwright.core.quantity import significant
from linkwright.laws.program import TURN
from linkwright.pictures.picture import MIN_TEXT, TEXT, Picture, Runs, as_runs, indexed, joined, runs_width
from linkwright.sheets.cam_division import Phase, divided, graphical, phases
from linkwright.sheets.layout import Drawn, Panel, preferred
from linkwright.words import Translate, _

#: Shares of the height for lift, velocity and acceleration; space above and below each strip, mm.
_SHARES, _ABOVE, _BELOW = (0.42, 0.29, 0.29), 11.0, 3.0
#: Depth of the numbers of divided angles, height of a level of dimensions of phases, mm.
_NUMBERS, _LEVEL = 5.5, 6.5
#: Widest and narrowest a turn is drawn, mm; the distance that two marks of an ordinate have at least.
_WIDEST, _NARROWEST, _MARK = 360.0, 120.0, 9.0


@dataclass(frozen=True)
class Strip:
    """One of the curves: its symbol, its unit, the values (n,) in that unit, and the index of its symbol."""

    symbol: str
    unit: str
    values: Floats
    index: str = ""

    @property
    def label(self) -> Runs:
        """The label of its ordinate: ``v/(m/s)``."""
        unit = f"/({self.unit})" if "/" in self.unit else f"/{self.unit}"
        return joined(indexed(self.symbol, self.index), unit if self.unit else "")


class MotionPanel(Panel):
    """s, v and a (oscillating: ψ, ω, ε) over the angle of the cam with its divided angles."""

    name, rank = "motion", 1.0
    smallest = 130.0

    def __init__(self, design: CamDesign, translate: Translate, largest: float) -> None:
        self.design, self.translate, self.largest = design, translate, largest
        program = design.cam.program
        self.places, self.phases = divided(program), phases(program)
        self.strips = strips(design)

    def drawn(self, size: float, scale: float | None) -> Drawn:
        picture = Picture()
        room = min(max(size - 22.0, _NARROWEST), _WIDEST)
        mu = scale or preferred(360.0 / room)
        wide = 360.0 / mu
        levels = self._levels(wide)
        fixed = 3 * (_ABOVE + _BELOW) + _NUMBERS + _LEVEL * (max(levels, default=-1) + 1)
        free = max(min(size, 1.7 * wide) - fixed, 60.0)
        top, scales, between = 0.0, [], (0.0, 0.0)
        for number, (strip, share) in enumerate(zip(self.strips, _SHARES, strict=True)):
            each = preferred(max(float(np.ptp(np.append(strip.values, 0.0))), 1e-12) / (share * free))
            low = float(min(strip.values.min(), 0.0)) / each
            high = float(max(strip.values.max(), 0.0)) / each
            zero = top - _ABOVE - high
            self._curve(picture, strip, (wide, zero, each), (low, high))
            below = zero + low - _BELOW
            if number == 0:
                self._divisions(picture, wide, zero, each)
                below = min(below, zero - _NUMBERS)
                self._dimensions(picture, wide, below, levels)
                between = (below, below - _LEVEL * (max(levels, default=-1) + 1) - 1.0)
                below = between[1]
            scales.append(graphical(strip.symbol + strip.index, each, strip.unit))
            top = below
        self._boundaries(picture, wide, between, top)
        lines = [as_runs(self.translate(_("Follower motion with divided angles")))]
        lines += list(_in_lines([graphical("δ", mu, "°"), *scales], 1.15 * wide))
        return Drawn(picture, tuple(lines))

    def _curve(
        self, picture: Picture, strip: Strip, place: tuple[float, float, float], ends: tuple[float, float]
    ) -> None:
        """A curve with its axes; ``place``: width, height of the zero line, scale."""
        wide, zero, each = place
        x = np.degrees(self.design.angles) * wide / 360.0
        picture.arrow((0.0, zero), (wide + 13.0, zero), "thin")
        picture.text((wide + 3.5, zero - 5.5), "δ/°", self.letters)
        picture.arrow((0.0, zero + ends[0] - 1.0), (0.0, zero + ends[1] + 8.0), "thin")
        picture.text((2.0, zero + ends[1] + 4.5), strip.label, self.letters)
        step = preferred(_MARK * each)
        for k in range(math.ceil(ends[0] * each / step - 1e-9), math.floor(ends[1] * each / step + 1e-9) + 1):
            level = zero + k * step / each
            picture.line([(-1.2, level), (0.0, level)])
            picture.text((-2.0, level - 0.5 * MIN_TEXT), significant(k * step), MIN_TEXT, "end")
        picture.line(np.stack([x, zero + strip.values / each], axis=1), "thick")

    def _divisions(self, picture: Picture, wide: float, zero: float, each: float) -> None:
        """Ordinates at the divided angles with their numbers, as many as have room."""
        lift = self.strips[0].values
        last = -math.inf
        places = np.append(self.places, TURN)
        for number, place in enumerate(places.tolist()):
            x = wide * place / TURN
            height = float(np.interp(place, self.design.angles, lift)) / each
            picture.line([(x, zero), (x, zero + height)] if abs(height) > 0.3 else [(x, zero - 1.0), (x, zero)])
            name = str(number % len(self.places))
            half = 0.5 * runs_width(as_runs(name), MIN_TEXT)
            if x - half > last + 0.5:
                picture.text((x, zero - 1.5 - MIN_TEXT), name, MIN_TEXT, "middle")
                last = x + half

    def _boundaries(self, picture: Picture, wide: float, between: tuple[float, float], bottom: float) -> None:
        """Where phases meet, through all curves but for the numbers and dimensions ``between``."""
        for phase in self.phases[1:]:
            x = wide * phase.start / TURN
            picture.line([(x, -_ABOVE), (x, between[0] + _NUMBERS)], "dashed")
            picture.line([(x, between[1]), (x, bottom)], "dashed")

    def _names(self, wide: float) -> list[Runs]:
        """The angle of each phase; where that has no room between its ends the symbol alone, if this has."""
        found = []
        for phase in self.phases:
            symbol = indexed(*phase.symbol) if phase.symbol[0] else ()
            degrees = f"{significant(math.degrees(phase.angle), 5)}°"
            full = joined(symbol, f" = {degrees}") if symbol else as_runs(degrees)
            span = wide * phase.angle / TURN
            short = symbol and self._fits(symbol, span) and not self._fits(full, span)
            found.append(symbol if short else full)
        return found

    def _fits(self, text: Runs, room: float) -> bool:
        """Whether a text fits between two marks."""
        return runs_width(text, self.letters) + 2.0 <= room

    def _levels(self, wide: float) -> list[int]:
        """At which level the angle of each phase is written, so that none meets its neighbour."""
        levels: list[int] = []
        taken: list[float] = []
        for phase, name in zip(self.phases, self._names(wide), strict=True):
            left, right, _unused = self._span(phase, name, wide)
            level = next((k for k, end in enumerate(taken) if left > end + 1.0), len(taken))
            if level == len(taken):
                taken.append(right)
            taken[level] = right
            levels.append(level)
        return levels

    def _span(self, phase: Phase, name: Runs, wide: float) -> tuple[float, float, float]:
        """From where to where the angle of a phase takes room, and the middle of its text: between its ends, else
        next to them."""
        start, end = wide * phase.start / TURN, wide * phase.end / TURN
        half = 0.5 * runs_width(name, self.letters)
        if self._fits(name, end - start):
            return start, end, 0.5 * (start + end)
        if end + 2 * half + 4.0 < wide:
            return start, end + 2 * half + 4.0, end + half + 3.0
        return start - 2 * half - 4.0, end, start - half - 3.0

    def _dimensions(self, picture: Picture, wide: float, top: float, levels: Sequence[int]) -> None:
        """The angles of the phases beneath the numbers of the divided angles."""
        for phase, name, level in zip(self.phases, self._names(wide), levels, strict=True):
            start, end = wide * phase.start / TURN, wide * phase.end / TURN
            height = top - _LEVEL * level - 5.5
            left, right, middle = self._span(phase, name, wide)
            for x, other in ((start, end), (end, start)):
                picture.line([(x, top), (x, height - 1.0)])
                if end - start > 6.0:
                    picture.head((x, height), (x - other, 0.0), 2.5)
            picture.line([(min(start, left), height), (max(end, right), height)])
            picture.text((middle, height + 1.0), name, self.letters, "middle")


def strips(design: CamDesign) -> tuple[Strip, Strip, Strip]:
    """Lift, velocity and acceleration: over time where the cam's speed is known, else over its angle in rad."""
    speed = design.loading.speed
    s, v, a, _unused = design.motion
    if design.cam.follower.oscillating:
        first = Strip("ψ", "°", np.degrees(s))
        if speed:
            return first, Strip("ω", "rad/s", speed * v, "2"), Strip("ε", "rad/s²", speed**2 * a, "2")
        return first, Strip("ψ′", "", v), Strip("ψ″", "1/rad", a)
    first = Strip("s", "mm", 1e3 * s)
    if speed:
        return first, Strip("v", "m/s", speed * v), Strip("a", "m/s²", speed**2 * a)
    return first, Strip("s′", "mm/rad", 1e3 * v), Strip("s″", "mm/rad²", 1e3 * a)


def _in_lines(parts: Sequence[Runs], wide: float) -> Iterator[Runs]:
    """Texts one after the other in lines of a width."""
    line: Runs = ()
    for part in parts:
        longer = joined(line, ",  ", part) if line else part
        if line and runs_width(longer, TEXT) > wide:
            yield line
            longer = part
        line = longer
    if line:
        yield line
