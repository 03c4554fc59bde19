"""Evaluation of values and gradients of objectives over many designs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkwright.engine.numpy_backend import numpy_program
from linkwright.engine.program import Program
from linkwright.engine.reductions import VALID_COUNT, Kind, Reduction
from linkwright.engine.sweep import Backend, sweep
from linkwright.engine.trace import Scalar, Trace

Floats = NDArray[np.float64]
Arrays = Mapping[str, ArrayLike]


class AnyTerm(Protocol):
    """A part of an objective."""

    @property
    def output(self) -> str: ...
    @property
    def weight(self) -> float: ...


@dataclass(frozen=True, slots=True)
class Group:
    """Terms whose adjoints share one factor that is known after the last position."""

    terms: tuple[AnyTerm, ...]
    kind: Kind
    seeded: bool = False

    def seed(self, trace: Trace, term: AnyTerm, value: Scalar) -> Scalar:
        """Adjoint of a term's output at one position, without the common factor."""
        if self.seeded:
            return trace.field_input(f"seed:{term.output}")
        return trace.mul(term.weight, value) if self.kind == "rms" else term.weight

    def reductions(self) -> list[Reduction]:
        """What the terms' values need."""
        return [Reduction(term.output, self.kind) for term in self.terms]

    def value(self, results: Mapping[str, NDArray[Any]]) -> Floats:
        """Sum of the terms, per design."""
        parts = [term.weight * results[r.name] for term, r in zip(self.terms, self.reductions(), strict=True)]
        return np.asarray(sum(parts[1:], parts[0]), dtype=np.float64)

    def factor(self, results: Mapping[str, NDArray[Any]]) -> Floats | None:
        """What the adjoints' sums are multiplied with, per design; None for one."""
        if self.kind == "sum":
            return None
        count = np.asarray(results[VALID_COUNT], dtype=np.float64)
        if self.kind == "mean":
            return np.asarray(1.0 / count)
        return np.asarray(1.0 / (count * results[self.reductions()[0].name]))


@dataclass(frozen=True)
class GradientProgram:
    """Two programs: one over the positions, whose adjoints are summed, one per design after it.

    ``wrt``: the parameters in the order of the gradient's columns.
    """

    along: Program
    per_design: Program
    wrt: tuple[str, ...]
    groups: tuple[Group, ...]
    boundary: tuple[int, ...]
    valid: str | None

    def __call__(
        self,
        parameters: Mapping[str, ArrayLike],
        positions: Arrays,
        fields: Arrays | None = None,
        *,
        threads: int | None = None,
        backend: Backend = "auto",
    ) -> tuple[Floats, Floats]:
        """Values (designs,) and gradients (designs, wrt).

        ``parameters``: (designs,) or a number per name; ``positions``: (n,) per name;
        ``fields``: (designs, n) per name, among them the seeds. A design without a valid
        position has the value NaN, or 0 for sums.
        """
        table = _table(parameters, self.along.parameters)
        designs = len(table)
        results = sweep(
            self.along,
            table,
            positions,
            self.reductions,
            fields=fields,
            valid=self.valid,
            threads=threads,
            backend=backend,
        )
        with np.errstate(all="ignore"):
            values = [group.value(results) for group in self.groups]
            sums = self._totals(results, designs)
        inner = _table({**parameters, **sums}, self.per_design.parameters, designs)
        gradient = numpy_program(self.per_design).run_designs(inner, {}, length=1)[:, :, 0]
        return np.asarray(sum(values[1:], values[0])), gradient

    @cached_property
    def reductions(self) -> list[Reduction]:
        """Sums of the adjoints and what the terms' values need."""
        wanted = [Reduction(name, "sum") for name in self.along.output_names if name.startswith("adjoint:")]
        return list(dict.fromkeys([r for group in self.groups for r in group.reductions()] + wanted))

    def _totals(self, results: Mapping[str, NDArray[Any]], designs: int) -> dict[str, Floats]:
        """Adjoints of the boundary lines by the names of the parameters that take them."""
        factors = [group.factor(results) for group in self.groups]
        totals: dict[str, Floats] = {}
        for index in self.boundary:
            parts = []
            for number, factor in enumerate(factors):
                total = results.get(f"adjoint:{number}:{index}.sum")
                if total is not None:
                    parts.append(total if factor is None else factor * total)
            totals[f"adjoint:{index}"] = sum(parts[1:], parts[0]) if parts else np.zeros(designs)
        return totals


def _table(parameters: Mapping[str, ArrayLike], names: tuple[str, ...], designs: int | None = None) -> Floats:
    missing = [name for name in names if name not in parameters]
    if missing:
        raise ValueError(f"the parameters {', '.join(missing)} are not given")
    if designs is None:
        designs = max((np.size(parameters[name]) for name in names), default=1)
    table = np.empty((designs, len(names)))
    for column, name in enumerate(names):
        table[:, column] = parameters[name]
    return table
