"""Demands on layers in sentences."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

from linkwright.collisions.gaps import Gap
from linkwright.core.quantity import length_text, shown
from linkwright.layering.arrangement import Conflict
from linkwright.layering.problem import Apart, Demand, Fixed, Part, Problem
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _


@dataclass(frozen=True)
class Sentences:
    """What demands of a problem say, in the words of a machine."""

    mechanism: Mechanism
    problem: Problem

    def conflict(self, demand: Demand) -> Conflict:
        """A demand that contradicts others."""
        if isinstance(demand, Fixed):
            return Conflict(demand.plate, "", None, self._fixed(demand))
        if isinstance(demand, Apart):
            return Conflict(demand.first, demand.second, demand.gap, self._apart(demand))
        sentence = _("{first} and {second} touch in one layer", first=demand.first, second=demand.second)
        return Conflict(demand.first, demand.second, None, sentence)

    def _fixed(self, demand: Fixed) -> Message:
        if demand.layer is None:
            return _("{plate} is in all layers", plate=demand.plate)
        return _("{plate} is fixed in layer {layer}", plate=demand.plate, layer=demand.layer)

    def _apart(self, demand: Apart) -> Message:
        first, second = self._body(demand.first, demand.parts[0]), self._body(demand.second, demand.parts[1])
        gap = demand.gap
        if gap is None or gap.size <= 0.0:
            return _("{first} runs over {second}{where}", first=first, second=second, where=self._where(gap))
        return _(
            "{first} comes to {gap} from {second}{where}",
            first=first,
            gap=length_text(gap.size, 4),
            second=second,
            where=self._where(gap),
        )

    def _body(self, name: str, part: Part) -> Message | str:
        plates = self.problem.bodies[name]
        if part == "heads":
            return _("a head of {name}", name=name)
        return _("{name} (through {plates})", name=name, plates=plates) if len(plates) > 1 else name

    def _where(self, gap: Gap | None) -> Message | str:
        if gap is None:
            return ""
        if isfinite(gap.input):
            return _(" at an input of {input}", input=shown(gap.input, self.mechanism.across, 4))
        return _(" at {time}", time=shown(gap.time, "time", 4))
