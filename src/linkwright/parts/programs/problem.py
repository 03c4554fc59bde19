"""A program in numbers: variables with bounds, scaled so that all of them go from about 0 to 1."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from linkwright import units
from linkwright.core.arrays import Floats
from linkwright.parts.programs.formula import Constraint, Formula


@dataclass(frozen=True)
class Variable:
    """``low`` ≤ x ≤ ``high`` (SI), ``integer``, or one of ``choices`` (rising); ``start`` of a search."""

    low: float = -math.inf
    high: float = math.inf
    integer: bool = False
    choices: tuple[float, ...] = ()
    start: float | None = None
    dimension: units.Dimension = units.NONE

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
