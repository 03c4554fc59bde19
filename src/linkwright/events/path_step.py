"""One step along a path of a group without closed form, of many designs at once, and whether it is certain.

It is predicted with the exact rates and the last third derivative, corrected by Newton's method, and judged by the
rule of steps (:mod:`linkwright.kinematics.step_rule`).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.curves.pieces import LOW, Columns
from linkwright.events.course import Course
from linkwright.events.following import ChainCoordinate, chain_coordinates
from linkwright.events.formula import Formula, Known
from linkwright.formula.program import Program
from linkwright.formula.replay import inlined
from linkwright.formula.trace import Scalar, Trace, absolute, maximum, select
from linkwright.kinematics.groups import CONVERGED
from linkwright.kinematics.step_rule import LARGEST, doubt
from linkwright.kinematics.trace import MotionTrace

#: Columns of a step: its length, s, and what a correction may be beside its share of it.
STEP, ROOM = "step", "room"
_NOW = np.zeros(1)


@dataclass(frozen=True)
class Place:
    """Where designs are: coordinates with two rates, ``values`` (3, n, designs); the ``doubt`` of the step there and
    Newton's last correction, squared, (designs,); ``signs`` of determinants (groups, designs)."""

    values: Floats
    doubt: Floats
    residual: Floats
    signs: Floats


class PathStep:
    """The formula of a step of all machines of one shape; ``varied``: dimensions that are columns."""

    def __init__(self, motion: MotionTrace, course: Course, varied: frozenset[str]) -> None:
        self.coordinates = chain_coordinates(motion)
        self.scale = np.array([[each.scale] for each in self.coordinates])
        self.groups = tuple(name for name, placed in motion.placed.items() if placed.coordinates)
        self._formula = self._traced(motion, course, varied)
        row = self._formula.place
        self._values = [[row[each.name + mark] for each in self.coordinates] for mark in ("", "'", "''")]
        self._signs = [row[f"determinant {name}"] for name in self.groups]
        self.varied = tuple(name for name in self._formula.columns if name in varied)

    def _traced(self, motion: MotionTrace, course: Course, varied: frozenset[str]) -> Formula:
        """Coordinates with two rates after a step, and what it is judged by."""
        t, outputs = Trace(), dict(motion.next_states)
        for each in self.coordinates:
            outputs |= {f"{each.name}'": each.rate, f"{each.name}''": each.second}
        residual: Scalar = 0.0
        for name in self.groups:
            residual = residual + motion.placed[name].residual
            outputs[f"determinant {name}"] = motion.placed[name].determinant
        once = Program.of(motion.trace, motion.next_states)
        whole = Program.of(motion.trace, {**outputs, "residual": residual})
        given = course.inputs(t, t.position(LOW), varied)
        given |= {name: t.position(name) for name in whole.parameters if name in varied}
        h, near = t.position(STEP), {}
        for each in self.coordinates:
            x, v, a, j = _before(t, each)
            near[each] = x + h * (v + h * (0.5 * a + (1.0 / 6.0) * h * j))
        states = {name: value for each, x in near.items() for name, value in each.given(x).items()}
        found = inlined(whole, t, given | inlined(once, t, given | states))
        made = {each.name: each.found(found, x) for each, x in near.items()}
        rest = {name: found[name] for name in whole.output_names if name not in motion.next_states}
        return Formula(Program.of(t, {**made, **rest, "doubt": self._doubt(t, near, {**rest, **made})}))

    def _doubt(self, t: Trace, near: Mapping[ChainCoordinate, Scalar], found: Mapping[str, Scalar]) -> Scalar:
        """The doubt of a step, the largest one of all groups; infinite where Newton's method finds no assembly."""
        h, good = t.position(STEP), t.compare("less", found["residual"], CONVERGED)
        worst: Scalar = 0.0
        for group in dict.fromkeys(each.group for each in self.coordinates):
            change: Scalar = 0.0
            correction: Scalar = 0.0
            misfit: Scalar = 0.0
            for each in self.coordinates:
                if each.group == group:
                    x, v, a, _ = _before(t, each)
                    share, value = 1.0 / each.scale, found[each.name]
                    rate, second = found[f"{each.name}'"], found[f"{each.name}''"]
                    quintic = h * (0.5 * (rate + v) + h * (1.0 / 12.0) * (a - second))
                    way = absolute(value - x) * share
                    good = t.logic("and", good, t.compare("less", way, LARGEST))
                    change = maximum(change, way)
                    correction = maximum(correction, absolute(value - near[each]) * share)
                    misfit = maximum(misfit, absolute(value - x - quintic) * share)
            worst = maximum(worst, doubt(change, correction, misfit, t.position(ROOM)))
        return select(t.logic("and", good, t.compare("less", worst, np.inf)), worst, np.inf)

    def place(
        self,
        known: Known,
        designs: Columns,
        time: Floats,
        before: Floats,
        h: Floats | None = None,
        room: Floats | None = None,
    ) -> Place:
        """The places of designs at some times, s, after steps ``h``, s, from coordinates with three derivatives
        ``before``, (4, n, designs)."""
        zero = np.zeros_like(time)
        columns = {**designs, LOW: time, STEP: zero if h is None else h, ROOM: zero if room is None else room}
        for k, each in enumerate(self.coordinates):
            columns |= {f"{each.name}|{order}": before[order, k] for order in range(4)}
        found = self._formula.run(known, columns, _NOW)[0]
        row = self._formula.place
        return Place(
            found[self._values], found[row["doubt"]], found[row["residual"]], np.sign(found[self._signs])
        )


def _before(t: Trace, each: ChainCoordinate) -> list[Scalar]:
    """A coordinate and three derivatives at the beginning of a step."""
    return [t.position(f"{each.name}|{order}") for order in range(4)]
