"""Efforts that the drivers of a mechanism need where its motion is given: at the verge of motion, and in motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.core.inputs import Input
from linkwright.core.outputs import row_name
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.switches import agreeing, gap_name
from linkwright.formula.program import Program
from linkwright.formula.trace import Scalar
from linkwright.kinematics.motion import Motion
from linkwright.mechanism.mechanism import Mechanism

#: Share of its speed at which an input at the verge of motion is thought to move, so that friction has its sense.
CREEPING = 1e-9


@dataclass(frozen=True)
class Course:
    """Positions of a motion: coordinate, rate (rad/s, m/s) and its rate of every driver, (n,) each; ``states``: what
    groups without closed form begin from."""

    places: Mapping[str, Floats]
    rates: Mapping[str, Floats]
    seconds: Mapping[str, Floats]
    states: Mapping[str, Floats]

    @classmethod
    def of(cls, motion: Motion, positions: Flags) -> Course:
        """The course of some positions of a motion, with its speeds and accelerations."""
        rows = {name: [row[positions] for row in rows] for name, rows in motion.positions.coordinates.items()}
        places, rates, seconds = ({name: row[k] for name, row in rows.items()} for k in range(3))
        return cls(places, rates, seconds, {name: row[positions] for name, row in motion.states.items()})

    def at_rest(self) -> Course:
        """The same positions at rest."""
        still = {name: 0.0 * row for name, row in self.rates.items()}
        return replace(self, rates=still, seconds=still)

    def towards(self, senses: Mapping[str, Floats]) -> Course:
        """The same positions with other rates, without acceleration."""
        return replace(self, rates=senses, seconds={name: 0.0 * row for name, row in self.seconds.items()})

    @property
    def count(self) -> int:
        """How many positions there are."""
        return len(next(iter(self.places.values())))

    def inputs(self) -> dict[str, Floats]:
        """The same as inputs of the programs of an equation of motion."""
        found = {f"q:{name}": row for name, row in self.places.items()}
        found |= {f"qd:{name}": row for name, row in self.rates.items()}
        found |= {Input("second", name).name: row for name, row in self.seconds.items()}
        return {**found, **self.states}


@dataclass(frozen=True)
class Efforts:
    """What the drivers of a mechanism must supply: by name (n,), N·m or N along the coordinate.

    ``effort``: with friction, NaN where no finite effort moves it; ``ideal``: without friction in joints.
    """

    effort: Mapping[str, Floats]
    ideal: Mapping[str, Floats]


class QuasiStatic:
    """Efforts of the drivers of a mechanism, its actuators acting as loads, at positions of a course.

    At the verge of motion friction has the sense of the motion to come and nothing else depends on a speed:
    comparisons of rates are evaluated creeping, all else at rest.
    Source: equation of motion, see :class:`~linkwright.dynamics.equation.EquationOfMotion`.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        self.equation = EquationOfMotion(mechanism, prescribed=mechanism.drivers)

    @cached_property
    def _program(self) -> Program:
        equation = self.equation
        values: dict[str, Scalar | bool] = {}
        for name in equation.names:
            values[row_name("effort", name)] = equation.forces.outputs.value(row_name("effort", name))
            values[f"ideal:{name}"] = equation.plain.outputs.value(row_name("effort", name))
        friction = equation.forces.programs.friction
        if friction is not None:
            values["found"] = friction.found
        return equation.value_program(values)

    @cached_property
    def _gaps(self) -> Program:
        return self.equation.program(gap_name(k) for k in range(len(self.equation.switches.names)))

    @cached_property
    def _qualities(self) -> Program:
        return self.equation.program(f"closure:{group}" for group in self.equation.groups)

    def running(self, course: Course, time: float = 0.0) -> Efforts:
        """At the speeds and accelerations of the course, all at one ``time``, s."""
        return self._evaluate(course, self._held(course, time), time)

    def starting(self, course: Course, senses: Mapping[str, Floats]) -> Efforts:
        """At rest, just before the drivers begin to move in their ``senses``, rad/s or m/s."""
        creeping = {name: CREEPING * row for name, row in senses.items()}
        return self._evaluate(course.at_rest(), self._held(course.towards(creeping)))

    def quality(self, course: Course) -> Floats:
        """The worst group's square of the sine of its transmission angle (see ``EquationOfMotion``), (n,); 1 where
        nothing closes a loop."""
        if not self.equation.groups:
            return np.ones(course.count)
        with np.errstate(all="ignore"):
            return np.asarray(self.equation.run(self._qualities, course.inputs(), course.count).min(axis=0))

    def _held(self, course: Course, time: float = 0.0) -> dict[str, Floats]:
        """The comparisons by which forces switch, 1 or 0, in agreement with each other."""

        def gaps(held: Mapping[str, Floats]) -> Floats:
            with np.errstate(all="ignore"):
                return self.equation.run(self._gaps, {**course.inputs(), **held, "time": time}, course.count)

        return agreeing(gaps, self.equation.switches.names, course.count)

    def _evaluate(self, course: Course, held: Mapping[str, Floats], time: float = 0.0) -> Efforts:
        program, names = self._program, self.equation.names
        with np.errstate(all="ignore"):
            rows = self.equation.run(program, {**course.inputs(), **held, "time": time}, course.count)
        found = dict(zip(program.output_names, rows, strict=True))
        moves = found["found"] > 0.5 if "found" in found else np.ones(course.count, dtype=bool)
        effort = {name: np.where(moves, found[row_name("effort", name)], np.nan) for name in names}
        return Efforts(effort, {name: found[f"ideal:{name}"] for name in names})
