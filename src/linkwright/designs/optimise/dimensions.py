"""Dimensions as quantities of a problem: varied ones, and masses that follow from the shapes of links."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.designs.traced_outputs import design_table
from linkwright.formula.gradient import forward
from linkwright.formula.numpy_backend import numpy_program
from linkwright.formula.program import Program
from linkwright.formula.trace import Trace
from linkwright.kinematics.dimensions import Dimensions
from linkwright.mechanism.mechanism import Mechanism


class HeldDimensions:
    """Values (designs,) of the dimensions ``names`` where others, the ``addresses``, vary, and their gradients."""

    def __init__(self, mechanism: Mechanism, addresses: Sequence[str], names: Sequence[str]) -> None:
        self.known, self.names = mechanism.dimensions(), tuple(names)
        trace = Trace()
        dimensions = Dimensions(mechanism, trace, frozenset(addresses))
        self._program = Program.of(trace, {name: dimensions(name) for name in self.names})

    def values(self, columns: Mapping[str, Floats]) -> dict[str, Floats]:
        """By the names."""
        return self._evaluated(self._program, columns) if self.names else {}

    def slopes(self, columns: Mapping[str, Floats], by: tuple[str, ...]) -> dict[str, Floats]:
        """Gradients (designs, k) of the names by the addresses ``by``."""
        if not self.names:
            return {}
        found = self._evaluated(self._slopes, columns)
        none = np.zeros(len(next(iter(columns.values()))))
        return {
            name: np.stack([found.get(f"{name}|{address}", none) for address in by], axis=1) for name in self.names
        }

    @cached_property
    def _slopes(self) -> Program:
        return forward(self._program, self._program.parameters)

    def _evaluated(self, program: Program, columns: Mapping[str, Floats]) -> dict[str, Floats]:
        table = design_table(program.parameters, self.known, columns)
        values = numpy_program(program).run_designs(table, {}, length=1)[:, :, 0]
        return dict(zip(program.output_names, values.T, strict=True))
