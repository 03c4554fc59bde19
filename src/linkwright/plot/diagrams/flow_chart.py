"""The flow chart of a solution as one picture, its columns side by side."""

from __future__ import annotations

from collections.abc import Sequence

from linkwright.errors import RequestError
from linkwright.pictures.drawing import Drawing
from linkwright.plot.diagrams.base import DIAGRAMS, Kind, Request
from linkwright.plot.diagrams.source import Source
from linkwright.plot.flow_chart.content import flow_chart_steps
from linkwright.plot.flow_chart.picture import flow_chart_pages
from linkwright.words import _


@DIAGRAMS.register("flow_chart")
class FlowChart(Kind):
    """The steps that solve a machine: driver, groups in solving order with the teaching texts' names of their
    subprograms, forces in reverse order, output, over all positions of the motion."""

    def draw(self, sources: Sequence[Source], request: Request) -> Drawing:
        if len(sources) > 1:
            raise RequestError(
                _(
                    "a flow chart shows how one mechanism is solved; give one result",
                    code="picture.one_flow_chart",
                )
            )
        (source,) = sources
        nodes = flow_chart_steps(source.motion, range(source.motion.steps), request.language)
        title = request.titled(source.label)
        heading = title if request.title is None else request.title
        (svg,) = flow_chart_pages(nodes, title, columns=len(nodes), heading=heading)
        return Drawing(svg)
