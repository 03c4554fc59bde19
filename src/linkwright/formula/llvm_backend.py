"""Evaluation by compiled code: all positions of one or many designs in one call."""

from __future__ import annotations

import ctypes
import threading
from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats, Integers
from linkwright.formula import machine_code
from linkwright.formula.cache import loaded_code
from linkwright.formula.call_block import Inputs, SingleCall, address_of, aligned
from linkwright.formula.ir_kernel import kernel
from linkwright.formula.ir_module import ENTRY
from linkwright.formula.lines import Lines
from linkwright.formula.machine_code import available
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.reductions import Accumulation, Results
from linkwright.formula.table import Tables, tables_in_order
from linkwright.formula.threads import spread_over

__all__ = ["CompiledProgram", "available", "compile_program"]

Arrays = Mapping[str, ArrayLike]
_NONE: Arrays = {}
#: Most configurations (designs times positions) of one call; a call cannot be interrupted. On several threads the
#: last calls have as few as these, or a fourth of a thread's share.
_LONGEST_CALL, _SHORTEST_CALL = 1 << 20, 1 << 16
_CALLS_PER_THREAD = 4


def compile_program(program: Program, accumulation: Accumulation | None = None) -> CompiledProgram | None:
    """The program as machine code, or None where llvmlite is missing.

    Without an ``accumulation`` every output is stored (:meth:`CompiledProgram.store`, ``.repeated``); with
    one, of this program, its reductions are found inside the loop (:meth:`CompiledProgram.sweep`).
    Machine code is cached in memory and on disk. Raises
    ValueError for unknown outputs.
    """
    if not available():
        return None
    owner = program if accumulation is None else accumulation
    return _compiled.get(owner, None, lambda: _compile(program, accumulation))


def _compile(program: Program, accumulation: Accumulation | None) -> CompiledProgram:
    needed = program if accumulation is None else accumulation.needed
    width = machine_code.host().width
    key = f"{needed.key} {'stored' if accumulation is None else accumulation.key}"
    code = loaded_code(key, lambda: kernel(Lines.of(needed), width, accumulation), ENTRY)
    return CompiledProgram(needed, accumulation, code, width)


_compiled: Recent[Program | Accumulation, CompiledProgram] = Recent(64)


class CompiledProgram:
    """A program's machine code. May be used from several threads.

    Results do not depend on the number of threads, to the last bit.
    """

    def __init__(
        self, program: Program, accumulation: Accumulation | None, code: machine_code.Loaded, width: int
    ) -> None:
        self.program = program
        self.accumulation = accumulation
        self.width = width
        self._function = code.function(ENTRY)
        self._own = threading.local()

    def repeated(self, positions: Arrays, *, tables: Tables | None = None) -> Callable[[Floats], Floats]:
        """Outputs (outputs, n) of one design (parameters,) after another, on positions and tables that are looked at
        once.

        An array of parameters that is passed again is read in place. Outputs are read-only; those that nobody holds
        any more, nor a view of them, make room for the next ones. Raises ValueError for missing inputs, unequal
        lengths, and programs that take fields.
        """
        if self.program.fields:
            raise ValueError("only programs without fields are repeated")
        own, function = threading.local(), self._function
        inputs = self._inputs(positions, _NONE, None, tables)
        if inputs.stride != inputs.length:
            return lambda parameters: self.store(parameters[None, :], positions, tables=tables)[0]

        def run(parameters: Floats) -> Floats:
            call: SingleCall | None = getattr(own, "call", None)
            if call is None:
                call = own.call = SingleCall(self.program, inputs)
            call.set_parameters(parameters)
            out = call.free_out()
            function(call.address)
            return out

        return run

    def one_by_one(
        self,
        parameters: Floats,
        positions: Arrays,
        out: Floats,
        *,
        fields: Arrays = _NONE,
        tables: Tables | None = None,
    ) -> tuple[int, Integers, Integers]:
        """For those that call it themselves, kernels among them: the address of the code, the call block of the first
        design, and the addresses of the fields in it.

        Kernels move the addresses of the parameters and the fields on, by the bytes of a design. ``parameters``
        (designs, parameters), ``positions`` (n,), ``fields`` (designs, n) and ``out`` (outputs, n) are read and
        written where they lie; contiguous floats, they must live as long as the block is used, as must this program.
        """
        inputs = self._inputs(positions, fields, None, tables)
        if inputs.stride != inputs.length:
            raise ValueError(f"only programs of {self.width} or more positions")
        block = inputs.block(address_of(parameters), address_of(out))
        return ctypes.cast(self._function, ctypes.c_void_p).value or 0, block, inputs.fields_of(block)

    def store(
        self,
        parameters: ArrayLike,
        positions: Arrays,
        fields: Arrays = _NONE,
        *,
        threads: int = 1,
        length: int | None = None,
        tables: Tables | None = None,
    ) -> Floats:
        """Outputs of many designs, shape (designs, outputs, n).

        ``parameters``: (designs, parameters); ``fields``: (designs, n) per name; ``length``: n where no input
        is an array; ``tables``: those that the program looks up.
        """
        inputs = self._inputs(positions, fields, length, tables)
        table = self._table(parameters)
        out = aligned((len(table), len(self.program.outputs), inputs.stride))
        self._call(inputs, table, out, threads)
        stored: Floats = out[:, :, : inputs.length]
        return stored

    def sweep(
        self,
        parameters: ArrayLike,
        positions: Arrays,
        fields: Arrays = _NONE,
        *,
        threads: int = 1,
        length: int | None = None,
        tables: Tables | None = None,
    ) -> Results:
        """Reductions of many designs: ``output.kind`` and ``valid.count`` to (designs,) arrays.

        Inputs as for :meth:`store`. Where no position is valid: NaN, position number -1, count 0.
        """
        if self.accumulation is None:
            raise ValueError("this program was compiled without reductions: compile it with them to sweep")
        inputs = self._inputs(positions, fields, length, tables)
        table = self._table(parameters)
        sums = np.empty((len(table), self.accumulation.width))
        self._call(inputs, table, sums, threads)
        return self.accumulation.finish(sums, inputs.length)

    def _inputs(self, positions: Arrays, fields: Arrays, length: int | None, tables: Tables | None) -> Inputs:
        """The inputs of a call; those of the call before, where the same arrays are passed again."""
        names = self.program.tables if self.accumulation is None else self.accumulation.tables
        found = tables_in_order(names, tables)
        previous: Inputs | None = getattr(self._own, "inputs", None)
        if previous is None or not previous.fits(positions, fields, length, found):
            previous = Inputs(self.program, self.width, positions, fields, length=length, tables=found)
            self._own.inputs = previous if not previous.fields else None
        return previous

    def _table(self, parameters: ArrayLike) -> Floats:
        table = np.ascontiguousarray(parameters, dtype=np.float64)
        names = self.program.parameters if self.accumulation is None else self.accumulation.parameters
        wanted = len(names)
        if table.ndim != 2 or table.shape[1] != wanted:
            raise ValueError(f"parameters must have the shape (designs, {wanted}), but have {table.shape}")
        return table

    def _call(self, inputs: Inputs, table: Floats, out: Floats, threads: int) -> None:
        if inputs.length == 0 or len(table) == 0:
            out[...] = self.accumulation.start(len(table)) if self.accumulation is not None else np.nan
            return
        rows = {array.shape[0] for array in inputs.fields} - {len(table)}
        if rows:
            raise ValueError(f"fields must have one row per design, {len(table)}, but have {rows.pop()}")

        def work(first: int, after: int) -> None:
            block = inputs.block(
                address_of(table) + first * table.strides[0],
                address_of(out) + first * out.strides[0],
                first,
                after - first,
            )
            self._function(address_of(block))

        share = -(-len(table) // (threads * _CALLS_PER_THREAD))
        longest, shortest = _LONGEST_CALL // inputs.length, min(_SHORTEST_CALL // inputs.length, share)
        size, minimum = (max(1, designs // self.width) * self.width for designs in (longest, shortest))
        spread_over(len(table), size, threads, work, minimum=minimum)
