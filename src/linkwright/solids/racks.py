"""Racks: bars along the pitch line, as far as their pinions go, in one layer with these."""

from __future__ import annotations

import cmath
from dataclasses import dataclass, field

from linkwright.joints.rack import RackPair
from linkwright.shapes.shape import Shape, polygon
from linkwright.solids.draft import Body, Draft
from linkwright.solids.mounting import fasten

#: From the pitch line to the back of a rack, beyond the last place of a pinion, and height of its teeth (ISO 53 A):
#: modules.
BACK, TEETH_BEYOND, TEETH = 3.75, 2.0, 2.25
#: The same without teeth, and radius of a post: shares of the link's width.
BARE, BEYOND, POST = 0.5, 0.5, 0.15


@dataclass(eq=False)
class Rack:
    """A rack on a link.

    In the axes of the carrier, m: ``start`` on its back at its lower end, the unit vector ``way`` along it and
    ``across`` from its back to its teeth; its ``length`` and ``depth``. ``is_link``: whether it is the plate of its
    link; ``plates``: by the planes in which it runs.
    """

    body: Body
    link: str
    start: complex
    way: complex
    across: complex
    length: float
    depth: float
    module: float
    is_link: bool = False
    plates: dict[int, str] = field(default_factory=dict)

    @property
    def shape(self) -> Shape:
        """The rectangle to the tips of its teeth."""
        along, over = self.length * self.way, self.depth * self.across
        corners = [self.start, self.start + along, self.start + along + over, self.start + over]
        return polygon(corners if (self.way.conjugate() * self.across).imag > 0.0 else corners[::-1])

    @property
    def posts(self) -> tuple[complex, complex]:
        """Places at its ends at which posts hold it, below the roots of its teeth."""
        inset = 0.5 * (self.depth - TEETH * self.module)
        middle = self.start + inset * self.across
        return middle + inset * self.way, middle + (self.length - inset) * self.way


def rack_of(draft: Draft, joint: RackPair) -> Rack:
    """A rack along all places of its pinion."""
    body = draft.body(joint.rack)
    width, module = draft.width(body), _module(joint)
    way = draft.carriers.places[joint.rack].turn * cmath.exp(1j * joint.direction)
    through = draft.carriers.place(joint.rack, joint.through)
    seen = ((draft.point_path(joint.pinion, joint.centre, body.carrier) - through) * way.conjugate()).real
    low, high = (float(seen.min()), float(seen.max())) if len(seen) else (0.0, 0.0)
    beyond, back = max(TEETH_BEYOND * module, BEYOND * width), max(BACK * module, BARE * width)
    across = 1j * joint.side * way
    start = through + (low - beyond) * way - back * across
    return Rack(body, joint.rack, start, way, across, high - low + 2.0 * beyond, back + module, module)


def _module(joint: RackPair) -> float:
    return joint.module or (0.0 if joint.teeth is None else 2.0 * joint.radius / joint.teeth)


def settle_rack(draft: Draft, rack: Rack) -> None:
    """Whether a rack is its link's plate, as it is around all of its points below the roots of its teeth; else that
    plate holds its posts."""
    body = rack.body
    if (
        draft.is_free(body)
        and not body.fixed
        and all(_within(rack, each, POST * draft.width(body)) for each in draft.points(body))
    ):
        body.shape, body.sort, rack.is_link = rack.shape, "wheel", True
    else:
        body.fixed.append(rack.posts)


def _within(rack: Rack, place: complex, room: float) -> bool:
    gap = place - rack.start
    along, over = (gap * rack.way.conjugate()).real, (gap * rack.across.conjugate()).real
    return room < along < rack.length - room and room < over < rack.depth - TEETH * rack.module - room


def add_rack(draft: Draft, rack: Rack) -> str:
    """A rack that is not its link's plate, with its posts."""
    name = draft.free_name(f"rack {rack.link}")
    draft.plate(name, "wheel", rack.body.carrier, rack.shape, rack.link)
    fasten(draft, name, rack.body, name, rack.posts, POST * draft.width(rack.body))
    return name
