"""Force polygons of links to scale for one position, beside the mechanism, group by group as statics takes them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
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
from linkwright.pictures.diagram import COLOURS, Axes, Figure
from linkwright.plot.diagrams.axes import unit_of, wrapped
from linkwright.plot.diagrams.base import DIAGRAMS, Kind, Request
from linkwright.plot.diagrams.outputs import known_link
from linkwright.plot.diagrams.position import draw_position, name_position, position_cell
from linkwright.plot.diagrams.reactions import require_forces
from linkwright.plot.diagrams.scaled_page import (
    BAR,
    INCH,
    LEAST,
    Cell,
    Labels,
    arrow,
    colour_key,
    headed,
    page,
    scale_of_picture,
    side_by_side,
    symbol,
    text_width,
)
from linkwright.plot.diagrams.source import Source
from linkwright.words.sentence import links_said

#: Longest extent of a polygon on the paper, mm, and how many pictures stand in a row.
EXTENT, IN_ROW = 58.0, 3
LOOKS = {
    "load": COLOURS[1],
    "weight": COLOURS[2],
    "inertia": COLOURS[3],
    "driver": COLOURS[4],
    "reaction": COLOURS[0],
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
    def name(self) -> str:
        """Letter and index on one line."""
        return self.letter + self.index

    @property
    def symbol(self) -> str:
        """Letter and index as mathematics; other names as they are."""
        return symbol(self.letter, self.index) if self.index else self.letter.replace("$", r"\$")

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

    def draw(self, sources: Sequence[Source], request: Request) -> Figure:
        if len(sources) > 1:
            raise RequestError("picture.one_mechanism_forces")
        source, say = sources[0], request.say
        forces = source.forces_at(request.at)
        require_forces(forces)
        parts = _links(forces, request)
        scales = [scale_of_picture(corners(each), EXTENT) for each in parts.values()]
        ink, millimetre, cell = position_cell(forces.motion, say)
        cells = [cell]
        for (link, each), scale in zip(parts.items(), scales, strict=True):
            title = f"{_title(forces, link)}\n{symbol('μ', 'F')} = {_per_mm(scale)}"
            unit = unit_of("force", [np.array([BAR * scale])])
            drawn = np.array([place for pair in _pairs(each, scale) for place in pair])
            cells.append(Cell(drawn, title, _notes(each), unit.text(BAR * scale)))
        subject = f"{say('kind.force_polygon')}, {source.place_text(forces.motion, say)}"
        title = request.titled(source.label, subject)
        wide = max(LEAST, sum(float(cell.size[0]) for cell in cells[:IN_ROW]))
        heading = wrapped(title if request.title is None else request.title, wide / INCH)
        head = 4.0 + 4.6 * (heading.count("\n") + 1) if heading else 2.0
        numbered = list(_numbered(forces, request, wide))
        foot = 5.0 * len(numbered) + 8.0
        figure, (first, *axes) = page(cells, IN_ROW, foot=foot, head=head)
        draw_position(first, forces.motion, 0, factor=1 / millimetre)
        name_position(first, ink)
        for one, each, scale in zip(axes, parts.values(), scales, strict=True):
            _draw(one, each, scale)
        roles = {force.role for each in parts.values() for force in each}
        entries = [(say(f"force.{role}"), colour) for role, colour in LOOKS.items() if role in roles]
        colour_key(figure, entries, foot - 6.0)
        for line, text in enumerate(numbered, 2):
            colour_key(figure, [(text, "#222222")], foot - 5.0 * line - 0.5, mark="")
        headed(figure, heading)
        return figure


def _numbered(forces: Forces, request: Request, wide: float) -> Iterator[str]:
    """The links with their numbers, in lines that fit a width, mm."""
    line, *more = links_said(link_numbers(forces.mechanism), request.language)
    for each in more:
        longer = f"{line}, {each}"
        if text_width(longer, 8.0) > wide - 8.0:
            yield f"{line},"
            longer = each
        line = longer
    yield line


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
    return sorted(found, key=lambda each: list(LOOKS).index(each.role))


def corners(found: list[LinkForce]) -> Floats:
    """Corners of the polygon, (forces + 1, 2) N, from zero back to zero."""
    steps = np.array([each.force for each in found]).reshape(-1, 2)
    return np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])


def _pairs(found: list[LinkForce], scale: float) -> list[tuple[Floats, Floats]]:
    places = corners(found) / scale
    return side_by_side(list(pairwise(places)))


def _draw(axes: Axes, found: list[LinkForce], scale: float) -> None:
    pairs = _pairs(found, scale)
    places = np.array([place for pair in pairs for place in pair])
    middle = 0.5 * (places.min(axis=0) + places.max(axis=0))
    labels = Labels(axes)
    for each, (start, end) in zip(found, pairs, strict=True):
        arrow(axes, start, end, LOOKS[each.role])
        labels.line(start, end)
    for each, (start, end) in zip(found, pairs, strict=True):
        if np.hypot(*(end - start)) > 1.5:
            spots = [start + share * (end - start) for share in (0.5, 0.35, 0.65, 0.2, 0.8)]
            labels.put(
                each.name,
                spots,
                away=spots[0] - middle,
                colour=LOOKS[each.role],
                size=7.5,
                written=each.symbol if each.index else None,
            )


def _notes(found: list[LinkForce]) -> tuple[tuple[str, str], ...]:
    """Sizes of the forces in the colours of their roles."""
    unit = unit_of("force", [each.force for each in found])
    return tuple((f"{each.symbol} = {unit.text(each.size)}", LOOKS[each.role]) for each in found)


def _per_mm(scale: float) -> str:
    return f"{significant(scale / 1e3)} kN/mm" if scale >= 1e3 else f"{significant(scale)} N/mm"
