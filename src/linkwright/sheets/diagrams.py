"""Curves over the cycle and polygons of velocities, accelerations and forces as panels, to preferred scales."""

from __future__ import annotations

import math
import re
from abc import abstractmethod
from typing import ClassVar

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import per_mm, significant
from linkwright.kinetostatics.forces import link_numbers
from linkwright.pictures.labels import Name, put
from linkwright.pictures.picture import MIN_TEXT, Pen, Picture, Runs, Words, as_runs, indexed, joined, round_up
from linkwright.plotting.diagrams.axes import ANGLE_STEPS, InputAxis, Unit
from linkwright.plotting.diagrams.marks import LOW
from linkwright.plotting.diagrams.motion_polygons import (
    MotionPolygon,
    acceleration_polygon,
    arrows,
    gathered,
    velocity_polygon,
)
from linkwright.plotting.diagrams.panels import Panel as Plotted
from linkwright.plotting.diagrams.scaled_page import SHARES, SHORT, corners, end_to_end
from linkwright.plotting.free_bodies import Action
from linkwright.sheets.layout import Drawn, Panel, preferred
from linkwright.sheets.machine import Positions, Shown
from linkwright.units import si_unit
from linkwright.words import Message, _

#: Height of a diagram in widths; room for numbers at the left, below, and for the arrows of the axes, mm.
FLATNESS, LEFT, BELOW, BEYOND = 0.45, 16.0, 9.0, 6.0
#: Minimum distance of marks on an axis, and their length, mm.
TICK_SPACING, MARK = 13.0, 1.2
#: Distance of curves from zero, in their own heights, from which the axis does not begin at zero.
FAR = 1.5
#: Share of a diagram's height below which a level is zero.
NOTHING = 1e-6
_PENS: tuple[Pen, ...] = ("thick", "thin", "dashed", "chain")


def _label(symbol: Runs, unit: Unit) -> Runs:
    """Symbol and unit of an axis."""
    name = f"({unit.name})" if "/" in unit.name else unit.name
    return joined(symbol, f"/{name}" if name else "")


def _scale(symbol: Runs, dimension: str, unit: Unit, chosen: float) -> Runs:
    """The scale of an axis, given in its unit per mm, as a caption: in SI units per mm, degrees for angles."""
    mu = indexed("μ", symbol[0][0])
    if dimension == "angle":
        return joined(mu, f" = {chosen:g} °/mm")
    return joined(mu, f" = {chosen / unit.factor:.6g} {per_mm(si_unit(dimension))}")


class CurvePanel(Panel):
    """The curves of a diagram's panel over the input; ``symbols`` of both axes with their indices."""

    smallest, largest = 80.0, 180.0

    def __init__(
        self, name: str, rank: float, caption: Words, symbols: tuple[Runs, Runs], axis: InputAxis, plotted: Plotted
    ) -> None:
        self.name, self.rank, self.caption, self.symbols = name, rank, caption, symbols
        self.axis, self.plotted, self.unit = axis, plotted, plotted.unit
        self.x = np.asarray(axis.values, dtype=float) * axis.unit.factor
        several = len(plotted.curves) > 1
        self.curves = [(c.values * self.unit.factor, c.label if several else "") for c in plotted.curves]
        self.levels = [(level.label, level.value * self.unit.factor) for level in plotted.levels]
        self._pictures: dict[tuple[float, float], Picture] = {}

    def drawn(self, size: float, scale: float | None) -> Drawn:
        wide = size - LEFT - BEYOND - 8.0
        high = FLATNESS * size - BELOW
        x_scale = preferred((float(np.nanmax(self.x)) - float(np.nanmin(self.x)) or 1.0) / wide)
        low, top = self._range()
        y_scale = scale * self.unit.factor if scale else preferred((top - low) / high)
        if (x_scale, y_scale) not in self._pictures:
            self._pictures[x_scale, y_scale] = self._picture(x_scale, y_scale, low, top)
        picture = self._pictures[x_scale, y_scale]
        across = _scale(self.symbols[0], self.axis.dimension, self.axis.unit, x_scale)
        up = _scale(self.symbols[1], self.plotted.dimension, self.unit, y_scale)
        return Drawn(picture, (as_runs(self.caption), joined(across, ",  ", up)))

    def _range(self) -> tuple[float, float]:
        """The smallest and largest value; zero among them unless the curves lie far from it."""
        every = np.concatenate([*(values for values, _ in self.curves), [v for _, v in self.levels]])
        low, top = float(np.nanmin(every)), float(np.nanmax(every))
        if top - low <= 1e-9 * max(abs(low), abs(top), 1e-9):
            return min(low, 0.0), max(top, 0.0) or 1.0
        if max(low, -top) > FAR * (top - low):
            return low - 0.1 * (top - low), top
        return min(low, 0.0), max(top, 0.0)

    def _picture(self, x_scale: float, y_scale: float, low: float, top: float) -> Picture:
        """Axes, curves and levels; the axis below is at zero where that is in the picture."""
        found, base = Picture(), 0.0 if low <= 0.0 <= top else low
        x = self._places(self.x, x_scale)
        right = float(np.nanmax(x))
        self._across(found, x_scale, right, (low - base) / y_scale)
        self._up(found, y_scale, (low, top), base)
        names = []
        for number, (values, name) in enumerate(self.curves):
            line = np.stack([x, (values - base) / y_scale], axis=1)
            found.line(line, _PENS[number % len(_PENS)])
            if name:
                good = line[np.isfinite(line).all(axis=1)]
                spots = [good[int(share * (len(good) - 1))] for share in (0.15, 0.35, 0.6, 0.85)]
                names.append(Name(as_runs(name), spots, self.letters, clear=1.5, symbol=True))
        for text, value in self.levels:
            if abs(value) < NOTHING * (top - low):
                continue
            level = (value - base) / y_scale
            found.line([(0.0, level), (right, level)], "dashed")
            spots = [np.array([share * right, level]) for share in (0.9, 0.7, 0.5, 0.2)]
            names.append(Name(as_runs(text), spots, self.letters, clear=1.0))
        put(found, names)
        return found

    def _places(self, values: Floats, scale: float) -> Floats:
        """Where values stand on the axis, mm from its start."""
        start = float(np.nanmax(values) if self.axis.backwards else np.nanmin(values))
        return np.abs(values - start) / scale

    def _across(self, picture: Picture, scale: float, right: float, floor: float) -> None:
        """The axis below at zero, its numbers under the curves."""
        picture.arrow((0.0, 0.0), (right + BEYOND, 0.0), "thin")
        picture.text((right + BEYOND + 1.0, 1.2), _label(self.symbols[0], self.axis.unit), self.letters)
        low, top = float(np.nanmin(self.x)), float(np.nanmax(self.x))
        step = _step(TICK_SPACING * scale, angle=self.axis.dimension == "angle")
        for value in np.arange(math.ceil(low / step - 1e-9), math.floor(top / step + 1e-9) + 1) * step:
            place = abs(value - (top if self.axis.backwards else low)) / scale
            picture.line([(place, -MARK if floor < -MARK else 0.0), (place, MARK)])
            if floor < 0:
                picture.line([(place, floor), (place, floor - MARK)])
            picture.text((place, floor - MARK - 1.0 - MIN_TEXT), significant(float(value)), MIN_TEXT, "middle")

    def _up(self, picture: Picture, scale: float, ends: tuple[float, float], base: float) -> None:
        """The axis at the left with its numbers."""
        low, top = ends
        peak = (top - base) / scale
        picture.arrow((0.0, (low - base) / scale), (0.0, peak + BEYOND), "thin")
        picture.text((1.5, peak + BEYOND - 2.0), _label(self.symbols[1], self.unit), self.letters)
        step = _step(0.6 * TICK_SPACING * scale, angle=self.plotted.dimension == "angle")
        for value in np.arange(math.ceil(low / step - 1e-9), math.floor(top / step + 1e-9) + 1) * step:
            level = (value - base) / scale
            picture.line([(-MARK, level), (0.0, level)])
            picture.text((-MARK - 0.8, level - 0.5 * MIN_TEXT), significant(float(value)), MIN_TEXT, "end")


def _step(minimum: float, *, angle: bool) -> float:
    """A round distance of marks that is not below a value."""
    found = round_up(minimum, (1.0, 2.0, 5.0))
    return next((each for each in ANGLE_STEPS if each >= minimum * (1 - 1e-9)), found) if angle else found


#: Letters at the ends of parts of an acceleration.
ENDS = {"normal": "n", "coriolis": "k"}


class ScaledPanel(Panel):
    """A panel of vectors to a preferred scale, SI per mm; ``symbol`` and ``unit`` of that scale."""

    smallest, largest = 34.0, 130.0
    symbol: ClassVar[str]
    unit: ClassVar[str]

    def __init__(self, name: str, rank: float, positions: Positions, shown: Shown) -> None:
        self.name, self.rank = name, rank
        self.positions, self.shown = positions, shown
        self._pictures: dict[float, Picture] = {}

    @abstractmethod
    def reach(self) -> float:
        """The longer side of the picture, SI."""

    @abstractmethod
    def picture(self, scale: float) -> Picture:
        """The picture to a scale, SI per mm."""

    @abstractmethod
    def caption(self) -> str:
        """What it shows."""

    def drawn(self, size: float, scale: float | None) -> Drawn:
        chosen = scale or preferred(self.reach() / max(size - 10.0, 8.0))
        mu = joined(indexed("μ", self.symbol), f" = {chosen:g} {per_mm(self.unit)}")
        if chosen not in self._pictures:
            self._pictures[chosen] = self.picture(chosen)
        return Drawn(self._pictures[chosen], (as_runs(self.caption()), mu))


class MotionPolygonPanel(ScaledPanel):
    """A velocity or acceleration polygon: absolute vectors thick, relative ones thin, parts dashed."""

    prime: ClassVar[str] = ""
    title: ClassVar[Message]
    title_at: ClassVar[Message]

    def __init__(self, name: str, rank: float, positions: Positions, shown: Shown) -> None:
        super().__init__(name, rank, positions, shown)
        self.polygon = self.made()
        self.longest = float(np.ptp(self.polygon.places, axis=0).max())

    @abstractmethod
    def made(self) -> MotionPolygon:
        """The polygon in SI units."""

    def reach(self) -> float:
        return self.longest

    def caption(self) -> str:
        positions = self.positions
        if len(positions.shown) < 2:
            return positions.subject.words(self.title)
        return positions.subject.words(self.title_at.format(number=self.shown.number))

    def picture(self, scale: float) -> Picture:
        found = Picture()
        pairs = arrows(self.polygon, scale)
        for step, (start, end) in zip(self.polygon.steps, pairs, strict=True):
            if step.role == "absolute":
                found.arrow(start, end)
        for step, (start, end) in zip(self.polygon.steps, pairs, strict=True):
            if step.role != "absolute":
                found.arrow(start, end, "thin" if step.role in ("relative", "sliding") else "dashed")
        names: list[Name] = []
        for texts, place in gathered(self.polygon, scale, self.prime):
            found.circle(place, 0.45, fill="ink")
            runs = as_runs(", ".join(map(self._short, texts)))
            names.append(Name(runs, [place], self.letters, symbol=True))
        names += self._ends(pairs)
        put(found, names)
        return found

    def _short(self, text: str) -> str:
        """A name of an image; that of a guide's point under a block, ``a(lever)``, with the number of its link."""
        found = re.fullmatch(r"(\w+)\((.+)\)(′?)", text)
        numbers = link_numbers(self.positions.mechanism)
        if found is None or found[2] not in numbers:
            return text
        return f"{found[1]}{str(numbers[found[2]]).translate(LOW)}{found[3]}"

    def _ends(self, pairs: list[tuple[Floats, Floats]]) -> list[Name]:
        """n′ at the ends of normal parts, k′ at those of Coriolis parts, numbered where there are several."""
        parts = {
            role: [
                end
                for step, (start, end) in zip(self.polygon.steps, pairs, strict=True)
                if step.role == role and np.hypot(*(end - start)) > SHORT
            ]
            for role in ENDS
        }
        found = []
        for role, ends in parts.items():
            for number, end in enumerate(ends, 1):
                runs = as_runs(((f"{ENDS[role]}′", 0), (str(number) if len(ends) > 1 else "", -1)))
                found.append(Name(runs, [end], MIN_TEXT, symbol=True))
        return found


class VelocityPanel(MotionPolygonPanel):
    """The velocity polygon of a position."""

    symbol, unit = "v", "m/s"
    title = _("Velocity polygon")
    title_at = _("Velocity polygon, position {number}")

    def made(self) -> MotionPolygon:
        return velocity_polygon(self.positions.motion, self.shown.index)


class AccelerationPanel(MotionPolygonPanel):
    """The acceleration polygon of a position."""

    symbol, unit, prime = "a", "m/s²", "′"
    title = _("Acceleration polygon")
    title_at = _("Acceleration polygon, position {number}")

    def made(self) -> MotionPolygon:
        return acceleration_polygon(self.positions.motion, self.shown.index)


class ForcePanel(ScaledPanel):
    """The force polygon of a link: loads, weight, inertia force, then joint forces; it closes."""

    symbol, unit = "F", "N"
    smallest, largest = 28.0, 90.0

    def __init__(
        self, name: str, rank: float, positions: Positions, shown: Shown, link: str, vectors: list[Action]
    ) -> None:
        super().__init__(name, rank, positions, shown)
        self.link = link
        self.vectors = vectors
        self.forces = [each.force for each in vectors]

    def reach(self) -> float:
        return float(np.ptp(corners(self.forces), axis=0).max()) or 1.0

    def caption(self) -> str:
        words, number = self.positions.subject.words, link_numbers(self.positions.mechanism)[self.link]
        if len(self.positions.shown) < 2:
            return words(_("Force polygon of link {link}", link=number))
        return words(_("Force polygon of link {link}, position {number}", link=number, number=self.shown.number))

    def picture(self, scale: float) -> Picture:
        found = Picture()
        names = []
        for vector, (start, end) in zip(self.vectors, end_to_end(self.forces, scale), strict=True):
            found.arrow(start, end, "thick" if vector.role == "reaction" else "thin")
            if np.hypot(*(end - start)) > SHORT:
                spots = [start + share * (end - start) for share in SHARES]
                runs = indexed(vector.letter, vector.index)
                names.append(Name(runs, spots, self.letters, clear=1.2, symbol=True))
        put(found, names)
        return found
