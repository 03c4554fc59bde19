"""Guides of a machine as slots of a file of Linkage."""

from __future__ import annotations

import math

import numpy as np

from linkwright.exporters.linkage.links import FRAME, Links
from linkwright.joints.lower_pair import SlidingJoint
from linkwright.kinematics.motion import Motion
from linkwright.mechanism.link import Vec

#: What a slot is longer than the way in it, as a share of the machine's size.
SPARE = 0.1


class Slots:
    """Adds slots to links, long enough for a motion."""

    def __init__(self, links: Links, motion: Motion) -> None:
        self.links, self.found, self.motion = links, links.found, motion

    def slide(self, guide: SlidingJoint) -> None:
        """A guide as a slot: a pin in it, or two pins of a block that must not turn."""
        direction = self.links.placed[guide.guide].direction[self.links.index]
        angle = math.atan2(direction[1], direction[0]) + guide.direction
        along, at = (math.cos(angle), math.sin(angle)), self.links.place(guide.block, guide.at)
        way = self.motion.joint(guide.name).displacement
        here, way = float(way[self.links.index]), way[np.isfinite(way)]
        low, high = float(way.min()) - here, float(way.max()) - here
        spare = SPARE * self.links.size
        pins, second = self.pins(guide, at, along, spare)
        limits = self.limits(guide, at, along, (low, high + second))
        if limits is None:
            ends = (_ahead(at, along, low - spare), _ahead(at, along, high + second + spare))
            names = (f"{guide.name}_1", f"{guide.name}_2")
            limits = (
                self.links.extra(guide.guide, names[0], ends[0]),
                self.links.extra(guide.guide, names[1], ends[1]),
            )
            if guide.guide == FRAME:
                self.found.link("", list(limits))
        for each in pins:
            self.found.connectors[each].limits = limits
            if self.found.connectors[each].anchor:
                self.found.link("", [each])

    def pins(self, guide: SlidingJoint, at: Vec, along: Vec, spare: float) -> tuple[list[int], float]:
        """The connectors that slide, and how far ahead of the block's point the last one is, m."""
        first, block = self.slider(guide.block, guide.at), guide.block
        if first is not None and block != FRAME and self.links.is_pin(block):
            return [first], 0.0
        pins, ahead = [] if first is None else [first], 0.0
        while len(pins) < 2:
            ahead += spare
            pins.append(self.links.extra(block, f"{guide.at}_{guide.name}", _ahead(at, along, ahead)))
        return pins, ahead

    def limits(self, guide: SlidingJoint, at: Vec, along: Vec, way: tuple[float, float]) -> tuple[int, int] | None:
        """The two points that give the guide's direction, where the way in it lies between them."""
        if guide.direction_points is None or guide.guide == FRAME or abs(guide.offset) > 0:
            return None
        ends = [self.links.place(guide.guide, each) for each in guide.direction_points]
        low, high = sorted((x - at[0]) * along[0] + (y - at[1]) * along[1] for x, y in ends)
        if way[0] < low or way[1] > high:
            return None
        first, second = (self.links.numbers[guide.guide, each] for each in guide.direction_points)
        return first, second

    def slider(self, block: str, point: str) -> int | None:
        """The connector of a block's point, where it is free to slide; a further one of a link that is pinned there.

        None: there is none, so that the block, a link of its own, has to slide with two others.
        """
        pin = block in self.links.links and self.links.is_pin(block)
        holders = self.links.holders(block) if pin else [block]
        holder = holders[0] if holders else block
        found = self.links.numbers[holder, point]
        if self.found.connectors[found].limits is None:
            return found
        firm = [each for each in holders if each == FRAME or len(self.links.links[each].points) > 1]
        if pin and firm:
            return self.links.extra(firm[0], point, self.links.place(block, point))
        if block not in self.links.of_link and block != FRAME:
            self.links.of_link[block] = self.found.link(block, [found])
        return None


def _ahead(place: Vec, along: Vec, by: float) -> Vec:
    return place[0] + by * along[0], place[1] + by * along[1]
