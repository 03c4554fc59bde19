"""Velocity and acceleration polygons of one position, as numbers: images of points, and the vectors between them.

The graphical method: absolute vectors begin at the pole; on every link the vector of a point is that of its first
joint plus the relative one, whose acceleration has a part along the link (normal, ω² r towards the first joint) and
one across it (tangential, α r). At a moving guide the block's point adds the Coriolis acceleration 2 ω × v_r and the
relative one along the guide (Norton, Design of Machinery, chapters 6 and 7).
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.errors import LinkwrightError
from linkwright.joints.lower_pair import SlidingJoint
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.words import _


@dataclass(frozen=True)
class Step:
    """A vector of the polygon from ``start`` to ``end`` (2,): ``letter``, ``name`` of points, ``role``, ``group``.

    Roles: ``absolute``, ``relative``, ``normal``, ``tangential``, ``coriolis``, ``sliding``.
    """

    letter: str
    name: str
    role: str
    start: Floats
    end: Floats
    group: str = ""

    @property
    def size(self) -> float:
        """Its length, SI."""
        return float(np.hypot(*(self.end - self.start)))


@dataclass
class MotionPolygon:
    """``images`` of the points by name, (2,) each from the pole, and the ``steps`` that lead to them."""

    images: dict[str, Floats] = field(default_factory=dict)
    steps: list[Step] = field(default_factory=list)
    group: str = ""

    @property
    def places(self) -> Floats:
        """The pole, images and ends of all vectors, (n, 2); raises LinkwrightError where nothing moves."""
        found = np.array([np.zeros(2), *self.images.values(), *(step.end for step in self.steps)])
        if not float(np.ptp(found, axis=0).max()) > 0.0:
            raise LinkwrightError(
                _(
                    "nothing moves at this position, so there is no polygon; choose another input: at=…",
                    code="picture.nothing_moves",
                )
            )
        return found

    def put(self, letter: str, name: str, role: str, start: Floats, end: Floats) -> None:
        """A vector from start to end."""
        self.steps.append(Step(letter, name, role, np.asarray(start), np.asarray(end), self.group))


def velocity_polygon(motion: Motion, index: int) -> MotionPolygon:
    """Velocities of all points at one position, m/s."""
    return _Polygon(motion, index, "v").made()


def acceleration_polygon(motion: Motion, index: int) -> MotionPolygon:
    """Accelerations of all points at one position, m/s², with their normal, tangential and Coriolis parts."""
    return _Polygon(motion, index, "a").made()


def place_of(motion: Motion, link: str, point: str, index: int) -> Floats:
    """A point of a link at one position, (2,) m."""
    x, y = motion.mechanism.link(link).points[point]
    if link == "frame":
        return np.array([x, y])
    return np.asarray(motion.point(f"{link}.{point}").position[index])


class _Polygon:
    def __init__(self, motion: Motion, index: int, letter: str) -> None:
        self.motion, self.index, self.letter = motion, index, letter
        self.found = MotionPolygon()

    def made(self) -> MotionPolygon:
        """Group by group, in solving order; in each the absolute vectors of its points first."""
        guides = [joint for joint in self.motion.mechanism.guides.values() if joint.guide != "frame"]
        solved: set[str] = set()
        for group in self.motion.structure.groups:
            self.found.group = f"{group.signature}: {', '.join(group.links)}"
            known, place = set(self.found.images), len(self.found.steps)
            for link in group.links:
                self._link(link)
            solved |= set(group.links)
            for joint in [each for each in guides if solved >= {each.guide, each.block}]:
                guides.remove(joint)
                self._guide(joint)
            relative = self.found.steps[place:]
            del self.found.steps[place:]
            for key in [each for each in self.found.images if each not in known]:
                self.found.put(self.letter, key, "absolute", np.zeros(2), self.found.images[key])
            self.found.steps += relative
        return self.found

    def _link(self, link: str) -> None:
        points = list(self.motion.mechanism.links[link].points)
        known = [p for p in points if canonical(self.motion.mechanism, link, p) in self.found.images]
        fixed = [p for p in points if self._fixed(link, p)]
        base = (fixed or known or points)[0]
        if not fixed:
            self.found.images.setdefault(self._key(link, base), self._value(link, base))
        for point in points:
            if point != base and not self._fixed(link, point):
                self._relative(link, base, point)
                self.found.images[self._key(link, point)] = self._value(link, point)

    def _relative(self, link: str, base: str, point: str) -> None:
        """From the image of a link's base to that of another of its points."""
        state, i = self.motion.link(link), self.index
        arm = place_of(self.motion, link, point, i) - place_of(self.motion, link, base, i)
        across = np.array([-arm[1], arm[0]])
        start, end = self._value(link, base), self._value(link, point)
        pair = point if self._fixed(link, base) else f"{point}{base}"
        if self.letter == "v":
            if not self._fixed(link, base):
                self.found.put("v", pair, "relative", start, end)
            return
        corner = start - float(state.angular_velocity[i]) ** 2 * arm
        self.found.put("a", pair, "normal", start, corner)
        self.found.put("a", pair, "tangential", corner, corner + float(state.angular_acceleration[i]) * across)

    def _guide(self, joint: SlidingJoint) -> None:
        """From the guide's point under the block to the block's own point."""
        under = f"{joint.at}({joint.guide})"
        state, i = self.motion.link(joint.guide), self.index
        base = next(iter(self.motion.mechanism.links[joint.guide].points))
        arm = place_of(self.motion, joint.block, joint.at, i) - place_of(self.motion, joint.guide, base, i)
        across = np.array([-arm[1], arm[0]])
        omega, alpha = float(state.angular_velocity[i]), float(state.angular_acceleration[i])
        point = self.motion.point(f"{joint.guide}.{base}") if not self._fixed(joint.guide, base) else None
        still = np.zeros(2)
        velocity = (still if point is None else point.velocity[i]) + omega * across
        own = self._value(joint.block, joint.at)
        if self.letter == "v":
            self.found.images[under] = velocity
            self.found.put("v", f"{joint.at}{under}", "sliding", velocity, own)
            return
        acceleration = (still if point is None else point.acceleration[i]) + alpha * across - omega**2 * arm
        sliding = np.asarray(self.motion.point(f"{joint.block}.{joint.at}").velocity[i]) - velocity
        corner = acceleration + 2 * omega * np.array([-sliding[1], sliding[0]])
        self.found.images[under] = acceleration
        self.found.put("a", joint.at, "coriolis", acceleration, corner)
        self.found.put("a", joint.at, "sliding", corner, own)

    def _key(self, link: str, point: str) -> str:
        key = canonical(self.motion.mechanism, link, point)
        return key if "." not in key or self._ambiguous(point) else point

    def _ambiguous(self, point: str) -> bool:
        links = self.motion.mechanism.links.values()
        keys = {canonical(self.motion.mechanism, each.name, point) for each in links if point in each.points}
        return len(keys) > 1

    def _fixed(self, link: str, point: str) -> bool:
        return {"frame", link} <= set(self.motion.mechanism.pin_links(point))

    def _value(self, link: str, point: str) -> Floats:
        found = self.motion.point(f"{link}.{point}")
        return np.asarray((found.velocity if self.letter == "v" else found.acceleration)[self.index])
