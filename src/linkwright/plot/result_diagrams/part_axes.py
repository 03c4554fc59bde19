"""What the diagrams of machine parts have in common: curves over a quantity, arrows in a plane."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.pictures.diagram import COLOURS, INK, Axes, Figure, new_figure
from linkwright.plot.diagrams.axes import Legend, Unit, angle_ticks, unit_of
from linkwright.plot.diagrams.base import Request, framed

if TYPE_CHECKING:
    from matplotlib.axis import Axis


@dataclass(frozen=True)
class Line:
    """A curve: places and values, SI; ``label`` for the legend, ``marks`` indices that are named, ``peaks`` places
    and values of extremes between them that are."""

    x: Floats
    y: Floats
    label: str = ""
    marks: tuple[int, ...] = ()
    dash: str = "-"
    peaks: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True)
class Pane:
    """A panel: its title, the dimension of its values, its curves; ``fill`` shades the first down to zero."""

    title: str
    dimension: str
    lines: tuple[Line, ...]
    fill: bool = False
    log: bool = False


def panes(
    name: str, across: tuple[str, str], given: Sequence[Pane], request: Request, *, logx: bool = False
) -> Figure:
    """Panels of what has a name, one below the other over one axis, which has a name and a dimension."""
    figure = new_figure(request.size or (7.2, 1.2 + 1.9 * max(len(given), 1.45)))
    axes = list(figure.subplots(len(given), 1, sharex=True, squeeze=False)[:, 0])
    legend = Legend()
    below = unit_of(across[1])
    for one, pane in zip(axes, given, strict=True):
        _pane(one, pane, below, legend)
        if logx:
            one.set_xscale("log")
            _plain_ticks(one.xaxis, one.get_xlim())
    if across[1] == "angle":
        angle_ticks(axes[-1], float(np.ptp(axes[-1].get_xlim())))
    axes[-1].set_xlabel(below.label(across[0]))
    framed(figure, request.titled(name), request, legend)
    figure.align_ylabels(axes)
    return figure


def _pane(axes: Axes, pane: Pane, below: Unit, legend: Legend) -> None:
    shown = unit_of(pane.dimension, [line.y for line in pane.lines])
    if not pane.log:
        axes.axhline(0.0, color="#9aa0a6", linewidth=0.7, zorder=1.2)
    for number, line in enumerate(pane.lines):
        colour = COLOURS[number % len(COLOURS)]
        x, y = line.x * below.factor, line.y * shown.factor
        (drawn,) = axes.plot(x, y, color=colour, linestyle=line.dash)
        if line.label:
            legend.add(line.label, drawn)
        if pane.fill and number == 0:
            axes.fill_between(x, y, 0.0, color=colour, alpha=0.12, linewidth=0)
        for place, value in (*((float(line.x[k]), float(line.y[k])) for k in line.marks), *line.peaks):
            at = place * below.factor, value * shown.factor
            axes.plot(*at, "o", color=colour, markersize=3.5)
            low = at[1] <= np.nanmin(y) < np.nanmax(y)
            axes.annotate(shown.text(value), at, (3, -4 if low else 4), textcoords="offset points", fontsize=7.5,
                          color=INK, va="top" if low else "bottom")  # fmt: skip
    if pane.log:
        axes.set_yscale("log")
        _plain_ticks(axes.yaxis, axes.get_ylim())
    else:
        axes.margins(y=0.16)
    axes.set_ylabel(shown.label(pane.title, "\n"))


def _plain_ticks(axis: Axis, limits: tuple[float, float]) -> None:
    """Ticks of a logarithmic axis as plain numbers: at 1, 2, 5 times powers of ten, over many at these alone."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if limits[1] <= 1000.0 * limits[0] else (1.0,)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def plane(name: str, request: Request, count: int = 1) -> tuple[Figure, list[Axes]]:
    """Axes of equal scale side by side."""
    figure = new_figure(request.size or (4.2 * count + 1.2, 4.6))
    found = list(figure.subplots(1, count, squeeze=False)[0])
    for axes in found:
        axes.set_aspect("equal", adjustable="datalim")
        axes.margins(0.15)
    framed(figure, request.titled(name), request)
    return figure, found


#: Inches of a plane across, of what stands about it below and above, and bounds of its height as shares of its width.
ACROSS, AROUND, FLAT, TALL = 3.6, 1.2, 0.3, 1.25


def fitted(figure: Figure, planes: Sequence[Axes], request: Request) -> None:
    """A figure as high as what its planes of equal scale show, where no size is asked for."""
    if request.size is not None:
        return
    extents = [axes.dataLim for axes in planes]
    share = max(each.height / each.width if each.width > 0.0 else TALL for each in extents)
    wide = float(figure.get_size_inches()[0])
    figure.set_size_inches(wide, AROUND + (wide / len(planes) - 1.2) * min(max(share, FLAT), TALL))
