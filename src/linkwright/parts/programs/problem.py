"""A program in numbers: variables with bounds and scales, objective and constraints with exact derivatives."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from linkwright import units
from linkwright.core import expressions
from linkwright.core.arrays import Floats
from linkwright.core.expressions import Expression
from linkwright.errors import QuantityError
from linkwright.fields.base import Field
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar
from linkwright.fields.reading import Place, Reader
from linkwright.fields.tables import Flag, Listed, Table
from linkwright.parts.fields import AnyQuantity
from linkwright.words import _


def _variable(**values: Any) -> Variable:
    ends = {name: values[name][0] for name in ("low", "high", "start") if values.get(name)}
    choices = tuple(sorted(value for value, _unused in values.get("choices", ())))
    kinds = [values[name][1] for name in ("low", "high", "start") if values.get(name) and values[name][0]]
    kinds += [kind for _unused, kind in values.get("choices", ())]
    kinds = [kind for kind in kinds if kind != units.NONE] or [units.NONE]
    return Variable(**ends, integer=bool(values.get("integer")), choices=choices, dimension=kinds[0])


VARIABLE = Table(
    {
        "low": AnyQuantity(key="from", doc="lower bound; default: none"),
        "high": AnyQuantity(key="to", doc="upper bound; default: none"),
        "integer": Flag(doc="true: integers only"),
        "choices": Listed(AnyQuantity(), "[1 mm, 1.25 mm]", doc="the values that it may take"),
        "start": AnyQuantity(doc="where a search begins"),
    },
    _variable,
)


@dataclass(frozen=True)
class Objective(Field):
    """An expression of the variables and parameters."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Formula | None:
        text, variables = reader.text(node, place), siblings.get("variables")
        if text is None or variables is None:
            return None
        try:
            return formula(text, _kinds(reader, variables), reader.values)
        except QuantityError as error:
            reader.quantity_error(error, node, place, text)
            return None

    def shape(self) -> dict[str, Any]:
        return {"type": "string"}


@dataclass(frozen=True)
class Conditions(Field):
    """Constraints by name: ``left <= right``, ``left >= right``, ``left = right``, ``low <= expression <= high``."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        mapping, variables = reader.mapping(node, place), siblings.get("variables")
        found: list[Constraint] = []
        for entry in mapping.entries if isinstance(mapping, MappingNode) and variables is not None else []:
            child = place.child(entry.key.text)
            text = entry.value.text if isinstance(entry.value, Scalar) else reader.text(entry.value, child)
            try:
                kinds = _kinds(reader, variables or {})
                found += constraint(entry.key.text, text or "", kinds, reader.values)
            except QuantityError as error:
                if not reader.follows(text or ""):
                    reader.error(entry.value, child, error.message, error.remedy, error.code)
        return tuple(found)

    def shape(self) -> dict[str, Any]:
        return {"type": "object", "additionalProperties": {"type": "string"}}


def _kinds(reader: Reader, variables: Mapping[str, Variable | None]) -> dict[str, units.Dimension]:
    """Dimensions of parameters and variables; variables that are wrong themselves are noted as such."""
    reader.broken.update(name for name, each in variables.items() if each is None)
    return {**reader.kinds, **{name: each.dimension for name, each in variables.items() if each is not None}}


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
            _('invalid constraint "{text}"', text=text), _("write left <= right, left >= right or left = right")
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


@dataclass(frozen=True)
class Variable:
    """``low`` ≤ x ≤ ``high`` (SI), ``integer``, or one of ``choices`` (rising); ``start`` of a search."""

    low: float = -math.inf
    high: float = math.inf
    integer: bool = False
    choices: tuple[float, ...] = ()
    start: float | None = None
    dimension: units.Dimension = units.NONE

    def __post_init__(self) -> None:
        missing = len(units.NONE) - len(self.dimension)
        object.__setattr__(self, "dimension", (*self.dimension, *(0,) * missing))

    @property
    def discrete(self) -> bool:
        """Whether it takes single values only."""
        return self.integer or bool(self.choices)

    @property
    def minimum(self) -> float:
        """Lower bound."""
        return self.choices[0] if self.choices else self.low

    @property
    def maximum(self) -> float:
        """Upper bound."""
        return self.choices[-1] if self.choices else self.high

    @property
    def middle(self) -> float:
        """Where a search begins: the start, the middle of the bounds, or near the one bound."""
        if self.start is not None:
            return self.start
        if math.isfinite(self.minimum) and math.isfinite(self.maximum):
            return (self.minimum + self.maximum) / 2
        if math.isfinite(self.minimum):
            return self.minimum + self.size
        return self.maximum - self.size if math.isfinite(self.maximum) else 1.0

    @property
    def size(self) -> float:
        """Its scale: the width of its bounds, else the size of its start or bound, else 1."""
        if math.isfinite(self.minimum) and math.isfinite(self.maximum):
            return (self.maximum - self.minimum) or abs(self.maximum) or 1.0
        ends = [abs(v) for v in (self.start, self.minimum, self.maximum) if v is not None and math.isfinite(v) and v]
        return max(ends, default=1.0)


@dataclass(frozen=True)
class Model:
    """Minimise ``objective`` (times ``sign``: −1 for a maximum) under ``constraints``."""

    variables: Mapping[str, Variable]
    objective: Formula
    sign: int
    constraints: Sequence[Constraint] = field(default_factory=tuple)

    def point(self, x: Floats) -> dict[str, Floats]:
        """Values by variable from columns (variables, n)."""
        return dict(zip(self.variables, np.atleast_2d(x.T).T, strict=True))

    @cached_property
    def lows(self) -> Floats:
        """Lower bounds."""
        return np.array([v.minimum for v in self.variables.values()])

    @cached_property
    def highs(self) -> Floats:
        """Upper bounds."""
        return np.array([v.maximum for v in self.variables.values()])

    @cached_property
    def sizes(self) -> Floats:
        """Scales of the variables."""
        return np.array([v.size for v in self.variables.values()])

    def samples(self, count: int) -> Floats:
        """Starts within the bounds, (variables, count): the middle, then an even sequence of Sobol's."""
        from scipy.stats import qmc

        middle = np.array([v.middle for v in self.variables.values()])
        power = max(count - 1, 1).bit_length()
        even = qmc.Sobol(len(middle), seed=7).random_base2(power).T
        low = np.where(np.isfinite(self.lows), self.lows, middle - 5 * self.sizes)
        high = np.where(np.isfinite(self.highs), self.highs, middle + 5 * self.sizes)
        spread = low[:, None] + even * (high - low)[:, None]
        return np.concatenate([middle[:, None], spread], axis=1)[:, :count]

    @cached_property
    def linear(self) -> bool:
        """Whether objective and constraints are linear: their derivatives do not change from place to place."""
        points = self.point(self.samples(6))
        for each in (self.objective, *(side for c in self.constraints for side in (c.left, c.right))):
            slopes = each.gradient(points)
            if not np.isfinite(slopes).all():
                return False
            largest = np.abs(slopes).max(axis=1, keepdims=True)
            if (np.ptp(slopes, axis=1, keepdims=True) > 1e-12 * largest).any():
                return False
        return True

    def without(self, constraint: str | None = None, bound: tuple[str, str] | None = None) -> Model:
        """The same without one constraint, or without one bound (``low`` or ``high``) of a variable."""
        from dataclasses import replace

        remaining = tuple(c for c in self.constraints if c.name != constraint)
        variables = dict(self.variables)
        if bound is not None:
            name, side = bound
            open_end = -math.inf if side == "low" else math.inf
            variables[name] = replace(variables[name], **{side: open_end})  # type: ignore[arg-type]
        return Model(variables, self.objective, self.sign, remaining)
