"""Links as bodies that hang on each other along the chains of the Assur groups, and how these bodies move."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from linkwright.core.arrays import Floats
from linkwright.elements import Connection, TreeJoint
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.placement import placements
from linkwright.mechanism.link import Link

Complexes = NDArray[np.complex128]
Vec = tuple[float, float]


@dataclass(frozen=True)
class Coordinate:
    """A hinge or slide of the model, with ``values`` (n,) and ``rates`` (n,) over the motion, rad or m.

    ``at``: the hinge's place on its body, m. ``axis``: direction of the slide on its body; of a hinge (sense, 0),
    with sense -1 where the body turns against the coordinate. ``driver`` moves it, where one does.
    """

    name: str
    slides: bool
    at: Vec
    axis: Vec
    values: Floats
    rates: Floats
    driver: str | None = None


@dataclass(frozen=True)
class Body:
    """A link, or a rider (``link`` None): a slide on a guide, to which the block is held.

    ``place`` (m) and ``turn`` (rad) against the parent at the start.
    """

    name: str
    parent: str
    place: Vec
    turn: float
    coordinate: Coordinate | None
    link: Link | None = None


@dataclass(frozen=True)
class Pose:
    """Origins (n,) m and directions (n,) of a body's axes as complex numbers."""

    origin: Complexes
    direction: Complexes

    def of(self, point: Vec) -> Complexes:
        """A point of the body in frame axes, (n,) m."""
        return self.origin + self.direction * complex(*point)


Poses = Mapping[str, Pose]


class Chains:
    """All bodies of a motion, placed as at the position ``index``, in MuJoCo's order: parents before children."""

    def __init__(self, motion: Motion, index: int) -> None:
        self.motion, self.index = motion, index
        self.mechanism, self.structure = motion.mechanism, motion.structure
        self.exact = exact_poses(motion)
        self.hung = {step.child: step for group in self.structure.groups for step in group.tree}
        self.cuts = [cut for group in self.structure.groups for cut in group.cuts]
        self._names: set[str] = set()
        self.bodies: list[Body] = [*self._riders("frame"), *self._below("frame")]

    @property
    def coordinates(self) -> list[Coordinate]:
        """All coordinates in MuJoCo's order."""
        return [body.coordinate for body in self.bodies if body.coordinate is not None]

    @property
    def joint_of(self) -> dict[str, str]:
        """The coordinate that each driver moves."""
        return {each.driver: each.name for each in self.coordinates if each.driver is not None}

    def of(self, body: str) -> Coordinate | None:
        """The coordinate of a body."""
        return next(each.coordinate for each in self.bodies if each.name == body)

    def start(self, body: str) -> tuple[complex, complex]:
        """Origin and direction of a body's axes at the start."""
        pose = self.exact[body]
        return complex(pose.origin[self.index]), complex(pose.direction[self.index])

    def moved(self, values: Mapping[str, Floats]) -> Poses:
        """Where all bodies are with these coordinates by their names, as MuJoCo's chains place them."""
        count = len(next(iter(values.values()), np.zeros(1)))
        poses = {"frame": Pose(np.zeros(count, complex), np.ones(count, complex))}
        for body in self.bodies:
            base = poses[body.parent]
            origin = base.of(body.place)
            direction = base.direction * complex(math.cos(body.turn), math.sin(body.turn))
            each = body.coordinate
            if each is not None:
                moved = values[each.name] - each.values[self.index]
                if each.slides:
                    origin = origin + direction * complex(*each.axis) * moved
                else:
                    turned = direction * np.exp(1j * each.axis[0] * moved)
                    origin, direction = origin + (direction - turned) * complex(*each.at), turned
            poses[body.name] = Pose(origin, direction)
        return poses

    def factors(self, cut: Connection) -> dict[str, float]:
        """The row of a higher pair as factors of the model's coordinates; their sum stays what it is."""
        rotations, slides, _unused = self.mechanism.joints[cut.joint].sums(self.mechanism)
        found: dict[str, float] = {}
        for link, factor in rotations.items():
            while link in self.hung:
                coordinate, step = self.of(link), self.hung[link]
                if step.turns and coordinate is not None:
                    found[coordinate.name] = found.get(coordinate.name, 0.0) + factor * coordinate.axis[0]
                link = step.parent
        for name, factor in slides.items():
            found[name] = found.get(name, 0.0) + factor
        return {name: factor for name, factor in found.items() if factor}

    def _below(self, parent: str) -> Iterator[Body]:
        for child, step in self.hung.items():
            if step.parent == parent:
                coordinate = self._coordinate(step) if step.turns or step.slides else None
                place, turn = self.against(parent, child)
                yield Body(child, parent, place, turn, coordinate, self.mechanism.links[child])
                yield from self._riders(child)
                yield from self._below(child)

    def _riders(self, guide: str) -> Iterator[Body]:
        """A rider on each guide of this link that is cut."""
        for cut in self.cuts:
            if cut.slides and cut.a == guide:
                angle = self.mechanism.guides[cut.joint].block_angle
                slide = self.motion.joint(cut.joint)
                coordinate = Coordinate(
                    self._named(cut.joint, cut.b),
                    True,
                    (0.0, 0.0),
                    (math.cos(angle), math.sin(angle)),
                    slide.displacement,
                    slide.velocity,
                )
                yield Body(rider(cut), guide, *self.against(guide, cut.b), coordinate)

    def against(self, base: str, body: str) -> tuple[Vec, float]:
        """Place and angle of a body's axes in those of another one."""
        (origin, direction), (other, turned) = self.start(base), self.start(body)
        place, turn = (other - origin) * direction.conjugate(), turned * direction.conjugate()
        return (place.real, place.imag), math.atan2(turn.imag, turn.real)

    def _coordinate(self, step: TreeJoint) -> Coordinate:
        name, link = self._named(step.joint, step.child), self.mechanism.links[step.child]
        if step.slides:
            slide = self.motion.joint(step.joint)
            axis = self._slide_axis(step)
            return Coordinate(name, True, link.centre, axis, slide.displacement, slide.velocity, step.driver)
        moved, base = self._pair(step)
        of, against = self.motion.link(moved), self.motion.link(base)
        values = of.angle - against.angle if step.driver is None else self.motion.inputs[step.driver]
        rates = of.angular_velocity - against.angular_velocity
        sense = 1.0 if step.child == moved else -1.0
        return Coordinate(name, False, link.points[step.joint], (sense, 0.0), values, rates, step.driver)

    def _named(self, joint: str, child: str) -> str:
        """The joint's name, with that of the child where another coordinate has it."""
        name = joint if joint not in self._names else f"{joint}.{child}"
        self._names.add(name)
        return name

    def _pair(self, step: TreeJoint) -> tuple[str, str]:
        """Link that turns, and link against which the angle is measured."""
        if step.driver is not None:
            driver = self.mechanism.drivers[step.driver]
            return driver.link, driver.relative_to
        return step.connection.b, step.connection.a

    def _slide_axis(self, step: TreeJoint) -> Vec:
        joint = self.mechanism.guides[step.joint]
        if step.child == joint.block:
            return math.cos(joint.block_angle), math.sin(joint.block_angle)
        return -math.cos(joint.direction), -math.sin(joint.direction)


def rider(cut: Connection) -> str:
    """The name of the rider on a guide that is cut."""
    return f"{cut.joint}.rider"


def span(link: Link) -> float:
    """Largest distance between two points of a link, m."""
    places = np.array(list(link.points.values()))
    return float(np.hypot(*(places[:, None] - places[None]).T).max())


def exact_poses(motion: Motion) -> Poses:
    """Where all links are in a motion."""
    placed = placements(motion).items()
    return {name: Pose(_complex(each.origin), _complex(each.direction)) for name, each in placed}


def _complex(rows: Floats) -> Complexes:
    return rows[:, 0] + 1j * rows[:, 1]
