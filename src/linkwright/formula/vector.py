"""Vectors in the plane over numbers or traced values; also read as complex numbers."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from linkwright.formula.trace import Mask, Scalar, Value, angle, reciprocal, select


@dataclass(frozen=True, slots=True)
class Vec:
    """(x, y); as a complex number x + i y, whose product turns and stretches."""

    x: Scalar
    y: Scalar

    def __add__(self, other: Vec) -> Vec:
        return Vec(self.x + other.x, self.y + other.y)

    def __sub__(self, other: Vec) -> Vec:
        return Vec(self.x - other.x, self.y - other.y)

    def __neg__(self) -> Vec:
        return Vec(-self.x, -self.y)

    def __mul__(self, factor: Scalar) -> Vec:
        return Vec(self.x * factor, self.y * factor)

    __rmul__ = __mul__

    @property
    def perp(self) -> Vec:
        """Turned by a right angle, counter-clockwise."""
        return Vec(-self.y, self.x)

    def angle(self, half_turns: int = 0) -> Scalar:
        """Direction from the x axis, counter-clockwise, within half a turn of so many half turns, rad."""
        ahead = -self if half_turns % 2 else self
        return angle(ahead.y, ahead.x) + pi * half_turns

    @property
    def square(self) -> Scalar:
        """Length squared."""
        return self.x * self.x + self.y * self.y

    @property
    def conjugate(self) -> Vec:
        """Mirrored at the x axis."""
        return Vec(self.x, -self.y)

    def dot(self, other: Vec) -> Scalar:
        """Scalar product."""
        return self.x * other.x + self.y * other.y

    def cross(self, other: Vec) -> Scalar:
        """Component of the vector product along z."""
        return self.x * other.y - self.y * other.x

    def turn(self, other: Vec) -> Vec:
        """Product as complex numbers."""
        return Vec(self.x * other.x - self.y * other.y, self.x * other.y + self.y * other.x)

    def over(self, other: Vec) -> Vec:
        """Quotient as complex numbers; exactly (1, 0) for the same vector."""
        if self == other:
            return Vec(1.0, 0.0)
        if isinstance(other.y, float) and other.y == 0.0:
            return Vec(_quotient(self.x, other.x), _quotient(self.y, other.x))
        inverse = reciprocal(other.square)
        return Vec(self.dot(other) * inverse, other.cross(self) * inverse)


def _quotient(a: Scalar, b: Scalar) -> Scalar:
    return a / b if isinstance(b, Value) else a * reciprocal(b) if b == 0.0 else a / b


ZERO = Vec(0.0, 0.0)


def choose(condition: Mask, a: Vec, b: Vec) -> Vec:
    """``a`` where the condition holds, else ``b``."""
    return Vec(select(condition, a.x, b.x), select(condition, a.y, b.y))
