"""Kinds of diagrams that are pages of drawings: the flow chart of a solution, free-body diagrams of links."""

from __future__ import annotations

import math
from collections.abc import Sequence

from linkwright.errors import speaker
from linkwright.pictures.drawing import Drawing
from linkwright.plotting.diagrams.base import DIAGRAMS, Kind, Request
from linkwright.plotting.diagrams.outputs import known_link
from linkwright.plotting.diagrams.reactions import require_forces
from linkwright.plotting.diagrams.source import PlotInput
from linkwright.plotting.flow_chart.content import flow_chart_steps
from linkwright.plotting.flow_chart.picture import flow_chart_pages
from linkwright.plotting.free_bodies.page import free_body_pages
from linkwright.words import _


@DIAGRAMS.register("flow_chart")
class FlowChart(Kind):
    """The steps that solve a machine: driver, groups in solving order with the teaching texts' names of their
    subprograms, forces in reverse order, output, over all positions of the motion."""

    title = _("flow chart of the solution")
    single = _("a flow chart shows how one mechanism is solved; give one result", code="picture.one_flow_chart")

    def draw(self, sources: Sequence[PlotInput], request: Request) -> Drawing:
        (source,) = sources
        nodes = flow_chart_steps(source.motion, range(source.motion.steps), request.language)
        title = request.titled(source.label)
        (svg,) = flow_chart_pages(nodes, title, columns=len(nodes), heading=request.heading(title))
        return Drawing(svg)


@DIAGRAMS.register("free_bodies")
class FreeBodies(Kind):
    """Every link by itself with joint forces, loads, weight, inertia force and couple, what a driver exerts; of named
    links where ``of`` says which."""

    title = _("free-body diagrams of the links")
    single = _(
        "free-body diagrams show one mechanism at one position; give one result", code="picture.one_free_bodies"
    )
    options = ("of", "at", "static")

    def draw(self, sources: Sequence[PlotInput], request: Request) -> Drawing:
        (source,) = sources
        forces = source.forces_at(request.at)
        require_forces(forces)
        links = [known_link(forces.mechanism, name) for name in request.of]
        place = source.place_text(forces.motion, request.say)
        title = request.titled(source.label, f"{request.say(self.title)}, {place}")
        (svg,) = free_body_pages(
            forces,
            0,
            speaker(request.language),
            request.language,
            of=links,
            columns=3 if len(forces.mechanism.links) > 4 else 2,
            tallest=math.inf,
            heading=request.heading(title),
        )
        return Drawing(svg)
