"""Diagrams of programs: the feasible region of two variables, or how far each constraint is used."""

from __future__ import annotations

import math

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import unit_of_kind
from linkwright.parts.programs.problem import Variable
from linkwright.parts.programs.program import Optimum
from linkwright.pictures.diagram import COLOURS, FAINT, INK, SHADE, Axes, Figure, new_figure
from linkwright.plot.diagrams.base import Request, framed, result_diagram
from linkwright.words import _

GRID = 241


@result_diagram("optimum", Optimum)
def draw_optimum(result: Optimum, request: Request) -> Figure:
    """Contours of the objective over two variables with the region that the constraints leave; else bars."""
    figure = new_figure(request.size or (6.6, 5.2))
    axes = figure.subplots()
    if len(result.x) == 2:
        _region(axes, result)
    else:
        _bars(axes, result, request)
    framed(figure, request.titled(result.title), request)
    return figure


def _span(variable: Variable, value: float) -> Floats:
    """Places around the optimum, within the bounds."""
    reach = 0.9 * abs(value) if value else variable.size
    low, high = value - reach, value + reach
    low = max(low, variable.least) if math.isfinite(variable.least) else low
    high = min(high, variable.most) if math.isfinite(variable.most) else high
    return np.linspace(low, high if high > low else low + 1.0, GRID)


def _region(axes: Axes, result: Optimum) -> None:
    names = list(result.x)
    spans = [_span(result.program.variables[n], result.x[n]) for n in names]
    u, v = (each.ravel() for each in np.meshgrid(*spans))
    point = dict(zip(names, (u, v), strict=True))
    scales = [unit_of_kind(result.program.variables[n].dimension) for n in names]
    x, y = (span * scale[1] for span, scale in zip(spans, scales, strict=True))
    value = result.program.model.objective.value(point).reshape(GRID, GRID)
    kept = np.ones(len(u), dtype=bool)
    for number, c in enumerate(result.program.subject_to):
        excess = c.excess(point)
        if c.sense != "=":
            kept &= excess <= 0.0
        if (excess > 0).any() and (excess < 0).any():
            drawn = axes.contour(x, y, excess.reshape(GRID, GRID), [0.0], colors=[COLOURS[(number + 1) % 8]])
            axes.clabel(drawn, fmt={0.0: c.name}, fontsize=7.5)
    axes.contourf(x, y, kept.reshape(GRID, GRID).astype(float), [0.5, 1.5], colors=[SHADE], alpha=0.6)
    axes.contour(x, y, value, 14, colors=[FAINT], linewidths=0.7)
    axes.plot(result.x[names[0]] * scales[0][1], result.x[names[1]] * scales[1][1], "o", color=INK)
    axes.set_xlabel(f"{names[0]} ({scales[0][0]})" if scales[0][0] else names[0])
    axes.set_ylabel(f"{names[1]} ({scales[1][0]})" if scales[1][0] else names[1])


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
    axes.set_xlabel(request.say(_("share of the limit that is used (%)")))
    axes.invert_yaxis()
