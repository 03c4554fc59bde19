"""The plates of links and of the frame: bars, plates, eyes, with slots for the blocks that slide in them."""

from __future__ import annotations

from linkwright.mechanism.plate import around, plate, shape_kind
from linkwright.shapes.shape import Shape, joined
from linkwright.solids.draft import Body, Draft
from linkwright.solids.slots import slotted, tied

#: The frame's plate over the machine.
COVER = "cover"


def add_links(draft: Draft) -> None:
    """The plates of all moving links that are not something else."""
    for body in draft.bodies.values():
        if body.carrier != "frame" and not takes_no_room(draft, body):
            body.plate = body.carrier
            shape = body.shape or shape_of_links(draft, body)
            draft.plate(body.plate, body.sort, body.carrier, shape, body.links[0])


def add_frame(draft: Draft) -> None:
    """The base plate around all that is held by the frame, and the cover."""
    body = draft.bodies["frame"]
    own = draft.mechanism.frame.shape
    if takes_no_room(draft, body) and own is not None:
        return
    places = [place for _name, place in draft.pinned(body)]
    welded = ((link, point) for link in body.links[1:] for point in draft.mechanism.link(link).points)
    places += [draft.carriers.place(link, point) for link, point in welded]
    places += body.held
    if own is None and not places:
        return
    body.plate = "frame"
    shape = around(places, draft.width(body)) if own is None else shape_of_links(draft, body)
    draft.plate("frame", "frame", "frame", shape, "frame")
    if draft.construction.supports == "both":
        draft.plate(COVER, "frame", "frame", shape, "frame")


def takes_no_room(draft: Draft, body: Body) -> bool:
    """Whether the file leaves out the shape of all links of a body."""
    return all(_kind(draft, link) == "none" for link in body.links)


def _kind(draft: Draft, link: str) -> str:
    return shape_kind(draft.mechanism.link(link))


def shape_of_links(draft: Draft, body: Body) -> Shape:
    """One plate for links that move as one, with their slots."""
    parts = [of_link(draft, link) for link in body.links if _kind(draft, link) != "none"]
    shape = joined(parts)
    for places in body.fixed:
        shape = tied(shape, around(places, draft.width(body)))
    for slot in body.slots:
        shape = slotted(shape, slot, (place for _pin, place in draft.pinned(body)), draft.width(body))
    return shape


def of_link(draft: Draft, link: str) -> Shape:
    """A link's own shape in the axes of its carrier, without holes."""
    place = draft.carriers.places[link]
    return plate(draft.mechanism.link(link), draft.sizes.width[link]).moved(place.turn, place.origin)
