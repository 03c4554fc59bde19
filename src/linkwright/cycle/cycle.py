"""What is wanted of the cycles of a machine, in formulas of one position: signals, what goes to and fro, bends.

``Solved(Cycle(machine, parts), designs)`` serves one machine and thousands of designs: pieces of all designs lie
behind each other, whatever pattern of events each has.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from functools import cached_property
from typing import NamedTuple

import numpy as np

from linkwright.core.arrays import Indices
from linkwright.core.outputs import Output, RelativeAngle
from linkwright.cycle.block import Swings
from linkwright.cycle.loads import input_end
from linkwright.cycle.machine import VALID, Machine
from linkwright.cycle.summary import StrokeSummary, Summary
from linkwright.events.formula import Formula
from linkwright.formula.trace import Scalar, absolute
from linkwright.kinetostatics.friction import FrictionTerm
from linkwright.loads.phases import MovingPhase, SwingPhase

#: Sides of a signal on which its summaries lie.
SIDES: Mapping[str, tuple[float, ...]] = {
    "max": (1.0,), "min": (-1.0,), "peak": (1.0, -1.0), "range": (1.0, -1.0), "argmax": (1.0,), "argmin": (-1.0,),
}  # fmt: skip
EVEN = ("mean", "rms", "excess")
#: A side of a signal: its number, sign, and the output on whose rising or falling strokes it is asked for.
Side = tuple[int, float, tuple[Output, str] | None]


class Signal(NamedTuple):
    """An output in the user's words, or its square."""

    words: str
    squared: bool = False

    def __str__(self) -> str:
        return f"{self.words}²" if self.squared else self.words


class Cycle:
    """What is wanted of a machine: ``parts``, its summaries.

    ``limited``: outputs whose places and extremes are those of their limit positions; ``never``: outputs by whose
    reversals designs are told apart; ``even``: signals that pieces meet everywhere.
    """

    def __init__(
        self,
        machine: Machine,
        parts: Iterable[Summary],
        limited: Collection[Output] = (),
        never: Iterable[Output] = (),
        even: Iterable[str] = (),
    ) -> None:
        self.machine = machine
        self.parts = {part.name: part for part in parts}
        self.limited = {
            text: output
            for text, part in self.parts.items()
            if type(part) is Summary and part.kind in ("max", "min", "range", "argmax", "argmin")
            for output in [machine.meant(part.output)] if output in limited
        }  # fmt: skip
        self.on_strokes = {
            text: (machine.meant(part.by), part.way)
            for text, part in self.parts.items()
            if isinstance(part, StrokeSummary)
        }
        signals = {text: part for text, part in self.parts.items() if text not in self.limited}
        self.words = {text: self._signal(part.output, part.kind) for text, part in signals.items()}
        self.even_words = tuple(Signal(each) for each in dict.fromkeys(even))
        self._trace(tuple(dict.fromkeys([*self.words.values(), *self.even_words])), signals)
        self.never = tuple(dict.fromkeys(never))
        self._follow()

    def _signal(self, words: str, kind: str) -> Signal:
        """The signal from which a summary is found: of sizes their square where that tells as much."""
        squared = kind in ("max", "peak", "rms", "argmax") and self.machine.traces.square(words) is not None
        return Signal(words, squared)

    def _trace(self, signals: tuple[Signal, ...], parts: Mapping[str, Summary]) -> None:
        """The formula of all signals, and what its pieces must be met for."""
        traces = self.machine.traces
        kinds: dict[tuple[str, bool], list[int]] = {}
        for k, each in enumerate(signals):
            kinds.setdefault((traces.quantity(each.words).dimension, each.squared), []).append(k)
        self.alike: list[Indices] = [np.array(rows) for rows in kinds.values() if len(rows) > 1]
        self.formula = self.machine.formula(("signals", signals), lambda: self._outputs(signals))
        self.number = {each: k for k, each in enumerate(signals)}
        even = [self.number[self.words[text]] for text, part in parts.items() if part.kind in EVEN]
        self.even = tuple(dict.fromkeys([*even, *(self.number[each] for each in self.even_words)]))
        numbers: dict[Side, int] = {}
        self.sides_of: dict[str, tuple[int, ...]] = {}
        for text, part in parts.items():
            own = self.words[text]
            signs = (1.0,) if own.squared and part.kind == "peak" else SIDES.get(part.kind, ())
            stroke = self.on_strokes.get(text)
            sides = [(self.number[own], sign, stroke) for sign in signs]
            self.sides_of[text] = tuple(numbers.setdefault(side, len(numbers)) for side in sides)
        self.sides = tuple(numbers)

    def _outputs(self, signals: Iterable[Signal]) -> dict[str, Scalar]:
        traces = self.machine.traces
        found: dict[str, Scalar] = {}
        for each in signals:
            square = traces.square(each.words) if each.squared else None
            found[str(each)] = traces.quantity(each.words).value if square is None else square
        return {**found, VALID: traces.valid()}

    def _follow(self) -> None:
        """What goes to and fro: ``whole``, where loads find limits over more than the course."""
        machine, loads = self.machine, self.machine.mechanism.loads.values()
        phases = [load.magnitude.phase for load in loads]
        swung = [each.output for each in phases if isinstance(each, SwingPhase)]
        moving = [each.output for each in phases if isinstance(each, MovingPhase)]
        turned = machine.turned if swung or moving else None
        reversing = [load.reverses(machine.mechanism) for load in loads]
        opposed = [each for each in reversing if isinstance(each, Output)]
        pairs = [each for each in reversing if isinstance(each, RelativeAngle)]
        terms: list[RelativeAngle | FrictionTerm] = [*pairs, *machine.terms]
        turning = [each for each in terms if machine.swings(each)]
        driven = [output for output, _ in self.on_strokes.values()]
        asked = [*opposed, *driven, *self.limited.values(), *self.never]
        own = [*moving, *asked] if turned else [*swung, *moving, *asked]
        valued = self.limited.values() if turned else [*self.limited.values(), *swung]
        self.swings = Swings(machine, dict.fromkeys([*own, *turning]), valued)
        self.whole = Swings(turned, dict.fromkeys([*swung, *moving]), swung) if turned else None
        self.bending = tuple(dict.fromkeys([*opposed, *driven, *moving, *turning]))
        self.signed = self._signed()

    def _signed(self) -> Formula | None:
        """Forces, N, at whose zeros the signals bend: those that press guides with friction, and between teeth."""
        programs, trace = self.machine.traces.programs, self.machine.traces.motion.trace
        if not programs.signed:
            return None
        outputs = self._outputs(self.number)
        needed = set(trace.needed([trace.lift(value) for value in outputs.values()]))
        bending = {
            name: force
            for name, force in programs.signed.items()
            if programs.friction is not None or trace.lift(absolute(force)) in needed
        }
        return self.machine.varying(("signed", tuple(bending)), lambda: bending)

    @cached_property
    def columns(self) -> frozenset[str]:
        """The dimensions that vary on which anything depends."""
        machine = self.machine
        formulas = [self.formula, *self.swings.formulas, *(machine.bends() or ())]
        ends = {input_end(name, which) for name in machine.phases for which in (0, 1)}
        taken = machine.taken([*formulas, *([self.signed] if self.signed else [])])
        return taken | (ends & frozenset(machine.varied))
