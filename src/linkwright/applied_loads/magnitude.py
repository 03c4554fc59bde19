"""How large a load is: a size within a phase."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from linkwright.applied_loads.phases import Always, InputPhase, MovingPhase, Phase, SwingPhase
from linkwright.applied_loads.signals import Course
from linkwright.applied_loads.site import Mechanism
from linkwright.applied_loads.sizes import Constant, One, OverCycle, Size, Twist
from linkwright.applied_loads.strokes import NEAR, TURN
from linkwright.core.outputs import Output
from linkwright.formula.trace import Scalar, select


@dataclass(frozen=True)
class Magnitude:
    """A size within a phase; zero outside.

    In files each has a key of its own: ``magnitude``, ``ramp`` or ``table`` for the size, ``phase``.
    """

    size: Size = One()
    phase: Phase = Always()

    @classmethod
    def of(cls, values: Mapping[str, Any]) -> Magnitude:
        """From values by the keys of a file."""
        sizes = (values[key] for key in ("magnitude", "ramp", "table") if values.get(key) is not None)
        return cls(next(sizes, One()), values.get("phase") or Always())

    @property
    def by_key(self) -> dict[str, Size | Phase]:
        """Values by the keys of a file."""
        found: dict[str, Size | Phase] = {self.size.key: self.size} if self.size.key else {}
        return found if isinstance(self.phase, Always) else {**found, "phase": self.phase}

    def at(self, course: Course) -> Scalar:
        """Its value; NaN where a table or a part of a stroke is too short."""
        acts, share, exists = self.phase.passed(course, self.size.ramp)
        return select(exists, select(acts, self.size.at(course, share), 0.0), float("nan"))

    @property
    def constant(self) -> bool:
        """Whether it is one number at all positions."""
        return isinstance(self.phase, Always) and isinstance(self.size, Constant | One)

    @property
    def has_formula(self) -> bool:
        """Whether a formula gives it."""
        return not isinstance(self.size, OverCycle)

    def traceable(self, mechanism: Mechanism) -> bool:
        """Whether its formula holds for designs and between positions as well: not for an interval longer than a
        turn, and not where it divides by an output, which may go through zero between two positions."""
        interval = self._of_turn
        if interval is not None and abs(interval.end - interval.start) > TURN + NEAR:
            return False
        outputs = self.size.outputs(mechanism)
        return None not in outputs and not (outputs and self.size.divides)

    @property
    def fallible(self) -> bool:
        """Whether designs may have no such value somewhere."""
        return self.size.fallible or self._of_turn is not None or self.phase.in_part

    @property
    def through_end(self) -> bool:
        """Whether the load acts through the end of a turn of the input."""
        return self._of_turn is not None and self._of_turn.end < self._of_turn.start

    @property
    def _of_turn(self) -> InputPhase | None:
        """The interval of a turn in which it acts."""
        return self.phase if isinstance(self.phase, InputPhase) and self.phase.across == "angle" else None

    @property
    def rate(self) -> Output | None:
        """The output by the sign of whose rate alone the load acts; None where it goes by something else."""
        return self.phase.output if isinstance(self.phase, MovingPhase) and not self.size.ramp else None

    @property
    def limits(self) -> MovingPhase | SwingPhase | None:
        """The phase where the load acts between limits of an output; None where it goes by something else."""
        if isinstance(self.phase, SwingPhase) or (isinstance(self.phase, MovingPhase) and self.size.ramp):
            return self.phase
        return None

    def outputs(self, mechanism: Mechanism) -> tuple[Output, ...]:
        """The outputs whose values it takes."""
        own = (each for each in self.size.outputs(mechanism) if each is not None)
        return tuple(dict.fromkeys((*own, *(self.phase.outputs if self.phase.in_part else ()))))

    def angles(self, mechanism: Mechanism) -> dict[tuple[str, str], float | None]:
        """The links a, b of which it takes the angle of b against a, with the angle (rad) near which that begins, or
        None: as the motion has it."""
        found = {("frame", each.owner): None for each in self.outputs(mechanism) if each.kind == "angle"}
        twist = {(self.size.a, self.size.b): self.size.near} if isinstance(self.size, Twist) else {}
        return {**found, **twist}

    @property
    def constants(self) -> dict[str, float]:
        """Its numbers that are no dimensions, by the names that ``Course.constant`` takes."""
        return {**self.size.constants, **self.phase.constants}
