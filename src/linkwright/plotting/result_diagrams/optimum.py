"""What an optimisation found, and how far metrics follow dimensions."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from linkwright import units
from linkwright.core.arrays import Floats
from linkwright.core.quantity import unit_of_kind
from linkwright.designs.optimise.optimum import Optimum, label
from linkwright.designs.ranges import dimension_of
from linkwright.designs.sensitivity import Sensitivity
from linkwright.errors import RequestError
from linkwright.mechanism.mechanism import Mechanism
from linkwright.pictures.diagram import COLOURS, INK, Figure, new_figure
from linkwright.plotting.diagrams.axes import InputAxis, Legend
from linkwright.plotting.diagrams.base import Request, framed, result_diagram
from linkwright.plotting.diagrams.marks import Curve
from linkwright.plotting.diagrams.panels import Panel, stacked
from linkwright.plotting.result_diagrams.design_space import chosen
from linkwright.words import _
from linkwright.words.sentence import in_language

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
    axes.set_xlabel(request.say(_("change per 1 % of the dimension (%)")))
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
        label = request.say(_("{dimension} + {step}", dimension=by, step=text))
        values: Floats = step * result.slope(name, by)
        curves.append(Curve(label, values))
    return Panel(request.say(_("change of {output}", output=name)), result.quantities[name].dimension, tuple(curves))


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
