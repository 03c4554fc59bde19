"""Evaluation by compiled code: all positions of one or many designs in one call, and what it is called with."""

from __future__ import annotations

import ctypes
import math
import threading
from collections.abc import Callable, Mapping
from ctypes import addressof, c_char
from sys import getrefcount
from typing import Any, TypeGuard

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats, Integers
from linkwright.formula import machine_code
from linkwright.formula.ir_kernel import ENTRY, Block, kernel
from linkwright.formula.machine_code import available, loaded_code
from linkwright.formula.program import Lines, Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.reductions import Accumulation, Results
from linkwright.formula.table import Table, Tables, tables_in_order
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


_LINE = 64  # bytes of a cache line


def address_of(array: Floats | Integers) -> int:
    """Where an array's first number lies."""
    return int(array.__array_interface__["data"][0])


def aligned(shape: tuple[int, ...]) -> Floats:
    """An uninitialised C-contiguous array that starts at a cache line."""
    return _at_a_line(shape)[0]


def _at_a_line(shape: tuple[int, ...]) -> tuple[Floats, int]:
    """Such an array and its address."""
    room: Any = np.empty(math.prod(shape) + _LINE // 8)
    address = addressof(c_char.from_buffer(room))
    skipped = -address % _LINE
    return np.ndarray(shape, np.float64, room, skipped), address + skipped


class _Lent:
    """Read-only outputs in other hands."""

    __slots__ = ("_room", "address", "rows")

    def __init__(self, shape: tuple[int, ...]) -> None:
        self.rows, self.address = _at_a_line(shape)
        self.rows.setflags(write=False)
        self._room = self.rows.base  # which every view of them holds

    def holders(self) -> int:
        """:data:`_UNHELD`, and one more for every other holder of the outputs or of a view of them."""
        return getrefcount(self.rows) + getrefcount(self._room)


_UNHELD = _Lent((1,)).holders()


class Inputs:
    """Positions and fields of a program as contiguous arrays of one length.

    ``length``: n; ``stride``: the length of the rows that the code sees, which is never below
    the vector width (the last value is repeated).
    """

    def __init__(
        self,
        program: Program,
        width: int,
        positions: Arrays,
        fields: Arrays,
        *,
        length: int | None = None,
        tables: list[Table] | None = None,
    ) -> None:
        self._bound_positions = [(name, positions[name]) for name in program.positions if name in positions]
        self._bound_fields = [(name, fields[name]) for name in program.fields if name in fields]
        self.positions = _taken("position", program.positions, positions)
        self.fields = _taken("field", program.fields, fields)
        bound, used = (*self._bound_positions, *self._bound_fields), (*self.positions, *self.fields)
        self._unconverted = bool(bound) and all(own is each for own, (_, each) in zip(used, bound, strict=True))
        self._tables = list(tables or [])
        self._numbers = [table.numbers for table in self._tables]
        lengths = {array.shape[-1] for array in used}
        if length is not None:
            lengths.add(length)
        if not lengths:
            lengths = {np.shape(array)[-1] for array in positions.values()}
        if len(lengths) != 1:
            raise ValueError(f"inputs over the positions must have one length, but have {sorted(lengths)}")
        self.length = lengths.pop()
        self.width = width
        self.stride = self.length
        if 0 < self.length < width:
            self.stride = width
            self.positions = [_padded(array, width) for array in self.positions]
            self.fields = [_padded(array, width) for array in self.fields]
        self._template = self._unaddressed()

    def fits(self, positions: Arrays, fields: Arrays, length: int | None, tables: list[Table]) -> bool:
        """Whether these are the same arrays and tables, read where they lie."""
        return (
            self._unconverted
            and (length is None or length == self.length)
            and all(positions.get(name) is array for name, array in self._bound_positions)
            and all(fields.get(name) is array for name, array in self._bound_fields)
            and all(own is each for own, each in zip(self._tables, tables, strict=True))
        )

    def _unaddressed(self) -> Integers:
        """What all call blocks have in common."""
        full, rest = divmod(self.length, self.width)
        if full:
            tail = (self.length - self.width, self.width - rest, self.width) if rest else (-1, 0, 0)
        else:
            tail = (0, 0, rest)
        sources = [address_of(array) for array in (*self.positions, *self.fields, *self._numbers)]
        block = np.zeros(Block.INPUTS + len(sources), dtype=np.int64)
        block[Block.LENGTH], block[Block.COUNT], block[Block.FULL_END] = (self.stride, self.length, full * self.width)
        block[Block.TAIL_START], block[Block.TAIL_LOW], block[Block.TAIL_HIGH] = tail
        block[Block.INPUTS :] = sources
        return block

    def block(self, parameters: int, out: int, first: int = 0, designs: int = 1) -> Integers:
        """The call block for some designs from number ``first`` on; addresses as numbers."""
        block = self._template.copy()
        block[Block.DESIGNS], block[Block.PARAMETERS] = designs, parameters
        block[Block.OUT] = out
        if first and self.fields:
            self.fields_of(block)[:] += 8 * first * self.stride
        return block

    def fields_of(self, block: Integers) -> Integers:
        """The addresses of the fields in a call block."""
        place = Block.INPUTS + len(self.positions)
        return block[place : place + len(self.fields)]


def _taken(kind: str, names: tuple[str, ...], arrays: Arrays) -> list[Floats]:
    missing = [name for name in names if name not in arrays]
    if missing:
        raise ValueError(f"the program needs the {kind} inputs {', '.join(missing)}: give them")
    return [np.ascontiguousarray(arrays[name], dtype=np.float64) for name in names]


def _padded(array: Floats, width: int) -> Floats:
    missing = width - array.shape[-1]
    return np.concatenate([array, np.repeat(array[..., -1:], missing, axis=-1)], axis=-1)


def _is_plain(array: object, shape: tuple[int, ...]) -> TypeGuard[Floats]:
    return (
        isinstance(array, np.ndarray)
        and array.shape == shape
        and array.dtype == np.float64
        and bool(array.flags.c_contiguous)
    )


class SingleCall:
    """A call for one design on inputs that stay where they are."""

    def __init__(self, program: Program, inputs: Inputs) -> None:
        self._own: Floats = np.empty(len(program.parameters))
        self._last_parameters: object = None
        self._bound: object = None
        self._lent: _Lent | None = None
        self._block = inputs.block(address_of(self._own), 0)
        self.address = address_of(self._block)
        self.shape = (len(program.outputs), inputs.length)

    def set_parameters(self, parameters: ArrayLike) -> None:
        """The design: copied, or read in place if the same array is passed repeatedly."""
        if parameters is self._bound:
            return
        if parameters is self._last_parameters and _is_plain(parameters, self._own.shape):
            self._bound = parameters
            self._block[Block.PARAMETERS] = address_of(parameters)
            return
        if np.shape(parameters) != self._own.shape:
            raise ValueError(f"parameters must have the shape {self._own.shape}, not {np.shape(parameters)}")
        if self._bound is not None:
            self._bound = None
            self._block[Block.PARAMETERS] = address_of(self._own)
        self._last_parameters = parameters
        self._own[:] = parameters

    def free_out(self) -> Floats:
        """Read-only outputs: those before where neither they nor a view of them are held any more, else new ones."""
        lent = self._lent
        if lent is None or lent.holders() > _UNHELD:
            lent = self._lent = _Lent(self.shape)
            self._block[Block.OUT] = lent.address
        return lent.rows
