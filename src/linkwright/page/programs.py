"""The programs of a page: all that it draws and plots, and before it the limit positions of its loads."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from linkwright.engine.cycle import CycleProgram
from linkwright.engine.program import Program
from linkwright.engine.stage import Stage
from linkwright.engine.trace import Scalar, select
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical, vector_names
from linkwright.kinematics.step_rule import StepRule
from linkwright.kinematics.trace import MotionTrace
from linkwright.kinetostatics.closure import dyads, transmission
from linkwright.kinetostatics.forces import Forces, solve_forces
from linkwright.kinetostatics.site import guide_state
from linkwright.mechanism.mechanism import Mechanism
from linkwright.page.dimensions import geometry_addresses
from linkwright.plot.force_names import carries
from linkwright.structure.group import Group
from linkwright.study.iterated_groups import ITERATIONS
from linkwright.study.limit_stages import constants
from linkwright.study.loaded_cycle import SIZES, AlongInput, along_input
from linkwright.study.traced import Traced

Floats = NDArray[np.float64]
STEPS = 360


class PagePrograms:
    """Programs of one mechanism and their inputs.

    Outputs of ``main`` beside those of motion and forces: ``d:GUIDE`` direction of a guide, ``m:GROUP``
    transmission angle and ``quality:GROUP`` closeness to change points of a dyad, ``ok`` and ``outcome``.
    """

    def __init__(self, motion: Motion) -> None:
        self.motion = motion
        self.mechanism: Mechanism = motion.mechanism
        self.forces: Forces | None = solve_forces(motion) if carries(self.mechanism) else None
        self.free = frozenset(geometry_addresses(self.mechanism))

    @cached_property
    def held(self) -> list[str]:
        """Loads that a page cannot find again after a change: their course is that of the original."""
        fields = self._plain.forces.fields_needed() if self.forces is not None else ()
        loads = [name.removeprefix("load:") for name in fields if name.startswith("load:")]
        return [name for name in loads if name not in self.followed.names]

    def friction(self) -> list[dict[str, object]]:
        """The friction that the page finds again, with the links whose stored reactions add up to that on ``b``."""
        terms = self.forces.solver.friction.terms if self.forces is not None else ()
        joints = self.mechanism.joints
        return [
            {**asdict(term), "field": term.field,
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
        names = [name for name in self._plain.forces.fields_needed() if name.startswith("load:")]
        found = [name for name in names if along_input(self._plain, self.free, [name]) is not None]
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
            along_input=self.followed.names,
        )
        if self.motion.modes:
            groups = frozenset(name.removeprefix("mode:") for name in self.motion.modes)
            found.solver.manner = replace(found.solver.manner, flipping=groups)
        return found

    @cached_property
    def stages(self) -> tuple[Stage, ...]:
        """What is found before the main program: limit positions between which loads act."""
        return tuple(self.followed.stages(self.traced)) if self.followed.outputs else ()

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
            return Program.of(motion.trace, {**outputs, "ok": motion.valid})
        trace = motion.trace
        rule = StepRule(motion, trace.position("step"))
        passed = trace.logic("and", motion.valid, trace.compare("less", 0.5, trace.state("alive")))
        passed = trace.logic("and", passed, rule.kept)
        outputs |= {f"next:{name}": value for name, value in motion.next_states.items()}
        outputs |= {f"determinant:{name}": placed.determinant for name, placed in motion.placed.items()
                    if placed.coordinates}  # fmt: skip
        following = {**rule.following, "alive": select(passed, 1.0, 0.0)}
        self.begin = {**rule.begin, "alive": 1.0}
        return Program.of(trace, {**outputs, "margin": rule.margin, "ok": passed}, following)

    @cached_property
    def starts(self) -> dict[str, float | str]:
        """First values of the states: numbers, or the name of the state that they repeat."""
        _ = self.main
        states = {name: float(row[0]) for name, row in self.motion.states.items()}
        return {name: states.get(name, self.begin.get(name, 0.0)) for name in self.main.states}

    def _outputs(self, motion: MotionTrace) -> dict[str, Scalar | bool]:
        solver = self.traced.solver
        names = [name for name in solver.outputs.standard() if name != "outcome"]
        frame = [canonical(self.mechanism, "frame", point) for point in self.mechanism.frame.points]
        names += [each for key in frame for each in vector_names("p", key)]
        names += [each for link in self.mechanism.links for each in vector_names("e", link)]
        names += [
            each
            for name, link in self.mechanism.links.items()
            if link.mass
            for each in vector_names("p", f"{name}.@centre")
        ]
        names += [f"fact:{name}|{fact}" for name, placed in motion.placed.items() for fact in placed.facts]
        outputs: dict[str, Scalar | bool] = {name: solver.outputs.value(name) for name in names}
        for name in self.mechanism.guides:
            outputs |= {
                f"{kind}:{name}": solver.outputs.value(f"{kind}:{name}") for kind in ("s", "sv", "sa")
            }
            direction, _, _ = guide_state(motion, name)
            outputs |= {f"d:{name}.x": direction.x, f"d:{name}.y": direction.y}
        for group in self.dyads:
            outputs[f"m:{group.name}"] = transmission(solver.outputs, group)
            outputs[f"quality:{group.name}"] = motion.placed[group.name].quality
        if self.forces is not None:
            outputs |= self._of_forces()
        return {**outputs, "outcome": motion.outcome}

    def _of_forces(self) -> dict[str, Scalar | bool]:
        forces = self.traced.forces.outputs
        names = forces.standard()
        for load in self.mechanism.loads:
            names += [*vector_names("lf", load), *vector_names("lp", load)]
        names += ["shake.x", "shake.y", "shake_moment"]
        found: dict[str, Scalar | bool] = {name: forces.value(name) for name in names}
        return {**found, SIZES: self.followed.sizes(self.traced)} if self.followed.fallible else found

    @cached_property
    def dyads(self) -> tuple[Group, ...]:
        """Groups that have a transmission angle."""
        return dyads(self.motion.structure)

    def values(self) -> dict[str, float]:
        """Every parameter that a program takes, but those that the stages find."""
        known = {**self.traced.solver.nominal.parameters, **constants(self.traced), **self.followed.constants}
        wanted = dict.fromkeys([*self.main.parameters, *(self.cycle.dimensions if self.stages else ())])
        return {name: known[name] for name in wanted if name in known}

    def fields(self) -> Mapping[str, Floats]:
        """The course of what is held."""
        if self.forces is None:
            return {}
        return {name: self.forces.fields[name] for name in self.main.fields}

    def arrays(self) -> dict[str, Floats]:
        """The inputs per position of all programs."""
        found = {**self.motion.positions.arrays, **self.motion.modes}
        count = self.motion.positions.count
        time = self.motion.positions.time
        found["step"] = np.full(count, time[1] - time[0] if count > 1 else 0.0)
        wanted = {*self.main.positions, *(name for stage in self.stages for name in stage.program.positions)}
        return {name: found[name] for name in found if name in wanted}
