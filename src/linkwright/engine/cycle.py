"""Cycle programs: stages over the positions of every design, joined by numbers found on the way."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats, Whole
from linkwright.core.dataclass import dataclass
from linkwright.engine.reductions import Results
from linkwright.engine.stage import Stage, blank
from linkwright.engine.summaries import BACKENDS, Arrays, Backend, Run
from linkwright.engine.table import Tables
from linkwright.engine.threads import chunks, cores

#: Configurations of a block: of results alone, of what gradients are found from, and where stages keep fields.
_RESULTS, _KNOWN, _WITH_FIELDS = 1 << 26, 1 << 23, 1 << 20


@dataclass(frozen=True, eq=False)
class CycleProgram:
    """Stages in their order; a stage takes dimensions and the results of stages before it.

    ``dimensions``: the parameters that no stage finds, in the order of the columns that
    :meth:`evaluate` takes; by default as they appear. Raises ValueError for a name found twice, or taken
    before it is found.
    """

    stages: tuple[Stage, ...]
    dimensions: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        found: set[str] = set()
        later = {name for stage in self.stages for name in stage.results}
        taken: dict[str, None] = {}
        for stage in self.stages:
            early = [name for name in stage.parameters if name in later and name not in found]
            if early:
                raise ValueError(f"the cycle values {', '.join(early)} are taken before they are found")
            taken |= dict.fromkeys(name for name in stage.parameters if name not in found)
            twice = [name for name in stage.results if name in found or name in self.dimensions]
            if twice:
                raise ValueError(f"more than one stage finds {', '.join(twice)}")
            found |= set(stage.results)
        missing = [name for name in taken if name not in self.dimensions]
        if self.dimensions and missing:
            raise ValueError(f"the parameters {', '.join(missing)} are neither dimensions nor cycle values")
        object.__setattr__(self, "dimensions", self.dimensions or tuple(taken))

    @cached_property
    def results(self) -> tuple[str, ...]:
        """Names of all cycle values."""
        return tuple(name for stage in self.stages for name in stage.results)

    def evaluate(
        self,
        table: ArrayLike,
        positions: Arrays | None = None,
        fields: Arrays | None = None,
        *,
        tables: Tables | None = None,
        threads: int | None = None,
        backend: Backend = "auto",
    ) -> Results:
        """Results of all stages, (designs,) per name.

        ``table``: (designs, dimensions); ``positions``: (n,) per name; ``fields``: (designs, n) per
        name; ``tables``: those that the programs look up. ``threads``: None for all cores; results do not
        depend on it. ``backend`` ``auto`` compiles where that pays and llvmlite is there. Memory does not grow with
        the designs, but for fields and results. Raises ValueError for unknown back ends, missing inputs and wrong
        shapes.
        """
        size = None if any(stage.keep for stage in self.stages) else _RESULTS
        blocks = self.blocks(
            table, positions, fields, tables=tables, threads=threads, backend=backend, size=size
        )
        parts = [known.values for _, known, _ in blocks]
        if len(parts) == 1:
            return parts[0]
        return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}

    def blocks(
        self,
        table: ArrayLike,
        positions: Arrays | None = None,
        fields: Arrays | None = None,
        *,
        tables: Tables | None = None,
        threads: int | None = None,
        backend: Backend = "auto",
        size: int | None = None,
    ) -> Iterator[tuple[int, Known, Run]]:
        """What is found of some designs after another: (number after the last design, numbers, manner).

        ``size``: most configurations of one block; by default fewer where stages keep fields.
        """
        if backend not in BACKENDS:
            raise ValueError(f"there is no back end '{backend}': use auto, numpy or llvm")
        numbers = np.ascontiguousarray(table, dtype=np.float64)
        if numbers.ndim != 2 or numbers.shape[1] != len(self.dimensions):
            wanted = ", ".join(self.dimensions)
            raise ValueError(f"the table must have the columns {wanted}, not the shape {numbers.shape}")
        given = {name: np.ascontiguousarray(a, dtype=np.float64) for name, a in (fields or {}).items()}
        n = self._length(positions or {}, given)
        run = Run(positions or {}, n, tables, cores() if threads is None else threads, backend)
        most = size or (_WITH_FIELDS if any(stage.keep for stage in self.stages) else _KNOWN)
        for first, end in chunks(len(numbers), max(1, most // max(n, 1))) if len(numbers) else [(0, 0)]:
            rows = {name: array[first:end] for name, array in given.items()}
            yield end, self._block(numbers[first:end], rows, run), run

    def _block(self, numbers: Floats, fields: dict[str, Floats], run: Run) -> Known:
        """All stages of some designs."""
        known = Known(self.dimensions, numbers, fields)
        failed = np.zeros(len(numbers), dtype=np.bool_)
        for stage in self.stages:
            own = stage.manner(run)
            needed, kept = stage.accumulation.needed, stage.kept
            table, start = known.table(stage.accumulation.parameters), known.starts(stage, needed.states)
            results, missed = stage.evaluate(table, known.fields, start, own)
            failed |= missed
            blank(results, failed)
            if stage.keep:
                table, start = known.table(kept.parameters), known.starts(stage, kept.states)
                known.fields |= stage.fields(table, known.fields, start, own)
            known.values |= results
        return known

    def _length(self, positions: Arrays, fields: Mapping[str, Floats]) -> int:
        lengths = {int(np.shape(array)[-1]) for array in (*positions.values(), *fields.values())}
        if not lengths and all(stage.steps is not None for stage in self.stages):
            return max(stage.steps or 1 for stage in self.stages)
        if len(lengths) != 1:
            raise ValueError(f"inputs over the positions must have one length, but have {sorted(lengths)}")
        return lengths.pop()


@dataclass
class Known:
    """What is known of some designs so far."""

    dimensions: tuple[str, ...]
    numbers: Floats
    fields: dict[str, Floats]
    values: Results = field(default_factory=dict)

    def table(self, names: tuple[str, ...]) -> Floats:
        """(designs, names), without a copy where these are the dimensions."""
        if names == self.dimensions:
            return self.numbers
        if not any(name in self.values for name in names):
            return np.ascontiguousarray(self.numbers[:, [self.dimensions.index(name) for name in names]])
        table = np.empty((len(self.numbers), len(names)))
        for column, name in enumerate(names):
            table[:, column] = self.column(name)
        return table

    def column(self, name: str) -> Floats | Whole:
        """A cycle value or a dimension."""
        return self.values[name] if name in self.values else self.numbers[:, self.dimensions.index(name)]

    def starts(self, stage: Stage, states: tuple[str, ...]) -> Floats | None:
        """First values of the named states, (designs, states)."""
        if not states or not stage.starts:
            return None
        start = np.empty((len(self.numbers), len(states)))
        for column, name in enumerate(states):
            source = stage.starts[name]
            start[:, column] = self.column(source) if isinstance(source, str) else source
        return start
