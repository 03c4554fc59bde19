"""Force polygons of links to scale for one position."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from linkwright.errors import RequestError
from linkwright.kinematics.cycle import Floats
from linkwright.kinetostatics.forces import Forces
from linkwright.plot.diagrams.axes import wrapped
from linkwright.plot.diagrams.base import DIAGRAMS, Kind, Request
from linkwright.plot.diagrams.labels import Labels
from linkwright.plot.diagrams.link_forces import LinkForce, link_forces
from linkwright.plot.diagrams.outputs import known_link
from linkwright.plot.diagrams.paper import (
    INCH,
    LEAST,
    Cell,
    arrow,
    colour_key,
    headed,
    page,
    scale_for,
    symbol,
)  # fmt: skip
from linkwright.plot.diagrams.picture import COLOURS
from linkwright.plot.diagrams.reactions import require_forces
from linkwright.plot.diagrams.source import Source
from linkwright.plot.diagrams.units import significant, unit_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Longest extent of a polygon on the paper, mm, and how many stand in a row.
EXTENT, IN_ROW = 58.0, 3
LOOKS = {
    "load": COLOURS[1],
    "weight": COLOURS[2],
    "inertia": COLOURS[3],
    "driver": COLOURS[4],
    "reaction": COLOURS[0],
}


@DIAGRAMS.register("force_polygon")
class ForcePolygon(Kind):
    """Forces on every link set end to end: loads, weight, inertia force -m a, joint forces; they close.

    Links that carry two forces only are left out unless they are named by ``of``.
    """

    name = "force_polygon"
    options = ("of", "at", "static")

    def draw(self, sources: Sequence[Source], request: Request) -> Figure:
        if len(sources) > 1:
            raise RequestError("force polygons show one mechanism at one position; give one result")
        source, say = sources[0], request.say
        forces = source.forces_at(request.at)
        require_forces(forces)
        parts = _links(forces, request)
        scales = [scale_for(float(np.ptp(_corners(each), axis=0).max()), EXTENT) for each in parts.values()]
        cells = [
            Cell(_corners(each) / scale, f"{link}: {symbol('μ', 'F')} = {_per_mm(scale)}", _notes(each))
            for (link, each), scale in zip(parts.items(), scales, strict=True)
        ]
        title = f"{source.label}: {say('kind.force_polygon')}, {source.place_text(forces.motion, say)}"
        wide = max(LEAST, sum(float(cell.size[0]) for cell in cells[:IN_ROW]))
        heading = wrapped(title if request.title is None else request.title, wide / INCH)
        head = 4.0 + 4.6 * (heading.count("\n") + 1) if heading else 2.0
        figure, axes = page(cells, IN_ROW, foot=9.0, head=head)
        for one, each, scale in zip(axes, parts.values(), scales, strict=True):
            _draw(one, each, scale)
        roles = {force.role for each in parts.values() for force in each}
        colour_key(
            figure, [(say(f"force.{role}"), colour) for role, colour in LOOKS.items() if role in roles], 2.5
        )
        headed(figure, heading)
        return figure


def _links(forces: Forces, request: Request) -> dict[str, list[LinkForce]]:
    """Forces by link: of the links that are named, else of those with three forces or more."""
    if request.of:
        return {
            known_link(forces.mechanism, name): _ordered(link_forces(forces, name, 0)) for name in request.of
        }
    every = {link: _ordered(link_forces(forces, link, 0)) for link in forces.mechanism.links}
    return {link: found for link, found in every.items() if len(found) > 2} or {
        link: found for link, found in every.items() if found
    }


def _ordered(found: list[LinkForce]) -> list[LinkForce]:
    """In the order of the graphical method: what is known first, joint forces last."""
    return sorted(found, key=lambda each: list(LOOKS).index(each.role))


def _corners(found: list[LinkForce]) -> Floats:
    """Corners of the polygon, (forces + 1, 2) N, from zero back to zero."""
    steps = np.array([each.force for each in found]).reshape(-1, 2)
    return np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])


def _draw(axes: Axes, found: list[LinkForce], scale: float) -> None:
    corners = _corners(found) / scale
    middle = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
    labels = Labels(axes)
    pairs = list(zip(found, corners[:-1], corners[1:], strict=True))
    for each, start, end in pairs:
        arrow(axes, start, end, LOOKS[each.role])
        labels.line(start, end)
    for each, start, end in pairs:
        if np.hypot(*(end - start)) > 1.5:
            places = [start + share * (end - start) for share in (0.5, 0.35, 0.65, 0.2, 0.8)]
            labels.put(each.name, places, away=places[0] - middle, colour=LOOKS[each.role], size=7.5)


def _notes(found: list[LinkForce]) -> tuple[tuple[str, str], ...]:
    """Sizes of the forces in the colours of their roles."""
    unit = unit_of("force", [each.force for each in found])
    return tuple(
        (f"{each.name.replace('$', chr(92) + '$')} = {unit.text(each.size)}", LOOKS[each.role])
        for each in found
    )


def _per_mm(scale: float) -> str:
    return f"{significant(scale / 1e3)} kN/mm" if scale >= 1e3 else f"{significant(scale)} N/mm"
