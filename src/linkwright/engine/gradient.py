"""Evaluation of values and gradients of objectives over many designs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkwright.engine.program import Program
from linkwright.engine.sweep import Backend, Progress, sweep

Floats = NDArray[np.float64]
Arrays = Mapping[str, ArrayLike]

#: The output of the objective's value, and the prefix of its derivatives.
VALUE = "value"


@dataclass(frozen=True)
class GradientProgram:
    """Two programs: ``along`` over the positions, whose adjoints are summed, ``after`` per design.

    ``wrt``: the parameters in the order of the gradient's columns. ``parameters``: the names
    and the order of the columns that :meth:`evaluate` takes.
    """

    along: Program
    after: Program
    wrt: tuple[str, ...]
    valid: str | None

    @property
    def parameters(self) -> tuple[str, ...]:
        """Parameters of the program that was differentiated, as far as they matter."""
        return self.along.parameters

    def __call__(
        self,
        parameters: Mapping[str, ArrayLike],
        positions: Arrays,
        fields: Arrays | None = None,
        *,
        threads: int | None = None,
        backend: Backend = "auto",
    ) -> tuple[Floats, Floats]:
        """Values and gradients as :meth:`evaluate`; parameters (designs,) or a number by name."""
        missing = [name for name in self.parameters if name not in parameters]
        if missing:
            raise ValueError(f"the parameters {', '.join(missing)} are not given")
        designs = max((np.size(parameters[name]) for name in self.parameters), default=1)
        table = np.empty((designs, len(self.parameters)))
        for column, name in enumerate(self.parameters):
            table[:, column] = parameters[name]
        return self.evaluate(table, positions, fields, threads=threads, backend=backend)

    def evaluate(
        self,
        table: ArrayLike,
        positions: Arrays,
        fields: Arrays | None = None,
        *,
        threads: int | None = None,
        backend: Backend = "auto",
        progress: Progress | None = None,
    ) -> tuple[Floats, Floats]:
        """Values (designs,) and gradients (designs, wrt) of many designs.

        ``table``: (designs, parameters) in the order of :attr:`parameters`; ``positions``: (n,)
        per name; ``fields``: (designs, n) per name, among them the seeds. A design without a
        valid position has the value 0 for sums, NaN for means and root mean squares.
        """
        results = sweep(
            self.along,
            table,
            positions,
            (),
            fields=fields,
            valid=self.valid,
            after=self.after,
            threads=threads,
            backend=backend,
            progress=progress,
        )
        values = np.asarray(results[VALUE], dtype=np.float64)
        gradient = np.empty((len(values), len(self.wrt)))
        for column, name in enumerate(self.wrt):
            gradient[:, column] = results[derivative_name(name)]
        return values, gradient


def derivative_name(parameter: str) -> str:
    """The output of the objective's derivative with respect to a parameter."""
    return f"{VALUE}|{parameter}"
