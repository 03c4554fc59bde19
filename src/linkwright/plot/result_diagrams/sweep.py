"""Summaries of a sweep over what varies."""

from __future__ import annotations

from typing import TYPE_CHECKING

from linkwright.plot.diagrams.base import Request, result_diagram
from linkwright.plot.result_diagrams.design_space import draw_designs
from linkwright.plot.result_diagrams.design_table import DesignTable, chosen, measure, varied
from linkwright.study.designs import Sweep

if TYPE_CHECKING:
    from matplotlib.figure import Figure


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
    title = request.titled(result.mechanism.name, request.say("kind.sweep"))
    return draw_designs(DesignTable(title, over, measures, result.ok), request)
