"""Diagrams of tolerance studies: the machines' numbers, and curves with their bands."""

from __future__ import annotations

import numpy as np

from linkwright.designs.tolerance.result import Spread
from linkwright.pictures.diagram import COLOURS, FAINT, Axes, Figure, new_figure
from linkwright.plot.diagrams.axes import unit_of
from linkwright.plot.diagrams.base import Request, framed, result_diagram


@result_diagram("tolerance", Spread)
def draw_tolerance(result: Spread, request: Request) -> Figure:
    """Histograms of summaries with the linear normal distribution and limits; curves' deviation ±3σ and shift."""
    texts = [t for t in result.study.of if result.swept is not None]
    count = max(len(texts) + len(result.study.curves), 1)
    figure = new_figure(request.size or (7.2, 1.0 + 2.4 * count))
    axes = list(figure.subplots(count, 1, squeeze=False)[:, 0])
    for one, text in zip(axes, texts, strict=False):
        _histogram(one, result, text, request)
    for one, output in zip(axes[len(texts) :], result.study.curves, strict=False):
        _band(one, result, output)
    framed(figure, request.titled(result.title), request)
    return figure


def _histogram(axes: Axes, result: Spread, text: str, request: Request) -> None:
    values, shown = result.values(text), unit_of(result.dimension(text))
    axes.hist(values * shown.factor, bins=60, color=FAINT, alpha=0.5)
    sigma, middle = result.linear(text), float(values.mean())
    if sigma:
        x = np.linspace(values.min(), values.max(), 300)
        width = float(np.ptp(values)) / 60
        density = np.exp(-0.5 * ((x - middle) / sigma) ** 2) / (sigma * np.sqrt(2 * np.pi))
        axes.plot(x * shown.factor, density * width * len(values), color=COLOURS[0])
    limit = result.study.limits.get(text)
    for end in (limit.lower, limit.upper) if limit else ():
        if np.isfinite(end):
            axes.axvline(end * shown.factor, color=COLOURS[1], linestyle="--", linewidth=1.1)
    axes.set_xlabel(shown.label(text))
    axes.set_ylabel(request.say("machines"))


def _band(axes: Axes, result: Spread, output: str) -> None:
    """±3σ about the shift by pressed pins, over the input, and between which values 99.73 % of the machines lie."""
    place, _, deviation = result.curve(output)
    shift, shown = result.pressed(output), unit_of(result.dimension(output))
    turning = unit_of("angle" if result.turning else "length")
    x = place * turning.factor
    low, high = ((shift + sign * 3 * deviation) * shown.factor for sign in (-1, 1))
    axes.fill_between(x, low, high, color=COLOURS[0], alpha=0.2, linewidth=0)
    axes.plot(x, shift * shown.factor, color=COLOURS[0])
    if output in result.curves:
        nominal = result.curve(output)[1] - shift
        for edge in (result.curves[output].low, result.curves[output].high):
            axes.plot(x, (edge - nominal) * shown.factor, color=COLOURS[1], linestyle="--", linewidth=1.0)
    axes.set_xlabel(turning.label("φ" if result.turning else "s"))
    axes.set_ylabel(shown.label(f"Δ {output} ± 3σ", "\n"))
