"""Units of axes, the axis of the input, titles, axes of equal scale, and the legend below them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from linkwright.core.arrays import Floats, largest
from linkwright.core.quantity import SHOWN, significant
from linkwright.pictures.diagram import INK, Axes, Figure
from linkwright.units import si_unit
from linkwright.words import _

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axis import Axis

    from linkwright.words import Translate


_PREFIXED = {"force": "N", "torque": "N·m", "power": "W", "energy": "J"}
_PREFIXES = ((1e7, "M", 1e-6), (1e4, "k", 1e-3), (1e-2, "", 1.0), (0.0, "m", 1e3))


@dataclass(frozen=True)
class Unit:
    """A unit's name, and the factor from SI to it."""

    name: str
    factor: float

    def text(self, value: float, digits: int = 4) -> str:
        """An SI value as text with the unit: ``56.14 kN``."""
        shown = significant(value * self.factor, digits)
        return f"{shown}{self.name}" if self.name in ("°", "") else f"{shown} {self.name}"

    def label(self, quantity: str, between: str = " ") -> str:
        """The label of an axis: quantity and unit, ``travel (mm)``; the quantity alone where there is no unit."""
        return f"{quantity}{between}({self.name})" if self.name else quantity


def unit_of(dimension: str, arrays: Iterable[Floats] = ()) -> Unit:
    """The unit for a quantity; forces, torques, powers and energies take a prefix by their largest size."""
    if dimension in SHOWN:
        return Unit(*SHOWN[dimension])
    if dimension not in _PREFIXED:
        return Unit(si_unit(dimension), 1.0)
    size = max(map(largest, arrays), default=0.0)
    prefix, factor = next((p, f) for limit, p, f in _PREFIXES if size >= limit or (size == 0.0 and f == 1.0))
    return Unit(prefix + _PREFIXED[dimension], factor)


ANGLE_STEPS = (1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 60.0, 90.0, 180.0, 360.0, 720.0)


#: Letters of the input by its dimension, and of the time.
SYMBOLS = {"angle": "φ", "length": "s", "time": "t"}


@dataclass(frozen=True)
class InputAxis:
    """The axis below curves: its dimension, its ``values`` (n,) SI; ``name``: what it is, if not the input or time;
    ``log``: whether it is logarithmic."""

    dimension: str
    values: Floats
    name: str = ""
    log: bool = False

    @property
    def unit(self) -> Unit:
        """The unit in which it is shown."""
        return unit_of(self.dimension)

    @property
    def backwards(self) -> bool:
        """Whether the input falls as time goes on, so that the axis runs from right to left."""
        return bool(self.values[-1] < self.values[0])

    def label(self, translate: Translate) -> str:
        """Its name with the unit, ``input φ (°)``."""
        if self.name:
            return self.unit.label(self.name)
        word = translate(_("time")) if self.dimension == "time" else translate(_("input"))
        return self.unit.label(f"{word} {SYMBOLS[self.dimension]}")


def label_input(axes: Axes, axis: InputAxis, translate: Translate) -> None:
    """Label, range and ticks of the axis below: the input in the order of the motion."""
    shown = axis.values * axis.unit.factor
    good = shown[np.isfinite(shown)]
    if len(good) and good[0] != good[-1]:
        axes.set_xlim(*((good.max(), good.min()) if axis.backwards else (good.min(), good.max())))
    if axis.dimension == "angle":
        _angle_ticks(axes, float(np.ptp(good)) if len(good) else 360.0)
    if axis.log:
        axes.set_xscale("log")
        plain_ticks(axes.xaxis, axes.get_xlim())
    axes.set_xlabel(axis.label(translate))


def _angle_ticks(axes: Axes, span: float) -> None:
    """Ticks below at integer fractions of a turn, for an axis that shows ``span`` degrees."""
    from matplotlib.ticker import MultipleLocator

    step = next((each for each in ANGLE_STEPS if span / each <= 12.5), None)
    if step is not None:
        axes.xaxis.set_major_locator(MultipleLocator(step))


def plain_ticks(axis: Axis, limits: tuple[float, float]) -> None:
    """Ticks of a logarithmic axis as plain numbers: at 1, 2, 5 times powers of ten, over many at these alone."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if limits[1] <= 1000.0 * limits[0] else (1.0,)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def wrapped(text: str, inches: float) -> str:
    """A long title in lines that fit a width."""
    import textwrap

    if not text:
        return ""
    wide = sum(2.0 if ord(c) > 0x2E7F else 1.0 for c in text) / len(text)
    return "\n".join(textwrap.wrap(text, max(20, int(inches * 10.5 / wide)))) or text


def make_plane(axes: Axes, margin: float, unit: str = "mm") -> None:
    """Axes of equal scale for places x and y."""
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(margin)
    axes.set(xlabel=f"x ({unit})", ylabel=f"y ({unit})")


def make_force_plane(axes: Axes, unit: Unit, names: str = "xy") -> None:
    """Axes of equal scale for components of a force, with lines through the origin and a cross there."""
    make_plane(axes, 0.13)
    axes.set(xlabel=unit.label(f"F{names[0]}"), ylabel=unit.label(f"F{names[1]}"))
    for draw in (axes.axhline, axes.axvline):
        draw(0.0, color="#9aa0a6", linewidth=0.8, zorder=1.2)
    axes.plot([0], [0], "+", color=INK, markersize=9, zorder=5)


#: Height of a row of a legend, inches, and rows for which a figure has room as it is.
ROW, FREE_ROWS = 0.19, 4


class Legend:
    """Entries in the order in which they come, each once."""

    def __init__(self) -> None:
        self._entries: dict[str, Artist] = {}

    def add(self, label: str, artist: Artist) -> None:
        """An entry with the look of something drawn."""
        self._entries.setdefault(label, artist)

    def patch(self, label: str, colour: str) -> None:
        """An entry for a shaded stretch."""
        from matplotlib.patches import Patch

        self.add(label, Patch(facecolor=colour, linewidth=0))

    def line(self, label: str, colour: str, dash: Any) -> None:
        """An entry for a line."""
        from matplotlib.lines import Line2D

        self.add(label, Line2D([], [], color=colour, linestyle=dash, linewidth=1.0))

    def put(self, figure: Figure) -> None:
        """Draws the entries below the figure, as many in a row as have room."""
        entries = {label: artist for label, artist in self._entries.items() if label}
        if not entries:
            return
        wide = max(sum(2.0 if ord(c) > 0x2E7F else 1.0 for c in label) for label in entries)
        width, height = figure.get_size_inches()
        columns = int(max(1, min(len(entries), width * 72.0 // (wide * 4.9 + 42))))
        rows = -(-len(entries) // columns)
        figure.set_size_inches(width, height + ROW * max(rows - FREE_ROWS, 0))
        shown = [f" {label}" if label.startswith("_") else label for label in entries]
        figure.legend(list(entries.values()), shown, loc="outside lower center", ncols=columns)
