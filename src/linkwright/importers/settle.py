"""Places of points that hold given distances, lines and places, nearest to where a file has them.

Programs that move points until their lengths fit store coordinates that are off by what was left; the lengths count.
Each step is the smallest change of all coordinates that mends what is wrong to first order (Gauss-Newton with the
minimum norm; Nocedal, Wright: Numerical Optimization, 2nd edition, section 10.3).
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from linkwright.mechanism.link import Vec

if TYPE_CHECKING:
    import numpy as np

#: Steps from the drawing to where the machine begins; iterations of one step.
LED, ITERATIONS = 40, 60
#: How far a point may go in an iteration, as a share of the size.
FARTHEST = 0.25
#: What is left of a residual, as a share of the size, that is rounding.
CLOSED = 1e-13

Row = tuple[float, dict[str, Vec]]


class Constraint(Protocol):
    """What must hold of some points: rows of what is wrong (m) and its slopes along the points' coordinates."""

    def rows(self, at: Mapping[str, Vec], share: float) -> Iterator[Row]:
        """``share``: how far the constraint has gone from what the drawing has, 0, to what it shall be, 1."""


@dataclass
class Distance:
    """The distance of two points, m; ``drawn``: from which it is led there."""

    a: str
    b: str
    length: float
    drawn: float | None = None

    def rows(self, at: Mapping[str, Vec], share: float) -> Iterator[Row]:
        """One row."""
        dx, dy = at[self.b][0] - at[self.a][0], at[self.b][1] - at[self.a][1]
        wanted = self.length if self.drawn is None else self.drawn + share * (self.length - self.drawn)
        now = math.hypot(dx, dy) or 1e-300
        yield now - wanted, {self.a: (-dx / now, -dy / now), self.b: (dx / now, dy / now)}


@dataclass
class Turned:
    """A point at a distance and an angle (rad) from a fixed one; ``drawn``: the angle from which it is led there."""

    pivot: str
    point: str
    length: float
    angle: float
    drawn: float

    def rows(self, at: Mapping[str, Vec], share: float) -> Iterator[Row]:
        """A row along each axis."""
        angle = self.drawn + share * math.remainder(self.angle - self.drawn, 2 * math.pi)
        (x, y), (x0, y0) = at[self.point], at[self.pivot]
        yield x - x0 - self.length * math.cos(angle), {self.point: (1.0, 0.0)}
        yield y - y0 - self.length * math.sin(angle), {self.point: (0.0, 1.0)}


@dataclass
class Apart:
    """The difference of two points' x (axis 0) or y (axis 1), m."""

    a: str
    b: str
    axis: int
    value: float

    def rows(self, at: Mapping[str, Vec], share: float) -> Iterator[Row]:
        """One row."""
        along = (1.0, 0.0) if self.axis == 0 else (0.0, 1.0)
        back = (-along[0], -along[1])
        yield at[self.b][self.axis] - at[self.a][self.axis] - self.value, {self.a: back, self.b: along}


@dataclass
class OnLine:
    """A point on a line through a fixed place, in a direction (rad)."""

    point: str
    through: Vec
    angle: float

    def rows(self, at: Mapping[str, Vec], share: float) -> Iterator[Row]:
        """One row."""
        x, y = at[self.point]
        normal = (-math.sin(self.angle), math.cos(self.angle))
        yield normal[0] * (x - self.through[0]) + normal[1] * (y - self.through[1]), {self.point: normal}


@dataclass
class OnBar:
    """A point on a line that moves with two others: through a, moved by ``offset`` to the left of a → b, turned by an
    angle (rad) against a → b."""

    point: str
    a: str
    b: str
    angle: float
    offset: float

    def rows(self, at: Mapping[str, Vec], share: float) -> Iterator[Row]:
        """One row."""
        (x, y), (xa, ya), (xb, yb) = at[self.point], at[self.a], at[self.b]
        length = math.hypot(xb - xa, yb - ya) or 1e-300
        bar = math.atan2(yb - ya, xb - xa)
        line = bar + self.angle
        normal, along = (-math.sin(line), math.cos(line)), (math.cos(line), math.sin(line))
        wrong = normal[0] * (x - xa) + normal[1] * (y - ya) - self.offset * math.cos(self.angle)
        by_angle = -(along[0] * (x - xa) + along[1] * (y - ya)) / length
        turn = (-math.sin(bar) * by_angle, math.cos(bar) * by_angle)
        slopes = {self.b: turn, self.point: normal}
        slopes[self.a] = (-normal[0] - turn[0], -normal[1] - turn[1])
        yield wrong, slopes


def settle(
    places: Mapping[str, Vec], fixed: Collection[str], constraints: Collection[Constraint]
) -> tuple[dict[str, Vec], float]:
    """Places that hold the constraints, nearest to the given ones, and what is left wrong, m.

    Where a constraint is led from what the drawing has to another value, the points follow step by step, in the
    assembly mode in which they are drawn. Places that hold already are returned as they are.
    """
    import numpy as np

    size = max((math.hypot(*each) for each in places.values()), default=0.0) or 1.0
    movable = [name for name in places if name not in fixed]
    at = dict(places)
    led = any(abs(_gap(each, at)) > CLOSED * size for each in constraints)
    for step in range(1, LED + 1) if led else (1,):
        share = step / LED if led else 1.0
        for _iteration in range(ITERATIONS):
            wrong, slopes = _system(at, share, constraints, movable)
            if not wrong.size or np.abs(wrong).max() <= CLOSED * size:
                break
            change = np.linalg.lstsq(slopes, -wrong, rcond=1e-10)[0]
            change *= min(1.0, FARTHEST * size / (float(np.abs(change).max()) or 1.0))
            at |= {
                name: (at[name][0] + float(change[2 * k]), at[name][1] + float(change[2 * k + 1]))
                for k, name in enumerate(movable)
            }
            if np.abs(change).max() <= 1e-15 * size:
                break
        else:
            break  # no place holds them all
    wrong, _slopes = _system(at, 1.0, constraints, movable)
    return at, float(np.abs(wrong).max(initial=0.0))


def _gap(constraint: Constraint, at: Mapping[str, Vec]) -> float:
    """How far a constraint is led."""
    if isinstance(constraint, Turned):
        return math.remainder(constraint.angle - constraint.drawn, 2 * math.pi) * constraint.length
    if isinstance(constraint, Distance) and constraint.drawn is not None:
        return constraint.length - constraint.drawn
    return 0.0


def _system(
    at: Mapping[str, Vec], share: float, constraints: Collection[Constraint], movable: list[str]
) -> tuple[np.ndarray, np.ndarray]:
    """What is wrong, and its slopes along the coordinates of the movable points."""
    import numpy as np

    rows = [row for each in constraints for row in each.rows(at, share)]
    columns = {name: 2 * k for k, name in enumerate(movable)}
    slopes = np.zeros((len(rows), 2 * len(movable)))
    for number, (_wrong, gradient) in enumerate(rows):
        for name, (x, y) in gradient.items():
            if name in columns:
                slopes[number, columns[name] : columns[name] + 2] += x, y
    return np.array([wrong for wrong, _gradient in rows]), slopes


def meeting(one: Vec, radius: float, other: Vec, other_radius: float, left: bool) -> Vec | None:
    """Where two circles meet, to the left of the line from the first centre to the other or to its right."""
    dx, dy = other[0] - one[0], other[1] - one[1]
    apart = math.hypot(dx, dy)
    if not abs(radius - other_radius) <= apart <= radius + other_radius or apart == 0:
        return None
    along = (radius**2 - other_radius**2 + apart**2) / (2 * apart)
    height = math.sqrt(max(0.0, radius**2 - along**2)) * (1 if left else -1)
    return one[0] + (along * dx - height * dy) / apart, one[1] + (along * dy + height * dx) / apart
