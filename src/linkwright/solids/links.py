"""The plates of links: bars, plates, eyes, with slots for the blocks that slide in them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from linkwright.shapes.shape import Piece, Shape, bar, disc, joined
from linkwright.solids.carriers import Place
from linkwright.solids.draft import Body, Draft
from linkwright.solids.slots import slotted

#: Points are in line where they leave it by less than this share of their extent.
IN_LINE = 1e-6


def add_links(draft: Draft) -> None:
    """The plates of all moving links that are not something else."""
    for body in draft.bodies.values():
        if body.carrier != "frame" and not takes_no_room(draft, body):
            body.plate = body.carrier
            shape = body.shape or shape_of_links(draft, body)
            draft.plate(body.plate, body.sort, body.carrier, shape, body.links[0])


def takes_no_room(draft: Draft, body: Body) -> bool:
    """Whether the file leaves out the shape of all links of a body."""
    shapes = (draft.own_shape(link) for link in body.links)
    return all(each is not None and each.kind == "none" for each in shapes)


def shape_of_links(draft: Draft, body: Body) -> Shape:
    """One plate for links that move as one, with their slots."""
    parts = [_of_link(draft, link) for link in body.links]
    width = draft.width(body)
    if len(body.links) > 1 or body.fixed:
        parts.append(around([*draft.points(body), *body.fixed], width))
    shape = joined(parts)
    for slot in body.slots:
        shape = slotted(shape, slot)
    return shape


def _of_link(draft: Draft, link: str) -> Shape:
    place = draft.carriers.places[link]
    points = [complex(*each) for each in draft.mechanism.link(link).points.values()]
    return moved(around(points, draft.sizes.width[link]), place)


def around(points: Sequence[complex], width: float) -> Shape:
    """A bar along points in line, the hull of others, a disc about one, all widened by half a width."""
    places = np.array([*points], dtype=complex)
    middle = places.mean()
    extent = float(np.abs(places - middle).max())
    if extent <= IN_LINE * width:
        return disc(complex(places[0]), 0.5 * width)
    far = places[int(np.abs(places - middle).argmax())]
    along = (far - middle) / abs(far - middle)
    local = (places - middle) * along.conjugate()
    if float(np.abs(local.imag).max()) <= IN_LINE * extent:
        return bar([places[int(local.real.argmin())], places[int(local.real.argmax())]], width)
    return Shape((Piece((hull(places),), 0.5 * width, filled=True),))


def hull(places: np.ndarray) -> np.ndarray:
    """The corners of the convex hull, counter-clockwise (Andrew's monotone chain)."""
    ordered = sorted({(each.real, each.imag) for each in places})

    def half(points: Sequence[tuple[float, float]]) -> list[complex]:
        found: list[complex] = []
        for x, y in points:
            place = complex(x, y)
            while len(found) > 1 and ((found[-1] - found[-2]).conjugate() * (place - found[-1])).imag <= 0.0:
                found.pop()
            found.append(place)
        return found[:-1]

    return np.array(half(ordered) + half(ordered[::-1]))


def moved(shape: Shape, place: Place) -> Shape:
    """A shape in the axes of the carrier."""
    pieces = (
        Piece(tuple(place.origin + place.turn * ring for ring in each.rings), each.radius, each.filled)
        for each in shape.pieces
    )
    return Shape(tuple(pieces), tuple((place.of(centre), radius) for centre, radius in shape.holes))
