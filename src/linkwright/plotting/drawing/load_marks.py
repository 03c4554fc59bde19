"""What drawings show of loads that do not lie between points: arrows, turning arrows, pressures."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import singledispatch

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.force import Force
from linkwright.applied_loads.magnitude import Magnitude
from linkwright.applied_loads.pressure import Pressure
from linkwright.applied_loads.sizes import Constant, Ramp
from linkwright.applied_loads.torque import Torque
from linkwright.kinematics.motion import Motion


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
