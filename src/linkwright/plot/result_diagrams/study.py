"""Metrics of a parameter study and summaries of a sweep over what varies."""

from __future__ import annotations

from linkwright.designs.criteria import criterion
from linkwright.designs.designs import Sweep
from linkwright.designs.study import Study
from linkwright.pictures.diagram import Figure
from linkwright.plot.diagrams.base import Request, result_diagram
from linkwright.plot.result_diagrams.design_space import draw_designs
from linkwright.plot.result_diagrams.design_table import DesignTable, chosen, measure, varied


@result_diagram("study", Study, options=("of",))
def draw_study(result: Study, request: Request) -> Figure:
    """Every metric over what varies: a curve over one dimension, a map over a grid of two, points over others.

    Designs that cannot move are crossed, the best ones ringed. ``of``: the metrics, all by default.
    """
    over = tuple(
        varied(result.mechanism, each.address, result.varied[each.address], each.unit)
        for each in result.ranges
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


@result_diagram("sweep", Sweep, options=("of",))
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
