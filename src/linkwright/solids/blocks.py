"""Blocks: plates in one layer with their guides, which are links of their own or held by posts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from linkwright.mechanism.plate import shape_kind
from linkwright.shapes.shape import Shape, polygon
from linkwright.solids.draft import Body, Draft
from linkwright.solids.guides import Slide, block_place
from linkwright.solids.mounting import fasten, roller_pin
from linkwright.solids.slots import Slot

#: Radius of the posts of a block, and how far they are from its middle, without and with a pin there: shares of its
#: width.
POST, APART, BESIDE_PIN = 0.12, 0.3, 0.52


def plan_blocks(draft: Draft, slides: list[Slide]) -> dict[str, Slide]:
    """Links that are blocks and nothing else: their plates are the blocks of these slides. What the plates of others
    need for the posts of their blocks is added to them."""
    alone: dict[str, Slide] = {}
    for slide in slides:
        body = draft.body(slide.joint.block)
        if body.carrier not in alone and _is_alone(draft, slides, body):
            body.sort, alone[body.carrier] = "block", slide
            if draft.is_free(body):
                body.shape = _shape(draft, slide)
    for slide in slides:
        body = draft.body(slide.joint.block)
        kinds = {shape_kind(draft.mechanism.link(link)) for link in body.links}
        wide = kinds <= {"bar", "plate", "path"} and body.carrier != "frame" and not _has_pin(draft, slide)
        if body.carrier not in alone and not wide:
            body.fixed.append(_posts(draft, slide))
    return alone


def _is_alone(draft: Draft, slides: list[Slide], body: Body) -> bool:
    """Whether a link is a block and nothing else; of several blocks only without a pin, as they must not turn."""
    own = [each for each in slides if draft.body(each.joint.block) is body]
    still = len(own) == 1 or not any(_has_pin(draft, each) for each in own)
    bare = body.shape is None and not body.slots and not body.fixed and len(draft.points(body)) == 1
    return bare and still and body.carrier != "frame"


def _place(draft: Draft, slide: Slide) -> Slot:
    return block_place(draft, slide.joint, slide.width, slide.shift)


def _shape(draft: Draft, slide: Slide) -> Shape:
    """A block in the axes of its carrier."""
    return polygon(_place(draft, slide).corners())


def _has_pin(draft: Draft, slide: Slide) -> bool:
    """Whether a pin goes through a block."""
    return any(goes_through(draft, slide, place, radius) for place, radius in _pins(draft, slide))


def goes_through(draft: Draft, slide: Slide, place: complex, radius: float) -> bool:
    """Whether a block is around a pin."""
    inner = _place(draft, slide)
    room = replace(inner, low=inner.low + radius, high=inner.high - radius, half=inner.half - radius)
    return min(room.half, room.high - room.low) > 0.0 and room.distance(place) <= draft.near


def _pins(draft: Draft, slide: Slide) -> Iterator[tuple[complex, float]]:
    body = draft.body(slide.joint.block)
    yield from ((place, draft.sizes.pin_radius[name]) for name, place in draft.pinned(body))
    for each in draft.rollers(body):
        yield draft.carriers.place(each.follower, each.at), roller_pin(draft, each)


def _posts(draft: Draft, slide: Slide) -> tuple[complex, complex]:
    """Places of the two posts of a block, beside its pin where it has one."""
    place = _place(draft, slide)
    away = slide.width * (BESIDE_PIN if _has_pin(draft, slide) else APART)
    return place.at(-away), place.at(away)


def add_blocks(draft: Draft, slides: list[Slide], alone: dict[str, Slide]) -> None:
    """The plates of blocks that are not links of their own, with their posts; all are level with their guides."""
    for slide in slides:
        body, guide = draft.body(slide.joint.block), draft.known(slide.plate)
        block = body.plate
        if alone.get(body.carrier) is not slide:
            block = slide.block
            draft.plate(block, "block", body.carrier, _shape(draft, slide), slide.joint.block)
            if body.plate:
                fasten(draft, block, body, block, _posts(draft, slide), POST * slide.width)
        if guide and block:
            draft.level.append((guide, block))
            draft.join(guide, block)
            draft.join(
                guide, *(f"post {block}.{number}" for number in (1, 2) if f"post {block}.{number}" in draft.solids)
            )


def around_pin(
    draft: Draft, slides: list[Slide], carrier: str, place: complex, radius: float
) -> tuple[list[str], list[str]]:
    """Of a pin of some links that goes through blocks: those that are plates of their own, and the guides around."""
    reached, around = [], []
    for slide in slides:
        if draft.body(slide.joint.block).carrier == carrier and goes_through(draft, slide, place, radius):
            reached += [each for each in (draft.known(slide.block),) if each]
            around += [each for each in (draft.known(slide.plate),) if each]
    return reached, around
