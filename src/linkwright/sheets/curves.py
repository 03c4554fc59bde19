"""Diagrams over the cycle as panels: curves with axes to preferred scales."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.quantity import significant
from linkwright.pictures.labels import Name, put
from linkwright.pictures.picture import LEAST, Pen, Picture, Runs, Words, as_runs, indexed, joined
from linkwright.sheets.panel import Drawn, Panel, preferred
from linkwright.units import si_unit

#: Height of a diagram in widths; room for numbers at the left, below, and for the arrows of the axes, mm.
FLATNESS, LEFT, BELOW, BEYOND = 0.45, 16.0, 9.0, 6.0
#: Least distance of marks on an axis, and their length, mm.
APART, MARK = 13.0, 1.2
#: Distance of curves from zero, in their own heights, from which the axis does not begin at zero.
FAR = 1.5
#: Share of a diagram's height below which a level is zero.
NOTHING = 1e-6
_ANGLES = (1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 60.0, 90.0, 180.0, 360.0, 720.0)
_PENS: tuple[Pen, ...] = ("thick", "thin", "dashed", "chain")


@dataclass(frozen=True)
class Axis:
    """An axis: its symbol with indices, its dimension, and the factor from SI to the ``unit`` of its numbers."""

    symbol: Runs
    dimension: str
    unit: str
    factor: float = 1.0

    def label(self) -> Runs:
        """Symbol and unit."""
        unit = f"({self.unit})" if "/" in self.unit else self.unit
        return joined(self.symbol, f"/{unit}" if unit else "")

    def scale(self, chosen: float) -> Runs:
        """The scale, given in its unit per mm, as a caption: in SI units per mm, degrees for angles."""
        if self.dimension == "angle":
            return joined(_mu(self.symbol), f" = {chosen:g} °/mm")
        unit = si_unit(self.dimension)
        per = f"({unit})/mm" if "/" in unit else f"{unit}/mm"
        return joined(_mu(self.symbol), f" = {chosen / self.factor:.6g} {per}")


def _mu(symbol: Runs) -> Runs:
    return indexed("μ", symbol[0][0])


@dataclass(frozen=True)
class Curve:
    """A curve: values (n,) SI, with a name where there are several."""

    values: Floats
    name: str = ""


class CurvePanel(Panel):
    """Curves over one axis (n,) SI; ``backwards``: the axis falls from left to right."""

    smallest, largest = 80.0, 180.0

    def __init__(
        self,
        name: str,
        rank: float,
        caption: Words,
        across: tuple[Axis, Floats],
        up: Axis,
        curves: Sequence[Curve],
        *,
        levels: Sequence[tuple[Words, float]] = (),
        backwards: bool = False,
    ) -> None:
        self.name, self.rank, self.caption = name, rank, caption
        self.x_axis, self.x = across[0], across[1] * across[0].factor
        self.y_axis = up
        self.curves = [Curve(curve.values * up.factor, curve.name) for curve in curves]
        self.levels = [(text, value * up.factor) for text, value in levels]
        self.backwards = backwards
        self._pictures: dict[tuple[float, float], Picture] = {}

    def drawn(self, size: float, scale: float | None) -> Drawn:
        wide = size - LEFT - BEYOND - 8.0
        high = FLATNESS * size - BELOW
        x_scale = preferred((float(np.nanmax(self.x)) - float(np.nanmin(self.x)) or 1.0) / wide)
        low, top = self._range()
        y_scale = scale * self.y_axis.factor if scale else preferred((top - low) / high)
        if (x_scale, y_scale) not in self._pictures:
            self._pictures[x_scale, y_scale] = self._picture(x_scale, y_scale, low, top)
        picture = self._pictures[x_scale, y_scale]
        scales = joined(self.x_axis.scale(x_scale), ",  ", self.y_axis.scale(y_scale))
        return Drawn(picture, (as_runs(self.caption), scales))

    def _range(self) -> tuple[float, float]:
        """The smallest and largest value; zero among them unless the curves lie far from it."""
        every = np.concatenate([*(curve.values for curve in self.curves), [v for _, v in self.levels]])
        low, top = float(np.nanmin(every)), float(np.nanmax(every))
        if top - low <= 1e-9 * max(abs(low), abs(top), 1e-9):
            return min(low, 0.0), max(top, 0.0) or 1.0
        if max(low, -top) > FAR * (top - low):
            return low - 0.1 * (top - low), top
        return min(low, 0.0), max(top, 0.0)

    def _picture(self, x_scale: float, y_scale: float, low: float, top: float) -> Picture:
        """Axes, curves and levels; the axis below stands at zero where that is in the picture."""
        found, base = Picture(), 0.0 if low <= 0.0 <= top else low
        x = self._places(self.x, x_scale)
        right = float(np.nanmax(x))
        self._across(found, x_scale, right, (low - base) / y_scale)
        self._up(found, y_scale, (low, top), base)
        names = []
        for number, curve in enumerate(self.curves):
            line = np.stack([x, (curve.values - base) / y_scale], axis=1)
            found.line(line, _PENS[number % len(_PENS)])
            if curve.name:
                good = line[np.isfinite(line).all(axis=1)]
                spots = [good[int(share * (len(good) - 1))] for share in (0.15, 0.35, 0.6, 0.85)]
                names.append(Name(as_runs(curve.name), spots, self.letters, clear=1.5, symbol=True))
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
        start = float(np.nanmax(values) if self.backwards else np.nanmin(values))
        return np.abs(values - start) / scale

    def _across(self, picture: Picture, scale: float, right: float, floor: float) -> None:
        """The axis below at zero, its numbers under the curves."""
        picture.arrow((0.0, 0.0), (right + BEYOND, 0.0), "thin")
        picture.text((right + BEYOND + 1.0, 1.2), self.x_axis.label(), self.letters)
        low, top = float(np.nanmin(self.x)), float(np.nanmax(self.x))
        step = _step(APART * scale, angle=self.x_axis.dimension == "angle")
        for value in np.arange(math.ceil(low / step - 1e-9), math.floor(top / step + 1e-9) + 1) * step:
            place = abs(value - (top if self.backwards else low)) / scale
            picture.line([(place, -MARK if floor < -MARK else 0.0), (place, MARK)])
            if floor < 0:
                picture.line([(place, floor), (place, floor - MARK)])
            picture.text((place, floor - MARK - 1.0 - LEAST), significant(float(value)), LEAST, "middle")

    def _up(self, picture: Picture, scale: float, ends: tuple[float, float], base: float) -> None:
        """The axis at the left with its numbers."""
        low, top = ends
        peak = (top - base) / scale
        picture.arrow((0.0, (low - base) / scale), (0.0, peak + BEYOND), "thin")
        picture.text((1.5, peak + BEYOND - 2.0), self.y_axis.label(), self.letters)
        step = _step(0.6 * APART * scale, angle=self.y_axis.dimension == "angle")
        for value in np.arange(math.ceil(low / step - 1e-9), math.floor(top / step + 1e-9) + 1) * step:
            level = (value - base) / scale
            picture.line([(-MARK, level), (0.0, level)])
            picture.text((-MARK - 0.8, level - 0.5 * LEAST), significant(float(value)), LEAST, "end")


def _step(least: float, *, angle: bool) -> float:
    """A round distance of marks that is not below a value."""
    if angle:
        for each in _ANGLES:
            if each >= least * (1 - 1e-9):
                return each
    power = math.pow(10.0, math.floor(math.log10(least) + 1e-12))
    return min(k * power for k in (1.0, 2.0, 5.0, 10.0) if k * power >= least * (1 - 1e-9))
