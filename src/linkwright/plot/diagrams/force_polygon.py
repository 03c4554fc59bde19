"""Force polygons of links to scale for one position, beside the mechanism, group by group as statics takes them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import row_names
from linkwright.core.quantity import significant
from linkwright.errors import RequestError
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.link_balance import driver_wrenches
from linkwright.mechanism.force_names import link_numbers, reaction_index
from linkwright.pictures.drawing import Drawing
from linkwright.pictures.labels import Label
from linkwright.pictures.picture import Runs, indexed, joined
from linkwright.pictures.sketch import Sketch
from linkwright.pictures.svg.text import fold
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
from linkwright.words.sentence import links_said

#: Longest extent of a polygon on the paper, mm, and how many pictures stand in a row.
EXTENT, IN_ROW = 58.0, 3
#: Forces that are shorter on the paper have no name of their own, mm; where along a force its name may stand.
SHORT, SHARES = 1.5, (0.5, 0.35, 0.65, 0.2, 0.8)
#: Roles with the classes of their arrows, in the order of the graphical method: what is known first.
ROLES = {
    "load": "lw-load",
    "weight": "lw-weight",
    "inertia": "lw-inertia",
    "driver": "lw-driver",
    "reaction": "lw-force",
}


@dataclass(frozen=True)
class LinkForce:
    """A force on a link, N in frame axes; ``role``: ``load``, ``weight``, ``inertia``, ``driver``, ``reaction``.

    ``letter`` and ``index`` make its symbol: F with 12 is what link 1 exerts on link 2.
    """

    letter: str
    role: str
    force: Floats
    index: str = ""

    @property
    def symbol(self) -> Runs:
        """Letter and index."""
        return indexed(self.letter, self.index)

    @property
    def size(self) -> float:
        """Its size, N."""
        return float(np.hypot(*self.force))


def link_forces(forces: Forces, link: str, index: int) -> list[LinkForce]:
    """Loads, weight, inertia force -m a, drivers and joint forces on a link; their sum is zero but for rounding.

    Forces of less than 1e-9 of the largest are left out.
    """
    mechanism = forces.mechanism
    part, number = mechanism.links[link], str(link_numbers(mechanism)[link])
    applied = np.array([row[index] for row in forces.fetch(row_names("applied", link))])
    found = [LinkForce(_load_name(forces, link), "load", applied)]
    found.append(LinkForce("G", "weight", part.mass * np.asarray(mechanism.gravity), number))
    if not forces.static:
        inertia = -part.mass * forces.motion.link(link).centre.acceleration[index]
        found.append(LinkForce("−m·a", "inertia", inertia))
    for name, force, _ in driver_wrenches(forces, link):
        found.append(LinkForce(name, "driver", force[index]))
    for name, joint in mechanism.joints.items():
        if link in joint.joined:
            force = forces.reaction(name, on=link)[index]
            found.append(LinkForce("F", "reaction", force, reaction_index(mechanism, name, link)))
    largest = max(each.size for each in found)
    return [each for each in found if each.size > 1e-9 * largest]


def _load_name(forces: Forces, link: str) -> str:
    names = [name for name, load in forces.mechanism.loads.items() if load.acts_on == link]
    return names[0] if len(names) == 1 else "ΣP"


@DIAGRAMS.register("force_polygon")
class ForcePolygon(Kind):
    """Forces on every link set end to end: loads, weight, inertia force -m a, joint forces; they close.

    Groups come in the order of statics, the last of the motion first. Links that carry two forces only are left
    out unless they are named by ``of``.
    """

    options = ("of", "at", "static")

    def draw(self, sources: Sequence[Source], request: Request) -> Drawing:
        if len(sources) > 1:
            raise RequestError("picture.one_mechanism_forces")
        source, say = sources[0], request.say
        forces = source.forces_at(request.at)
        require_forces(forces)
        parts = _links(forces, request)
        say = request.say
        cells = [position_cell(forces.motion, say), *(polygon_cell(forces, *each) for each in parts.items())]
        roles = {force.role for each in parts.values() for force in each}
        wide = page_width(cells[:IN_ROW], IN_ROW)
        heading = request.titled(
            source.label, f"{say('kind.force_polygon')}, {source.place_text(forces.motion, say)}"
        )
        numbered = fold(", ".join(links_said(link_numbers(forces.mechanism), request.language)), wide, SIZE)
        return page(
            cells,
            IN_ROW,
            [
                key([(say(f"force.{role}"), style) for role, style in ROLES.items() if role in roles]),
                *([((line, "lw-legend"), 0.0)] for line in numbered),
            ],
            heading if request.title is None else request.title,
            heading,
        )


def polygon_cell(forces: Forces, link: str, found: list[LinkForce]) -> Cell:
    """The polygon of a link with the sizes of its forces."""
    scale = scale_of_picture(corners(found), EXTENT)
    sketch = Sketch()
    for each, (start, end) in zip(found, arrows(found, scale), strict=True):
        style = ROLES[each.role]
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
        (joined(each.symbol, f" = {unit.text(each.size)}"), f"{ROLES[each.role]}-name") for each in found
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


def _links(forces: Forces, request: Request) -> dict[str, list[LinkForce]]:
    """Forces by link, the last group first: of the links that are named, else of those with three forces or more."""
    if request.of:
        names = [known_link(forces.mechanism, name) for name in request.of]
        return {name: ordered(link_forces(forces, name, 0)) for name in names}
    return {link: ordered(link_forces(forces, link, 0)) for link in polygon_links(forces, 0)}


def polygon_links(forces: Forces, index: int) -> list[str]:
    """Links with three forces or more at a position, the last group first; where there are none, those with any."""
    order = [link for group in reversed(forces.motion.structure.groups) for link in reversed(group.links)]
    count = {link: len(link_forces(forces, link, index)) for link in order}
    return [link for link in order if count[link] > 2] or [link for link in order if count[link]]


def ordered(found: list[LinkForce]) -> list[LinkForce]:
    """Forces in the order of the graphical method: what is known first, joint forces last."""
    return sorted(found, key=lambda each: list(ROLES).index(each.role))


def corners(found: list[LinkForce]) -> Floats:
    """Corners of the polygon, (forces + 1, 2) N, from zero back to zero."""
    steps = np.array([each.force for each in found]).reshape(-1, 2)
    return np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])


def arrows(found: list[LinkForce], scale: float) -> list[tuple[Floats, Floats]]:
    """Starts and ends of the forces in paper mm, end to end."""
    return side_by_side(list(pairwise(corners(found) / scale)))
