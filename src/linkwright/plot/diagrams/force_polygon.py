"""Force polygons of links to scale for one position, beside the mechanism, group by group as statics takes them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import significant
from linkwright.errors import RequestError
from linkwright.kinetostatics.forces import Forces
from linkwright.mechanism.force_names import link_numbers
from linkwright.pictures.drawing import Drawing
from linkwright.pictures.labels import Label
from linkwright.pictures.picture import indexed, joined
from linkwright.pictures.sketch import Sketch
from linkwright.pictures.svg.element import fold
from linkwright.pictures.symbols.base import vec
from linkwright.plot.diagrams.axes import unit_of
from linkwright.plot.diagrams.base import DIAGRAMS, Kind, Request
from linkwright.plot.diagrams.outputs import known_link
from linkwright.plot.diagrams.reactions import require_forces
from linkwright.plot.diagrams.scaled_page import (
    BAR,
    MILLIMETRE,
    SIZE,
    Cell,
    key,
    page,
    page_width,
    position_cell,
    scale_of_picture,
    scale_title,
    side_by_side,
    units,
)
from linkwright.plot.diagrams.source import Source
from linkwright.plot.free_bodies.actions import STYLES, Action, free_bodies
from linkwright.words import _
from linkwright.words.sentence import links_said

#: Longest extent of a polygon on the paper, mm, and how many pictures stand in a row.
EXTENT, IN_ROW = 58.0, 3
#: Forces that are shorter on the paper have no name of their own, mm; where along a force its name may stand.
SHORT, SHARES = 1.5, (0.5, 0.35, 0.65, 0.2, 0.8)
#: Roles in the order of the graphical method; what the key calls some of them.
ORDER = ("load", "friction", "weight", "inertia", "driver", "reaction")
PLAIN = {"friction": "load"}


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

    options = ("of", "at", "static")

    def draw(self, sources: Sequence[Source], request: Request) -> Drawing:
        if len(sources) > 1:
            raise RequestError(
                _(
                    "force polygons show one mechanism at one position; give one result",
                    code="picture.one_mechanism_forces",
                )
            )
        source, say = sources[0], request.say
        forces = source.forces_at(request.at)
        require_forces(forces)
        found = link_forces(forces, 0)
        named = [known_link(forces.mechanism, name) for name in request.of]
        parts = {link: found[link] for link in named if link in found} or worth_drawing(found)
        cells = [position_cell(forces.motion, say), *(polygon_cell(forces, *each) for each in parts.items())]
        roles = {PLAIN.get(force.role, force.role) for each in parts.values() for force in each}
        wide = page_width(cells[:IN_ROW], IN_ROW)
        heading = request.titled(
            source.label, f"{say('kind.force_polygon')}, {source.place_text(forces.motion, say)}"
        )
        numbered = fold(", ".join(links_said(link_numbers(forces.mechanism), request.language)), wide, SIZE)
        return page(
            cells,
            IN_ROW,
            [
                key([(say(f"force.{role}"), style) for role, style in STYLES.items() if role in roles]),
                *([((line, "lw-legend"), 0.0)] for line in numbered),
            ],
            heading if request.title is None else request.title,
            heading,
        )


def polygon_cell(forces: Forces, link: str, found: list[Action]) -> Cell:
    """The polygon of a link with the sizes of its forces."""
    scale = scale_of_picture(corners(found), EXTENT)
    sketch = Sketch()
    for each, (start, end) in zip(found, arrows(found, scale), strict=True):
        style = STYLES[each.role]
        sketch.arrow(units(start), units(end), style)
        if np.hypot(*(end - start)) > SHORT:
            spots = tuple(vec(units(start + share * (end - start))) for share in SHARES)
            sketch.labels.append(
                Label(each.letter, spots, f"{style}-name", 12.0, 4.0, leader=False, index=each.index)
            )
    sketch.write_names()
    per_mm = f"{significant(scale / 1e3)} kN/mm" if scale >= 1e3 else f"{significant(scale)} N/mm"
    bar = BAR * MILLIMETRE * scale
    unit = unit_of("force", [each.force for each in found])
    notes = tuple(
        (joined(indexed(each.letter, each.index), f" = {unit.text(each.size)}"), f"{STYLES[each.role]}-name")
        for each in found
    )
    return Cell(
        sketch,
        (_title(forces, link), scale_title("", "F", per_mm)),
        unit_of("force", [np.array([bar])]).text(bar),
        notes,
    )


def _title(forces: Forces, link: str) -> str:
    """The group and the link, by its number."""
    group = next(each for each in forces.motion.structure.groups if link in each.links)
    return f"{group.signature}: {link_numbers(forces.mechanism)[link]} {link}"


def corners(found: list[Action]) -> Floats:
    """Corners of the polygon, (forces + 1, 2) N, from zero back to zero."""
    steps = np.array([each.force for each in found]).reshape(-1, 2)
    return np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])


def arrows(found: list[Action], scale: float) -> list[tuple[Floats, Floats]]:
    """Starts and ends of the forces in paper mm, end to end."""
    return side_by_side(list(pairwise(corners(found) / scale)))
