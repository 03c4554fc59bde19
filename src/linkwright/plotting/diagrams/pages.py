"""Diagrams that are pages of drawings: flow charts, free-body diagrams, and force polygons to scale."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from linkwright.errors import speaker
from linkwright.kinetostatics.forces import Forces, link_numbers
from linkwright.pictures.drawing import Drawing
from linkwright.pictures.svg import fold
from linkwright.plotting.diagrams.axes import unit_of
from linkwright.plotting.diagrams.base import DIAGRAMS, Kind, Request
from linkwright.plotting.diagrams.forces import require_forces
from linkwright.plotting.diagrams.scaled_page import (
    SIZE,
    Cell,
    Vector,
    key,
    page,
    page_width,
    position_cell,
    vector_cell,
)
from linkwright.plotting.diagrams.source import PlotInput, known_link
from linkwright.plotting.flow_chart import flow_chart_pages
from linkwright.plotting.free_bodies import STYLES, Action, free_bodies
from linkwright.plotting.free_body_pages import free_body_pages
from linkwright.plotting.solution_steps import flow_chart_steps
from linkwright.words import _, pgettext
from linkwright.words.message import numbered_links


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
        place = source.place_text(forces.motion, request.translate)
        title = request.titled(source.label, f"{request.translate(self.title)}, {place}")
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


#: Pictures in a row.
IN_ROW = 3
#: Roles in the order of the graphical method; what the key calls some of them.
ORDER = ("load", "friction", "weight", "inertia", "driver", "reaction")
PLAIN = {"friction": "load"}
#: What the forces of a polygon are.
ROLES = {
    "load": _("load"),
    "weight": _("weight G"),
    "inertia": _("inertia force −m·a"),
    "driver": pgettext("plot", "driver"),
    "reaction": _("joint force F"),
}


def link_forces(forces: Forces, index: int) -> dict[str, list[Action]]:
    """The forces on every link at a position as the graphical method takes them: known ones first, joint forces last.

    Links come in the order of statics, the last of the motion first; the forces on each add up to zero.
    """
    found = {body.link: sorted(body.forces, key=_turn) for body in free_bodies(forces, index)}
    order = [link for group in reversed(forces.motion.structure.groups) for link in reversed(group.links)]
    return {link: found[link] for link in order if found.get(link)}


def _turn(force: Action) -> int:
    return ORDER.index(force.role)


def worth_drawing(found: dict[str, list[Action]]) -> dict[str, list[Action]]:
    """The links with three forces or more; all where there are none."""
    return {link: acting for link, acting in found.items() if len(acting) > 2} or found


@DIAGRAMS.register("force_polygon")
class ForcePolygon(Kind):
    """Forces on every link set end to end: loads, weight, inertia force -m a, joint forces; they close.

    Groups come in the order of statics, the last of the motion first. Links that carry two forces only are left
    out unless they are named by ``of``.
    """

    title = _("force polygons")
    single = _(
        "force polygons show one mechanism at one position; give one result", code="picture.one_mechanism_forces"
    )
    options = ("of", "at", "static")

    def draw(self, sources: Sequence[PlotInput], request: Request) -> Drawing:
        source, translate = sources[0], request.translate
        forces = source.forces_at(request.at)
        require_forces(forces)
        found = link_forces(forces, 0)
        named = [known_link(forces.mechanism, name) for name in request.of]
        parts = {link: found[link] for link in named if link in found} or worth_drawing(found)
        cells = [position_cell(forces.motion, translate), *(polygon_cell(forces, *each) for each in parts.items())]
        roles = {PLAIN.get(force.role, force.role) for each in parts.values() for force in each}
        wide = page_width(cells[:IN_ROW], IN_ROW)
        title = request.titled(
            source.label, f"{translate(self.title)}, {source.place_text(forces.motion, translate)}"
        )
        numbered = fold(", ".join(numbered_links(link_numbers(forces.mechanism), request.language)), wide, SIZE)
        below = [key([(translate(ROLES[role]), style) for role, style in STYLES.items() if role in roles])]
        below += [[((line, "lw-legend"), 0.0)] for line in numbered]
        return page(cells, IN_ROW, below, request.heading(title), title)


def polygon_cell(forces: Forces, link: str, found: Sequence[Action]) -> Cell:
    """The polygon of a link with the sizes of its forces."""
    vectors = [Vector(each.letter, each.force, STYLES[each.role], each.index) for each in found]
    return vector_cell((_title(forces, link),), vectors, "F", force_text)


def force_text(value: float) -> str:
    """A force with its unit."""
    return unit_of("force", [np.array([value])]).text(value)


def _title(forces: Forces, link: str) -> str:
    """The group and the link, by its number."""
    group = next(each for each in forces.motion.structure.groups if link in each.links)
    return f"{group.signature}: {link_numbers(forces.mechanism)[link]} {link}"
