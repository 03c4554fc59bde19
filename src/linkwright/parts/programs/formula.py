"""Objectives and constraints as expressions of variables, with exact derivatives."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from linkwright import units
from linkwright.core import expressions
from linkwright.core.arrays import Floats
from linkwright.core.expressions import Expression
from linkwright.errors import QuantityError
from linkwright.words import _

SENSES = {"<=": "<=", "≤": "<=", ">=": ">=", "≥": ">=", "=": "=", "==": "="}
_SENSE = re.compile(r"(<=|>=|==|≤|≥|=)")


@dataclass(frozen=True)
class Formula:
    """An expression of variables with the values (SI) of its parameters."""

    expression: Expression
    constants: Mapping[str, float]
    dimension: units.Dimension

    @property
    def text(self) -> str:
        """As it was written."""
        return self.expression.text

    def value(self, point: Mapping[str, Floats]) -> Floats:
        """Values (n,) at points (n,) by variable; NaN where there is none."""
        with np.errstate(all="ignore"):
            found = self.expression.over({**self.constants, **point})
        return np.broadcast_to(np.asarray(found, dtype=float), next(iter(point.values())).shape)

    def gradient(self, point: Mapping[str, Floats]) -> Floats:
        """Derivatives by the variables in the point's order, (variables, n)."""
        values = {**self.constants, **point}
        return np.array([self.expression.derivatives(values, name)[0] for name in point])


@dataclass(frozen=True)
class Constraint:
    """``left`` sense ``right`` with sense <=, >= or =."""

    name: str
    left: Formula
    sense: str
    right: Formula

    @property
    def text(self) -> str:
        """As it was written."""
        return f"{self.left.text} {self.sense} {self.right.text}"

    def excess(self, point: Mapping[str, Floats]) -> Floats:
        """left − right, for >= right − left: not above zero where it holds, (n,)."""
        difference = self.left.value(point) - self.right.value(point)
        return -difference if self.sense == ">=" else difference

    def slope(self, point: Mapping[str, Floats]) -> Floats:
        """Derivatives of the excess, (variables, n)."""
        difference = self.left.gradient(point) - self.right.gradient(point)
        return -difference if self.sense == ">=" else difference


def formula(text: str, kinds: Mapping[str, units.Dimension], constants: Mapping[str, float]) -> Formula:
    """A formula of the names in ``kinds``; raises QuantityError."""
    plain = units.tidy(text)
    found = (
        expressions.parse_any(plain, kinds)
        if expressions.is_literal(plain, kinds)
        else expressions.parse(plain, kinds)
    )
    used = {name: value for name, value in constants.items() if name in found.names}
    try:
        found.over(dict.fromkeys(found.names, math.nan) | used)
    except ZeroDivisionError:
        message = _('"{text}" divides by zero', code="model.divides_by_zero", text=text)
        raise QuantityError(message, _("change the values"), code="not-finite") from None
    return Formula(found, used, found.dimension(kinds))


def constraint(
    name: str, text: str, kinds: Mapping[str, units.Dimension], constants: Mapping[str, float]
) -> list[Constraint]:
    """One constraint, or two of ``a <= b <= c``; raises QuantityError."""
    parts = [part.strip() for part in _SENSE.split(text)]
    if len(parts) not in (3, 5) or (len(parts) == 5 and "=" in (SENSES[parts[1]], SENSES[parts[3]])):
        raise QuantityError(
            _('"{text}" is no constraint', text=text), _("write left <= right, left >= right or left = right")
        )
    sides = [formula(part, kinds, constants) for part in parts[::2]]
    for side in sides[1:]:
        zero = any(
            s.dimension == units.NONE and not s.expression.names and s.text.strip() in ("0", "0.0") for s in sides
        )
        if side.dimension != sides[0].dimension and not zero:
            one, other = units.name_of(sides[0].dimension), units.name_of(side.dimension)
            raise QuantityError(
                _("the left side is {left}, the right side {right}", left=one, right=other),
                _("compare values of one kind"),
            )
    if len(parts) == 3:
        return [Constraint(name, sides[0], SENSES[parts[1]], sides[1])]
    return [Constraint(f"{name} ({i + 1})", sides[i], SENSES[parts[2 * i + 1]], sides[i + 1]) for i in range(2)]
