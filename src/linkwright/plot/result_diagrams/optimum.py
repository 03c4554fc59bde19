"""What an optimisation found: the front of two objectives with the start, or how the least value fell."""

from __future__ import annotations

from typing import Any

import numpy as np

from linkwright.core.quantity import unit_of_kind
from linkwright.designs.optimise.optimum import Optimum
from linkwright.designs.optimise.report import label
from linkwright.pictures.diagram import COLOURS, INK, Figure, new_figure
from linkwright.plot.diagrams.base import Request, result_diagram
from linkwright.words import say
from linkwright.words.sentence import in_language

#: A front of less than this share of the way to the start would be a dot beside it; the start stays outside then.
NEAR = 0.1


@result_diagram("optimisation", Optimum)
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
    title = say(
        "optimize.picture",
        request.language,
        name=in_language(result.problem.mechanism.name, request.language),
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
    axes.plot(x, y, "o-", ms=4.5, color=COLOURS[0], lw=1, label=say("optimize.legend.front", language))
    if np.isfinite([x0, y0]).all():
        wide, high = max(np.ptp([*x, x0]), 1e-300), max(np.ptp([*y, y0]), 1e-300)
        near = len(x) == 1 or (np.ptp(x) > NEAR * wide and np.ptp(y) > NEAR * high)
        key = "optimize.legend.start" if near else "optimize.legend.outside"
        said = say(key, language, x=f"{x0:.5g}", y=f"{y0:.5g}")
        axes.plot([x0] if near else [], [y0] if near else [], "s", ms=7, mfc="none", color=INK, label=said)
    axes.margins(0.06)
    axes.set_xlabel(x_label)
    axes.set_ylabel(y_label)
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
    said = say("optimize.legend.search", language)
    axes.step(generations, history, where="post", color=COLOURS[0], label=said)
    best = result.best.numbers[goal.text] * factor
    axes.plot(
        [len(result.history)],
        [best],
        "o",
        color=COLOURS[1],
        label=say("optimize.legend.polished", language),
    )
    if np.isfinite(result.start[goal.text]):
        start = result.start[goal.text] * factor
        axes.axhline(start, ls="--", lw=1, color=INK, label=say("optimize.legend.start", language))
    axes.margins(0.03)
    axes.set_xlabel(say("optimize.axis.generation", language))
    title = label(result, goal.text, language)
    axes.set_ylabel(f"{title}, {symbol}" if symbol else title)
    axes.legend()
