"""The formula of a page: all that it draws and plots of one position, and the numbers that it takes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.inputs import mode_groups
from linkwright.core.json_data import Plain
from linkwright.core.outputs import SLIDE, Output, row_name, row_names
from linkwright.elements.topology import Group
from linkwright.formula.program import Program
from linkwright.formula.table import Tables
from linkwright.formula.trace import Scalar
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical, program_names
from linkwright.kinematics.programs import Manner
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinematics.step_rule import StepRule
from linkwright.kinematics.trace import MotionTrace
from linkwright.kinetostatics.closure import dyads, transmission
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.friction import FrictionTerm, traced_rate
from linkwright.kinetostatics.load_site import TracedSite, guide_state
from linkwright.kinetostatics.run import solve_forces
from linkwright.kinetostatics.solver import ForceSolver
from linkwright.kinetostatics.traced_loads import AlongInput, numbers_of_loads
from linkwright.loads.base import Load
from linkwright.mechanism.mechanism import Mechanism
from linkwright.page.dimensions import geometry_addresses
from linkwright.page.loads import angles, found_again, interval, moving_name, phases, traced_name

#: Newton steps of groups without closed form at every position.
ITERATIONS = 3
#: The output that is the sum of magnitudes which may not exist.
SIZES = "sizes of loads"


def _rate_of(term: FrictionTerm) -> str:
    """Name of the output that is the rate of a joint with friction, zero at rest."""
    return f"moving {term.field}"


class PagePrograms:
    """The formula of one mechanism and its inputs.

    Outputs of ``main`` beside those of motion and forces: ``d:GUIDE`` direction of a guide, ``m:GROUP``
    transmission angle and ``quality:GROUP`` closeness to change points of a dyad, ``ok`` and ``outcome``.
    """

    def __init__(self, motion: Motion) -> None:
        self.motion = motion
        self.mechanism: Mechanism = motion.mechanism
        self.forces: Forces | None = solve_forces(motion) if self.mechanism.has_loads else None
        self.free = frozenset(geometry_addresses(self.mechanism))

    @cached_property
    def held(self) -> list[str]:
        """Loads that a page cannot find again after a change: their course is that of the original."""
        return [load.name for load in self._varying if load not in self.found]

    @cached_property
    def found(self) -> list[Load]:
        """Loads whose phases and angles the page finds at every position, and whose sizes are formulas."""
        return [load for load in self._varying if found_again(load, self.motion)]

    @property
    def _varying(self) -> list[Load]:
        """The loads whose magnitudes are no numbers."""
        return [each for each in self.mechanism.loads.values() if not each.magnitude.constant]

    @cached_property
    def _numbers(self) -> AlongInput:
        """The numbers that they take."""
        return numbers_of_loads(self.found, self.mechanism)

    @property
    def tables(self) -> Tables:
        """The tables of the loads."""
        return self._numbers.tables

    @property
    def phases(self) -> list[Plain]:
        """The phases that the page finds."""
        return phases(self.found, self.motion)

    @property
    def angles(self) -> list[Plain]:
        """The angles that the page finds at every position."""
        return [each for each in self._angles if each["field"] in self.main.fields]

    @cached_property
    def _angles(self) -> list[Plain]:
        return angles(self.found, self.motion)

    def friction(self) -> list[dict[str, object]]:
        """The friction that the page finds again, with the links whose stored reactions add up to that on ``b``."""
        terms = self.forces.solver.friction.terms if self.forces is not None else ()
        joints = self.mechanism.joints
        return [
            {**asdict(term), "field": term.field, "rate": _rate_of(term),
             "on": [term.b] if term.b in joints[term.joint].joined[1:] else joints[term.joint].joined[1:]}
            for term in terms
        ]  # fmt: skip

    @property
    def bends(self) -> list[Plain]:
        """Where cams and the like go over to another formula: angles of a link against its carrier, to which a
        dimension is added."""
        found = [joint.bends for joint in self.mechanism.joints.values() if joint.bends is not None]
        phase = self.solver.nominal.parameters
        return [
            {
                "link": each.link,
                "carrier": each.carrier,
                "angles": each.angles,
                "phase": [each.phase, phase[each.phase]],
            }
            for each in found
        ]

    @cached_property
    def iterated(self) -> bool:
        """Whether a group without closed form is followed from position to position."""
        return bool(self.motion.solver.motion.next_states)

    @cached_property
    def solver(self) -> MotionSolver:
        """The traced motion, with the signs of assembly modes per position where these change."""
        groups = frozenset(mode_groups(self.motion.modes)) if self.motion.modes else frozenset()
        return MotionSolver(
            self.mechanism, Manner(self.free, flipping=groups, iterations=ITERATIONS if self.iterated else 1)
        )

    @cached_property
    def loaded(self) -> ForceSolver:
        """The traced forces."""
        return ForceSolver(self.solver, along_input=frozenset(map(traced_name, self.found)))

    @cached_property
    def main(self) -> Program:
        """All outputs; where groups are iterated, also their coordinates (``next:``), and all that the formula takes
        at the next position (``then:``)."""
        motion = self.solver.motion
        outputs = self._outputs(motion)
        if not self.iterated:
            return self._with_angles(Program.of(motion.trace, {**outputs, "ok": motion.valid}))
        trace = motion.trace
        rule = self._rule
        outputs |= {f"next:{name}": value for name, value in motion.next_states.items()}
        outputs |= {f"then:{name}": value for name, value in rule.following.items()}
        outputs |= {f"determinant:{name}": placed.determinant for name, placed in motion.placed.items()
                    if placed.coordinates}  # fmt: skip
        passed = trace.logic("and", motion.valid, rule.kept)
        return self._with_angles(Program.of(trace, {**outputs, "margin": rule.margin, "ok": passed}))

    @cached_property
    def _rule(self) -> StepRule:
        motion = self.solver.motion
        return StepRule(motion, motion.trace.position("step"))

    def _with_angles(self, program: Program) -> Program:
        """The program with the angles near which angles stay, where these turn through, taken per position."""
        return program.with_given([str(each["field"]) for each in self._angles])

    @cached_property
    def starts(self) -> dict[str, float | str]:
        """What goes from one position to the next, with its first values: numbers, or the name of another that they
        repeat."""
        if not self.iterated:
            return {}
        states = {name: float(row[0]) for name, row in self.motion.states.items()}
        begin = {**dict.fromkeys(self._rule.following, 0.0), **self._rule.begin, **states}
        return {name: begin[name] for name in self.main.fields if name in begin}

    def _outputs(self, motion: MotionTrace) -> dict[str, Scalar | bool]:
        solver = self.solver
        names = [name for name in solver.outputs.standard if name != "outcome"]
        frame = [canonical(self.mechanism, "frame", point) for point in self.mechanism.frame.points]
        names += [each for key in frame for each in row_names("position", key)]
        names += [each for link in self.mechanism.links for each in row_names("direction", link)]
        names += [
            each
            for name, link in self.mechanism.links.items()
            if link.mass
            for each in row_names("position", f"{name}.@centre")
        ]
        names += [
            row_name("fact", name, on=fact) for name, placed in motion.placed.items() for fact in placed.facts
        ]
        outputs: dict[str, Scalar | bool] = {name: solver.outputs.value(name) for name in names}
        for name in self.mechanism.guides:
            outputs |= zip((row_name(kind, name) for kind in SLIDE), solver.outputs.slide(name), strict=True)
            direction, _, _ = guide_state(motion, name)
            outputs |= zip(row_names("guide_direction", name), (direction.x, direction.y), strict=True)
        for group in self.dyads:
            outputs[row_name("transmission_angle", group.name)] = transmission(solver.outputs, group)
            outputs[row_name("quality", group.name)] = motion.placed[group.name].quality
        if self.forces is not None:
            outputs |= self._of_forces()
        return {**outputs, "outcome": motion.outcome}

    def _of_forces(self) -> dict[str, Scalar | bool]:
        forces = self.loaded.outputs
        names = list(forces.standard)
        for load in self.mechanism.loads:
            names += [*row_names("load", load), *row_names("load_place", load)]
        names += [*row_names("shaking_force"), row_name("shaking_moment")]
        found: dict[str, Scalar | bool] = {name: forces.value(name) for name in names}
        motion, terms = self.solver.motion, self.loaded.friction.terms
        found |= {_rate_of(term): traced_rate(motion, term) for term in terms}
        found |= {
            moving_name(each): self._moving(each)
            for load in self.found
            for each in load.magnitude.phase.outputs
        }
        fallible = self._numbers.fallible
        return {**found, SIZES: sum((self._size(name) for name in fallible), 0.0)} if fallible else found

    def _moving(self, output: Output) -> Scalar:
        """The rate of an output, zero at rest."""
        _, rates = program_names(self.mechanism, output)
        rate, second = (self.solver.outputs.value(name) for name in rates)
        return self.solver.motion.moving(rate, second, output.dimension)

    def _size(self, name: str) -> Scalar:
        load = self.mechanism.loads[name]
        known = traced_name(load) != name
        return TracedSite(self.solver.motion, load, along_input=True, phase_known=known).magnitude()

    @cached_property
    def dyads(self) -> tuple[Group, ...]:
        """Groups that have a transmission angle."""
        return dyads(self.motion.structure)

    def values(self) -> dict[str, float]:
        """Every number that the program takes, and the ends of intervals of the input."""
        known = {**self.solver.nominal.parameters, **self._numbers.constants}
        ends = [end for load in self.found for end in interval(load)]
        return {name: known[name] for name in dict.fromkeys([*self.main.parameters, *ends])}

    def fields(self) -> Mapping[str, Floats]:
        """The course of what is held; zeros of what the page finds."""
        if self.forces is None:
            return {}
        empty = np.zeros(self.motion.positions.count)
        return {
            name: self.forces.fields.get(name, empty) for name in self.main.fields if name not in self.starts
        }

    def arrays(self) -> dict[str, Floats]:
        """The inputs per position."""
        found = {**self.motion.positions.arrays, **self.motion.modes}
        count = self.motion.positions.count
        time = self.motion.positions.time
        found["step"] = np.full(count, time[1] - time[0] if count > 1 else 0.0)
        return {name: found[name] for name in found if name in self.main.positions}
