"""The programs of a page: all that it draws and plots, and before it the limit positions of its loads."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, replace
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.inputs import mode_groups
from linkwright.core.outputs import SLIDE, owners_of, row_name, row_names
from linkwright.cycle_programs.iterated_groups import ITERATIONS
from linkwright.cycle_programs.limit_stages import constants, limit_stages
from linkwright.cycle_programs.loaded_cycle import SIZES, along_input
from linkwright.cycle_programs.traced_outputs import Traced
from linkwright.elements.topology import Group
from linkwright.engine.cycle import CycleProgram
from linkwright.engine.program import Program
from linkwright.engine.stage import Stage
from linkwright.engine.states import inputs_as_fields
from linkwright.engine.table import Tables
from linkwright.engine.trace import Scalar, select
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.kinematics.step_rule import StepRule
from linkwright.kinematics.trace import MotionTrace
from linkwright.kinetostatics.closure import dyads, transmission
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.friction import FrictionTerm, traced_rate
from linkwright.kinetostatics.load_site import TracedSite, guide_state
from linkwright.kinetostatics.run import solve_forces
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.kinetostatics.traced_loads import AlongInput, numbers_of_loads
from linkwright.loads.base import Load
from linkwright.mechanism.mechanism import Mechanism
from linkwright.page.dimensions import geometry_addresses
from linkwright.page.loads import angles, fields, found_again, phases, traced_names

STEPS = 360


def _rate_of(term: FrictionTerm) -> str:
    """Name of the output that is the rate of a joint with friction, zero at rest."""
    return f"moving {term.field}"


class PagePrograms:
    """Programs of one mechanism and their inputs.

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
        return [name for name in self._varying if name not in self.followed.names | self.positional.names]

    @cached_property
    def _varying(self) -> list[str]:
        """The loads whose magnitudes are no numbers."""
        fields = self._plain.forces.fields_needed() if self.forces is not None else ()
        return owners_of("magnitude", fields)

    @cached_property
    def positional(self) -> AlongInput:
        """Loads that are traced but for what the page finds at every position, and the numbers that they take."""
        left = [self.mechanism.loads[name] for name in self._varying if name not in self.followed.names]
        return numbers_of_loads([each for each in left if found_again(each, self.motion)], self.mechanism)

    @property
    def tables(self) -> Tables:
        """The tables of the loads."""
        return {**self.positional.tables, **self.followed.tables}

    @cached_property
    def found_per_position(self) -> dict[str, list[dict[str, object]]]:
        """``phases`` and ``angles`` that the page finds at every position."""
        return {
            "phases": phases(self._positional_loads, self.motion),
            "angles": angles(self._positional_loads, self.motion, self.followed.constants),
        }

    @property
    def _positional_loads(self) -> list[Load]:
        return [self.mechanism.loads[name] for name in sorted(self.positional.names)]

    def friction(self) -> list[dict[str, object]]:
        """The friction that the page finds again, with the links whose stored reactions add up to that on ``b``."""
        terms = self.forces.solver.friction.terms if self.forces is not None else ()
        joints = self.mechanism.joints
        return [
            {**asdict(term), "field": term.field, "rate": _rate_of(term),
             "on": [term.b] if term.b in joints[term.joint].joined[1:] else joints[term.joint].joined[1:]}
            for term in terms
        ]  # fmt: skip

    @cached_property
    def _plain(self) -> Traced:
        return Traced(
            self.mechanism, self.free, self.motion.positions, iterations=self._iterations, turning=True
        )

    @cached_property
    def followed(self) -> AlongInput:
        """Loads whose magnitudes are traced, and what they take."""
        none = AlongInput(frozenset())
        if self.forces is None or self.iterated:
            return none
        found, signals = [], MotionSignals(self.motion)
        for name in (row_name("magnitude", name) for name in self._varying):
            known = along_input(self._plain, self.free, [name])
            if known is not None and known.limits(signals) is not None:
                found.append(name)
        return along_input(self._plain, self.free, found) or none

    @cached_property
    def iterated(self) -> bool:
        """Whether a group without closed form is followed from position to position."""
        return bool(self.motion.solver.motion.next_states)

    @property
    def _iterations(self) -> int:
        return ITERATIONS if self.iterated else 1

    @cached_property
    def traced(self) -> Traced:
        """The traces of motion and forces."""
        found = Traced(
            self.mechanism,
            self.free,
            self.motion.positions,
            iterations=self._iterations,
            turning=True,
            along_input=self.followed.names | traced_names(self._positional_loads, self.motion),
        )
        if self.motion.modes:
            groups = frozenset(mode_groups(self.motion.modes))
            found.solver.manner = replace(found.solver.manner, flipping=groups)
        return found

    @cached_property
    def stages(self) -> tuple[Stage, ...]:
        """What is found before the main program: limit positions between which loads act."""
        return tuple(limit_stages(self.traced, self.followed.outputs, valued=self.followed.valued))

    @cached_property
    def cycle(self) -> CycleProgram:
        """The stages as a cycle program."""
        return CycleProgram(self.stages)

    @cached_property
    def main(self) -> Program:
        """All outputs; it carries states where groups are iterated."""
        motion = self.traced.solver.motion
        outputs = self._outputs(motion)
        if not self.iterated:
            return self._with_angles(Program.of(motion.trace, {**outputs, "ok": motion.valid}))
        trace = motion.trace
        rule = StepRule(motion, trace.position("step"))
        passed = trace.logic("and", motion.valid, trace.compare("less", 0.5, trace.state("alive")))
        passed = trace.logic("and", passed, rule.kept)
        outputs |= {f"next:{name}": value for name, value in motion.next_states.items()}
        outputs |= {f"determinant:{name}": placed.determinant for name, placed in motion.placed.items()
                    if placed.coordinates}  # fmt: skip
        following = {**rule.following, "alive": select(passed, 1.0, 0.0)}
        self.begin = {**rule.begin, "alive": 1.0}
        return self._with_angles(
            Program.of(trace, {**outputs, "margin": rule.margin, "ok": passed}, following)
        )

    def _with_angles(self, program: Program) -> Program:
        """The program with the angles near which angles stay, where these turn through, taken per position."""
        return inputs_as_fields(program, [str(each["field"]) for each in self.found_per_position["angles"]])

    @cached_property
    def starts(self) -> dict[str, float | str]:
        """First values of the states: numbers, or the name of the state that they repeat."""
        _ = self.main
        states = {name: float(row[0]) for name, row in self.motion.states.items()}
        return {name: states.get(name, self.begin.get(name, 0.0)) for name in self.main.states}

    def _outputs(self, motion: MotionTrace) -> dict[str, Scalar | bool]:
        solver = self.traced.solver
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
        forces = self.traced.forces.outputs
        names = list(forces.standard)
        for load in self.mechanism.loads:
            names += [*row_names("load", load), *row_names("load_place", load)]
        names += [*row_names("shaking_force"), row_name("shaking_moment")]
        found: dict[str, Scalar | bool] = {name: forces.value(name) for name in names}
        motion, terms = self.traced.solver.motion, self.traced.forces.friction.terms
        found |= {_rate_of(term): traced_rate(motion, term) for term in terms}
        return found if (sizes := self._sizes()) is None else {**found, SIZES: sizes}

    def _sizes(self) -> Scalar | None:
        """Sum of the magnitudes that may not exist; None where there are none."""
        if not (self.followed.fallible or self.positional.fallible):
            return None
        total, motion = self.followed.sizes(self.traced.solver.motion), self.traced.solver.motion
        partly = traced_names(self._positional_loads, self.motion)
        for name in self.positional.fallible:
            load = self.mechanism.loads[name]
            site = TracedSite(motion, load, along_input=True, phase_known=name not in partly)
            total = total + site.magnitude()
        return total

    @cached_property
    def dyads(self) -> tuple[Group, ...]:
        """Groups that have a transmission angle."""
        return dyads(self.motion.structure)

    def values(self) -> dict[str, float]:
        """Every parameter that a program takes, but those that the stages find."""
        loads = {**self.positional.constants, **self.followed.constants}
        known = {**self.traced.solver.nominal.parameters, **constants(self.traced), **loads}
        wanted = dict.fromkeys([*self.main.parameters, *(self.cycle.dimensions if self.stages else ())])
        return {name: known[name] for name in wanted if name in known}

    def fields(self) -> Mapping[str, Floats]:
        """The course of what is held."""
        if self.forces is None:
            return {}
        own = [str(each["field"]) for each in self.found_per_position["angles"]]
        empty = dict.fromkeys(own, np.zeros(self.motion.positions.count))
        known = {**self.forces.fields, **fields(self._positional_loads, self.motion), **empty}
        return {name: known[name] for name in self.main.fields}

    def arrays(self) -> dict[str, Floats]:
        """The inputs per position of all programs."""
        found = {**self.motion.positions.arrays, **self.motion.modes}
        count = self.motion.positions.count
        time = self.motion.positions.time
        found["step"] = np.full(count, time[1] - time[0] if count > 1 else 0.0)
        wanted = {*self.main.positions, *(name for stage in self.stages for name in stage.program.positions)}
        return {name: found[name] for name in found if name in wanted}
