"""What goes into a dyad and comes out: points, lines and slides with their rates, plain numbers or arrays of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.errors import RequestError
from linkwright.formula.linear_algebra import Vec
from linkwright.joints import pose
from linkwright.joints.pose import Pose, Rotor
from linkwright.words import _

#: Longest value that a sentence repeats.
_LONGEST = 60


@dataclass(frozen=True, eq=False)
class State:
    """A point: ``position`` (m), ``velocity`` (m/s), ``acceleration`` (m/s²) in frame axes, each (…, 2)."""

    position: ArrayLike
    velocity: ArrayLike = (0.0, 0.0)
    acceleration: ArrayLike = (0.0, 0.0)


@dataclass(frozen=True, eq=False)
class Slide:
    """Displacement of a block along its guide (m) and its two rates (m/s, m/s²)."""

    displacement: ArrayLike
    velocity: ArrayLike = 0.0
    acceleration: ArrayLike = 0.0


@dataclass(frozen=True, eq=False)
class Line:
    """A line fixed in a link: the axis of a bar, or a guide.

    ``origin``: a point of the link on the line, a :class:`State`, or (x, y) where it is at rest; ``angle``: direction
    of the line from the frame's x axis, counter-clockwise, rad; its rates in rad/s and rad/s². The coordinates of
    further points run along the line and to its left.
    """

    origin: Any
    angle: ArrayLike = 0.0
    angular_velocity: ArrayLike = 0.0
    angular_acceleration: ArrayLike = 0.0

    def point(self, along: ArrayLike, left: ArrayLike = 0.0) -> State:
        """The point of the link at these coordinates, m."""
        moving = self._moving()
        arm = moving.pose.rotor.now.turn(_vector(numbers("along", along), numbers("left", left)))
        found = (moving.pose.place + arm, moving.velocity_at(arm), moving.acceleration_at(arm))
        return State(*map(_stacked, found))

    def polar(self, radius: ArrayLike, angle: ArrayLike = 0.0) -> State:
        """The point of the link at a radius (m) from the origin, in a direction from the line (rad)."""
        r, turn = numbers("radius", radius), numbers("angle", angle)
        return self.point(r * np.cos(turn), r * np.sin(turn))

    def line(self, along: ArrayLike, left: ArrayLike = 0.0, angle: ArrayLike = 0.0) -> Line:
        """Another line of the same link, through the point at these coordinates, at an angle (rad) to this one."""
        turned = numbers("angle", self.angle) + numbers("angle", angle)
        return Line(self.point(along, left), turned, self.angular_velocity, self.angular_acceleration)

    def inputs(self) -> dict[str, Floats]:
        """Cosine and sine of its direction, and its rates, by the names of programs' inputs."""
        angle = numbers("angle", self.angle)
        return {
            "cos": np.cos(angle),
            "sin": np.sin(angle),
            "omega": numbers("angular_velocity", self.angular_velocity),
            "alpha": numbers("angular_acceleration", self.angular_acceleration),
        }

    def _moving(self) -> pose.State:
        """The link as the formulas of the package take it, over arrays."""
        place, velocity, acceleration = (_components(each) for each in state("origin", self.origin))
        inputs: dict[str, Any] = dict(self.inputs())
        rotor = Rotor(_vector(inputs["cos"], inputs["sin"]), Vec(1.0, 0.0))
        at = Pose(Vec(0.0, 0.0), place, rotor)
        return pose.State(at, velocity, inputs["omega"], acceleration, inputs["alpha"])


def _vector(x: Any, y: Any) -> Vec:
    return Vec(x, y)


def _components(found: Floats) -> Vec:
    return _vector(found[..., 0], found[..., 1])


def _stacked(vector: Vec) -> Floats:
    x, y = np.broadcast_arrays(np.asarray(vector.x), np.asarray(vector.y))
    return np.stack([x, y], axis=-1)


def numbers(name: str, value: Any) -> Floats:
    """Numbers as an array of any shape; raises RequestError where they are none."""
    try:
        return np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise RequestError(
            _(
                "{name}: expected a number or an array of numbers, got {value}",
                code="dyads.no_numbers",
                name=name,
                value=_shown(value),
            )
        ) from None


def pairs(name: str, value: Any) -> Floats:
    """Pairs of numbers, (…, 2); raises RequestError where they are none."""
    found = numbers(name, value)
    if found.ndim == 0 or found.shape[-1] != 2:
        raise RequestError(
            _(
                "{name}: expected pairs (x, y), an array whose last axis is 2 long, got {value}",
                code="dyads.no_pairs",
                name=name,
                value=_shown(value),
            )
        )
    return found


def state(name: str, value: Any) -> tuple[Floats, Floats, Floats]:
    """Position, velocity and acceleration of a point: of a :class:`State` or what has the same attributes (a point of
    a solved motion), or of (x, y) at rest."""
    if not hasattr(value, "position"):
        return pairs(name, value), np.zeros(2), np.zeros(2)
    parts = ("position", "velocity", "acceleration")
    position, velocity, acceleration = (pairs(f"{name}.{part}", getattr(value, part)) for part in parts)
    return position, velocity, acceleration


def point_inputs(name: str, value: Any) -> dict[str, Floats]:
    """A point's coordinates with their rates, by the names of programs' inputs."""
    parts = zip(("", "v", "a"), state(name, value), strict=True)
    return {f"{rate}{c}": found[..., i] for rate, found in parts for i, c in enumerate("xy")}


def line_inputs(name: str, value: Any) -> dict[str, Floats]:
    """The same of a line, with its direction; raises RequestError for what is none."""
    if not isinstance(value, Line):
        raise RequestError(
            _(
                "{name}: expected a lw.dyads.Line (origin, angle and their rates), got {value}",
                code="dyads.no_line",
                name=name,
                value=_shown(value),
            )
        )
    return point_inputs(f"{name}.origin", value.origin) | value.inputs()


def _shown(value: Any) -> str:
    text = " ".join(repr(value).split())
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"
