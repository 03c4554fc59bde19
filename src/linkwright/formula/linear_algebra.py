"""Linear algebra over numbers or traced values: vectors in the plane, read as complex numbers, and small systems."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi

from linkwright.formula.trace import Mask, Scalar, Value, absolute, angle, reciprocal, select


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


Matrix = list[list[Scalar]]


def inverse(matrix: Sequence[Sequence[Scalar]], inverse_determinant: Scalar | None = None) -> Matrix:
    """Inverse of a k×k matrix; for k = 2 the reciprocal of the determinant may be known already.

    k ≤ 2 by Cramer's rule, else by Gauss–Jordan elimination with partial pivoting (Golub & Van Loan,
    Matrix Computations, ch. 3). A singular matrix gives infinities or NaN.
    """
    size = len(matrix)
    if size == 0:
        return []
    if size == 1:
        return [[reciprocal(matrix[0][0])]]
    if size == 2:
        (a, b), (c, d) = matrix
        factor = inverse_determinant if inverse_determinant is not None else reciprocal(a * d - b * c)
        return [[d * factor, -(b * factor)], [-(c * factor), a * factor]]
    return _gauss_jordan(matrix)


def _gauss_jordan(matrix: Sequence[Sequence[Scalar]]) -> Matrix:
    size = len(matrix)
    rows: Matrix = [[*row, *(1.0 if i == j else 0.0 for j in range(size))] for i, row in enumerate(matrix)]
    for column in range(size):
        _bring_largest_up(rows, column)
        factor = reciprocal(rows[column][column])
        rows[column] = [entry * factor for entry in rows[column]]
        for i in range(size):
            if i != column and not _is_zero(rows[i][column]):
                lead = rows[i][column]
                rows[i] = [x - lead * y for x, y in zip(rows[i], rows[column], strict=True)]
    return [row[size:] for row in rows]


def solution(matrix: Sequence[Sequence[Scalar]], vector: Sequence[Scalar]) -> list[Scalar]:
    """x with matrix · x = vector, by elimination without exchanges.

    For matrices 1 - J where the absolute values of J have a spectral radius below 1, whose pivots stay above zero
    (they are H-matrices: Golub & Van Loan, Matrix Computations, ch. 3.4).
    """
    rows: Matrix = [[*row, right] for row, right in zip(matrix, vector, strict=True)]
    for column in range(len(rows)):
        factor = reciprocal(rows[column][0])
        pivot = [entry * factor for entry in rows[column][1:]]
        rows = [
            pivot if i == column else [x - row[0] * y for x, y in zip(row[1:], pivot, strict=True)]
            for i, row in enumerate(rows)
        ]
    return [row[0] for row in rows]


def determinant(matrix: Sequence[Sequence[Scalar]]) -> Scalar:
    """Determinant of a k×k matrix, by the same elimination as its inverse."""
    rows: Matrix = [list(row) for row in matrix]
    if len(rows) == 2:
        (a, b), (c, d) = rows
        return a * d - b * c
    found: Scalar = 1.0
    for column in range(len(rows)):
        found = found * _bring_largest_up(rows, column) * rows[column][column]
        factor = reciprocal(rows[column][column])
        rows[column] = [entry * factor for entry in rows[column]]
        for i in range(column + 1, len(rows)):
            if not _is_zero(rows[i][column]):
                lead = rows[i][column]
                rows[i] = [x - lead * y for x, y in zip(rows[i], rows[column], strict=True)]
    return found


def _bring_largest_up(rows: Matrix, column: int) -> Scalar:
    """Exchanges rows, by selection, so that the pivot is the largest of its column; the sign of the exchanges."""
    sign: Scalar = 1.0
    for i in range(column + 1, len(rows)):
        if _is_zero(rows[i][column]):
            continue
        if _is_zero(rows[column][column]):
            rows[column], rows[i] = rows[i], rows[column]
            sign = -sign
            continue
        larger = absolute(rows[column][column]) < absolute(rows[i][column])
        upper = [select(larger, y, x) for x, y in zip(rows[column], rows[i], strict=True)]
        exchanged = [select(larger, x, y) for x, y in zip(rows[column], rows[i], strict=True)]
        rows[column], rows[i] = upper, exchanged
        sign = select(larger, -sign, sign)
    return sign


def _is_zero(value: Scalar) -> bool:
    return isinstance(value, float) and value == 0.0


def product(matrix: Sequence[Sequence[Scalar]], vector: Sequence[Scalar]) -> list[Scalar]:
    """Matrix times vector."""
    result: list[Scalar] = []
    for row in matrix:
        total: Scalar = 0.0
        for entry, factor in zip(row, vector, strict=True):
            total = total + entry * factor
        result.append(total)
    return result


def transposed(matrix: Sequence[Sequence[Scalar]]) -> Matrix:
    """Rows become columns."""
    return [list(column) for column in zip(*matrix, strict=True)]
