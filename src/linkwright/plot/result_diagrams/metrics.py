"""Design numbers as dots against their recommended limits."""

from __future__ import annotations

import numpy as np

from linkwright.errors import RequestError
from linkwright.metrics.base import METRICS, MetricValue
from linkwright.metrics.table import MetricsTable
from linkwright.pictures.diagram import COLOURS, FAINT, Axes, Figure, new_figure
from linkwright.plot.diagrams.axes import Legend, Unit, unit_of
from linkwright.plot.diagrams.base import Request, framed, result_diagram
from linkwright.words.sentence import Sentence

#: Height of a row of dots and of an axis with its label, inches.
ROW, AXIS = 0.3, 0.75
WRONG = "#f6d5d0"
Group = tuple[str, tuple[MetricValue, ...]]


@result_diagram("metrics", MetricsTable, options=("of",))
def draw_metrics(result: MetricsTable, request: Request) -> Figure:
    """A row of dots for every subject of a metric, an axis for every metric and unit, with its recommended limit.

    The side on which the limit is not kept is shaded. Without ``of``: the metrics that have a limit.
    """
    groups = _groups(result, request)
    heights = [AXIS + ROW * len(rows) for _, rows in groups]
    figure = new_figure(request.size or (7.2, 0.7 + sum(heights)))
    places = figure.subplots(len(groups), 1, squeeze=False, gridspec_kw={"height_ratios": heights})[:, 0]
    legend = Legend()
    for axes, (name, rows) in zip(places, groups, strict=True):
        _draw(axes, name, rows, request, legend)
    framed(figure, request.titled(result.title), request, legend)
    return figure


def _groups(result: MetricsTable, request: Request) -> list[Group]:
    """Rows that share an axis: of one metric, one dimension, and one limit."""
    names = request.of or tuple(name for name in result.names if METRICS[name].limit is not None)
    if not names:
        first = result.names[:1]
        hint = Sentence("picture.name_one", name=first[0]) if first else Sentence("picture.no_numbers")
        raise RequestError("picture.no_limit", hint=hint)
    found: dict[tuple[str, str, float | None], list[MetricValue]] = {}
    for name in names:
        for row in result[name]:
            if np.isfinite(row.value):
                found.setdefault((name, row.dimension, row.limit), []).append(row)
    if not found:
        raise RequestError("picture.not_finite", names=names)
    return [(name, tuple(rows)) for (name, *_), rows in found.items()]


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
    legend.add(request.say("recommended"), line)
    if better is None:
        return
    low, high = axes.get_xlim()
    wrong = (low, place) if better == "higher" else (place, high)
    axes.axvspan(*wrong, color=WRONG, linewidth=0, zorder=0.5)
    legend.patch(request.say("outside"), WRONG)


def _number(axes: Axes, value: float, place: float, unit: Unit) -> None:
    axes.annotate(unit.text(value), (value * unit.factor, place), (6 if value >= 0 else -6, 0),
                  textcoords="offset points", ha="left" if value >= 0 else "right", va="center", fontsize=7.5,
                  annotation_clip=False, zorder=5)  # fmt: skip
