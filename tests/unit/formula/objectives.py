"""Weighted sums of summaries of a program's outputs, with their gradients."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.formula.gradient import Gradient
from linkwright.formula.program import Program
from linkwright.formula.reductions import Kind, Reduction
from linkwright.formula.trace import Trace


class Term(NamedTuple):
    """``weight`` times a summary of an output over the valid positions."""

    output: str
    kind: Kind = "sum"
    weight: float = 1.0


def gradient_of(
    program: Program, terms: Sequence[Term], wrt: Sequence[str] | None = None, valid: str | None = "valid"
) -> Gradient:
    """The sum of the terms with its gradient by parameters, all of them by default."""
    if len(terms) == 1 and terms[0].weight == 1.0:
        return Gradient(program, Reduction(*terms[0][:2]), wrt, valid=valid)
    t, total = Trace(), 0.0  # type: Trace, Scalar
    for term in terms:
        total = total + term.weight * t.parameter(Reduction(*term[:2]).name)
    return Gradient(program, Program.of(t, {"total": total}), wrt, valid=valid)


def table_of(gradient: Gradient, numbers: Mapping[str, ArrayLike]) -> Floats:
    """Designs (designs, parameters) from numbers (designs,) of each, or one for all."""
    columns = np.broadcast_arrays(*(np.atleast_1d(numbers[name]) for name in gradient.parameters))
    return np.array(columns, dtype=float).T
