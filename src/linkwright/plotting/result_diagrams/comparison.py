"""Designs and studies side by side: bars of metrics, curves over an input."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from linkwright.analysis.base import METRICS, MetricValue
from linkwright.analysis.evaluate import MetricsTable
from linkwright.core.arrays import Floats
from linkwright.designs.compare import Comparison, Overlay
from linkwright.designs.criteria import criterion
from linkwright.designs.study import Study
from linkwright.designs.sweep import Sweep
from linkwright.errors import RequestError
from linkwright.pictures.diagram import COLOURS, FAINT, Axes, Figure, new_figure
from linkwright.plotting.diagrams.axes import SYMBOLS, InputAxis, Legend, Unit, make_force_plane, unit_of
from linkwright.plotting.diagrams.base import Request, framed, result_diagram
from linkwright.plotting.diagrams.marks import Curve
from linkwright.plotting.diagrams.motion import ANGULAR, STRAIGHT
from linkwright.plotting.diagrams.panels import Panel, look, stacked
from linkwright.plotting.diagrams.source import PlotInput
from linkwright.plotting.result_diagrams.design_space import DesignTable, chosen, draw_designs, measure, varied
from linkwright.registry import offered
from linkwright.words import Translate, _

HODOGRAPH = "hodograph"
#: What a motion is called and measured in, for an output that turns and for one that slides.
_MOTION = dict(zip(("travel", "velocity", "acceleration"), zip(ANGULAR, STRAIGHT, strict=True), strict=True))
#: What the other curves are.
CURVES = {
    "input": _("input passed"),
    "pivot_reaction": _("reaction at the output's pivot"),
    "input_torque": _("balancing torque"),
}


@result_diagram("comparison", _("alternatives over each other"), Comparison, options=("of",))
def draw_comparison(result: Comparison, request: Request) -> Figure:
    """Curves of all alternatives over the input that has passed since the cycle's begin, a colour for each.

    ``of``: travel, velocity, acceleration, pivot_reaction, input_torque; all that there are by default.
    """
    sources = {each.label: PlotInput(each.motion) for each in result.alternatives}
    axis = _axis(sources, request.translate)
    panels = [
        panel for overlay in _chosen(result, request.of) for panel in _panels(result, overlay, sources, request)
    ]
    return stacked(panels, axis, request, " – ".join(result.labels))


@result_diagram("pivot_hodograph", _("hodographs of the reaction at the output's pivot"), Comparison, usual=False)
def draw_pivot_hodograph(result: Comparison, request: Request) -> Figure:
    """Hodographs of the reaction at the output's pivot, all alternatives from one origin, in the frame's axes."""
    overlay = next((each for each in result.curves if each.name == HODOGRAPH), None)
    if overlay is None:
        raise RequestError(
            _(
                "the alternatives carry no loads or masses, so no pivot has a reaction; give some",
                code="picture.no_pivot_reactions",
            )
        )
    unit = unit_of("force", [values for line in overlay.lines.values() for values in line])
    figure = new_figure(request.size or (6.4, 5.4))
    axes, legend = figure.subplots(), Legend()
    sources = {each.label: PlotInput(each.motion) for each in result.alternatives}
    for number, (label, components) in enumerate(overlay.lines.items()):
        x, y = map(sources[label].closed, components)
        colour, dash = look(number)
        (line,) = axes.plot(x * unit.factor, y * unit.factor, color=colour, linestyle=dash)
        legend.add(label, line)
    make_force_plane(axes, unit)
    return framed(figure, request.titled(""), request, legend)


def _chosen(result: Comparison, names: Sequence[str]) -> list[Overlay]:
    """The curves that are asked for."""
    known = {each.name: each for each in result.curves if each.name != HODOGRAPH}
    for name in names:
        if name not in known:
            raise RequestError(
                _(
                    'there is no curve "{name}" of this comparison; {hint}',
                    code="picture.no_curve",
                    name=name,
                    hint=offered(name, known),
                )
            )
    return [known[name] for name in names or known]


def _axis(sources: Mapping[str, PlotInput], translate: Translate) -> InputAxis:
    """The input passed; raises LinkwrightError where one input turns and another slides."""
    turning = {next(iter(each.motion.positions.rotary.values())) for each in sources.values()}
    if len(turning) > 1:
        raise RequestError(
            _(
                "one alternative has an input that turns and another one that slides, so their "
                "curves have no common axis; draw the pivot_hodograph",
                code="picture.turn_and_slide",
            )
        )
    longest = max(map(_passed, sources.values()), key=lambda x: float(np.nanmax(x)))
    dimension = "angle" if turning.pop() else "length"
    return InputAxis(dimension, longest, f"{translate(_('input passed'))} {SYMBOLS[dimension]}")


def _passed(source: PlotInput) -> Floats:
    """How far the input has gone since the cycle began, up to its end."""
    return np.asarray(np.abs(source.input - source.input[0]))


def _panels(result: Comparison, overlay: Overlay, sources: Mapping[str, PlotInput], request: Request) -> list[Panel]:
    """One panel for a quantity; two where some outputs turn and others slide."""
    looks = {label: look(n) for n, label in enumerate(result.labels)}
    kinds = _MOTION.get(overlay.name)
    if kinds is None:
        title = request.translate(CURVES[overlay.name])
        curves = [_curve(overlay, label, sources[label], looks) for label in result.labels]
        return [Panel(title, overlay.dimension, tuple(curves))]
    found = []
    for turning, (word, symbol, dimension) in zip((True, False), kinds, strict=True):
        labels = [each.label for each in result.alternatives if (each.output.kind == "angle") == turning]
        if labels:
            turns = dimension == "angle"
            curves = [_curve(overlay, label, sources[label], looks, turns=turns) for label in labels]
            found.append(Panel(f"{request.translate(word)} {symbol}", dimension, tuple(curves)))
    return found


def _curve(
    overlay: Overlay, label: str, source: PlotInput, looks: Mapping[str, tuple[str, str]], *, turns: bool = False
) -> Curve:
    """The curve of one alternative up to the end of its cycle; ``turns``: it is an angle."""
    values = source.closed(overlay.lines[label][1], turns=turns)
    return Curve(label, values, "", *looks[label], _passed(source))


#: Height of a row of dots and of an axis with its label, inches.
ROW, AXIS = 0.3, 0.75
WRONG = "#f6d5d0"
Group = tuple[str, tuple[MetricValue, ...]]


@result_diagram("metrics", _("metrics and recommended limits"), MetricsTable, options=("of",))
def draw_metrics(result: MetricsTable, request: Request) -> Figure:
    """A row of dots for every subject of a metric, an axis for every metric and unit, with its recommended limit.

    The side beyond the limit is shaded. Without ``of``: the metrics that have a limit.
    """
    groups = _groups(result, request)
    heights = [AXIS + ROW * len(rows) for _unused, rows in groups]
    figure = new_figure(request.size or (7.2, 0.7 + sum(heights)))
    places = figure.subplots(len(groups), 1, squeeze=False, gridspec_kw={"height_ratios": heights})[:, 0]
    legend = Legend()
    for axes, (name, rows) in zip(places, groups, strict=True):
        _draw(axes, name, rows, request, legend)
    return framed(figure, request.titled(result.title), request, legend)


def _groups(result: MetricsTable, request: Request) -> list[Group]:
    """Rows that share an axis: of one metric, one dimension, and one limit."""
    names = request.of or tuple(name for name in result.names if METRICS[name].limit is not None)
    if not names:
        first = result.names[:1]
        hint = _('name what to draw: of="{name}"', name=first[0]) if first else _("it has no numbers")
        raise RequestError(
            _(
                "nothing in this table has a recommended limit to be drawn against; {hint}",
                code="picture.no_limit",
                hint=hint,
            )
        )
    found: dict[tuple[str, str, float | None], list[MetricValue]] = {}
    for name in names:
        for row in result[name]:
            if np.isfinite(row.value):
                found.setdefault((name, row.dimension, row.limit), []).append(row)
    if not found:
        raise RequestError(
            _("there is no number to draw: {names} are not finite", code="picture.not_finite", names=names)
        )
    return [(name, tuple(rows)) for (name, *_unused), rows in found.items()]


def _draw(axes: Axes, name: str, rows: tuple[MetricValue, ...], request: Request, legend: Legend) -> None:
    metric = METRICS[name]()
    values = np.array([row.value for row in rows])
    limit = rows[0].limit
    unit = unit_of(rows[0].dimension, [values])
    shown, places = values * unit.factor, np.arange(len(rows))
    edges = [*shown.tolist(), *([] if limit is None else [limit * unit.factor])]
    low, high = min(*edges, 0.0), max(*edges, 0.0)
    room = 0.12 * (high - low) or 1.0
    axes.set_xlim(low - (room if low < 0 else 0.0), high + room)
    if limit is not None:
        _limit(axes, limit * unit.factor, metric.better, request, legend)
    axes.hlines(places, 0.0, shown, color=FAINT, linewidth=0.8, zorder=2)
    axes.plot(shown, places, "o", color=COLOURS[0], markersize=5.5, zorder=4, clip_on=False)
    for place, value in zip(places, values, strict=True):
        _number(axes, float(value), float(place), unit)
    axes.set_yticks(places, [row.subject for row in rows])
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.set_xlabel(unit.label(metric.label_in(request.language)))


def _limit(axes: Axes, place: float, better: str | None, request: Request, legend: Legend) -> None:
    line = axes.axvline(place, color=COLOURS[1], linewidth=1.1, linestyle=(0, (6, 3)), zorder=3)
    legend.add(request.translate(_("recommended limit")), line)
    if better is None:
        return
    low, high = axes.get_xlim()
    wrong = (low, place) if better == "higher" else (place, high)
    axes.axvspan(*wrong, color=WRONG, linewidth=0, zorder=0.5)
    legend.patch(request.translate(_("outside the limit")), WRONG)


def _number(axes: Axes, value: float, place: float, unit: Unit) -> None:
    axes.annotate(
        unit.text(value),
        (value * unit.factor, place),
        (6 if value >= 0 else -6, 0),
        textcoords="offset points",
        ha="left" if value >= 0 else "right",
        va="center",
        fontsize=7.5,
        annotation_clip=False,
        zorder=5,
    )


@result_diagram("study", _("parameter study"), Study, options=("of",))
def draw_study(result: Study, request: Request) -> Figure:
    """Every metric over what varies: a curve over one dimension, a map over a grid of two, points over others.

    Designs that cannot move are crossed, the best ones ringed. ``of``: the metrics, all by default.
    """
    over = tuple(
        varied(result.mechanism, each.address, result.varied[each.address], each.unit) for each in result.ranges
    )
    measures = tuple(
        measure(
            criterion(name).label(request.language),
            result.metrics[name],
            result.dimensions[name],
            result.best(name) if result.has_best(name) else None,
        )
        for name in chosen(request.of, result.metrics)
    )
    return draw_designs(DesignTable(result.mechanism.name, over, measures, result.ok), request)


@result_diagram("sweep", _("sweep over designs"), Sweep, options=("of",))
def draw_sweep(result: Sweep, request: Request) -> Figure:
    """Every summary over what varies: a curve over one dimension, a map over a full grid of two, points else.

    Designs that do not pass the cycle are crossed; many designs are shown by their number in cells. ``of``: the
    summaries, all by default.
    """
    known = {each.name: each for each in result.summaries}
    over = tuple(varied(result.mechanism, name, values) for name, values in result.varied.items())
    measures = tuple(
        measure(name, result.summaries[known[name]], result.dimension(known[name]))
        for name in chosen(request.of, known)
    )
    return draw_designs(DesignTable(result.mechanism.name, over, measures, result.ok), request)
