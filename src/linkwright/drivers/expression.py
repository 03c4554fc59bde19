"""A coordinate given by an expression of the time ``t``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from linkwright.core.expressions import Expression
from linkwright.drivers.base import LAWS, Law
from linkwright.fields.base import Field, Formula
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.core.arrays import Flags
    from linkwright.drivers.base import Array
    from linkwright.formula.trace import Scalar

#: Places between which an expression goes over to another formula once at most.
LOOKS = 721


@LAWS.register("position")
@dataclass(frozen=True)
class ExpressionLaw(Law):
    """q = expression(t), ``t`` in s, differentiated exactly; ``parameters`` are the values of its other
    names."""

    expression: Expression
    parameters: Mapping[str, float] = field(default_factory=dict)
    rotary: bool = True

    def coordinate(self, t: Array) -> tuple[Array, Array, Array]:
        values = {**self.parameters, "t": t}
        q: Array = self.expression.over(values) + 0.0 * t
        qd, qdd = self.expression.derivatives(values, "t", 2)
        return q, qd, qdd

    def traced(self, t: Scalar, start: float, end: float) -> tuple[Scalar, Scalar, Scalar]:
        q, rate, second = self.expression.along({**self.parameters, "t": t}, "t", 2)
        return q, rate, second

    def breaks(self, start: float, end: float) -> Array:
        import numpy as np

        from linkwright.core.search import ends

        def positive(t: Array) -> Flags:
            values = {**self.parameters, "t": t}
            signs = [np.broadcast_to(each >= 0.0, t.shape) for each in self.expression.switches(values)]
            return np.array(signs, dtype=np.bool_).reshape(len(signs), len(t))

        t = np.linspace(start, end, LOOKS)
        rows, at = np.nonzero(np.diff(known := positive(t), axis=1))
        before, taken = known[rows, at], np.arange(len(at))
        return np.sort(ends(lambda at: positive(at)[rows, taken] == before, t[at], t[at + 1]))

    def with_dimensions(self, value: Callable[[str], float], parameters: Mapping[str, float]) -> ExpressionLaw:
        return ExpressionLaw(self.expression, _used(self.expression, parameters), self.rotary)

    @classmethod
    def fields(cls, rotary: bool) -> Mapping[str, Field]:
        return {
            "position": Formula("angle" if rotary else "length", doc=_("coordinate, an expression of the time t"))
        }

    @classmethod
    def from_values(
        cls, values: Mapping[str, object], rotary: bool, parameters: Mapping[str, float]
    ) -> ExpressionLaw:
        expression = values["position"]
        assert isinstance(expression, Expression)
        return cls(expression, _used(expression, parameters), rotary)

    def text_values(self) -> Mapping[str, object]:
        return {"position": self.expression}


def _used(expression: Expression, parameters: Mapping[str, float]) -> dict[str, float]:
    return {name: value for name, value in parameters.items() if name in expression.names}
