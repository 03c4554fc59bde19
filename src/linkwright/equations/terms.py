"""Formulas that know their symbols and their numbers, so that both can be printed and evaluated again."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from operator import mul

#: Anything smaller (SI) is nothing but rounding.
ZERO_TOLERANCE = 1e-12
Leaf = Callable[["Term"], float]
Function = Callable[["Term", list[float]], float]


@dataclass(frozen=True)
class Term:
    """A symbol, a number, or an operation on terms; angles are counted in degrees.

    ``op``: symbol, number, sum (with ``signs``), product, quotient, square, root, size, cos, sin, tan, atan2,
    arccos, arcsin, arctan.
    """

    op: str
    args: tuple[Term, ...] = ()
    signs: tuple[int, ...] = ()
    plain: str = ""
    look: str = ""
    amount: float = 0.0
    degrees: bool = False

    @property
    def is_zero(self) -> bool:
        """Whether the term is nothing by its kind, not by chance."""
        return self.op == "number" and self.amount == 0.0

    def __add__(self, other: Term) -> Term:
        return _sum(self, other, 1)

    def __sub__(self, other: Term) -> Term:
        return _sum(self, other, -1)

    def __neg__(self) -> Term:
        return _sum(ZERO, self, -1)

    def __mul__(self, other: Term) -> Term:
        if self.is_zero or other.is_zero:
            return ZERO
        if self == ONE:
            return other
        if other == ONE:
            return self
        for first, second in ((self, other), (other, self)):
            if first.op == "sum" and len(first.args) == 1:
                return -(first.args[0] * second) if first is self else -(second * first.args[0])
        return Term("product", (*_factors(self), *_factors(other)))

    def __truediv__(self, other: Term) -> Term:
        return ZERO if self.is_zero else Term("quotient", (self, other))

    @property
    def squared(self) -> Term:
        """The term times itself."""
        return ZERO if self.is_zero else Term("square", (self,))

    @property
    def value(self) -> float:
        """What the term amounts to."""
        return self.evaluate(lambda leaf: 0.0 if leaf.is_rounding else leaf.amount)

    @property
    def is_rounding(self) -> bool:
        """Whether the amount of a symbol or a number is nothing but rounding; degrees are small units."""
        return abs(self.amount) < (100.0 * ZERO_TOLERANCE if self.degrees else ZERO_TOLERANCE)

    def evaluate(self, leaf: Leaf, apply: Mapping[str, Function] | None = None) -> float:
        """The term with ``leaf`` deciding what every symbol and number is worth; NaN where it has no value.

        ``apply``: what operations do with the values of their terms, in place of ``APPLY``.
        """
        if not self.args:
            return leaf(self)
        try:
            return (apply or APPLY)[self.op](self, [each.evaluate(leaf, apply) for each in self.args])
        except (ValueError, ZeroDivisionError, OverflowError):
            return math.nan

    def replaced(self, change: Callable[[Term], Term | None]) -> Term:
        """The term with parts of it replaced, from the outside in."""
        if (new := change(self)) is not None:
            return new
        return replace(self, args=tuple(each.replaced(change) for each in self.args)) if self.args else self

    def put(self, known: Mapping[str, Term]) -> Term:
        """The term with symbols, by their plain names, replaced by what is known of them."""
        return self.replaced(lambda each: known.get(each.plain) if each.op == "symbol" else None)

    def leaves(self) -> list[Term]:
        """All symbols and numbers in it."""
        return [self] if not self.args else [leaf for each in self.args for leaf in each.leaves()]


def _add(term: Term, values: list[float]) -> float:
    total: float = sum(map(mul, term.signs, values))
    return total


#: What every operation does with the values of its terms.
APPLY: dict[str, Function] = {
    "sum": _add,
    "product": lambda _, v: math.prod(v),
    "quotient": lambda _, v: v[0] / v[1],
    "square": lambda _, v: v[0] * v[0],
    "root": lambda _, v: math.sqrt(v[0]),
    "cos": lambda _, v: math.cos(math.radians(v[0])),
    "sin": lambda _, v: math.sin(math.radians(v[0])),
    "tan": lambda _, v: math.tan(math.radians(v[0])),
    "size": lambda _, v: abs(v[0]),
    "atan2": lambda _, v: math.degrees(math.atan2(v[0], v[1])),
    "arccos": lambda _, v: math.degrees(math.acos(v[0])),
    "arcsin": lambda _, v: math.degrees(math.asin(v[0])),
    "arctan": lambda _, v: math.degrees(math.atan(v[0])),
}


def _sum(a: Term, b: Term, sign: int) -> Term:
    if b.is_zero:
        return a
    first = () if a.is_zero else ((a.args, a.signs) if a.op == "sum" else ((a,), (1,)))
    args, signs = first or ((), ())
    if b.op == "sum" and (sign == 1 or len(b.args) == 1):
        return _flat((*args, *b.args), (*signs, *(sign * each for each in b.signs)))
    return _flat((*args, b), (*signs, sign))


def _flat(args: tuple[Term, ...], signs: tuple[int, ...]) -> Term:
    if len(args) == 1 and signs == (1,):
        return args[0]
    return Term("sum", args, signs)


def _factors(term: Term) -> tuple[Term, ...]:
    return term.args if term.op == "product" else (term,)


def symbol(plain: str, amount: float, *, degrees: bool = False, look: str = "") -> Term:
    """A named quantity with its value; ``look``: the name as it is printed, where it is not ``plain``."""
    return Term("symbol", plain=plain, look=look, amount=amount, degrees=degrees)


def number(amount: float, *, degrees: bool = False) -> Term:
    """A plain number."""
    return Term("number", amount=amount, degrees=degrees)


ZERO, ONE, TWO, FOUR = number(0.0), number(1.0), number(2.0), number(4.0)


def root(term: Term) -> Term:
    """Square root."""
    return Term("root", (term,))


def size(term: Term) -> Term:
    """The term without its sign."""
    return Term("size", (term,))


def cosine(angle: Term) -> Term:
    """Cosine of an angle in degrees."""
    return ONE if angle.is_zero else Term("cos", (angle,))


def sine(angle: Term) -> Term:
    """Sine of an angle in degrees."""
    return ZERO if angle.is_zero else Term("sin", (angle,))


def tangent(angle: Term) -> Term:
    """Tangent of an angle in degrees."""
    return ZERO if angle.is_zero else Term("tan", (angle,))


def direction(y: Term, x: Term) -> Term:
    """Angle of the vector (x, y), degrees, -180 to 180."""
    return Term("atan2", (y, x))


def arccosine(term: Term) -> Term:
    """Angle of a cosine, degrees, 0 to 180."""
    return Term("arccos", (term,))


def arcsine(term: Term) -> Term:
    """Angle of a sine, degrees, -90 to 90."""
    return ZERO if term.is_zero else Term("arcsin", (term,))


def arctangent(term: Term) -> Term:
    """Angle of a tangent, degrees, -90 to 90."""
    return ZERO if term.is_zero else Term("arctan", (term,))


def total(terms: list[Term]) -> Term:
    """Sum of terms."""
    found = ZERO
    for term in terms:
        found = found + term
    return found


def minus(a: Term, b: Term) -> Term:
    """The difference without parentheses."""
    args, signs = (b.args, b.signs) if b.op == "sum" else ((b,), (1,))
    for each, sign in zip(args, signs, strict=True):
        a = a - each if sign > 0 else a + each
    return a


@dataclass(frozen=True)
class Pair:
    """A vector of terms."""

    x: Term
    y: Term

    def __add__(self, other: Pair) -> Pair:
        return Pair(self.x + other.x, self.y + other.y)

    def __sub__(self, other: Pair) -> Pair:
        return Pair(self.x - other.x, self.y - other.y)

    def __neg__(self) -> Pair:
        return Pair(-self.x, -self.y)

    def times(self, factor: Term) -> Pair:
        """Stretched by a factor."""
        return Pair(factor * self.x, factor * self.y)

    @property
    def perp(self) -> Pair:
        """Turned by a right angle, counter-clockwise."""
        return Pair(-self.y, self.x)

    def cross(self, other: Pair) -> Term:
        """Component of the vector product along z."""
        return self.x * other.y - self.y * other.x

    def put(self, known: Mapping[str, Term]) -> Pair:
        """Both components with symbols replaced."""
        return Pair(self.x.put(known), self.y.put(known))

    def dot(self, other: Pair) -> Term:
        """Scalar product."""
        return self.x * other.x + self.y * other.y


NOWHERE = Pair(ZERO, ZERO)
