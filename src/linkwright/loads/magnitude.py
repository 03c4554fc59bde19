"""How large a load is: a size within a phase."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output
from linkwright.engine.trace import Scalar, select
from linkwright.loads.course import Course
from linkwright.loads.phases import Always, Phase
from linkwright.loads.site import Mechanism
from linkwright.loads.sizes import Constant, One, Size
from linkwright.loads.strokes import BetweenLimits


@dataclass(frozen=True)
class Magnitude:
    """A size within a phase; zero outside.

    In files each has a key of its own: ``magnitude``, ``ramp`` or ``table`` for the size, ``phase``.
    """

    size: Size = One()
    phase: Phase = Always()

    @classmethod
    def of(cls, given: Mapping[str, Any]) -> Magnitude:
        """From what is given under the keys of a file."""
        sizes = (given[key] for key in ("magnitude", "ramp", "table") if given.get(key) is not None)
        return cls(next(sizes, One()), given.get("phase") or Always())

    @property
    def by_key(self) -> dict[str, Size | Phase]:
        """What is given under the keys of a file."""
        found: dict[str, Size | Phase] = {self.size.key: self.size, "phase": self.phase}
        return {key: each for key, each in found.items() if key and not isinstance(each, Always)}

    def at(self, course: Course) -> Scalar:
        """Its value; NaN where a table or a part of a stroke is too short."""
        acts, share, exists = self.phase.passed(course, self.size.ramp)
        return select(exists, select(acts, self.size.at(course, share), 0.0), float("nan"))

    @property
    def constant(self) -> bool:
        """Whether it is one number at all positions."""
        return isinstance(self.phase, Always) and isinstance(self.size, Constant | One)

    def traceable(self, mechanism: Mechanism) -> bool:
        """Whether its formula holds for designs and between positions as well."""
        return self.phase.traceable and self.size.traceable(mechanism)

    @property
    def fallible(self) -> bool:
        """Whether designs may have no such value somewhere."""
        return self.size.fallible or self.phase.fallible

    @property
    def rate(self) -> Output | None:
        """The output by the sign of whose rate alone the load acts; None where it goes by something else."""
        return self.phase.rate(self.size.ramp)

    @property
    def limits(self) -> BetweenLimits | None:
        """The limits of an output between which the load acts; None where it goes by something else."""
        return self.phase.limits(self.size.ramp)

    def outputs(self, mechanism: Mechanism) -> tuple[Output, ...]:
        """The outputs whose values it takes."""
        return tuple(dict.fromkeys((*self.size.outputs(mechanism), *self.phase.valued)))

    def angles(self, mechanism: Mechanism) -> dict[tuple[str, str], float | None]:
        """The links a, b of which it takes the angle of b against a, with the angle (rad) near which that begins, or
        None: as the motion has it."""
        own = (each.owner for each in self.outputs(mechanism) if each.kind == "angle")
        return {**{("frame", link): None for link in own}, **self.size.angles}

    @property
    def constants(self) -> dict[str, float]:
        """Its numbers that are no dimensions, by the names that ``Course.constant`` takes."""
        return {**self.size.constants, **self.phase.constants}
