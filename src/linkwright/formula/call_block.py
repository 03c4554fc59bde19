"""What a compiled program is called with: numbers and addresses in one array."""

from __future__ import annotations

import math
from collections.abc import Mapping
from ctypes import addressof, c_char
from sys import getrefcount
from typing import Any, TypeGuard

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats, Integers
from linkwright.formula.ir_module import Block
from linkwright.formula.program import Program
from linkwright.formula.table import Table

Arrays = Mapping[str, ArrayLike]
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
