"""The parts of a mechanism's drawing: bodies, joints, supports, loads at points; the view in which they are drawn."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import singledispatch
from typing import Literal

import numpy as np

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.force import Force
from linkwright.applied_loads.magnitude import Magnitude
from linkwright.applied_loads.pressure import Pressure
from linkwright.applied_loads.sizes import Constant, Ramp
from linkwright.applied_loads.torque import Torque
from linkwright.core.arrays import Floats
from linkwright.errors import LinkwrightError
from linkwright.joints.lower_pair import SlidingJoint, TurningJoint
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.placement import Placement
from linkwright.mechanism.link import Link
from linkwright.pictures.picture import Line, Outline, Vec
from linkwright.pictures.symbols.base import PIN, SYMBOLS, Shape, points
from linkwright.words import _

DIAGONAL = 620.0
SHORTEST_BAR = 26.0


@dataclass(frozen=True)
class View:
    """Units of the paper per metre; the frame's origin is the paper's."""

    scale: float

    def paper(self, world: Floats) -> Floats:
        """Points (..., 2) in frame axes as points of the paper."""
        scaled: Floats = np.asarray(world) * (self.scale, -self.scale)
        return scaled

    def local(self, point: Vec) -> Vec:
        """A point in link axes as a point of the link's piece of paper."""
        return point[0] * self.scale, -point[1] * self.scale

    def transform(self, placement: Placement, index: int) -> tuple[float, float, float]:
        """Shift x, y and turn (degrees, clockwise) of a link's piece of paper at one position."""
        x, y = self.paper(placement.origin[index])
        c, s = placement.direction[index]
        return float(x), float(y), float(-np.degrees(np.arctan2(s, c)))


def moved(points: Floats, transform: tuple[float, float, float]) -> Floats:
    """Points of a link's piece of paper on the paper."""
    x, y, turn = transform
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    return np.stack([x + c * points[:, 0] - s * points[:, 1], y + s * points[:, 0] + c * points[:, 1]], axis=1)


def fitted(motion: Motion, placed: Mapping[str, Placement], diagonal: float = DIAGONAL) -> View:
    """A view in which all that the machine reaches has this diagonal, larger where bars are short."""
    mechanism = motion.mechanism
    cloud = [placed[link.name].world(p) for link in mechanism.links.values() for p in link.points.values()]
    pins = [np.array([p]) for name, p in mechanism.frame.points.items() if name in mechanism.joints]
    everything = np.concatenate([*cloud, *pins])
    everything = everything[np.isfinite(everything).all(axis=1)]
    if not len(everything):
        raise LinkwrightError(
            _(
                'no position of "{name}" was reached, so there is nothing to draw',
                code="picture.no_position_reached",
                name=mechanism.name,
            )
        )
    low, high = everything.min(axis=0), everything.max(axis=0)
    reach = float(np.hypot(*(high - low))) or 1.0
    scale = diagonal / reach
    shortest = min((length for link in mechanism.links.values() for length in _bars(link.points)), default=reach)
    scale *= float(np.clip(SHORTEST_BAR / (shortest * scale), 1.0, 1.6))
    return View(scale)


def extent_of(motion: Motion) -> float:
    """The longer side of all that a machine reaches, m; 1 of one that is a point."""
    clouds = [np.array(list(motion.mechanism.frame.points.values())).reshape(-1, 2)]
    clouds += [motion.point_of(key).position for key in motion.point_names()]
    every = np.concatenate(clouds)
    every = every[np.isfinite(every).all(axis=1)]
    return float(np.ptp(every, axis=0).max(initial=0.0)) or 1.0 if len(every) else 1.0


def _bars(points: Mapping[str, Vec]) -> list[float]:
    rows = list(points.values())
    lengths = [float(np.hypot(a[0] - b[0], a[1] - b[1])) for i, a in enumerate(rows) for b in rows[:i]]
    return [length for length in lengths if length > 0]


Layer = Literal["ground", "bodies", "blocks", "pins", "tops", "marks"]
LAYERS: tuple[Layer, ...] = ("ground", "bodies", "blocks", "pins", "tops", "marks")


@dataclass(frozen=True)
class Part:
    """A shape in the units of the paper in the axes of the link ``carrier``, on one of the layers."""

    layer: Layer
    carrier: str
    shape: Shape


def coloured(part: Part, colour: str) -> Part:
    """A part whose bars and plates have a colour; its symbols keep theirs."""
    if part.layer not in ("bodies", "tops"):
        return part
    elements = (
        replace(each, colour=colour)
        if isinstance(each, Line | Outline) and each.style in ("lw-bar", "lw-plate")
        else each
        for each in part.shape.elements
    )
    return replace(part, shape=replace(part.shape, elements=tuple(elements)))


@dataclass(frozen=True)
class DrawnMechanism:
    """A motion with the placements of its links and the view it is drawn in.

    ``others``: motions and positions in them that follow those of the motion in the placements.
    """

    motion: Motion
    placed: dict[str, Placement]
    view: View
    others: Sequence[tuple[Motion, int]] = ()

    def mark(self, load: Load, index: int) -> Mark | None:
        """What a load draws of itself at a position."""
        last = self.motion.steps
        return mark_of(load, *(self.others[index - last] if index >= last else (self.motion, index)))

    @property
    def pins(self) -> Mapping[str, TurningJoint]:
        """Its pins by name."""
        return self.motion.mechanism.pins

    @property
    def guides(self) -> Mapping[str, SlidingJoint]:
        """Its guides by name."""
        return self.motion.mechanism.guides

    def local(self, link: str, point: str) -> Vec:
        """A point on its link's piece of paper."""
        return self.view.local(self.motion.mechanism.link(link).points[point])

    def paper(self, link: str, point: str, index: int) -> Vec:
        """A point on the paper at one position."""
        x, y = self.view.paper(self.placed[link].world(self.motion.mechanism.link(link).points[point])[index])
        return float(x), float(y)

    def directions(self, link: str, point: str) -> list[Vec]:
        """Unit vectors, in the paper of the link, from one of its points to the others."""
        here = self.local(link, point)
        ways = ((x - here[0], y - here[1]) for x, y in self.cloud(link))
        return [(x / d, y / d) for x, y in ways if (d := math.hypot(x, y)) > 1.0]

    def cloud(self, link: str) -> Floats:
        """All points of a link on its piece of paper, (k, 2)."""
        return points([self.view.local(p) for p in self.motion.mechanism.link(link).points.values()])


def flat(cloud: Floats) -> Floats | None:
    """The two end points of points in a line, or None where they span an area."""
    if len(cloud) < 2:
        return cloud
    spread = cloud - cloud.mean(axis=0)
    _unused, _unused2, axes = np.linalg.svd(spread)
    along, across = spread @ axes[0], spread @ axes[1]
    if np.ptp(across) > 2.0:
        return None
    return cloud[[int(along.argmin()), int(along.argmax())]]


def bodies(machine: DrawnMechanism) -> Iterator[Part]:
    """Bars and plates of the moving links, and dots at their plain points."""
    for link in machine.motion.mechanism.links.values():
        cloud = machine.cloud(link.name)
        ends = flat(cloud)
        if ends is None:
            yield Part("bodies", link.name, SYMBOLS["plate"](corners=cloud))
        elif len(ends) == 2 and np.hypot(*(ends[1] - ends[0])) > 1.0:
            yield Part("bodies", link.name, SYMBOLS["bar"](through=ends))
        for name in plain_points(machine, link):
            yield Part("pins", link.name, SYMBOLS["point"](at=machine.local(link.name, name)))


def plain_points(machine: DrawnMechanism, link: Link) -> list[str]:
    """Points of a link that are no joints and hold nothing."""
    guided = {j.at for j in machine.guides.values() if j.block == link.name}
    through = {j.through for j in machine.guides.values() if j.guide == link.name}
    joints = machine.motion.mechanism.joints
    welded = {j.at for j in machine.motion.mechanism.welds.values() if link.name in j.links}
    return [
        p
        for p in link.points
        if p not in guided | through | welded and not (p in joints and link.name in joints[p].joined)
    ]


def pins(machine: DrawnMechanism) -> Iterator[Part]:
    """Pins; those of the frame on their supports; bars that go on through a pin are drawn over it."""
    for name, joint in machine.pins.items():
        carrier = "frame" if "frame" in joint.links else joint.links[0]
        at = machine.local(carrier, name)
        if carrier == "frame":
            toward = support_direction(machine, name, joint)
            yield Part("ground", "frame", SYMBOLS["fixed_pivot"](at=at, toward=toward))
        yield Part("pins", carrier, SYMBOLS["pin"](at=at))
        for link in joint.links:
            through = None if link == "frame" else _passing(machine, link, name)
            if through is not None:
                yield Part("tops", link, SYMBOLS["bar"](through=through))


def _passing(machine: DrawnMechanism, link: str, point: str) -> Floats | None:
    """A short piece of a straight bar about a pin inside it."""
    ends = flat(machine.cloud(link))
    if ends is None or len(ends) < 2:
        return None
    here = points([machine.local(link, point)])[0]
    if min(np.hypot(*(end - here)) for end in ends) < 2.0:
        return None
    along = (ends[1] - ends[0]) / np.hypot(*(ends[1] - ends[0]))
    return points([here - 1.3 * PIN * along, here + 1.3 * PIN * along])


def support_direction(machine: DrawnMechanism, point: str, joint: TurningJoint) -> Vec:
    """Direction of the ground under a fixed pivot: down, unless links reach there for most of the motion."""
    choices: list[tuple[Vec, float]] = [((0.0, 1.0), 0.0), ((0.0, -1.0), 0.25), ((-1.0, 0.0), 0.3), ((1.0, 0.0), 0.3)]
    reach = [_reaching(machine, link, point) for link in joint.links if link != "frame"]
    ways = np.concatenate([*reach, np.zeros((0, 2))])

    def cost(choice: tuple[Vec, float]) -> float:
        toward, dislike = choice
        return dislike + (float(np.mean(ways @ toward > 0.72)) if len(ways) else 0.0)

    return min(choices, key=cost)[0]


def _reaching(machine: DrawnMechanism, link: str, point: str) -> Floats:
    """Directions (m, 2) on the paper in which a link reaches from a pin over all positions."""
    local = points(machine.directions(link, point))
    direction = machine.placed[link].direction
    direction = direction[np.isfinite(direction).all(axis=1)]
    c, s = direction[:, :1], -direction[:, 1:]
    x, y = local[:, 0], local[:, 1]
    return np.stack([(c * x - s * y).ravel(), (s * x + c * y).ravel()], axis=1)


@dataclass(frozen=True)
class Push:
    """An arrow whose point is the point ``at`` of a link; ``angle`` of the force in frame axes, rad."""

    link: str
    at: str
    angle: float


@dataclass(frozen=True)
class Turn:
    """A turning arrow on a link: ``sense`` 1 counter-clockwise, -1 clockwise, 0 where that is not known."""

    link: str
    sense: int


@dataclass(frozen=True)
class Press:
    """Arrows on the face of a guide's block, along the guide for ``sense`` 1 and against it for -1."""

    joint: str
    sense: int


Mark = Push | Turn | Press


@singledispatch
def mark_of(load: Load, motion: Motion, index: int) -> Mark | None:
    """What drawings show at a position; None: the symbol of the kind between or at the points it names."""
    return None


@mark_of.register
def _force(load: Force, motion: Motion, index: int) -> Mark:
    angle = _direction(load, motion, index)
    return Push(load.on, load.at, angle if _sign(load.magnitude) >= 0 else angle + math.pi)


@mark_of.register
def _torque(load: Torque, motion: Motion, index: int) -> Mark:
    sense = _sign(load.magnitude)
    if load.opposes is not None:
        omega = motion.turning(load.on, load.against)[index]
        sense *= int(omega < 0.0) - int(omega > 0.0)
    return Turn(load.on, sense)


@mark_of.register
def _pressure(load: Pressure, motion: Motion, index: int) -> Mark:
    return Press(load.joint, (_sign(load.magnitude) or 1) * (-1 if load.pushes == "backward" else 1))


def _sign(magnitude: Magnitude) -> int:
    """1 or -1 for a magnitude that is a number, 0 for one that is not known beforehand."""
    match magnitude.size:
        case Constant(value):
            return -1 if value < 0 else 1
        case Ramp(start, end):
            return -1 if start + end < 0 else 1
    return 0


def _direction(load: Force, motion: Motion, index: int) -> float:
    """Direction of a force at a position in frame axes, rad."""
    if load.direction is not None:
        return load.direction
    if load.opposes is not None:
        return _against_velocity(load, motion, index)
    if load.components is not None:
        return math.atan2(load.components[1], load.components[0])
    turn = math.atan2(*motion.link(load.on).direction[index][::-1])
    ray = load.normal_to or load.along
    if ray is None:
        return turn + (load.in_link or 0.0)
    (px, py), (qx, qy) = (motion.mechanism.link(load.on).points[name] for name in ray)
    return turn + math.atan2(qy - py, qx - px) + (math.pi / 2 if load.normal_to else 0.0)


def _against_velocity(load: Force, motion: Motion, index: int) -> float:
    """Against the velocity of the point; at rest against the motion that begins there."""
    point = motion.point(f"{load.on}.{load.at}")
    (vx, vy), seconds = point.velocity[index], point.acceleration[index]
    if not motion.moving(math.hypot(vx, vy), math.hypot(*seconds), "length"):
        vx, vy = seconds
    return math.atan2(-vy, -vx)
