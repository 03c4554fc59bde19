"""The closed path of a coupler point, with its double points and cusps."""

from __future__ import annotations

import numpy as np

from linkwright.metrics.coupler_curve import CouplerCurve
from linkwright.pictures.diagram import COLOURS, Figure, new_figure
from linkwright.plot.diagrams.axes import Legend, unit_of
from linkwright.plot.diagrams.base import Request, framed, result_diagram


@result_diagram("coupler_curve", CouplerCurve)
def draw_coupler_curve(result: CouplerCurve, request: Request) -> Figure:
    """The path, both axes to one scale; double points ringed, cusps as diamonds; length and area in the title."""
    unit, legend = unit_of("length"), Legend()
    figure = new_figure(request.size or (6.2, 5.2))
    axes = figure.subplots()
    x, y = (np.concatenate([result.path, result.path[:1]]) * unit.factor).T
    axes.plot(x, y, color=COLOURS[0])
    doubles = [spot for spot, _ in result.double_points]
    cusps = [spot for spot, _ in result.cusps]
    if request.marks:
        for name, spots, sign in (("double_point", doubles, "o"), ("cusp", cusps, "D")):
            if spots:
                (dots,) = axes.plot(*(np.array(spots).T * unit.factor), sign, color=COLOURS[1], markersize=7,
                                    fillstyle="none", markeredgewidth=1.4)  # fmt: skip
                legend.add(request.say(name), dots)
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.1)
    axes.set_xlabel(unit.label("x"))
    axes.set_ylabel(unit.label("y"))
    length, area = unit.text(result.length, 6), unit_of("area").text(result.area, 6)
    framed(figure, request.say("curve_of", point=result.point, length=length, area=area), request, legend)
    return figure
