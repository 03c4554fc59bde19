"""Designs in the space of their metrics and dimensions, what an optimisation found, and the tables behind it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from linkwright import units
from linkwright.core.arrays import Flags, Floats
from linkwright.core.quantity import significant, unit_of_kind
from linkwright.designs.optimise.optimum import Optimum, label
from linkwright.designs.ranges import dimension_of
from linkwright.designs.sensitivity import Sensitivity
from linkwright.errors import RequestError
from linkwright.mechanism.mechanism import Mechanism
from linkwright.pictures.diagram import COLOURS, INK, Axes, Figure, new_figure
from linkwright.plotting.diagrams.axes import InputAxis, Legend, Unit, unit_of
from linkwright.plotting.diagrams.base import Request, framed, result_diagram
from linkwright.plotting.diagrams.marks import Curve
from linkwright.plotting.diagrams.panels import Panel, stacked
from linkwright.registry import offered
from linkwright.words import _
from linkwright.words.message import in_language

FAILED = "#c0392b"
#: From so many designs on, points would hide each other, and their number in cells is shown.
CROWD = 5000
#: Designs on a curve up to which each is a dot.
DOTS = 61
#: Places at which failed designs are marked along an axis, at most.
RUG = 240


def draw_designs(table: DesignTable, request: Request) -> Figure:
    """The figure for designs: a curve, a map or clouds of points for every metric.

    Raises LinkwrightError where nothing varies.
    """
    if not table.moving:
        raise RequestError(
            _("all designs are the same, so there is nothing to draw; vary a dimension", code="picture.same_designs")
        )
    legend = Legend()
    if len(table.moving) == 1:
        figure = _over_one(table, request, legend)
    elif len(table.moving) == 2 and table.grid:
        figure = _over_two(table, request, legend)
    else:
        figure = _clouds(table, request, legend)
    return framed(figure, request.titled(table.title), request, legend)


def _over_one(table: DesignTable, request: Request, legend: Legend) -> Figure:
    """A panel for every metric, over the one dimension."""
    (over,) = table.moving
    count = len(table.measures)
    figure = new_figure(request.size or (6.8, 1.2 + 1.9 * max(count, 1.45)))
    axes = figure.subplots(count, 1, sharex=True, squeeze=False)[:, 0]
    order = np.argsort(over.values, kind="stable")
    x, ok = over.values[order], table.ok[order]
    for one, measure in zip(axes, table.measures, strict=True):
        y = measure.values[order]
        one.plot(x, y, "-o" if len(x) <= DOTS else "-", color=COLOURS[0], markersize=3.2)
        _ground(one, y, measure.label, "\n")
        _failed(one, x[~ok], legend, request)
        if request.marks and measure.best is not None:
            _best(one, over.values[measure.best], measure, legend, request)
    axes[-1].set_xlabel(over.label)
    axes[-1].set_xlim(x[0] - 0.02 * (x[-1] - x[0]), x[-1] + 0.02 * (x[-1] - x[0]))
    figure.align_ylabels(list(axes))
    return figure


def _ground(axes: Axes, values: Floats, label: str, between: str) -> None:
    """Range and label of a metric's axis; values that differ by rounding alone lie on one line."""
    good = values[np.isfinite(values)]
    if len(good):
        low, high = float(good.min()), float(good.max())
        room = 0.14 * (high - low) if high - low > 1e-9 * max(abs(low), abs(high)) else max(0.1 * abs(high), 1.0)
        axes.set_ylim(low - room, high + room)
    axes.set_ylabel(label.replace(" (", f"{between}(") if label.endswith(")") else label)


def _failed(axes: Axes, x: Floats, legend: Legend, request: Request) -> None:
    """Crosses on the axis below for designs that cannot move; those too close to distinguish once."""
    if not len(x):
        return
    many = len(x) > RUG
    if many:
        x = np.unique(np.round((x - x.min()) / (np.ptp(x) or 1.0) * RUG)) / RUG * np.ptp(x) + x.min()
    (line,) = axes.plot(
        x,
        np.full(len(x), 0.02),
        "|" if many else "x",
        color=FAILED,
        markersize=4.5,
        transform=axes.get_xaxis_transform(),
        clip_on=False,
        zorder=4,
    )
    legend.add(request.translate(_("design fails")), line)


def _best(axes: Axes, x: float, measure: Column, legend: Legend, request: Request) -> None:
    assert measure.best is not None
    y = float(measure.values[measure.best])
    (line,) = axes.plot([x], [y], "o", color=COLOURS[1], markersize=8, fillstyle="none", zorder=5)
    legend.add(request.translate(_("best")), line)


def _over_two(table: DesignTable, request: Request, legend: Legend) -> Figure:
    """A map for every metric: colours with lines of equal value, crosses where a design cannot move."""
    across, up = table.moving
    count = len(table.measures)
    columns = min(count, 2)
    rows = -(-count // columns)
    figure = new_figure(request.size or ((6.4, 4.7) if count == 1 else (5.0 * columns + 0.4, 0.8 + 3.7 * rows)))
    places = figure.subplots(rows, columns, squeeze=False).ravel()
    order = np.lexsort((across.values, up.values))
    shape = (len(up.steps), len(across.steps))
    for one, measure in zip(places, table.measures, strict=False):
        _map(one, across.steps, up.steps, measure.values[order].reshape(shape), measure)
        failed = ~table.ok
        if failed.any():
            (line,) = one.plot(across.values[failed], up.values[failed], "x", color=FAILED, markersize=4.5)
            legend.add(request.translate(_("design fails")), line)
        if request.marks and measure.best is not None:
            place = (across.values[measure.best], up.values[measure.best])
            (ring,) = one.plot(
                *[[each] for each in place],
                "o",
                color=COLOURS[1],
                markersize=8,
                fillstyle="none",
                markeredgewidth=1.8,
                zorder=5,
            )
            legend.add(request.translate(_("best")), ring)
        one.set_xlabel(across.label)
        one.set_ylabel(up.label)
    for spare in places[count:]:
        spare.set_axis_off()
    return figure


def _map(axes: Axes, x: Floats, y: Floats, values: Floats, measure: Column) -> None:
    shown = np.ma.masked_invalid(values)
    mesh: Any = axes.pcolormesh(x, y, shown, shading="nearest", cmap="viridis", linewidth=0.2, edgecolors="face")
    axes.grid(False)
    figure = axes.get_figure()
    assert figure is not None
    bar: Any = figure.colorbar(mesh, ax=axes, label=measure.label, pad=0.02)
    bar.outline.set_linewidth(0.5)
    bar.solids.set(rasterized=False, edgecolor="face")
    good = shown.compressed()
    if min(values.shape) < 4 or not len(good) or np.ptp(good) <= 1e-9 * np.abs(good).max():
        return
    low, high = np.quantile(good, (0.04, 0.96))
    levels = np.array([tick for tick in bar.get_ticks() if low < tick < high])
    if len(levels) and np.isfinite(values[:-1, :-1] + values[1:, 1:]).any():
        lines = axes.contour(x, y, shown, levels=levels, colors="white", linewidths=0.8)
        axes.clabel(lines, fontsize=7, fmt=lambda level: significant(float(level)))


def _clouds(table: DesignTable, request: Request, legend: Legend) -> Figure:
    """A cloud of points for every metric over every dimension."""
    rows, columns = len(table.measures), len(table.moving)
    figure = new_figure(request.size or (max(6.0, 0.6 + 2.9 * columns), 0.9 + 2.3 * max(rows, 1.4)))
    places = figure.subplots(rows, columns, sharex="col", sharey="row", squeeze=False)
    for line, measure in zip(places, table.measures, strict=True):
        for one, over in zip(line, table.moving, strict=True):
            _cloud(one, over, measure)
            _failed(one, over.values[~table.ok], legend, request)
            if request.marks and measure.best is not None:
                _best(one, float(over.values[measure.best]), measure, legend, request)
        _ground(line[0], measure.values, measure.label, "\n")
    for one, over in zip(places[-1], table.moving, strict=True):
        one.set_xlabel(over.label)
        room = 0.03 * float(np.ptp(over.values))
        one.set_xlim(over.values.min() - room, over.values.max() + room)
    figure.align_ylabels(list(places[:, 0]))
    return figure


def _cloud(axes: Axes, over: Column, measure: Column) -> None:
    good = np.isfinite(measure.values)
    x, y = over.values[good], measure.values[good]
    if len(x) > CROWD:
        axes.hexbin(x, y, gridsize=48, mincnt=1, bins="log", vmin=0.2, cmap="Blues", linewidths=0.1)
    else:
        axes.plot(x, y, "o", color=COLOURS[0], markersize=3.0 if len(x) < 400 else 1.6, alpha=0.75, markeredgewidth=0)


@dataclass(frozen=True)
class Column:
    """A dimension that varies, or a metric: ``values`` (designs,) in the unit in which it is shown; ``best``: number
    of the design in which a metric is best."""

    name: str
    values: Floats
    unit: Unit
    best: int | None = None

    @property
    def label(self) -> str:
        """The label of its axis."""
        return self.unit.label(self.name)

    @property
    def steps(self) -> Floats:
        """The different values, rising."""
        return np.unique(self.values)


@dataclass(frozen=True)
class DesignTable:
    """Designs in rows: what varies, the metrics, and which designs pass the cycle; ``grid``: all combinations."""

    title: str
    varied: tuple[Column, ...]
    measures: tuple[Column, ...]
    ok: Flags

    @property
    def moving(self) -> tuple[Column, ...]:
        """The dimensions that have more than one value."""
        return tuple(each for each in self.varied if len(each.steps) > 1)

    @property
    def grid(self) -> bool:
        """Whether the designs are every combination of the values, each once."""
        places = np.column_stack([each.values for each in self.moving])
        return len(np.unique(places, axis=0)) == len(places) == np.prod([len(e.steps) for e in self.moving])


def varied(mechanism: Mechanism, name: str, values: Floats, written: str = "") -> Column:
    """A dimension in the unit that the user wrote, else in the usual one of its kind."""
    unit = _unit(mechanism, name, written)
    return Column(name, np.asarray(values * unit.factor), unit)


def measure(name: str, values: Floats, dimension: str, best: int | None = None) -> Column:
    """A metric in the unit for its size."""
    unit = unit_of(dimension, [values])
    return Column(name, np.asarray(values * unit.factor), unit, best)


def chosen(asked: tuple[str, ...], known: Mapping[str, object]) -> list[str]:
    """The metrics that are asked for, all by default; raises LinkwrightError for one that is not there."""
    for name in asked:
        if name not in known:
            raise RequestError(
                _(
                    'there is no metric "{name}" here; {hint}',
                    code="picture.no_metric",
                    name=name,
                    hint=offered(name, known),
                )
            )
    return list(asked or known)


def _unit(mechanism: Mechanism, name: str, written: str) -> Unit:
    if written:
        return Unit("°" if written == "deg" else written, 1.0 / units.unit(written)[0])
    found = dimension_of(mechanism, name)
    if found == units.DIMENSIONS["length"]:
        return unit_of("length")
    if found == units.DIMENSIONS["angle"]:
        return unit_of("angle")
    return Unit("SI" if found is None else units.si_symbol(found), 1.0)


#: A front of less than this share of the way to the start would be a dot next to it; the start stays outside then.
NEAR = 0.1


@result_diagram("optimisation", _("best designs"), Optimum)
def draw_optimisation(result: Optimum, request: Request) -> Figure:
    """Objectives of the designs against the first one, with the start; for one objective the search's progress."""
    goals = result.problem.goals
    count = max(len(goals) - 1, 1)
    figure = new_figure(request.size or (7.0, 1.4 + 3.4 * count))
    axes = figure.subplots(count, 1, squeeze=False)[:, 0]
    if len(goals) == 1:
        _progress(axes[0], result, request.language)
    for one, goal in zip(axes, goals[1:], strict=False):
        _front(one, result, goal.text, request.language)
    title = _("Optimisation of {name}", name=in_language(result.problem.mechanism.name, request.language)).translate(
        request.language
    )
    figure.suptitle(title if request.title is None else request.title)
    return figure


def _front(axes: Any, result: Optimum, text: str, language: str) -> None:
    first = result.problem.goals[0].text
    columns = []
    for name in (first, text):
        symbol, factor = unit_of_kind(result.kinds[name])
        values = np.array([each.numbers[name] for each in result.choices]) * factor
        title = label(result, name, language)
        columns.append((values, result.start[name] * factor, f"{title}, {symbol}" if symbol else title))
    (x, x0, x_label), (y, y0, y_label) = columns
    axes.plot(x, y, "o-", ms=4.5, color=COLOURS[0], lw=1, label=_("front").translate(language))
    if np.isfinite([x0, y0]).all():
        wide, high = max(np.ptp([*x, x0]), 1e-300), max(np.ptp([*y, y0]), 1e-300)
        near = len(x) == 1 or (np.ptp(x) > NEAR * wide and np.ptp(y) > NEAR * high)
        caption = (
            _("start") if near else _("start ({x}, {y}) lies outside", x=f"{x0:.5g}", y=f"{y0:.5g}")
        ).translate(language)
        axes.plot([x0] if near else [], [y0] if near else [], "s", ms=7, mfc="none", color=INK, label=caption)
    axes.margins(0.06)
    axes.set(xlabel=x_label, ylabel=y_label)
    axes.legend()


def _progress(axes: Any, result: Optimum, language: str) -> None:
    goal = result.problem.goals[0]
    symbol, factor = unit_of_kind(result.kinds[goal.text])
    history = goal.sign * np.array([np.nan if np.isinf(v) else v for v in result.history]) * factor
    generations = np.arange(1, len(history) + 1)
    met = all(low <= result.start[text] <= high for text, (low, high) in result.limits.items())
    if met and np.isfinite(result.start[goal.text]):
        generations = np.arange(len(history) + 1)
        history = np.append(result.start[goal.text] * factor, history)
    caption = _("best of the search").translate(language)
    axes.step(generations, history, where="post", color=COLOURS[0], label=caption)
    best = result.best.numbers[goal.text] * factor
    axes.plot(
        [len(result.history)], [best], "o", color=COLOURS[1], label=_("after the last steps").translate(language)
    )
    if np.isfinite(result.start[goal.text]):
        start = result.start[goal.text] * factor
        axes.axhline(start, ls="--", lw=1, color=INK, label=_("start").translate(language))
    axes.margins(0.03)
    axes.set_xlabel(_("generation").translate(language))
    title = label(result, goal.text, language)
    axes.set_ylabel(f"{title}, {symbol}" if symbol else title)
    axes.legend()


#: Steps in which a dimension that is zero is changed, with their texts, by its kind.
_STEPS = {"length": (1e-3, "1 mm"), "angle": (math.radians(1.0), "1°")}


@result_diagram(
    "sensitivity", _("relative sensitivities"), Sensitivity, options=("of",), when=lambda result: bool(result.values)
)
def draw_sensitivity(result: Sensitivity, request: Request) -> Figure:
    """Bars of (p/y)·dy/dp: the change of a summary in percent per percent of a dimension; a colour a summary.

    A summary that is zero has none, and a dimension that is zero has no percent: it stays at zero.
    """
    known = {summary.name: summary for summary in result.values}
    names = chosen(request.of, known)
    table = {name: result.relative(known[name].output, known[name].kind) for name in names}
    if not any(np.isfinite(row).any() for row in table.values()):
        raise RequestError(
            _(
                "all of these summaries are zero, so they have no relative sensitivity to draw",
                code="picture.zero_summaries",
            )
        )
    figure = new_figure(request.size or (7.2, 1.3 + len(result.by) * (0.22 + 0.16 * len(names))))
    axes, legend = figure.subplots(), Legend()
    places, thick = np.arange(len(result.by)), 0.8 / len(names)
    for number, (name, row) in enumerate(table.items()):
        at = places + (number - 0.5 * (len(names) - 1)) * thick
        bars = axes.barh(at, row, 0.92 * thick, color=COLOURS[number % len(COLOURS)])
        legend.add(name, bars[0])
    axes.axvline(0.0, color="#9aa0a6", linewidth=0.8)
    axes.set_yticks(places, list(result.by))
    axes.set_ylim(len(result.by) - 0.4, -0.6)
    axes.margins(x=0.06)
    axes.set_xlabel(request.translate(_("change per 1 % of the dimension (%)")))
    return framed(figure, request.titled(result.mechanism.name), request, legend)


@result_diagram(
    "sensitivity_curves",
    _("sensitivities over the input"),
    Sensitivity,
    options=("of",),
    when=lambda result: bool(result.curves),
)
def draw_sensitivity_curves(result: Sensitivity, request: Request) -> Figure:
    """Change of an output over the input when a dimension grows by a hundredth: 0.01·p·∂y/∂p; a panel an output.

    A dimension that is zero grows by 1 mm, 1° or its SI unit instead.
    """
    axis = _axis(result)
    panels = [_panel(result, name, request) for name in chosen(request.of, result.curves)]
    return stacked(panels, axis, request, request.titled(result.mechanism.name))


def _axis(result: Sensitivity) -> InputAxis:
    from linkwright.kinematics.cycle import over_cycle

    if len(result.input) < 2:
        raise RequestError(
            _(
                '"{name}" was solved at one position only, so there are no curves; ask for summaries',
                code="picture.no_curves_here",
                name=result.mechanism.name,
            )
        )
    turning = next(iter(over_cycle(result.mechanism, 1).rotary.values()))
    return InputAxis("angle" if turning else "length", result.input)


def _panel(result: Sensitivity, name: str, request: Request) -> Panel:
    curves = []
    for by in result.by:
        step, text = _step(result.mechanism, by)
        label = request.translate(_("{dimension} + {step}", dimension=by, step=text))
        values: Floats = step * result.slope(name, by)
        curves.append(Curve(label, values))
    return Panel(
        request.translate(_("change of {output}", output=name)), result.quantities[name].dimension, tuple(curves)
    )


def _step(mechanism: Mechanism, by: str) -> tuple[float, str]:
    """How far a dimension is changed, SI, and the text of it."""
    value = mechanism.dimensions()[by]
    if value:
        return 0.01 * value, "1 %"
    found = dimension_of(mechanism, by)
    kind = next((name for name in _STEPS if units.DIMENSIONS[name] == found), None)
    if kind is not None:
        return _STEPS[kind]
    return 1.0, "1" if found is None else f"1 {units.si_symbol(found)}".strip()
