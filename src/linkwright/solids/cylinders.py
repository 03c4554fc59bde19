"""Cylinders: links that slide in each other like rod and barrel, bars in one layer."""

from __future__ import annotations

import cmath

from linkwright.joints.lower_pair import SlidingJoint
from linkwright.shapes.shape import bar, disc, joined
from linkwright.solids.draft import Draft

#: A slide is a cylinder where the distance of its ends is never less than so many widths.
WIDTHS = 2.0
#: Length of a barrel at most, as a share of the shortest distance; width of a rod, as one of its link's.
BARREL, ROD = 0.94, 0.6


def is_cylinder(draft: Draft, joint: SlidingJoint) -> bool:
    """Whether two links slide in each other like rod and barrel: both with all their points on the line, pinned at
    ends that never come near each other."""
    pins = draft.mechanism.pins
    ends = ((joint.guide, joint.through), (joint.block, joint.at))
    if joint.offset or not all(point in pins and link in pins[point].joined for link, point in ends):
        return False
    if not all(draft.is_free(draft.body(link)) and len(draft.body(link).links) == 1 for link, _point in ends):
        return False
    others = (each for each in draft.mechanism.guides.values() if each is not joint)
    if any(link in each.joined for each in others for link, _point in ends):
        return False
    low, high = draft.stroke(joint)
    width = max(draft.sizes.width[link] for link, _point in ends)
    backwards = ((joint.guide, joint.through, joint.direction), (joint.block, joint.at, joint.block_angle + cmath.pi))
    behind = all(_behind(draft, link, point, angle, BARREL * low) for link, point, angle in backwards)
    return behind and low > max(WIDTHS * width, 0.5 * (high - low))


def _behind(draft: Draft, link: str, point: str, angle: float, reach: float) -> bool:
    """Whether no point of a link lies beside the line from its end, or beyond a reach along it."""
    here, way = draft.carriers.place(link, point), cmath.exp(-1j * angle)
    local = [(place - here) * way for place in draft.points(draft.body(link))]
    return all(abs(each.imag) <= draft.near and each.real <= reach for each in local)


def plan_cylinder(draft: Draft, joint: SlidingJoint) -> None:
    """Barrel and rod as bars as long as the stroke needs them."""
    short, longest = draft.stroke(joint)
    barrel = max(0.8 * short, min(0.62 * longest, BARREL * short))
    rod = max(longest - 0.92 * barrel, short - 0.98 * barrel)
    for link, point, angle, length, share in (
        (joint.guide, joint.through, joint.direction, barrel, 1.0),
        (joint.block, joint.at, joint.block_angle + cmath.pi, rod, ROD),
    ):
        start, width = draft.carriers.place(link, point), draft.sizes.width[link]
        points = draft.points(draft.body(link))
        reach = max(((each - start) * cmath.exp(-1j * angle)).real for each in points)
        end = start + cmath.rect(max(length, reach), angle)
        draft.body(link).shape = joined([bar([start, end], share * width), disc(start, 0.5 * width)])
    draft.level.append((joint.guide, joint.block))
    draft.join(joint.guide, joint.block)
