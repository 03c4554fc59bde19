"""What an assembled drawing tells: driver coordinates, directions of links, slides."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cached_property

from linkwright.core.linear_sums import SMALL, LinearSums
from linkwright.joints.base import Joint
from linkwright.joints.lower_pair import SlidingJoint
from linkwright.mechanism.mechanism import Mechanism

Vec = tuple[float, float]


class Drawing:
    """Coordinates of points in frame axes, some of them perhaps missing."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism
        self._sums: LinearSums[str] | None = None

    @cached_property
    def points(self) -> dict[str, Vec]:
        """Coordinates by the names of the points, m."""
        return {**self.mechanism.drawing, **self.mechanism.frame.points}

    def __bool__(self) -> bool:
        return bool(self.mechanism.drawing)

    @cached_property
    def _directions(self) -> dict[str, float | None]:
        """Directions of links without turns, rad; None of those that nothing drawn tells."""
        found: dict[str, float | None] = {"frame": 0.0}
        found |= {name: self._from_points(name) for name in self.mechanism.links}
        self._spread_along_guides(found)
        return found

    def angle(self, link: str) -> float | None:
        """Direction of a link's x axis, rad; None where the drawing does not tell.

        With the turns that it has in the motion where drivers, guides, welds and higher pairs of known phase give
        them, of a driver those at the start of its law; else in [-π, π].
        """
        if self._sums is None:
            self._count_turns()
        assert self._sums is not None
        terms, total = self._sums.reduced({link: 1.0})
        own = self._directions[link]
        for each, factor in terms.items():
            other = self._directions[each] if abs(factor) > SMALL else 0.0
            if other is None:
                return None if own is None else math.remainder(own, 2.0 * math.pi)
            total += factor * math.remainder(other, 2.0 * math.pi)
        return total if own is None else total + math.remainder(own - total, 2.0 * math.pi)

    def driver(self, name: str) -> float | None:
        """A driver's coordinate in the drawing."""
        driver = self.mechanism.drivers[name]
        if driver.joint in self.mechanism.guides:
            return self.slide(self.mechanism.guides[driver.joint])
        ends = driver.link, driver.relative_to
        if any(self._directions[link] is None for link in ends):
            return None
        turned, base = (self.angle(link) for link in ends)
        return None if turned is None or base is None else turned - base

    def slide(self, joint: SlidingJoint) -> float | None:
        """Displacement of a guide's block in the drawing."""
        through, at = self.place(joint.guide, joint.through), self.place(joint.block, joint.at)
        angle = self.angle(joint.guide)
        if through is None or at is None or angle is None:
            return None
        direction = angle + joint.direction
        return (at[0] - through[0]) * math.cos(direction) + (at[1] - through[1]) * math.sin(direction)

    def _from_points(self, link: str) -> float | None:
        local = self.mechanism.links[link].points
        drawn = [name for name in local if self.drawn(link, name) is not None]
        best: tuple[float, float] | None = None
        for i, first in enumerate(drawn):
            for second in drawn[i + 1 :]:
                a, b = local[first], local[second]
                p, q = self.drawn(link, first), self.drawn(link, second)
                assert p is not None and q is not None
                length = math.hypot(b[0] - a[0], b[1] - a[1])
                if length > 0 and (best is None or length > best[0]):
                    world = math.atan2(q[1] - p[1], q[0] - p[0])
                    best = (length, world - math.atan2(b[1] - a[1], b[0] - a[0]))
        return None if best is None else best[1]

    def drawn(self, link: str, point: str) -> Vec | None:
        """Where a point of a link is drawn, m."""
        return self.points.get(f"{link}.{point}", self.points.get(point))

    def place(self, link: str, point: str) -> Vec | None:
        drawn = self.drawn(link, point)
        if drawn is not None:
            return drawn
        angle = self.angle(link)
        local = self.mechanism.link(link).points
        for name, (x, y) in local.items():
            base = self.drawn(link, name)
            if base is not None and angle is not None:
                dx, dy = local[point][0] - x, local[point][1] - y
                c, s = math.cos(angle), math.sin(angle)
                return base[0] + c * dx - s * dy, base[1] + s * dx + c * dy
        return None

    def _count_turns(self) -> None:
        """Sums of rotations that hold in the motion, in the order in which chains hang on joints: a link whose
        direction the others do not fit follows none of them."""
        self._sums = LinearSums()
        self._add({"frame": 1.0}, 0.0)
        joints = [each for each in self.mechanism.joints.values() if each.ties or each.higher]
        joints.sort(key=lambda each: (each.higher, each.freedoms))
        while joints and not joints[0].freedoms:
            self._hold(joints.pop(0))
        for driver in self.mechanism.drivers.values():
            if driver.law.rotary:
                start = driver.law.own.at(0.0)
                turned, base = (self._directions[each] for each in (driver.link, driver.relative_to))
                if turned is not None and base is not None:
                    start += math.remainder(turned - base - start, 2.0 * math.pi)
                self._add({driver.link: 1.0, driver.relative_to: -1.0}, -start)
        while len(left := [each for each in joints if not self._hold(each)]) < len(joints):
            joints = left

    def _hold(self, joint: Joint) -> bool:
        """Adds what a joint holds; whether the drawing tells it so far."""
        held = joint.rotation_sum(self)
        if held is not None:
            self._add(*held)
        return held is not None

    def _add(self, terms: Mapping[str, float], rest: float) -> None:
        """Adds a sum, solved for a link that is not drawn, or whose direction the others fit best."""
        assert self._sums is not None
        left, constant = self._sums.reduced(terms, rest)
        directions = {link: self._directions[link] for link, factor in left.items() if abs(factor) > SMALL}

        def order(link: str) -> float:
            own = directions.get(link)
            if own is None:
                return 1.0
            total = constant + sum(
                left[each] * math.remainder(a or 0.0, 2.0 * math.pi) for each, a in directions.items()
            )
            return -round(abs(math.remainder(total / left[link], 2.0 * math.pi)), 1)

        self._sums.add(terms, rest, order)

    def _spread_along_guides(self, angles: dict[str, float | None]) -> None:
        """A link without two drawn points takes its direction from a guide, or from where its block is drawn."""
        guides = self.mechanism.guides.values()
        self._share_directions(angles)
        for joint in guides:
            if angles[joint.guide] is None and angles[joint.block] is None:
                angles[joint.guide] = self._along_guide(joint)
                self._share_directions(angles)

    def _share_directions(self, angles: dict[str, float | None]) -> None:
        """The directions of guides and blocks from each other's."""
        guides = self.mechanism.guides.values()
        for _ in guides:
            for joint in guides:
                turn = joint.direction - joint.block_angle
                guide, block = angles[joint.guide], angles[joint.block]
                if block is None and guide is not None:
                    angles[joint.block] = guide + turn
                elif guide is None and block is not None:
                    angles[joint.guide] = block - turn

    def _along_guide(self, joint: SlidingJoint) -> float | None:
        """Direction of a guide's link where its point and that of the block are drawn, the block ahead.

        The block is behind where the assembly's word or the start of its driver says so.
        """
        through, at = self.drawn(joint.guide, joint.through), self.drawn(joint.block, joint.at)
        if through is None or at is None:
            return None
        dx, dy = at[0] - through[0], at[1] - through[1]
        if math.hypot(dx, dy) <= abs(joint.offset):
            return None
        along = math.sqrt(dx * dx + dy * dy - joint.offset**2)
        starts = (d.law.own.at(0.0) for d in self.mechanism.drivers.values() if d.joint == joint.name)
        if self.mechanism.assembly.get(joint.name) == "backward" or next(starts, 0.0) < 0.0:
            along = -along
        return math.atan2(dy, dx) - math.atan2(joint.offset, along) - joint.direction
