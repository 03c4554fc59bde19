"""Equations of all joints over the coordinates of all links, with their derivatives.

Coordinates of a link are the place of its origin and its angle; all lengths are divided by the size of the mechanism,
so that rows and columns compare.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import row_names
from linkwright.formula.differentiation import slope
from linkwright.formula.linear_algebra import ZERO, Vec
from linkwright.formula.program import Program
from linkwright.formula.scalar_backend import ScalarProgram
from linkwright.formula.trace import Scalar, Trace, Value, cos, sin
from linkwright.joints.base import Joint
from linkwright.joints.ends import Ends
from linkwright.joints.pose import FRAME_POSE, Pose, Rotor
from linkwright.kinematics.dimensions import Dimensions
from linkwright.kinematics.equation import Rows
from linkwright.kinematics.names import canonical
from linkwright.mechanism.drawing import Drawing
from linkwright.mechanism.mechanism import Mechanism

#: Of (x, y, θ).
Part = tuple[float, float, float]


@dataclass(frozen=True)
class Row:
    """One scalar equation: its joint, what it holds (``place``, ``rotation``, ``rolling`` or ``driver``), value, and
    its derivatives by (x, y, θ) of the moving links."""

    joint: str
    holds: str
    value: float
    parts: Mapping[str, Part]


class ConstraintEquations:
    """Equations of the joints of a mechanism over (x, y, θ) of every link, by their residuals.

    A pin of several links holds each of them to the first one, in ``order`` or that of the file. The row of
    a higher pair keeps the value that it has where it is first evaluated.
    """

    def __init__(self, mechanism: Mechanism, order: Mapping[str, int] | None = None) -> None:
        self.mechanism = mechanism
        self.links = list(mechanism.links)
        self.size = mechanism.size
        self._number = order or {}
        self._first = {name: 3 * i for i, name in enumerate(self.links)}
        self._first_values: dict[int, float] = {}

    @property
    def freedoms(self) -> int:
        """Three of every link."""
        return 3 * len(self.links)

    # evaluation ---------------------------------------------------------------------------------
    def rows(self, x: Floats) -> list[Row]:
        """All equations of the joints at some coordinates."""
        return self._evaluated(x)[: self._joints]

    def driver_row(self, name: str, x: Floats) -> Row:
        """A driver's coordinate (rad, or m over the size) with its derivatives."""
        return self._evaluated(x)[self._joints + list(self.mechanism.drivers).index(name)]

    def residual(self, x: Floats) -> Floats:
        """Values of the equations; lengths over the size."""
        return np.array([row.value for row in self.rows(x)])

    def jacobian(self, x: Floats) -> Floats:
        """Derivatives of the equations, (equations, freedoms)."""
        return self.matrix(self.rows(x))

    def matrix(self, rows: Sequence[Row]) -> Floats:
        """The derivatives of some equations as a matrix."""
        entries = np.zeros((len(rows), self.freedoms))
        for entry, row in zip(entries, rows, strict=True):
            for link, part in row.parts.items():
                entry[self._first[link] : self._first[link] + 3] += part
        return entries

    def second(self, x: Floats, v: Floats) -> Floats:
        """∂(J v)/∂x of the equations of all joints and drivers, (equations, freedoms)."""
        entries, numbers = np.zeros((len(self._traced), self.freedoms)), iter(self._bent([*x, *v]))
        for entry, row in zip(entries, self._traced, strict=True):
            for link in row.links:
                entry[self._first[link] : self._first[link] + 3] = [next(numbers) for _ in range(3)]
        return entries

    def _evaluated(self, x: Floats) -> list[Row]:
        numbers, found = iter(self._values(list(x))), list[Row]()
        for index, row in enumerate(self._traced):
            value = next(numbers)
            if row.holds == "rolling":
                value -= self._first_values.setdefault(index, value)
            parts = {link: (next(numbers), next(numbers), next(numbers)) for link in row.links}
            found.append(Row(row.joint, row.holds, value, parts))
        return found

    @cached_property
    def _values(self) -> Callable[[Sequence[float]], list[float]]:
        """Value and derivatives of every row, one after the other, from the coordinates."""
        return self._program([each for row in self._traced for each in row.numbers])

    @cached_property
    def _bent(self) -> Callable[[Sequence[float]], list[float]]:
        """Derivatives of J v by the coordinates of every row's links, from the coordinates and v."""
        trace = self._dimensions.trace
        v = [trace.position(f"v{k}") for k in range(self.freedoms)]
        outputs: list[Scalar] = []
        for row in self._traced:
            total: Scalar = 0.0
            columns = [self._first[link] + k for link in row.links for k in range(3)]
            for column, part in zip(columns, row.numbers[1:], strict=True):
                total = total + part * v[column]
            outputs += [slope(total, {self._x[column]: 1.0}) for column in columns]
        return self._program(outputs)

    def _program(self, outputs: Sequence[Scalar]) -> Callable[[Sequence[float]], list[float]]:
        named = {f"{k}": each for k, each in enumerate(outputs)}
        program = Program.of(self._dimensions.trace, named)
        dimensions = self.mechanism.dimensions()
        run = ScalarProgram(program).of_design([dimensions[name] for name in program.parameters])
        places = [int(name[1:]) + (self.freedoms if name[0] == "v" else 0) for name in program.positions]
        return lambda numbers: run([float(numbers[place]) for place in places])

    # tracing ------------------------------------------------------------------------------------
    @cached_property
    def _dimensions(self) -> Dimensions:
        return Dimensions(self.mechanism, Trace())

    @cached_property
    def _x(self) -> list[Value]:
        return [self._dimensions.trace.position(f"x{k}") for k in range(self.freedoms)]

    @cached_property
    def _poses(self) -> dict[str, Pose]:
        poses = {"frame": FRAME_POSE}
        for name, i in self._first.items():
            x, y, angle = self._x[i : i + 3]
            place, now = Vec(x * self.size, y * self.size), Vec(cos(angle), sin(angle))
            poses[name] = Pose(ZERO, place, Rotor(now, Vec(1.0, 0.0)))
        return poses

    def _angle(self, link: str) -> Scalar:
        return 0.0 if link == "frame" else self._x[self._first[link] + 2]

    @property
    def _joints(self) -> int:
        return len(self._traced) - len(self.mechanism.drivers)

    @cached_property
    def _traced(self) -> list[_Traced]:
        """The equations of the joints, and behind them the coordinates of the drivers."""
        found = list[_Traced]()
        for joint in self.mechanism.joints.values():
            first, *others = sorted(joint.joined, key=lambda link: self._number.get(link, 0))
            if joint.higher:
                first, others = joint.joined[0], [joint.joined[1]]
            elif joint.ties:
                a, b = joint.ties
                turn = joint.turn_of(b, self.mechanism)
                found.append(self._turned(joint.name, "rotation", a, b, sin(self._between(a, b) - turn)))
                first, others = a, [b]
            for other in others:
                ends = Ends(self._dimensions, first, other)
                found += self._rows(joint, "rolling" if joint.higher else "place", ends, joint.residual(ends))
        return [*found, *map(self._driven, self.mechanism.drivers)]

    def _driven(self, name: str) -> _Traced:
        driver = self.mechanism.drivers[name]
        guide = self.mechanism.guides.get(driver.joint)
        if guide is None:
            joint = self.mechanism.joints[driver.joint]
            a, b = driver.relative_to, driver.link
            return self._turned(joint.name, "driver", a, b, self._between(a, b))
        ends = Ends(self._dimensions, guide.guide, guide.block)
        return self._rows(guide, "driver", ends, [guide.displacement(ends)])[0]

    def _between(self, a: str, b: str) -> Scalar:
        """The angle of b to a."""
        return self._angle(b) - self._angle(a)

    def _turned(self, joint: str, holds: str, a: str, b: str, value: Scalar) -> _Traced:
        """A row in the angle of b to a."""
        links = tuple(each for each in (a, b) if each != "frame")
        slopes = [slope(value, {self._x[self._first[each] + 2]: 1.0}) for each in links]
        return _Traced(joint, holds, links, [value, *(part for s in slopes for part in (0.0, 0.0, s))])

    def _rows(self, joint: Joint, holds: str, ends: Ends, residual: Sequence[Scalar]) -> list[_Traced]:
        rows, scale = Rows(ends, residual, self._angle), 1.0 / self.size
        links = tuple(link for link in rows.ends if link != "frame")
        parts = rows.parts(self._poses)
        found = []
        for k, value in enumerate(rows.residual(self._poses)):
            numbers = [value * scale]
            for link in links:
                x, y, turn = parts[link][k]
                numbers += [x, y, turn * scale]
            found.append(_Traced(joint.name, holds, links, numbers))
        return found


@dataclass(frozen=True)
class _Traced:
    """A row in the trace: ``numbers`` its value, and its derivatives by (x, y, θ) of the links."""

    joint: str
    holds: str
    links: tuple[str, ...]
    numbers: list[Scalar]


def first_points(mechanism: Mechanism) -> dict[str, str]:
    """The first point of every link."""
    return {name: canonical(mechanism, name, next(iter(link.points))) for name, link in mechanism.links.items()}


def pose_outputs(mechanism: Mechanism) -> tuple[str, ...]:
    """Names of the outputs that tell where every link is."""
    wanted = [
        row_names(*each)
        for name, key in first_points(mechanism).items()
        for each in (("direction", name), ("position", key))
    ]
    return tuple(dict.fromkeys(name for pair in wanted for name in pair))


def drawn_coordinates(mechanism: Mechanism) -> Floats | None:
    drawing = Drawing(mechanism)
    if not drawing:
        return None
    size, found = mechanism.size, []
    for name, link in mechanism.links.items():
        angle = drawing.angle(name)
        places = ((p, drawing.points.get(f"{name}.{p}", drawing.points.get(p))) for p in link.points)
        known = next(((link.points[p], place) for p, place in places if place is not None), None)
        if angle is None or known is None:
            return None
        (px, py), (x, y) = known
        c, s = math.cos(angle), math.sin(angle)
        found += [(x - c * px + s * py) / size, (y - s * px - c * py) / size, angle]
    return np.array(found)
