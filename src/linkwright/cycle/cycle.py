"""What is wanted of the cycles of a machine, in formulas of one position: signals, what goes to and fro, bends.

``Solved(Cycle(machine, parts), designs)`` serves one machine and thousands of designs: pieces of all designs lie
behind each other, whatever pattern of events each has.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from functools import cached_property

import numpy as np

from linkwright.applied_loads.phases import MovingPhase, SwingPhase
from linkwright.core.arrays import Indices
from linkwright.core.outputs import Output, RelativeAngle
from linkwright.cycle.block import Swings
from linkwright.cycle.loads import input_end
from linkwright.cycle.machine import VALID, Machine
from linkwright.cycle.summaries import OF_LIMITS, Asked, Signal
from linkwright.cycle.summary import StrokeSummary, Summary
from linkwright.events.formula import Formula
from linkwright.formula.trace import Scalar, absolute
from linkwright.kinetostatics.friction import FrictionTerm
from linkwright.kinetostatics.load_site import acts_name


class Cycle(Asked):
    """What is wanted of a machine: ``parts``, its summaries.

    ``limited``: outputs whose places and extremes are those of their limit positions; ``never``: outputs by whose
    reversals designs are distinguished; ``even``: signals that pieces meet everywhere; ``bent``: one may
    bend where it is zero, between two nodes of neighbours.
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
        every = {part.name: part for part in parts}
        found = {
            text: output
            for text, part in every.items()
            if type(part) is Summary and part.kind in OF_LIMITS
            for output in [machine.meant(part.output)]
            if output in limited
        }
        strokes = {
            text: (machine.meant(part.by), part.way)
            for text, part in every.items()
            if isinstance(part, StrokeSummary)
        }
        words = {text: self._signal(each.output, each.kind) for text, each in every.items() if text not in found}
        super().__init__(every, words, found, strokes, map(Signal, dict.fromkeys(even)))
        signals, traces = tuple(self.number), machine.traces
        kinds: dict[tuple[str, bool], list[int]] = {}
        for k, each in enumerate(signals):
            kinds.setdefault((traces.quantity(each.words).dimension, each.squared), []).append(k)
        self.bent = any(not each.squared and traces.square(each.words) is not None for each in signals)
        self.same_dimension: list[Indices] = [np.array(rows) for rows in kinds.values() if len(rows) > 1]
        self.formula = machine.formula(("signals", signals), lambda: self._outputs(signals))
        self.never = tuple(dict.fromkeys(never))
        self._follow()

    def _signal(self, words: str, kind: str) -> Signal:
        """The signal from which a summary is found: of sizes their square where that tells as much."""
        squared = kind in ("max", "peak", "rms", "argmax") and self.machine.traces.square(words) is not None
        return Signal(words, squared)

    def _outputs(self, signals: Iterable[Signal]) -> dict[str, Scalar]:
        traces = self.machine.traces
        found: dict[str, Scalar] = {}
        for each in signals:
            square = traces.square(each.words) if each.squared else None
            found[str(each)] = traces.quantity(each.words).value if square is None else square
        return {**found, VALID: traces.valid()}

    def _follow(self) -> None:
        """What oscillates: ``full``, where loads find limits over more than the course."""
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
        self.full = Swings(turned, dict.fromkeys([*swung, *moving]), swung) if turned else None
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
        formulas = [self.formula, *self.swings.formulas, *(machine.kinks() or ())]
        formulas += [self.signed] if self.signed else []
        acting = {name for name in machine.phases for each in formulas if acts_name(name) in each.columns}
        ends = {input_end(name, which) for name in acting for which in (0, 1)}
        return machine.taken(formulas) | (ends & frozenset(machine.varied))
