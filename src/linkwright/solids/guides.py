"""Guides and blocks: slots in the plates of links, guides of their own with posts, and what slides in them."""

from __future__ import annotations

import cmath
from dataclasses import dataclass, replace

from linkwright.joints.lower_pair import SlidingJoint
from linkwright.mechanism.plate import plate, shape_kind
from linkwright.shapes.distance import gap
from linkwright.shapes.shape import Shape, bar, disc, joined, polygon
from linkwright.solids.draft import Body, Draft
from linkwright.solids.links import moved
from linkwright.solids.mounting import clear, fasten
from linkwright.solids.slots import Slot
from linkwright.solids.solid import Solid

#: Length of a block, wall around its slot, radius of the posts of a guide, play at the ends of a stroke: shares of
#: the block's width.
LENGTH, WALL, POST, PLAY = 1.5, 0.3, 0.2, 0.1
#: How far outwards posts are tried, in radii from the end of the wall.
OUTWARDS = (1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0, 14.0)
#: A slide is a cylinder where the distance of its ends is never less than so many widths.
CYLINDER = 2.0
#: Length of a barrel at most, as a share of the shortest distance.
BARREL = 0.94


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
            _make_cylinder(draft, joint)
        else:
            found.append(_planned(draft, joint))
    return [_with_posts(draft, _shifted(draft, each)) for each in found]


def is_cylinder(draft: Draft, joint: SlidingJoint) -> bool:
    """Whether two links slide in each other like rod and barrel: both with all their points on the line, pinned at
    ends that never come near each other."""
    pins = draft.mechanism.pins
    ends = ((joint.guide, joint.through), (joint.block, joint.at))
    if joint.offset or not all(point in pins and link in pins[point].joined for link, point in ends):
        return False
    if "frame" in (draft.carriers.carrier(joint.guide), draft.carriers.carrier(joint.block)):
        return False
    if any(len(draft.body(link).links) > 1 for link, _point in ends):
        return False
    others = (each for each in draft.mechanism.guides.values() if each is not joint)
    if any(link in each.joined for each in others for link, _point in ends):
        return False
    low, high = draft.stroke(joint)
    width = max(draft.sizes.width[link] for link, _point in ends)
    backwards = ((joint.guide, joint.through, joint.direction), (joint.block, joint.at, joint.block_angle + cmath.pi))
    behind = all(_behind(draft, link, point, angle, BARREL * low) for link, point, angle in backwards)
    return behind and low > max(CYLINDER * width, 0.5 * (high - low))


def _behind(draft: Draft, link: str, point: str, angle: float, reach: float) -> bool:
    """Whether no point of a link lies beside the line from its end, or beyond a reach along it."""
    here, way = draft.carriers.place(link, point), cmath.exp(-1j * angle)
    local = [(place - here) * way for place in draft.points(draft.body(link))]
    return all(abs(each.imag) <= draft.near and each.real <= reach for each in local)


def _make_cylinder(draft: Draft, joint: SlidingJoint) -> None:
    """Barrel and rod as bars as long as the stroke needs them."""
    short, longest = draft.stroke(joint)
    barrel = max(0.8 * short, min(0.62 * longest, BARREL * short))
    rod = max(longest - 0.92 * barrel, short - 0.98 * barrel)
    for link, point, angle, length, share in (
        (joint.guide, joint.through, joint.direction, barrel, 1.0),
        (joint.block, joint.at, joint.block_angle + cmath.pi, rod, 0.6),
    ):
        start, width = draft.carriers.place(link, point), draft.sizes.width[link]
        points = draft.points(draft.body(link))
        reach = max(((each - start) * cmath.exp(-1j * angle)).real for each in points)
        end = start + cmath.rect(max(length, reach), angle)
        eyes = [disc(start, 0.5 * width)]
        draft.body(link).shape = joined([bar([start, end], share * width), *eyes])
    draft.level.append((joint.guide, joint.block))
    draft.join(joint.guide, joint.block)


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
    clear = all(slot.distance(place) > 1.5 * draft.sizes.pin_radius[name] for name, place in pins)
    return clear and not any(slot.meets(each) for each in body.slots)


def _outline(draft: Draft, link: str) -> bool:
    """Whether the file gives the outline of a link."""
    return shape_kind(draft.mechanism.link(link)) == "outline"


def _has_slot(draft: Draft, link: str, slot: Slot) -> bool:
    """Whether a given outline leaves the way of a block free, as a slot of its own or along an edge."""
    if not _outline(draft, link):
        return False
    own = moved(plate(draft.mechanism.link(link), 0.0), draft.carriers.places[link])
    return gap(own, polygon(slot.corners(-PLAY * slot.half))) > 0.0


def _with_posts(draft: Draft, slide: Slide) -> Slide:
    """A guide with the places of its posts, beyond its ends and clear of pins."""
    if not slide.own:
        return slide
    body, slot, radius = draft.body(slide.joint.guide), slide.slot, POST * slide.width
    ends = ((slot.low, -1.0), (slot.high, 1.0))
    found = [
        clear(draft, body, (slot.at(end + sign * (slot.wall + radius * share)) for share in OUTWARDS), radius)
        for end, sign in ends
    ]
    body.fixed.append((found[0], found[1]))
    return replace(slide, posts=(found[0], found[1]))


def _shifted(draft: Draft, slide: Slide) -> Slide:
    """The block of a link that has a slot at the same place, moved along its guide clear of that slot."""
    joint = slide.joint
    body, block = draft.body(joint.block), _block_place(draft, slide)
    if not any(each.meets(block) for each in body.slots):
        return slide
    reach = [block.local(corner).real for each in body.slots for corner in each.corners(each.wall)]
    shift = max(reach) + block.high + PLAY * slide.width
    body.fixed.append((block.at(shift),))
    slot = replace(slide.slot, start=slide.slot.at(shift))
    if not slide.own:
        slots = draft.body(joint.guide).slots
        slots[slots.index(slide.slot)] = slot
    return replace(slide, slot=slot, shift=shift)


def plan_blocks(draft: Draft, slides: list[Slide]) -> dict[str, Slide]:
    """Links that are blocks and nothing else: their plates are the blocks of these slides."""
    found: dict[str, Slide] = {}
    for slide in slides:
        body = draft.body(slide.joint.block)
        alone = body.shape is None and not body.slots and not body.fixed and len(draft.points(body)) == 1
        if alone and body.carrier not in found and body.carrier != "frame":
            body.sort = "block"
            if draft.is_free(body):
                body.shape = _block(draft, slide)
            found[body.carrier] = slide
    return found


def add_guides(draft: Draft, slides: list[Slide]) -> None:
    """Guides that are plates of their own, with their posts."""
    for slide in slides:
        if slide.own:
            _add_guide(draft, slide)


def _add_guide(draft: Draft, slide: Slide) -> None:
    body, slot, radius = draft.body(slide.joint.guide), slide.slot, POST * slide.width
    ends = (slot.at(slot.low - radius - slot.wall), slot.at(slot.high + radius + slot.wall))
    arms = [bar(pair, 2.0 * (radius + slot.wall)) for pair in zip(ends, slide.posts, strict=True)]
    shape = joined([Shape((slot.ring,)), *arms])
    draft.plate(slide.plate, "guide", body.carrier, shape, slide.joint.guide)
    fasten(draft, slide.joint.name, body, slide.plate, slide.posts, radius)


def add_blocks(draft: Draft, slides: list[Slide], alone: dict[str, Slide]) -> None:
    """Blocks: those that are links of their own are level with their guides, others reach to their links."""
    for slide in slides:
        body, guide = draft.body(slide.joint.block), draft.known(slide.plate)
        if alone.get(body.carrier) is not slide:
            plates = tuple(each for each in (guide, body.plate) if each)
            if plates:
                draft.add(Solid(slide.block, "block", body.carrier, _block(draft, slide), plates), *plates)
        elif guide and body.plate:
            draft.level.append((guide, body.plate))
            draft.join(guide, body.plate)


def around_pin(draft: Draft, slides: list[Slide], link: str, place: complex) -> tuple[list[str], list[str]]:
    """Of a pin of a link that goes through blocks: the guides that it reaches, and all solids around it."""
    reached, around = [], []
    for slide in slides:
        body, guide = draft.body(slide.joint.block), draft.known(slide.plate)
        if body is draft.body(link) and _block_place(draft, slide).distance(place) <= draft.near:
            own = draft.known(slide.block)
            reached += [guide] if guide and own else []
            around += [each for each in (guide, own) if each]
    return reached, around


def _block_place(draft: Draft, slide: Slide) -> Slot:
    """The place of a block in the axes of its carrier, as that of a slot."""
    joint = slide.joint
    way = draft.carriers.places[joint.block].turn * cmath.exp(1j * joint.block_angle)
    half = 0.5 * LENGTH * slide.width
    centre = draft.carriers.place(joint.block, joint.at) + slide.shift * way
    return Slot(centre, way, -half, half, slide.slot.half, 0.0)


def _block(draft: Draft, slide: Slide) -> Shape:
    """A block in the axes of its carrier."""
    return polygon(_block_place(draft, slide).corners())
