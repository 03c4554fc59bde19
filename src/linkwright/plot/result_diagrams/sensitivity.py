"""Sensitivities: bars of relative ones, curves over the input."""

from __future__ import annotations

import math

import numpy as np

from linkwright import units
from linkwright.core.arrays import Floats
from linkwright.designs.ranges import dimension_of
from linkwright.designs.sensitivity import Sensitivity
from linkwright.errors import RequestError
from linkwright.mechanism.mechanism import Mechanism
from linkwright.pictures.diagram import COLOURS, Figure, new_figure
from linkwright.plot.diagrams.axes import InputAxis, Legend
from linkwright.plot.diagrams.base import Request, framed, result_diagram
from linkwright.plot.diagrams.marks import Curve
from linkwright.plot.diagrams.panels import Panel, look, stacked
from linkwright.plot.result_diagrams.design_table import chosen

#: Steps in which a dimension that is zero is changed, with their texts, by its kind.
_STEPS = {"length": (1e-3, "1 mm"), "angle": (math.radians(1.0), "1°")}


@result_diagram("sensitivity", Sensitivity, options=("of",), when=lambda result: bool(result.values))
def draw_sensitivity(result: Sensitivity, request: Request) -> Figure:
    """Bars of (p/y)·dy/dp: the change of a summary in percent per percent of a dimension; a colour a summary.

    A summary that is zero has none, and a dimension that is zero has no percent: it stays at zero.
    """
    known = {summary.name: summary for summary in result.values}
    names = chosen(request.of, known)
    table = {name: result.relative(known[name].output, known[name].kind) for name in names}
    if not any(np.isfinite(row).any() for row in table.values()):
        raise RequestError("picture.zero_summaries")
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
    axes.set_xlabel(request.say("relative_change"))
    framed(figure, request.titled(result.mechanism.name), request, legend)
    return figure


@result_diagram("sensitivity_curves", Sensitivity, options=("of",), when=lambda result: bool(result.curves))
def draw_sensitivity_curves(result: Sensitivity, request: Request) -> Figure:
    """Change of an output over the input when a dimension grows by a hundredth: 0.01·p·∂y/∂p; a panel an output.

    A dimension that is zero grows by 1 mm, 1° or its SI unit instead.
    """
    axis = _axis(result)
    panels = [_panel(result, name, request) for name in chosen(request.of, result.curves)]
    return stacked(panels, axis, request, request.titled(result.mechanism.name))[0]


def _axis(result: Sensitivity) -> InputAxis:
    from linkwright.kinematics.cycle import over_cycle

    if len(result.input) < 2:
        raise RequestError("picture.no_curves_here", name=result.mechanism.name)
    turning = next(iter(over_cycle(result.mechanism, 1).rotary.values()))
    return InputAxis("", "angle" if turning else "length", result.input)


def _panel(result: Sensitivity, name: str, request: Request) -> Panel:
    curves = []
    for number, by in enumerate(result.by):
        step, text = _step(result.mechanism, by)
        label = request.say("step", dimension=by, step=text)
        values: Floats = step * result.slope(name, by)
        curves.append(Curve(label, values, "", *look(number)))
    return Panel(request.say("change_by", output=name), result.quantities[name].dimension, tuple(curves))


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
