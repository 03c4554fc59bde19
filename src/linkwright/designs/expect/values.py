"""What the subjects of expectations come to in a machine, exact between the positions of its cycle."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from linkwright import units
from linkwright.analysis import Analysis
from linkwright.analysis.by_name import Asked as OfOutput
from linkwright.analysis.by_name import is_summary, needs_forces, wanted
from linkwright.analysis.evaluate import unloaded
from linkwright.analysis.outputs import usual_output
from linkwright.core.arguments import STEPS
from linkwright.core.outputs import PLACES, Output
from linkwright.designs.alternatives import Alternative
from linkwright.designs.criteria import criterion
from linkwright.designs.expect.facts import FACTS
from linkwright.designs.expect.section import Asked
from linkwright.designs.ranges import dimension_of
from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import output_meant
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.run import solve_forces
from linkwright.machine.flywheel import FLUCTUATION
from linkwright.mechanism.mechanism import Mechanism
from linkwright.units import powers
from linkwright.words import _

#: What changes by less than this, rad or shares of the machine's size, rests.
RESTING = 1e-9
#: The metric that is about how much of a cycle can be passed.
RANGE = "range_of_motion"


class Value(NamedTuple):
    """A word, or a number, SI, of a dimension with its ``name`` where it has one; ``last``: the largest of an output
    over the cycle, whose smallest is the number; ``turns``: whether full turns count for nothing."""

    number: float | str
    kind: units.Dimension = units.NONE
    name: str = ""
    last: float | None = None
    turns: bool = False


@dataclass(eq=False)
class _Machine(Alternative):
    """The machine over its cycle: ``forced``: with its forces; ``in_part``: over what it reaches of the cycle."""

    forced: bool = False
    in_part: bool = False

    @cached_property
    def motion(self) -> Motion:
        return solve_motion(self.mechanism, steps=self.steps, failures="mark" if self.in_part else "raise")

    @cached_property
    def analysis(self) -> Analysis:
        return Analysis.of(self.forces if self.forced else self.motion)


@dataclass(frozen=True)
class Values:
    """Finds values of one machine; what they share is solved once. ``in_part``: its cycle is not passed, and that is
    expected, so that values are those of what it reaches."""

    mechanism: Mechanism
    in_part: bool = False

    @cached_property
    def _output(self) -> Output:
        return usual_output(self.mechanism)

    @cached_property
    def _machines(self) -> dict[tuple[bool, bool], Alternative]:
        return {}

    def _machine(self, *, forces: bool, in_part: bool) -> Alternative:
        """The machine solved with its forces, or without."""
        key = forces, in_part
        if key not in self._machines:
            name, output = self.mechanism.name, self._output
            self._machines[key] = _Machine(
                name, self.mechanism, output, STEPS, FLUCTUATION, forced=forces, in_part=in_part
            )
        return self._machines[key]

    @cached_property
    def _dimensions(self) -> dict[str, float]:
        return self.mechanism.dimensions()

    def of(self, asked: Asked) -> Value:
        """The value of an entry's subject; raises LinkwrightError where it has none."""
        subject = asked.subject
        if subject.fact:
            return Value(FACTS[subject.fact].find(self.mechanism))
        if subject.at is not None:
            return self._at(asked)
        if subject.output is not None:
            low, high = (self._number(f"{asked.of} {end}") for end in ("min", "max"))
            return low._replace(last=float(high.number))
        found = {name: self._number(each) for name, each in (subject.numbers or {}).items()}
        if subject.expression is None:
            return found[""]
        kind = subject.expression.dimension({name: each.kind for name, each in found.items()})
        return Value(subject.expression.evaluate({name: float(each.number) for name, each in found.items()}), kind)

    def rests(self, asked: Asked) -> bool:
        """Whether an entry is on a place, over the cycle or at an extreme, that is the same all over it."""
        subject, words = asked.subject, asked.of
        if subject.output is None:
            name = (subject.numbers or {}).get("", "")
            if subject.expression is not None or name in self._dimensions or not is_summary(name):
                return False
            (summary,) = wanted([name])
            words = summary.output if summary.kind in ("min", "max", "mean", "rms", "peak") else ""
        if subject.at is not None or not words or output_meant(self.mechanism, words).kind not in PLACES:
            return False
        size = self.mechanism.size if output_meant(self.mechanism, words).dimension == "length" else 1.0
        return abs(float(self._number(f"{words} range").number)) <= RESTING * size

    def _number(self, name: str) -> Value:
        """A dimension, a metric or a summary."""
        if name in self._dimensions:
            return Value(self._dimensions[name], dimension_of(self.mechanism, name) or units.NONE)
        own = OfOutput(self._output, FLUCTUATION)
        forces = needs_forces(name, self.mechanism, own)
        if forces and (missing := unloaded(self.mechanism, [name])) is not None:
            raise RequestError(missing)
        machine = self._machine(forces=forces, in_part=self.in_part or name.partition(" ")[0] == RANGE)
        found = criterion(name).measure(machine)
        if found is None:
            notes = machine.notes[-1:] or [_("it does not apply to this machine", code="expect.inapplicable")]
            raise LinkwrightError(notes[0])
        return Value(found.value, powers(found.dimension), found.dimension)

    def _at(self, asked: Asked) -> Value:
        """An output at one position, which the machine reaches from where its cycle begins."""
        subject = asked.subject
        assert subject.at is not None and subject.output is not None
        motion = (
            solve_motion(self.mechanism, at=subject.at)
            if isinstance(subject.at, Mapping)
            else subject.at.solved(self.mechanism, failures="raise")
        )
        result = motion if subject.output.of_motion else solve_forces(motion)
        value = Analysis.of(result).signal(asked.of)(result)
        name = subject.output.dimension
        return Value(float(value[0]), powers(name), name, turns=subject.output.kind == "angle")
