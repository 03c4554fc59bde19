"""Comparisons by which forces switch (sign of a rate, phase of a load, time), held between events.

A right-hand side in which they are inputs is smooth, and their gaps tell where one of them goes over.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.formula.program import Program
from linkwright.formula.replay import Replay
from linkwright.formula.trace import Scalar, Trace

#: Rounds in which comparisons that go by forces which go by comparisons come to agree.
ROUNDS = 12


def switch_name(number: int) -> str:
    """Name of the input that holds a comparison: 1 where it is true, 0 where not."""
    return f"switch:{number}"


def gap_name(number: int) -> str:
    """Name of the output that is positive where the comparison is true."""
    return f"gap:{number}"


def gap_rate_name(number: int) -> str:
    """Name of the output that is the rate of that along the motion."""
    return f"gap_rate:{number}"


@dataclass(frozen=True)
class Switches:
    """The comparisons by which forces switch, by the numbers of their ``lines`` in the trace of a motion."""

    trace: Trace
    lines: tuple[int, ...]

    @classmethod
    def of(
        cls, trace: Trace, wanted: Iterable[Scalar], kinematic: Iterable[Scalar], seconds: Container[str]
    ) -> Switches:
        """All comparisons for ``wanted`` values that differ from position to position, but those that the
        ``kinematic`` ones need, which choose between formulas of one and the same position, and those that go by
        accelerations, inputs ``seconds``, which choose between formulas of one and the same force."""
        own = set(trace.needed([trace.lift(value) for value in kinematic]))
        late: set[int] = set()
        found = []
        for index in trace.needed([trace.lift(value) for value in wanted]):
            op, *args = trace.lines[index]
            if any(arg in late for arg in args) or (not args and trace.constant_and_name(index)[1] in seconds):
                late.add(index)
            elif op in ("less", "less_equal") and trace.varies[index] and index not in own:
                found.append(index)
        return cls(trace, tuple(found))

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the inputs that hold them."""
        return tuple(switch_name(number) for number in range(len(self.lines)))

    def program(self, outputs: Mapping[str, Scalar | bool]) -> tuple[Program, dict[int, int]]:
        """The program of outputs of the trace, and the numbers of the switches in it by its lines."""
        order = self.trace.needed([self.trace.lift(value) for value in outputs.values()])
        number = {line: number for number, line in enumerate(self.lines)}
        return Program.of(self.trace, outputs), {k: number[line] for k, line in enumerate(order) if line in number}


def agreeing(
    gaps: Callable[[Mapping[str, Floats]], Floats], switches: Sequence[str], count: int
) -> dict[str, Floats]:
    """The comparisons, 1 or 0 at ``count`` positions, that agree with their ``gaps`` (switches, count), which go by
    forces that may go by comparisons."""
    held: dict[str, Floats] = dict.fromkeys(switches, np.zeros(count))
    for _round in range(ROUNDS if switches else 0):
        again = {name: (row > 0.0).astype(float) for name, row in zip(switches, gaps(held), strict=True)}
        if all(np.array_equal(again[name], held[name]) for name in switches):
            break
        held = again
    return held


class Held(Replay):
    """A program written into a trace, its comparisons ``held`` as inputs; ``gaps`` of these by name."""

    def __init__(self, program: Program, held: Mapping[int, int], trace: Trace, inputs: Mapping[str, Scalar]) -> None:
        self.held = held
        self.gaps: dict[str, Scalar] = {}
        super().__init__(program, trace=trace, inputs=inputs)

    def write(self, index: int) -> None:
        number = self.held.get(index)
        if number is None:
            super().write(index)
            return
        low, high = (self.values[arg] for arg in self.program.nodes[index].args)
        self.gaps[gap_name(number)] = self.trace.sub(high, low)
        self.values[index] = self.trace.compare("less", 0.5, self.trace.position(switch_name(number)))
