"""The frame: a base plate under the machine, a cover on it where it is supported on both sides."""

from __future__ import annotations

from linkwright.solids.draft import Draft
from linkwright.solids.links import around, shape_of_links, takes_no_room

COVER = "cover"


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
    if draft.construction is not None and draft.construction.supports == "both":
        draft.plate(COVER, "frame", "frame", shape, "frame")
