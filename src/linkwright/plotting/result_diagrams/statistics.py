"""Diagrams of statistics, tolerances and programs: samples and fits, deviations of machines, feasible regions."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import unit_of_kind
from linkwright.designs.tolerance.result import Spread
from linkwright.parts.programs.problem import Variable
from linkwright.parts.programs.program import Optimum
from linkwright.parts.statistics.samples import Statistics
from linkwright.pictures.diagram import COLOURS, FAINT, INK, SHADE, Axes, Figure, new_figure
from linkwright.plotting.diagrams.axes import Unit, unit_of
from linkwright.plotting.diagrams.base import Request, framed, result_diagram
from linkwright.plotting.diagrams.panels import DASHES
from linkwright.words import _, pgettext


@result_diagram("samples", _("samples"), Statistics)
def draw_samples(result: Statistics, request: Request) -> Figure:
    """A histogram of every sample with its fits and limits, and every regression of one variable."""
    lines = [n for n, fitting in result.problem.regressions.items() if len(fitting.on) == 1]
    used = {n for name in lines for n in (result.problem.regressions[name].y, *result.problem.regressions[name].on)}
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
    return framed(figure, request.titled(result.title), request)


def _histogram(axes: Axes, result: Statistics, name: str, colours: Mapping[str, str], request: Request) -> None:
    values, scale = result.problem.values(name), result.scale(name)
    shown = values / scale.factor
    axes.hist(shown, bins="auto", density=True, color=FAINT, alpha=0.4)
    axes.plot(shown, np.zeros(len(shown)), "|", color="#333333", markersize=9)
    span = np.ptp(values) or abs(values[0]) or 1.0
    x = np.linspace(values.min() - 0.3 * span, values.max() + 0.3 * span, 300)
    for number, fit in enumerate(result.fits.get(name, [])):
        axes.plot(
            x / scale.factor,
            fit.density(x) * scale.factor,
            color=colours[fit.name],
            label=fit.name,
            linestyle=DASHES[number % len(DASHES)],
        )
    limits = result.problem.capability.get(name)
    for limit in (limits.lower, limits.upper) if limits else ():
        if limit is not None:
            axes.axvline(limit / scale.factor, color=COLOURS[1], linestyle="--", linewidth=1.1)
    axes.set_xlabel(f"{name} ({scale.unit})" if scale.unit else name)
    density = request.translate(pgettext("plot", "density"))
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
    axes.set(xlabel=f"{fitting.on[0]} ({across.unit})", ylabel=f"{fitting.y} ({up.unit})")


@result_diagram("tolerance", _("spread by tolerances"), Spread)
def draw_tolerance(result: Spread, request: Request) -> Figure:
    """Histograms of summaries with the linear normal distribution and limits; curves' deviation ±3σ and shift."""
    texts = [t for t in result.study.of if result.swept is not None]
    count = max(len(texts) + len(result.study.curves), 1)
    figure = new_figure(request.size or (7.2, 1.0 + 2.4 * count))
    axes = list(figure.subplots(count, 1, squeeze=False)[:, 0])
    for one, text in zip(axes, texts, strict=False):
        _machines(one, result, text, request)
    for one, output in zip(axes[len(texts) :], result.study.curves, strict=False):
        _band(one, result, output)
    return framed(figure, request.titled(result.title), request)


def _machines(axes: Axes, result: Spread, text: str, request: Request) -> None:
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
    axes.set(xlabel=shown.label(text), ylabel=request.translate(_("machines")))


def _band(axes: Axes, result: Spread, output: str) -> None:
    """±3σ about the shift by pressed pins, over the input, and between which values 99.73 % of the machines lie."""
    place, _unused, deviation = result.curve(output)
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
    axes.set(xlabel=turning.label("φ" if result.turning else "s"), ylabel=shown.label(f"Δ {output} ± 3σ", "\n"))


GRID = 241


@result_diagram("optimum", _("constraints and optimum"), Optimum)
def draw_optimum(result: Optimum, request: Request) -> Figure:
    """Contours of the objective over two variables with the region that the constraints leave; else bars."""
    figure = new_figure(request.size or (6.6, 5.2))
    axes = figure.subplots()
    if len(result.x) == 2:
        _region(axes, result)
    else:
        _bars(axes, result, request)
    return framed(figure, request.titled(result.title), request)


def _span(variable: Variable, value: float) -> Floats:
    """Places around the optimum, within the bounds."""
    reach = 0.9 * abs(value) if value else variable.size
    low, high = value - reach, value + reach
    low = max(low, variable.minimum) if math.isfinite(variable.minimum) else low
    high = min(high, variable.maximum) if math.isfinite(variable.maximum) else high
    return np.linspace(low, high if high > low else low + 1.0, GRID)


def _region(axes: Axes, result: Optimum) -> None:
    names = list(result.x)
    spans = [_span(result.program.variables[n], result.x[n]) for n in names]
    u, v = (each.ravel() for each in np.meshgrid(*spans))
    point = dict(zip(names, (u, v), strict=True))
    units = [Unit(*unit_of_kind(result.program.variables[n].dimension)) for n in names]
    x, y = (span * unit.factor for span, unit in zip(spans, units, strict=True))
    value = result.program.model.objective.value(point).reshape(GRID, GRID)
    feasible = np.ones(len(u), dtype=bool)
    for number, c in enumerate(result.program.subject_to):
        excess = c.excess(point)
        if c.sense != "=":
            feasible &= excess <= 0.0
        if (excess > 0).any() and (excess < 0).any():
            drawn = axes.contour(x, y, excess.reshape(GRID, GRID), [0.0], colors=[COLOURS[(number + 1) % 8]])
            axes.clabel(drawn, fmt={0.0: c.name}, fontsize=7.5)
    axes.contourf(x, y, feasible.reshape(GRID, GRID).astype(float), [0.5, 1.5], colors=[SHADE], alpha=0.6)
    axes.contour(x, y, value, 14, colors=[FAINT], linewidths=0.7)
    best = (result.x[name] * unit.factor for name, unit in zip(names, units, strict=True))
    axes.plot(*best, "o", color=INK)
    axes.set(xlabel=units[0].label(names[0]), ylabel=units[1].label(names[1]))


def _bars(axes: Axes, result: Optimum, request: Request) -> None:
    """For every constraint, how much of the larger of its sides is not left over."""
    limits = result.program.subject_to
    used = []
    for c in limits:
        sides = [abs(float(side.value(result.point)[0])) for side in (c.left, c.right)]
        used.append(1.0 - max(result.slack(c), 0.0) / max(*sides, 1e-300) if c.sense != "=" else 1.0)
    colours = [COLOURS[1] if result.active(c) else COLOURS[0] for c in limits]
    axes.barh([c.name for c in limits], 100 * np.array(used), color=colours)
    axes.set_xlim(0.0, 105.0)
    axes.axvline(100.0, color=INK, linewidth=0.9)
    axes.set_xlabel(request.translate(_("share of the limit that is used (%)")))
    axes.invert_yaxis()
