"""The plates of links: bars, plates, eyes, with slots for the blocks that slide in them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from linkwright.mechanism.link_shape import ends, hull, in_line, link_shape, shape_kind
from linkwright.shapes.shape import Piece, Shape, bar, joined
from linkwright.solids.carriers import Place
from linkwright.solids.draft import Body, Draft
from linkwright.solids.slots import slotted, tied


def add_links(draft: Draft) -> None:
    """The plates of all moving links that are not something else."""
    for body in draft.bodies.values():
        if body.carrier != "frame" and not takes_no_room(draft, body):
            body.plate = body.carrier
            shape = body.shape or shape_of_links(draft, body)
            draft.plate(body.plate, body.sort, body.carrier, shape, body.links[0])


def takes_no_room(draft: Draft, body: Body) -> bool:
    """Whether the file leaves out the shape of all links of a body."""
    return all(_kind(draft, link) == "none" for link in body.links)


def _kind(draft: Draft, link: str) -> str:
    return shape_kind(draft.mechanism.link(link))


def shape_of_links(draft: Draft, body: Body) -> Shape:
    """One plate for links that move as one, with their slots."""
    parts = [_of_link(draft, link) for link in body.links if _kind(draft, link) != "none"]
    shape = joined(parts)
    for places in body.fixed:
        shape = tied(shape, around(places, draft.width(body)))
    for slot in body.slots:
        shape = slotted(shape, slot, (place for _pin, place in draft.pinned(body)), draft.width(body))
    return shape


def _of_link(draft: Draft, link: str) -> Shape:
    """A link's own shape in the axes of its carrier, without holes."""
    shape = link_shape(draft.mechanism, link, draft.sizes.width, lambda _pin: 0.0)
    return moved(shape, draft.carriers.places[link])


def around(places: Sequence[complex], width: float) -> Shape:
    """A bar along places in line, the hull of others, a disc about one, all widened by half a width."""
    found = [*places]
    if in_line(found):
        return bar(dict.fromkeys(ends(found)), width)
    return Shape((Piece((np.array(hull(found)),), 0.5 * width, filled=True),))


def moved(shape: Shape, place: Place) -> Shape:
    """A shape in the axes of the carrier."""
    pieces = (
        Piece(tuple(place.origin + place.turn * ring for ring in each.rings), each.radius, each.filled)
        for each in shape.pieces
    )
    return Shape(tuple(pieces), tuple((place.of(centre), radius) for centre, radius in shape.holes))
