"""A program on buffers that stay, for those that evaluate it point after point: integrators above all."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.formula import machine_code
from linkwright.formula.ir_kernel import ENTRY, kernel
from linkwright.formula.llvm_backend import Inputs, address_of, aligned, available
from linkwright.formula.machine_code import OF_ONE_ADDRESS, loaded_code
from linkwright.formula.numpy_backend import numpy_program
from linkwright.formula.program import Lines, Program
from linkwright.formula.scalar_backend import ScalarProgram
from linkwright.formula.table import Tables, tables_in_order

#: A call that keeps the lock of the interpreter: to give it back and take it again costs more than a short program.
_KEEPS_LOCK = ctypes.PYFUNCTYPE(None, ctypes.c_void_p)
#: From this number of lanes on the lock is given back.
_MANY_LANES = 256


class RightSide:
    """A program with its inputs and outputs where they lie: set :attr:`x`, :attr:`call`, read :attr:`out`.

    ``x``: (inputs,) or (inputs, lanes); ``out``: (outputs,) or (outputs, lanes), in the order of
    ``program.output_names``; ``inputs``: the row of ``x`` of every position and field of the program. ``numbers``:
    (parameters,), in the order of ``program.parameters``, equal in all lanes; may be changed between calls.
    ``compiled``: whether it is machine code; NumPy (one point: Python's floats) otherwise. Not for several threads
    at once.
    """

    def __init__(
        self,
        program: Program,
        numbers: Mapping[str, float],
        *,
        lanes: int | None = None,
        tables: Tables | None = None,
        first: Sequence[str] = (),
        compiled: bool | None = None,
    ) -> None:
        """``numbers``: values of the parameters; those of inputs are where ``x`` begins (others begin at 0).

        ``lanes``: points evaluated at once; None for one, without an axis. ``tables``: those that the program looks
        up. ``first``: names of inputs that have the first rows of ``x``, in this order, even where the program does
        not use them. ``compiled``: None where a compiler can be loaded. Raises ValueError for missing numbers and
        tables.
        """
        missing = [name for name in program.parameters if name not in numbers]
        if missing:
            raise ValueError(f"the program needs the numbers {', '.join(missing)}: give them")
        self.program = program.with_inputs(program.fields, "position") if program.fields else program
        self.lanes = lanes
        self.inputs = {name: row for row, name in enumerate(dict.fromkeys((*first, *self.program.positions)))}
        self.numbers: Floats = np.array([numbers[name] for name in program.parameters], dtype=np.float64)
        shape = () if lanes is None else (lanes,)
        self.x, self.out = aligned((len(self.inputs), *shape)), aligned((len(program.outputs), *shape))
        for name, row in self.inputs.items():
            self.x[row] = numbers.get(name, 0.0)
        self.compiled = available() if compiled is None else compiled
        #: Addresses of the code and of its call block, for kernels that call it; 0 and 0 where not compiled.
        self.addresses = (0, 0)
        self.call: Callable[[], object]
        """Evaluates ``x`` into ``out``."""
        if self.compiled:
            self._compile(tables)
        else:
            self.call = self._by_floats(tables) if lanes is None else self._by_numpy(tables)

    def set_inputs(self, values: Mapping[str, float | Floats]) -> None:
        """Sets inputs by name, those that the program has; (lanes,) or one number each."""
        for name, value in values.items():
            if name in self.inputs:
                self.x[self.inputs[name]] = value

    def _compile(self, tables: Tables | None) -> None:
        """Lanes as wide as the processor's; one number wide for few, which then need not be padded."""
        program, lanes = self.program, self.lanes or 1
        width = machine_code.host().width
        if lanes < width:
            width = 1
        code = loaded_code(f"{program.key} lanes {width}", lambda: kernel(Lines.of(program), width, None), ENTRY)
        x = self.x.reshape(-1, lanes)
        rows = {name: x[self.inputs[name]] for name in program.positions}
        found = tables_in_order(program.tables, tables)
        inputs = Inputs(program, width, rows, {}, length=lanes, tables=found)
        block = inputs.block(address_of(self.numbers), address_of(self.out))
        function = code.function(ENTRY, _KEEPS_LOCK if lanes < _MANY_LANES else OF_ONE_ADDRESS)
        function.read = (block, inputs, self.numbers, self.x, self.out)  # these live as long as the function
        self.addresses = ctypes.cast(function, ctypes.c_void_p).value or 0, address_of(block)
        self.call = partial(function, self.addresses[1])

    def _by_floats(self, tables: Tables | None) -> Callable[[], object]:
        evaluator = ScalarProgram(self.program, tables)
        x, out, numbers = self.x, self.out, self.numbers
        rows = np.array([self.inputs[name] for name in self.program.positions], dtype=np.intp)

        def call() -> None:
            out[:] = evaluator.step(numbers.tolist(), x[rows].tolist())

        return call

    def _by_numpy(self, tables: Tables | None) -> Callable[[], object]:
        evaluator = numpy_program(self.program)
        rows = {name: self.x[self.inputs[name]] for name in self.program.positions}
        out, numbers, lanes = self.out, self.numbers, self.lanes

        def call() -> None:
            out[...] = evaluator.run(numbers, rows, length=lanes, tables=tables)

        return call


def state_slopes(right: RightSide, freedoms: int) -> Callable[[float, Floats], Floats]:
    """f(t, y) as SciPy's integrators call it, y = (coordinates, rates, work) of 2 · ``freedoms`` + 1 numbers.

    ``right`` must have coordinates, rates and time as its first inputs, in this order, and accelerations and power as
    its first outputs. Other inputs (switches, dimensions) are read from ``right.x`` as they are at a call.
    """
    n, x, out, call = freedoms, right.x, right.out, right.call
    state, rates, found = x[: 2 * n], slice(n, 2 * n), out[: n + 1]

    def slopes(t: float, y: Floats) -> Floats:
        state[:] = y[: 2 * n]
        x[2 * n] = t
        call()
        dy = np.empty(2 * n + 1)
        dy[:n] = y[rates]
        dy[n:] = found
        return dy

    return slopes
