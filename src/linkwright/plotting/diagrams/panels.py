"""Curves over the input in stacked panels with one axis."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from linkwright.core.arrays import Floats, largest
from linkwright.core.outputs import Output
from linkwright.pictures.diagram import COLOURS, FAINT, INK, SHADE, Axes, Figure, new_figure
from linkwright.plotting.diagrams.axes import InputAxis, Legend, Unit, label_input, make_plane, plain_ticks, unit_of
from linkwright.plotting.diagrams.base import Kind, Request, framed
from linkwright.plotting.diagrams.marks import (
    Curve,
    LimitMark,
    PhaseMark,
    limit_marks,
    mark_peaks,
    phase_marks,
    through_peaks,
)
from linkwright.plotting.diagrams.source import PlotInput
from linkwright.words import Translate, _

#: A value below this in the unit of the axis has a unit of its own, below that share of the largest it is rounding.
SMALL, ROUNDING = 0.1, 1e-9
DASHES = ("-", "--", ":", "-.")


@dataclass(frozen=True)
class Level:
    """A value that holds over the full cycle, such as a mean."""

    label: str
    value: float


@dataclass(frozen=True)
class Panel:
    """One panel: the quantity as a word with its symbol, its dimension, curves and levels; ``fill`` shades the first
    curve down to the first level, or to zero; ``log``: whether its axis is logarithmic."""

    title: str
    dimension: str
    curves: tuple[Curve, ...]
    levels: tuple[Level, ...] = ()
    fill: bool = False
    log: bool = False

    @property
    def unit(self) -> Unit:
        """The unit in which the panel is shown."""
        return unit_of(self.dimension, [curve.values for curve in self.curves])


def with_mean(
    title: str, dimension: str, curve: Curve, mean: float, request: Request, whose: str = "", *, fill: bool = False
) -> Panel:
    """A panel of one curve with the level of its mean, which the legend names with its value; without it where there
    is none, as of a cycle that is only partly reached."""
    if np.isnan(mean):
        return Panel(title, dimension, (curve,))
    value = _readable(Panel(title, dimension, (curve,)).unit, dimension, mean, curve.values)
    level = Level(f"{whose}{request.translate(_('mean {value}').format(value=value))}", mean)
    return Panel(title, dimension, (curve,), (level,), fill)


def _readable(unit: Unit, dimension: str, value: float, values: Floats) -> str:
    """A value with the unit of its axis, or one of its own where it is small against the values, but no rounding."""
    if ROUNDING * largest(values) < abs(value) < SMALL / unit.factor:
        unit = unit_of(dimension, [np.array([value])])
    return unit.text(value)


def look(number: int) -> tuple[str, str]:
    """Colour and dash of one of many curves."""
    return COLOURS[number % len(COLOURS)], DASHES[number // len(COLOURS) % len(DASHES)]


class OverInput(Kind):
    """A diagram of panels over the input."""

    @abstractmethod
    def panels(self, source: PlotInput, request: Request) -> list[Panel]:
        """The panels of one source, from the top down; the same number for every source."""

    def subject(self, sources: Sequence[PlotInput], request: Request) -> str:
        """What the title names besides the mechanism."""
        return request.translate(self.title)

    def output(self, source: PlotInput, request: Request) -> Output | None:
        """The output whose limit positions are marked."""
        return None

    def axis(self, source: PlotInput) -> InputAxis:
        """What the panels lie over."""
        return source.axis

    def draw(self, sources: Sequence[PlotInput], request: Request) -> Figure:
        panels = _laid_over([(each, self.axis(each), self.panels(each, request)) for each in sources])
        axis = self.axis(sources[0])

        def mark(axes: list[Axes], legend: Legend) -> None:
            if request.marks and len(sources) == 1 and sources[0].has_motion:
                _draw_marks(axes, sources[0], self.output(sources[0], request), legend, request.translate)

        title = request.titled(sources[0].label if len(sources) == 1 else "", self.subject(sources, request))
        return stacked(panels, axis, request, title, mark)


def stacked(
    panels: Sequence[Panel],
    axis: InputAxis,
    request: Request,
    title: str,
    mark: Callable[[list[Axes], Legend], None] | None = None,
) -> Figure:
    """A figure with panels one below the other over one axis; ``mark`` adds to them and to the legend below."""
    figure = new_figure(request.size or (7.2, 1.2 + 1.9 * max(len(panels), 1.45)))
    axes = list(figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0])
    legend = Legend()
    for one, panel in zip(axes, panels, strict=True):
        draw_panel(one, panel, axis, request, legend)
    if mark is not None:
        mark(axes, legend)
    label_input(axes[-1], axis, request.translate)
    framed(figure, title, request, legend)
    figure.align_ylabels(axes)
    return figure


def plane(title: str, request: Request, unit: str = "mm") -> tuple[Figure, Axes]:
    """Axes of equal scale."""
    figure = new_figure(request.size or (5.4, 4.6))
    axes = figure.subplots()
    make_plane(axes, 0.15, unit)
    framed(figure, title, request)
    return figure, axes


#: Inches that stand about a plane below and above, and bounds of its height as shares of its width.
AROUND, FLAT, TALL = 1.2, 0.3, 1.25


def fit_plane(figure: Figure, axes: Axes, request: Request) -> None:
    """Makes a figure as high as what its plane shows, where no size is asked for."""
    if request.size is None:
        wide, extent = float(figure.get_size_inches()[0]), axes.dataLim
        share = extent.height / extent.width if extent.width > 0.0 else TALL
        figure.set_size_inches(wide, AROUND + (wide - 1.2) * min(max(share, FLAT), TALL))


def _laid_over(parts: list[tuple[PlotInput, InputAxis, list[Panel]]]) -> list[Panel]:
    """The panels of the first source with the curves of the others, one colour for each source."""
    if len(parts) == 1:
        return parts[0][2]
    merged: list[list[Curve]] = [[] for _unused in parts[0][2]]
    for number, (source, axis, panels) in enumerate(parts):
        for into, panel in zip(merged, panels, strict=False):
            for which, curve in enumerate(panel.curves):
                own = f": {curve.label}" if curve.label else ""
                x = axis.values if curve.x is None else curve.x
                colour, dash = COLOURS[number % len(COLOURS)], DASHES[which % len(DASHES)]
                label = f"{source.label}{own}"
                into.append(replace(curve, label=label, x=x, peak="", colour=colour, dash=dash))
    return [
        replace(panel, curves=tuple(curves), levels=(), fill=False)
        for panel, curves in zip(parts[0][2], merged, strict=True)
    ]


def draw_panel(axes: Axes, panel: Panel, axis: InputAxis, request: Request, legend: Legend) -> None:
    """Curves, levels, range, label and peaks of one panel; what they are called goes into the legend."""
    unit, looks = panel.unit, map(look, range(len(panel.curves)))
    curves = [
        replace(curve, colour=curve.colour or colour, dash=curve.dash or dash)
        for curve, (colour, dash) in zip(panel.curves, looks, strict=True)
    ]
    for curve in curves:
        x, y = through_peaks(curve, axis)
        shown = x * axis.unit.factor, y * unit.factor
        (line,) = axes.plot(*shown, color=curve.colour, linestyle=curve.dash)
        legend.add(curve.label, line)
    for level in panel.levels:
        line = axes.axhline(level.value * unit.factor, color=COLOURS[1], linewidth=1.1, linestyle=(0, (6, 3)))
        legend.add(level.label, line)
    if panel.fill:
        _fill(axes, panel, axis, unit)
    if panel.log:
        axes.set_yscale("log")
        plain_ticks(axes.yaxis, axes.get_ylim())
    else:
        axes.axhline(0.0, color="#9aa0a6", linewidth=0.7, zorder=1.2)
        _set_range(axes, panel, axis, unit)
    axes.set_ylabel(unit.label(panel.title, "\n"))
    if request.marks:
        mark_peaks(axes, curves, axis, unit)


def _fill(axes: Axes, panel: Panel, axis: InputAxis, unit: Unit) -> None:
    """The areas between the first curve and its first level, or zero."""
    curve, level = panel.curves[0], panel.levels[0].value * unit.factor if panel.levels else 0.0
    colours = COLOURS[1:3] if panel.levels else COLOURS[:1] * 2
    x = (axis.values if curve.x is None else curve.x) * axis.unit.factor
    y = curve.values * unit.factor
    for where, colour in zip((y > level, y < level), colours, strict=True):
        axes.fill_between(x, y, level, where=where.tolist(), interpolate=True, color=colour, alpha=0.14, linewidth=0)


def _set_range(axes: Axes, panel: Panel, axis: InputAxis, unit: Unit) -> None:
    """Room for the texts at peaks, no zooming into rounding errors, zero only where it is near."""
    numbers = [through_peaks(curve, axis)[1] for curve in panel.curves]
    every = np.concatenate([*numbers, np.array([level.value for level in panel.levels])]) * unit.factor
    every = every[np.isfinite(every)]
    if not len(every):
        return
    low, high = float(every.min()), float(every.max())
    threshold = 1e-9 * max(abs(low), abs(high)) + 1e-12 * unit.factor
    if high - low <= threshold:
        room = max(0.1 * abs(high), 1.0)
        axes.set_ylim(low - room, high + room)
        return
    room = 0.2 * (high - low)
    grounded = 0 <= low < 0.5 * high and not any(curve.peak == "both" or curve.marks for curve in panel.curves)
    axes.set_ylim(-0.02 * high if grounded else low - room, high + room)


def _draw_marks(
    axes: list[Axes], source: PlotInput, output: Output | None, legend: Legend, translate: Translate
) -> None:
    factor = source.axis.unit.factor
    limits = limit_marks(source, output)
    for phase in phase_marks(source, limits):
        _shade(axes, phase, factor)
        legend.patch(translate(_("{load} acts", load=phase.name)), SHADE)
    for limit in limits:
        for one in axes:
            one.axvline(limit.place * factor, color=FAINT, linewidth=0.9, linestyle=(0, (4, 3)), zorder=1.5)
    if limits:
        _name_limits(axes[0], limits, source.axis, translate)
        legend.line(translate(_("limit position of {output}", output=str(output))), FAINT, (0, (4, 3)))


def _shade(axes: list[Axes], phase: PhaseMark, factor: float) -> None:
    for one in axes:
        one.axvspan(phase.begin * factor, phase.end * factor, color=SHADE, alpha=0.75, linewidth=0, zorder=0.5)


def _name_limits(axes: Axes, limits: list[LimitMark], axis: InputAxis, translate: Translate) -> None:
    """Inputs of the limit positions above the panel; two that are close stand one over the other."""
    span = abs(axis.values[-1] - axis.values[0]) or 1.0
    ordered = sorted(limits, key=lambda each: each.place)
    row, before = 0, -np.inf
    for limit in ordered:
        row = 1 - row if limit.place - before < 0.14 * span else 0
        before = limit.place
        text = f"{translate(_('max') if limit.kind == 'max' else _('min'))} {axis.unit.text(limit.place)}"
        axes.annotate(
            text,
            (limit.place * axis.unit.factor, 1.0),
            (0, 2 + 9 * row),
            ha="center",
            va="bottom",
            xycoords=("data", "axes fraction"),
            textcoords="offset points",
            fontsize=7.5,
            color=INK,
        )
