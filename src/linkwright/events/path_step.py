"""One step along a path of a group without closed form, of many designs at once, and whether it is certain.

It is predicted with the exact rates and the last third derivative, corrected by Newton's method, and judged by the
rule of steps (:mod:`linkwright.kinematics.branch`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.curves.pieces import LOW, Columns
from linkwright.events.course import Course
from linkwright.events.following import ChainCoordinate, chain_coordinates
from linkwright.events.formula import Formula, Known
from linkwright.formula.program import Program
from linkwright.formula.replay import inlined
from linkwright.formula.trace import Scalar, Trace, absolute, maximum, select
from linkwright.kinematics.branch import LARGEST, doubt, misfit
from linkwright.kinematics.groups import CONVERGED
from linkwright.kinematics.trace import MotionTrace

#: Columns of a step: its length, s, and what a correction may be in addition to its share of it.
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


class TracedStep:
    """A step of the chain coordinates of a motion, written into another trace: ``before`` gives values there by name,
    ``h`` is its length, s.

    ``begin``: the coordinates with so many ``derivatives`` at its beginning; ``near``: what is expected at its end;
    ``groups``: names of those that Newton's method solves.
    """

    def __init__(self, motion: MotionTrace, before: Callable[[str], Scalar], h: Scalar, derivatives: int = 3) -> None:
        self.motion, self.h = motion, h
        self.coordinates = chain_coordinates(motion)
        self.groups = tuple(name for name, placed in motion.placed.items() if placed.coordinates)
        self.begin: dict[ChainCoordinate, list[Scalar]] = {
            each: [before(f"{each.name}|{k}") if k <= derivatives else 0.0 for k in range(4)]
            for each in self.coordinates
        }
        self.near: dict[ChainCoordinate, Scalar] = {
            each: x + h * (v + h * (0.5 * a + (1.0 / 6.0) * h * j)) for each, (x, v, a, j) in self.begin.items()
        }

    @property
    def outputs(self) -> dict[str, Scalar]:
        """What it takes of the motion at its end."""
        found, residual = dict(self.motion.next_states), 0.0
        for each in self.coordinates:
            found |= {f"{each.name}'": each.rate, f"{each.name}''": each.second}
        for name in self.groups:
            residual = residual + self.motion.placed[name].residual  # type: ignore[assignment]
            found[f"determinant {name}"] = self.motion.placed[name].determinant
        return {**found, "residual": residual}

    @property
    def states(self) -> dict[str, Scalar]:
        """What the motion takes."""
        return {name: value for each, x in self.near.items() for name, value in each.as_inputs(x).items()}

    def values(self, found: Mapping[str, Scalar]) -> dict[str, Scalar]:
        """The coordinates at its end, by name, from outputs there."""
        return {each.name: each.found(found, x) for each, x in self.near.items()}

    def doubt(self, t: Trace, found: Mapping[str, Scalar], groups: Iterable[str], room: Scalar) -> Scalar:
        """The doubt of the step, the largest one of some groups, from outputs and coordinates at its end; infinite
        where Newton's method finds no assembly."""
        h, good = self.h, t.compare("less", found["residual"], CONVERGED)
        worst: Scalar = 0.0
        for group in groups:
            change: Scalar = 0.0
            correction: Scalar = 0.0
            gap: Scalar = 0.0
            for each in self.coordinates:
                if each.group == group:
                    x, v, a, _ = self.begin[each]
                    share, value = 1.0 / each.scale, found[each.name]
                    rate, second = found[f"{each.name}'"], found[f"{each.name}''"]
                    off = misfit(value - x, h * v, h * h * a, h * rate, h * h * second)
                    way = absolute(value - x) * share
                    good = t.logic("and", good, t.compare("less", way, LARGEST))
                    change = maximum(change, way)
                    correction = maximum(correction, absolute(value - self.near[each]) * share)
                    gap = maximum(gap, absolute(off) * share)
            worst = maximum(worst, doubt(change, correction, gap, room))
        return select(t.logic("and", good, t.compare("less", worst, np.inf)), worst, np.inf)


class PathStep:
    """The formula of a step of all machines of one shape; ``varied``: dimensions that are columns."""

    def __init__(self, motion: MotionTrace, course: Course, varied: frozenset[str]) -> None:
        t = Trace()
        self._step = TracedStep(motion, t.position, t.position(STEP))
        self.coordinates, self.groups = self._step.coordinates, self._step.groups
        self.scale = np.array([[each.scale] for each in self.coordinates])
        self._formula = self._traced(t, course, varied)
        row = self._formula.place
        self._values = [[row[each.name + mark] for each in self.coordinates] for mark in ("", "'", "''")]
        self._signs = [row[f"determinant {name}"] for name in self.groups]
        self.varied = tuple(name for name in self._formula.columns if name in varied)

    def _traced(self, t: Trace, course: Course, varied: frozenset[str]) -> Formula:
        """Coordinates with two rates after a step, and what it is judged by."""
        step, motion = self._step, self._step.motion
        once = Program.of(motion.trace, motion.next_states)
        step_program = Program.of(motion.trace, step.outputs)
        inputs = course.inputs(t, t.position(LOW), varied)
        inputs |= {name: t.position(name) for name in step_program.parameters if name in varied}
        found = inlined(step_program, t, inputs | inlined(once, t, inputs | step.states))
        rest = {name: found[name] for name in step_program.output_names if name not in motion.next_states}
        made = {**step.values(found), **rest}
        groups = dict.fromkeys(each.group for each in self.coordinates)
        return Formula(Program.of(t, {**made, "doubt": step.doubt(t, made, groups, t.position(ROOM))}))

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
        return Place(found[self._values], found[row["doubt"]], found[row["residual"]], np.sign(found[self._signs]))
