"""The solved position as symbols: every quantity of the mechanism with its name and its value."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.elements import TreeJoint
from linkwright.equations.terms import NOWHERE, ONE, ZERO, Pair, Term, number, symbol
from linkwright.joints.base import Joint
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.mechanism.link import Link
from linkwright.words import Translate


@dataclass(frozen=True)
class PointState:
    """A point: its key, the label that the reader sees, where it is and how it moves."""

    key: str
    label: str
    place: Pair
    velocity: Pair
    acceleration: Pair
    fixed: bool


@dataclass(frozen=True)
class Slide:
    """A guide: unit vector, displacement with rates; ``sign`` -1 where the chain runs from block to guide."""

    joint: str
    along: Pair
    s: Term
    rate: Term
    second: Term


class SymbolTable:
    """Symbols of one position of a motion; links are numbered in the order of the file, the frame is 0."""

    def __init__(self, motion: Motion, index: int, translate: Translate) -> None:
        self.motion = motion
        self.mechanism = motion.mechanism
        self.index = index
        self.translate = translate
        self.numbers = {"frame": 0} | {name: i for i, name in enumerate(self.mechanism.links, 1)}
        self.introduced: set[str] = set()
        self._spots: dict[str, PointState] = {}

    # links --------------------------------------------------------------------------------
    def angle_of(self, link: str) -> float:
        """Angle of a link's x axis, degrees, -180 to 180."""
        x, y = self.motion.link(link).direction[self.index]
        angle = math.degrees(math.atan2(y, x))
        return 180.0 if angle < 1e-10 - 180.0 else angle

    def turn(self, link: str) -> Term:
        """φ of a link; nothing for the frame."""
        if link == "frame":
            return ZERO
        n = self.numbers[link]
        return symbol(f"φ{n}", self.angle_of(link), degrees=True)

    def rotation(self, link: str) -> Term:
        """φ of a link and the turns that pairs count with it."""
        turn = self.turn(link)
        if link == "frame" or not self.motion.solver.motion.angles.counts(link):
            return turn
        counted = math.degrees(float(self.motion.row("turned_angle", link)[self.index]))
        turns = round((counted - turn.amount) / 360.0)
        full_turns = number(360.0 * abs(turns), degrees=True)
        return turn + full_turns if turns > 0 else turn - full_turns

    def omega(self, link: str) -> Term:
        """ω of a link."""
        return self._rate(link, "ω", "angular_velocity")

    def alpha(self, link: str) -> Term:
        """α of a link; nothing where a constant speed drives it."""
        return ZERO if link in self.steady else self._rate(link, "α", "angular_acceleration")

    def _rate(self, link: str, letter: str, name: str) -> Term:
        if link in self.resting:
            return ZERO
        n = self.numbers[link]
        value = float(getattr(self.motion.link(link), name)[self.index])
        return symbol(f"{letter}{n}", value)

    @cached_property
    def resting(self) -> frozenset[str]:
        """Links that cannot turn: the frame, and what guides and welds hang on it."""
        found = {"frame"}
        for _ in self.mechanism.links:
            for joint in self.mechanism.joints.values():
                found |= _followers(joint, found)
        if not self.mechanism.drivers:
            found |= set(self.mechanism.links)
        return frozenset(found)

    @cached_property
    def steady(self) -> frozenset[str]:
        """Links that turn at constant speed by their drivers."""
        found = set(self.resting)
        for _ in self.mechanism.links:
            for driver in self.mechanism.drivers.values():
                turning = self.mechanism.joints[driver.joint].coordinate == "turn"
                ends = {driver.link, driver.relative_to}
                if turning and driver.law.constant_speed is not None and found & ends:
                    found |= ends
            for joint in self.mechanism.joints.values():
                found |= _followers(joint, found)
        return frozenset(found)

    # points -------------------------------------------------------------------------------
    def spot(self, link: str, point: str) -> PointState:
        """A point of a link; ``@centre`` is its mass centre."""
        point = self.centre_name(link) if point == "@centre" else point
        key = f"{link}.@centre" if point == "@centre" else canonical(self.mechanism, link, point)
        if key not in self._spots:
            self._spots[key] = self._make(key, link, point)
        return self._spots[key]

    def centre_name(self, link: str) -> str:
        """The point in which a link's mass centre lies, else ``@centre``."""
        part = self.mechanism.link(link)
        return next((name for name, place in part.points.items() if place == part.centre), "@centre")

    def _make(self, key: str, link: str, point: str) -> PointState:
        label = self._label(key, link, point)
        fixed = "frame" in (link, *self.mechanism.pin_links(key))
        if fixed:
            x, y = self.mechanism.frame.points[point]
            known = (t if t.amount else ZERO for t in self._coordinates(label, x, y))
            return PointState(key, label, Pair(*known), NOWHERE, NOWHERE, True)
        at = self.motion.point_of(key)
        place = Pair(*self._coordinates(label, *at.position[self.index]))
        if not self.mechanism.drivers:
            return PointState(key, label, place, NOWHERE, NOWHERE, False)
        velocity = self._components("v", label, *at.velocity[self.index])
        acceleration = self._components("a", label, *at.acceleration[self.index])
        return PointState(key, label, place, velocity, acceleration, False)

    def _components(self, letter: str, label: str, x: float, y: float) -> Pair:
        named = (symbol(f"{letter}_{label}{c}", float(v)) for c, v in (("x", x), ("y", y)))
        return Pair(*named)

    @staticmethod
    def _coordinates(label: str, x: float, y: float) -> list[Term]:
        named = zip("xy", (float(x), float(y)), strict=True)
        return [symbol(f"{c}_{label}", value) for c, value in named]

    def _label(self, key: str, link: str, point: str) -> str:
        if point == "@centre":
            taken = any(f"G{self.numbers[link]}" in each.points for each in self._links)
            return f"G{self.numbers[link]}" + ("*" if taken else "")
        if key == point:
            return point
        owners = [each.name for each in self._links if point in each.points]
        return point if len(owners) == 1 else key

    @cached_property
    def _links(self) -> list[Link]:
        return [self.mechanism.frame, *self.mechanism.links.values()]

    def local(self, link: str, point: str) -> complex:
        """A point in the axes of its link."""
        part = self.mechanism.link(link)
        return complex(*(part.centre if point == "@centre" else part.points[point]))

    def arm(self, link: str, start: str, end: str) -> Pair:
        """From one point of a link to another, in the axes of the link; known zeros left out."""
        d = self.local(link, end) - self.local(link, start)
        a, b = (self.spot(link, name).label for name in (start, end))
        size = abs(d)
        found = []
        straight = abs(d.imag) <= 1e-14 * size and d.real > 0.0
        for letter, value in (("l" if straight else "u", d.real), ("w", d.imag)):
            zero = abs(value) <= 1e-14 * size
            found.append(ZERO if zero else symbol(f"{letter}_{a}{b}", value))
        return Pair(*found)

    # guides and drivers -------------------------------------------------------------------
    def slide(self, joint: str) -> Slide:
        """A guide in this position."""
        prismatic = self.mechanism.guides[joint]
        at = self.motion.joint(joint)
        direction = math.radians(self.angle_of(prismatic.guide)) + prismatic.direction
        along = complex(np.cos(direction), np.sin(direction))
        terms = []
        for c, value in (("x", along.real), ("y", along.imag)):
            level = prismatic.guide in self.resting and abs(value) < 1e-15
            if prismatic.guide in self.resting and value == 1.0:
                terms.append(ONE)
                continue
            terms.append(ZERO if level else symbol(f"n_{joint},{c}", value))
        moves = bool(self.mechanism.drivers)
        rates = [
            symbol(f"s{mark}_{joint}", float(values[self.index]), look=f"s{accent}_{joint}")
            for mark, accent, values in (("'", "\u0307", at.velocity), ("''", "\u0308", at.acceleration))
        ]
        s = symbol(f"s_{joint}", float(at.displacement[self.index]))
        return Slide(joint, Pair(*terms), s, *(rates if moves else [ZERO, ZERO]))

    def guide_angle(self, step: TreeJoint) -> Term:
        """Direction of a guide in the axes of the link that carries it."""
        prismatic = self.mechanism.guides[step.joint]
        return self.degrees(prismatic.direction)

    def drive(self, name: str) -> tuple[Term, Term, Term]:
        """Coordinate of a driver with its rates."""
        q, rate, second = (float(row[self.index]) for row in self.motion.positions.coordinates[name])
        turning = self.motion.positions.rotary[name]
        mark = "" if len(self.mechanism.drivers) == 1 else f"_{name}"
        shown = math.degrees(q) if turning else q
        return (
            symbol(f"q{mark}", shown, degrees=turning),
            symbol(f"q'{mark}", rate, look=f"q̇{mark}"),
            ZERO if second == 0.0 else symbol(f"q''{mark}", second, look=f"q̈{mark}"),
        )

    def turned(self, step: TreeJoint) -> Term:
        """Angle of the child's axes against the parent's, for a guide or a weld."""
        return self.degrees(self.mechanism.joints[step.joint].turn_of(step.child, self.mechanism))

    @staticmethod
    def degrees(radians: float) -> Term:
        """A given angle as a plain number of degrees."""
        value = math.degrees(radians)
        return ZERO if value == 0.0 else number(float(f"{value:.13g}"), degrees=True)


def _followers(joint: Joint, known: set[str]) -> set[str]:
    """Links that turn as some others do (not at all, or steadily), as a joint ties their rotations."""
    if joint.ties:
        return set(joint.ties) if known & set(joint.ties) else set()
    if joint.rotations_only and len(set(joint.turning) - known) == 1:
        return set(joint.turning)
    return set()
