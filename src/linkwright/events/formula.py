"""Pointwise formulas: outputs at places of pieces of a cycle, with slopes, and weighted sums differentiated.

A piece is one design between two times. A formula takes the columns of a piece (its ends ``low`` and ``high``,
dimensions that vary, what loads do in it) and a place in it, its node; nothing goes over from one place to the next.
Pieces are the lanes of the machine code, nodes its outer loop.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Protocol

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.curves.pieces import LOW, Columns
from linkwright.formula.differentiation import Adjoints
from linkwright.formula.gradient import forward
from linkwright.formula.machine_code import available
from linkwright.formula.numpy_backend import numpy_program
from linkwright.formula.program import Program
from linkwright.formula.replay import Replay, depending
from linkwright.formula.scalar_backend import ScalarProgram
from linkwright.formula.table import Tables

if TYPE_CHECKING:
    from linkwright.formula.llvm_backend import CompiledProgram

#: Place in a piece, 0 to 1; the number of its design.
NODE, ROW = "node", "row"
#: Below this number of places NumPy has answered before a program is compiled.
WORTH_COMPILING = 20_000
#: So many places at most are evaluated one by one on plain numbers.
FEW = 4
#: The field of all formulas that take others of paths: the place in a path's step.
PLACE = "place in the step"


class Along(Protocol):
    """Paths of some designs."""

    @property
    def passed(self) -> Flags:
        """The designs whose paths go to the end, (designs,)."""
        ...

    def fields(self, columns: Columns, nodes: Floats) -> Columns:
        """What formulas take of them at nodes of pieces, (nodes, pieces) by name."""
        ...


@dataclass(frozen=True)
class Known:
    """What all pieces share: ``numbers`` by the names of parameters, ``tables`` that are looked up, the ``paths`` of
    groups without closed form, and whether the code is ``compiled``: None where that depends on how much there is
    to do."""

    numbers: Mapping[str, float]
    tables: Tables | None = None
    compiled: bool | None = None
    paths: Along | None = None

    def compiles(self, places: int) -> bool:
        """Whether so many places at a time are worth machine code."""
        wanted = places >= WORTH_COMPILING if self.compiled is None else self.compiled
        return wanted and available()


class Pointwise(Protocol):
    """Signals at places of pieces: a formula, or what is solved again there."""

    outputs: tuple[str, ...]

    def run(self, known: Known, columns: Columns, nodes: Floats) -> Floats:
        """The signals, (nodes, outputs, pieces), from ``columns`` (pieces,) and ``nodes`` (n,)."""
        ...

    @property
    def with_slope(self) -> Pointwise:
        """The same and, behind each, its derivative by the place in the piece."""
        ...


class Formula:
    """A program over pieces; ``columns``: what it takes of them, ``fields``: what it takes at every place."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self.outputs, self.columns, self.fields = program.output_names, program.positions, program.fields
        self.place = {name: k for k, name in enumerate(self.outputs)}
        parameters = program.parameters
        self._node = parameters.index(NODE) if NODE in parameters else None
        self._pulls: dict[tuple[str, ...], Formula] = {}

    def run(self, known: Known, columns: Columns, nodes: Floats, fields: Columns | None = None) -> Floats:
        """Outputs, (nodes, outputs, pieces), from ``columns`` (pieces,), ``nodes`` (n,) and ``fields`` (n,
        pieces)."""
        numbers = [known.numbers.get(name, np.nan) for name in self.program.parameters]
        count, inputs = len(columns[LOW]), {name: columns[name] for name in self.columns}
        if PLACE in self.fields and known.paths is not None:
            fields = {**known.paths.fields(columns, nodes), **(fields or {})}
        own = {name: fields[name] for name in self.fields} if fields else {}
        if known.compiled is None and 0 < count * len(nodes) <= FEW and not known.tables:
            return self._one_by_one(numbers, nodes, inputs, own, count)
        table = np.tile(numbers, (len(nodes), 1))
        if self._node is not None:
            table[:, self._node] = nodes
        if known.compiles(count * len(nodes)) and (code := self._code) is not None:
            return np.ascontiguousarray(code.store(table, inputs, own, length=count, tables=known.tables))
        program = numpy_program(self.program)
        return program.run_designs(table, inputs, own, length=count, tables=known.tables)

    def _one_by_one(self, numbers: list[float], nodes: Floats, inputs: Columns, own: Columns, count: int) -> Floats:
        """The outputs at a few places, on plain numbers."""
        found = np.empty((len(nodes), len(self.outputs), count))
        for k, node in enumerate(nodes.tolist()):
            if self._node is not None:
                numbers[self._node] = node
            for piece in range(count):
                at = [float(each[piece]) for each in inputs.values()]
                there = [float(each[k, piece]) for each in own.values()]
                found[k, :, piece] = self._scalar.step(numbers, at, there)
        return found

    @cached_property
    def _scalar(self) -> ScalarProgram:
        return ScalarProgram(self.program)

    @cached_property
    def _code(self) -> CompiledProgram | None:
        from linkwright.formula.llvm_backend import compile_program  # slow to load, for many places alone

        return compile_program(self.program)

    @cached_property
    def with_slope(self) -> Formula:
        """The outputs and, behind each, its derivative by the place in the piece."""
        if NODE not in self.program.parameters:
            raise ValueError("the outputs are the same at all places")
        both = forward(self.program, [NODE])
        return Formula(both.only([name for each in self.outputs for name in (each, f"{each}|{NODE}")]))

    def vjp(
        self,
        known: Known,
        columns: Columns,
        nodes: Floats,
        weights: Mapping[str, Floats],
        fields: Columns | None = None,
    ) -> dict[str, Floats]:
        """Derivatives by the columns, (pieces,) each, of the sum over the nodes of ``weights`` (nodes, pieces) times
        the outputs of these names."""
        pull = self._pull(tuple(weights))
        seeds = {_seed(name): np.ascontiguousarray(each) for name, each in weights.items()}
        found = pull.run(known, columns, nodes, {**(fields or {}), **seeds})
        return dict(zip(pull.outputs, found.sum(axis=0), strict=True))

    def _pull(self, names: tuple[str, ...]) -> Formula:
        """The weighted sum's derivatives as a formula."""
        if names not in self._pulls:
            replay, lines = Replay(self.program), dict(self.program.outputs)
            adjoints = Adjoints(replay, depending(self.program, self.columns))
            for name in names:
                adjoints.add(lines[name], replay.trace.field_input(_seed(name)))
            adjoints.sweep_back(set(range(len(self.program.nodes))))
            inputs = {node.name: i for i, node in enumerate(self.program.nodes) if node.op == "position"}
            bars = {name: adjoints.found[i].value for name, i in inputs.items() if i in adjoints.found}
            self._pulls[names] = Formula(Program.of(replay.trace, bars))
        return self._pulls[names]

    @cached_property
    def varying(self) -> list[str]:
        """The outputs that change with the place in the piece."""
        found: set[int] = set()
        for k, node in enumerate(self.program.nodes):
            if (not node.args and node.name == NODE) or any(each in found for each in node.args):
                found.add(k)
        return [each for each, k in self.program.outputs if k in found]


def _seed(name: str) -> str:
    return f"seed:{name}"
