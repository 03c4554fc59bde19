"""Diagrams of statistics: samples with the distributions fitted to them, regressions."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from linkwright.parts.statistics.samples import Statistics
from linkwright.pictures.diagram import COLOURS, FAINT, Axes, Figure, new_figure
from linkwright.plot.diagrams.base import Request, framed, result_diagram
from linkwright.plot.diagrams.panels import DASHES


@result_diagram("samples", Statistics)
def draw_samples(result: Statistics, request: Request) -> Figure:
    """A histogram of every sample with its fits and limits, and every regression of one variable."""
    lines = [n for n, fitting in result.problem.regressions.items() if len(fitting.on) == 1]
    used = {
        n
        for name in lines
        for n in (result.problem.regressions[name].y, *result.problem.regressions[name].on)
    }
    names = [name for name in result.problem.samples if name not in used]
    count = max(len(names) + len(lines), 1)
    figure = new_figure(request.size or (7.2, 1.0 + 2.6 * count))
    axes = list(figure.subplots(count, 1, squeeze=False)[:, 0])
    fits = dict.fromkeys(fit.name for name in names for fit in result.fits.get(name, []))
    colours = dict(zip(sorted(fits), COLOURS, strict=False))
    for one, name in zip(axes, names, strict=False):
        _histogram(one, result, name, colours, request)
    for one, name in zip(axes[len(names) :], lines, strict=False):
        _regression(one, result, name)
    framed(figure, request.titled(result.title), request)
    return figure


def _histogram(
    axes: Axes, result: Statistics, name: str, colours: Mapping[str, str], request: Request
) -> None:
    values, scale = result.problem.values(name), result.scale(name)
    shown = values / scale.factor
    axes.hist(shown, bins="auto", density=True, color=FAINT, alpha=0.4)
    axes.plot(shown, np.zeros(len(shown)), "|", color="#333333", markersize=9)
    span = np.ptp(values) or abs(values[0]) or 1.0
    x = np.linspace(values.min() - 0.3 * span, values.max() + 0.3 * span, 300)
    for number, fit in enumerate(result.fits.get(name, [])):
        axes.plot(x / scale.factor, fit.density(x) * scale.factor, color=colours[fit.name], label=fit.name,
                  linestyle=DASHES[number % len(DASHES)])  # fmt: skip
    limits = result.problem.capability.get(name)
    for limit in (limits.lower, limits.upper) if limits else ():
        if limit is not None:
            axes.axvline(limit / scale.factor, color=COLOURS[1], linestyle="--", linewidth=1.1)
    axes.set_xlabel(f"{name} ({scale.unit})" if scale.unit else name)
    density = request.say("density")
    axes.set_ylabel(f"{density} (1/{scale.unit})" if scale.unit else density)
    if axes.get_legend_handles_labels()[0]:
        axes.legend()


def _regression(axes: Axes, result: Statistics, name: str) -> None:
    fitting, found = result.problem.regressions[name], result.regressions[name]
    x, y = result.problem.values(fitting.on[0]), result.problem.values(fitting.y)
    across, up = result.scale(fitting.on[0]), result.scale(fitting.y)
    axes.plot(x / across.factor, y / up.factor, "o", color=COLOURS[1], markersize=4)
    line = np.linspace(x.min(), x.max(), 200)
    fitted = sum(float(b) * line**power for power, b in enumerate(found.coefficients))
    axes.plot(line / across.factor, fitted / up.factor, color=COLOURS[0])
    axes.margins(0.05)
    axes.set_xlabel(f"{fitting.on[0]} ({across.unit})")
    axes.set_ylabel(f"{fitting.y} ({up.unit})")
