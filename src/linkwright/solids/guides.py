"""Guides: slots in the plates of links, and plates of their own with posts."""

from __future__ import annotations

import cmath
from collections.abc import Iterator
from dataclasses import dataclass, replace

from linkwright.joints.lower_pair import SlidingJoint
from linkwright.mechanism.plate import shape_kind
from linkwright.shapes.distance import gap
from linkwright.shapes.shape import Shape, bar, joined, polygon
from linkwright.solids.cylinders import is_cylinder, plan_cylinder
from linkwright.solids.draft import Body, Draft
from linkwright.solids.links import of_link
from linkwright.solids.mounting import clear, fasten
from linkwright.solids.slots import Slot

#: Length of a block, wall around its slot, radius of the posts of a guide, play at the ends of a stroke: shares of
#: the block's width.
LENGTH, WALL, POST, PLAY = 1.5, 0.3, 0.2, 0.1
#: How far outwards posts are tried, in radii from the end of the wall.
OUTWARDS = (1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0, 14.0)


@dataclass(frozen=True)
class Slide:
    """A guide with its block as they are made.

    ``slot``: in the axes of the guide's carrier; ``plate``: of the guide; ``own``: whether that is a plate of its
    own, held by ``posts`` at its ends; ``shift``: how far along the guide the block is from the point of its link, m.
    """

    joint: SlidingJoint
    slot: Slot
    own: bool
    plate: str
    shift: float = 0.0
    posts: tuple[complex, ...] = ()

    @property
    def block(self) -> str:
        """The name of a block that is not a link of its own."""
        return f"block {self.joint.name}"

    @property
    def width(self) -> float:
        """Of the block, m."""
        return 2.0 * self.slot.half


def plan_slides(draft: Draft) -> list[Slide]:
    """What every guide is, before plates are made: slots are added to the links, and what posts need."""
    found: list[Slide] = []
    for joint in draft.mechanism.guides.values():
        if is_cylinder(draft, joint):
            plan_cylinder(draft, joint)
        else:
            found.append(_planned(draft, joint))
    found = [_shifted(draft, each) for each in found]
    return [_with_posts(draft, each, found) for each in found]


def _planned(draft: Draft, joint: SlidingJoint) -> Slide:
    low, high = draft.stroke(joint)
    width = draft.width(draft.body(joint.block))
    place = draft.carriers.places[joint.guide]
    way = place.turn * cmath.exp(1j * joint.direction)
    start = draft.carriers.place(joint.guide, joint.through) + 1j * way * joint.offset
    half_length = (0.5 * LENGTH + PLAY) * width
    slot = Slot(start, way, low - half_length, high + half_length, 0.5 * width, WALL * width)
    body = draft.body(joint.guide)
    if _fits(draft, body, slot):
        body.slots.append(slot)
        return Slide(joint, slot, False, body.carrier)
    if _has_slot(draft, joint.guide, slot):
        return Slide(joint, slot, False, body.carrier)
    return Slide(joint, slot, True, f"guide {joint.name}")


def _fits(draft: Draft, body: Body, slot: Slot) -> bool:
    """Whether a slot can be cut into the plate of a body: no pin and no other slot in its way."""
    given = any(_outline(draft, link) for link in body.links)
    if body.carrier == "frame" or body.shape is not None or given:
        return False
    pins = draft.pinned(body)
    free = all(slot.distance(place) > 1.5 * draft.sizes.pin_radius[name] for name, place in pins)
    return free and not any(slot.meets(each) for each in body.slots)


def _outline(draft: Draft, link: str) -> bool:
    """Whether the file gives the outline of a link."""
    return shape_kind(draft.mechanism.link(link)) == "outline"


def _has_slot(draft: Draft, link: str, slot: Slot) -> bool:
    """Whether a given outline leaves the way of a block free, as a slot of its own or along an edge."""
    if not _outline(draft, link):
        return False
    return gap(of_link(draft, link), polygon(slot.corners(-PLAY * slot.half))) > 0.0


def block_place(draft: Draft, joint: SlidingJoint, width: float, shift: float = 0.0) -> Slot:
    """The place of a block in the axes of its carrier, as that of a slot."""
    way = draft.carriers.places[joint.block].turn * cmath.exp(1j * joint.block_angle)
    half = 0.5 * LENGTH * width
    return Slot(draft.carriers.place(joint.block, joint.at) + shift * way, way, -half, half, 0.5 * width, 0.0)


def _shifted(draft: Draft, slide: Slide) -> Slide:
    """The block of a link that has a slot at the same place, moved along its guide clear of that slot and of all
    pins that come into the guide, as far as the nearer side asks for."""
    joint, body = slide.joint, draft.body(slide.joint.block)
    block = block_place(draft, joint, slide.width)
    if not any(each.meets(block) for each in body.slots):
        return slide
    ends = [block.local(corner).real for each in body.slots for corner in each.corners(each.wall)]
    pins = _pins_in_the_way(draft, slide)
    room = block.high + PLAY * slide.width
    before = [max(ends) + room, *(pin - slide.slot.low for pin in pins)]
    behind = [min(ends) - room, *(pin - slide.slot.high for pin in pins)]
    shift = min(max(before), min(behind), key=abs)
    body.fixed.append((block.at(shift),))
    slot = replace(slide.slot, start=slide.slot.at(shift))
    if not slide.own:
        slots = draft.body(joint.guide).slots
        slots[slots.index(slide.slot)] = slot
    return replace(slide, slot=slot, shift=shift)


def _pins_in_the_way(draft: Draft, slide: Slide) -> list[float]:
    """How far along a guide pins of other links are that come into its corridor: both ends of each."""
    guide, block = (draft.carriers.carrier(each) for each in (slide.joint.guide, slide.joint.block))
    found: list[float] = []
    for name, pin in draft.mechanism.pins.items():
        if block in map(draft.carriers.carrier, pin.joined):
            continue
        radius = draft.sizes.pin_radius[name] + 3.0 * slide.slot.wall
        local = (draft.point_path(pin.joined[0], name, guide) - slide.slot.start) * slide.slot.way.conjugate()
        near = local[abs(local.imag) <= slide.slot.half + radius].real
        found += [float(near.min()) - radius, float(near.max()) + radius] if len(near) else []
    return found


def _with_posts(draft: Draft, slide: Slide, slides: list[Slide]) -> Slide:
    """A guide with the places of its posts, beyond its ends and clear of pins and of other guides."""
    if not slide.own:
        return slide
    body, slot, radius = draft.body(slide.joint.guide), slide.slot, POST * slide.width
    others = [each.slot for each in slides if each is not slide and draft.body(each.joint.guide) is body]
    first, last = (
        clear(draft, body, _outwards(slot, end, sign, radius, others), radius)
        for end, sign in ((slot.low, -1.0), (slot.high, 1.0))
    )
    body.fixed.append((first, last))
    return replace(slide, posts=(first, last))


def _outwards(slot: Slot, end: float, sign: float, radius: float, others: list[Slot]) -> Iterator[complex]:
    """Places beyond an end of a guide, farther and farther, that are clear of other guides."""
    start = end + sign * slot.wall
    beyond = [sign * slot.local(corner).real for each in others for corner in each.corners(each.wall)]
    steps = [sign * start + radius * share for share in OUTWARDS]
    steps += [far + radius * share for far in sorted(beyond) if far > steps[0] for share in OUTWARDS]
    for step in steps:
        place = slot.at(sign * step)
        if all(each.distance(place) > each.wall + radius for each in others):
            yield place


def add_guides(draft: Draft, slides: list[Slide]) -> None:
    """Guides that are plates of their own, with their posts."""
    for slide in slides:
        if slide.own:
            _add_guide(draft, slide)


def _add_guide(draft: Draft, slide: Slide) -> None:
    body, slot, radius = draft.body(slide.joint.guide), slide.slot, POST * slide.width
    ends = (slot.at(slot.low - radius - slot.wall), slot.at(slot.high + radius + slot.wall))
    arms = [bar(dict.fromkeys(pair), 2.0 * (radius + slot.wall)) for pair in zip(ends, slide.posts, strict=True)]
    draft.plate(slide.plate, "guide", body.carrier, joined([Shape((slot.ring,)), *arms]), slide.joint.guide)
    fasten(draft, slide.joint.name, body, slide.plate, slide.posts, radius)
