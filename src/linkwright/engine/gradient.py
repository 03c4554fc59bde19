"""Evaluation of values and gradients of objectives over many designs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkwright.engine.program import Program
from linkwright.engine.reductions import Reduction
from linkwright.engine.sweep import Backend, Progress, sweep

Floats = NDArray[np.float64]
Arrays = Mapping[str, ArrayLike]

#: The output of the objective's value, and the prefix of its derivatives.
VALUE = "value"


@dataclass(frozen=True, slots=True)
class Manner:
    """How to evaluate: threads (None: all cores), back end, and what is told the progress."""

    threads: int | None = None
    backend: Backend = "auto"
    progress: Progress | None = None


class Part(Protocol):
    """A part of an objective, with its gradient."""

    @property
    def parameters(self) -> tuple[str, ...]:
        """The parameters that it takes, in the order of the table's columns."""

    def evaluate(
        self, table: Floats, positions: Arrays, fields: Arrays, manner: Manner
    ) -> tuple[Floats, Floats]:
        """Values (designs,) and gradients (designs, wrt)."""


@dataclass(frozen=True)
class SummedPart:
    """Terms summed over the positions.

    ``along``: evaluated at every position, its outputs summed; ``after``: then, once per design.
    """

    along: Program
    after: Program
    wrt: tuple[str, ...]
    valid: str | None

    @property
    def parameters(self) -> tuple[str, ...]:
        return self.along.parameters

    def evaluate(
        self, table: Floats, positions: Arrays, fields: Arrays, manner: Manner
    ) -> tuple[Floats, Floats]:
        results = sweep(
            self.along,
            table,
            positions,
            (),
            fields=fields,
            valid=self.valid,
            after=self.after,
            threads=manner.threads,
            backend=manner.backend,
            progress=manner.progress,
        )
        values = np.asarray(results[VALUE], dtype=np.float64)
        gradient = np.empty((len(values), len(self.wrt)))
        for column, name in enumerate(self.wrt):
            gradient[:, column] = results[derivative_name(name)]
        return values, gradient


@dataclass(frozen=True)
class ExtremePart:
    """The largest or smallest value of an output, with the gradient at its first position.

    ``there``: value and gradient at one position, whose inputs are all fields.
    """

    program: Program
    output: str
    kind: str
    valid: str | None
    there: SummedPart

    @property
    def parameters(self) -> tuple[str, ...]:
        return self.program.parameters

    def evaluate(
        self, table: Floats, positions: Arrays, fields: Arrays, manner: Manner
    ) -> tuple[Floats, Floats]:
        wanted = Reduction(self.output, "argmax" if self.kind == "max" else "argmin")
        found = sweep(
            self.program,
            table,
            positions,
            [wanted],
            fields=fields,
            valid=self.valid,
            threads=manner.threads,
            backend=manner.backend,
            progress=manner.progress,
        )[wanted.name]
        failed, place, designs = found < 0, np.maximum(found, 0), np.arange(len(table))
        inputs = {name: np.asarray(positions[name])[place][:, None] for name in self.program.positions}
        inputs |= {name: np.asarray(fields[name])[designs, place][:, None] for name in self.program.fields}
        columns = [self.program.parameters.index(name) for name in self.there.parameters]
        quiet = replace(manner, progress=None)
        values, gradient = self.there.evaluate(table[:, columns], {}, inputs, quiet)
        values[failed], gradient[failed] = np.nan, np.nan
        return values, gradient


@dataclass(frozen=True)
class GradientProgram:
    """Value and gradient of an objective, the sum of its parts.

    ``wrt``: the parameters in the order of the gradient's columns. ``parameters``: the names
    and the order of the columns that :meth:`evaluate` takes.
    """

    parts: tuple[Part, ...]
    wrt: tuple[str, ...]

    @property
    def parameters(self) -> tuple[str, ...]:
        """Parameters of the program that was differentiated, as far as they matter."""
        return tuple(dict.fromkeys(name for part in self.parts for name in part.parameters))

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
        names = self.parameters
        missing = [name for name in names if name not in parameters]
        if missing:
            raise ValueError(f"the parameters {', '.join(missing)} are not given")
        designs = max((np.size(parameters[name]) for name in names), default=1)
        table = np.empty((designs, len(names)))
        for column, name in enumerate(names):
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
        valid position has the value 0 for sums, else NaN. Raises ValueError for a table of
        another shape and missing inputs.
        """
        given, names = np.asarray(table, dtype=np.float64), self.parameters
        if given.ndim != 2 or given.shape[1] != len(names):
            raise ValueError(
                f"the table must have the columns {', '.join(names)}, not the shape {given.shape}"
            )
        manner = Manner(threads, backend, progress)
        values, gradient = np.zeros(len(given)), np.zeros((len(given), len(self.wrt)))
        for part in self.parts:
            own = given
            if part.parameters != names:
                own = given[:, [names.index(name) for name in part.parameters]]
            more, slopes = part.evaluate(own, positions, fields or {}, manner)
            values += more
            gradient += slopes
        return values, gradient


def derivative_name(parameter: str) -> str:
    """The output of the objective's derivative with respect to a parameter."""
    return f"{VALUE}|{parameter}"
