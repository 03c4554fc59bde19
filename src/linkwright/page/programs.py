"""The formula of a page: all that it draws and plots of one position, the loads, and the numbers to be changed.

Whether a load acts, how far its phase is passed, and the angles of links that turn are inputs per position of a
page's program, which the page finds once it has the motion.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict
from functools import cached_property

import numpy as np

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.phases import Always, InputPhase, MovingPhase, SwingPhase
from linkwright.core.arrays import Floats
from linkwright.core.data import Plain
from linkwright.core.inputs import mode_groups
from linkwright.core.outputs import SLIDE, Output, row_name, row_names
from linkwright.elements import Group
from linkwright.events.tracked_groups import TracedStep, chain_coordinates
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.replay import inlined
from linkwright.formula.table import Tables
from linkwright.formula.trace import Mask, Scalar, Trace, select
from linkwright.kinematics.branch import ROOM
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical, program_names
from linkwright.kinematics.programs import Manner
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinematics.trace import MotionTrace
from linkwright.kinetostatics.closure import dyads, transmission
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.friction import FrictionTerm, traced_rate
from linkwright.kinetostatics.load_site import TracedSite, acts_name, guide_state, middle_name
from linkwright.kinetostatics.run import solve_forces
from linkwright.kinetostatics.signals import AlongInput, MotionSignals, numbers_of_loads
from linkwright.kinetostatics.solver import ForceSolver
from linkwright.mechanism.mechanism import Mechanism
from linkwright.page.inputs import geometry_addresses, known_between

#: Newton steps of groups without closed form at every position.
ITERATIONS = 3
#: The output that is the sum of magnitudes which may not exist.
SIZES = "sizes of loads"


def _rate_of(term: FrictionTerm) -> str:
    """Name of the output that is the rate of a joint with friction, zero at rest."""
    return f"moving {term.field}"


class PagePrograms:
    """The formula of one mechanism and its inputs.

    Outputs of ``main`` besides those of motion and forces: ``d:GUIDE`` direction of a guide, ``m:GROUP``
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
            {
                **asdict(term),
                "field": term.field,
                "rate": _rate_of(term),
                "on": [term.b] if term.b in joints[term.joint].joined[1:] else joints[term.joint].joined[1:],
            }
            for term in terms
        ]

    @property
    def bends(self) -> list[Plain]:
        """Where cams and the like go over to another formula: angles of a link against its carrier, to which a
        dimension is added."""
        found = [joint.kinks for joint in self.mechanism.joints.values() if joint.kinks is not None]
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
        """Whether a group without closed form is tracked from position to position."""
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
        """All outputs; where groups are iterated, what the formula takes of them at the next position as well
        (``then:``)."""
        motion = self.solver.motion
        outputs = {**self._outputs(motion), "ok": motion.valid}
        program = self._after_step(outputs) if self.iterated else Program.of(motion.trace, outputs)
        return program.with_inputs([str(each["field"]) for each in self._angles])

    def _after_step(self, outputs: Mapping[str, Scalar | bool]) -> Program:
        """Outputs after a step from the position before, and whether that counts."""
        motion, t = self.solver.motion, Trace()
        step = TracedStep(motion, t.field_input, t.position("step"), 2)
        found = inlined(Program.of(motion.trace, {**step.outputs, **outputs}), t, step.states)
        values = step.values(found)
        doubt = step.doubt(t, {**found, **values}, step.groups, ROOM)
        passed: Mask = t.compare("less", doubt, 1.0)
        made = {name: found[name] for name in outputs}
        for name in step.groups:
            made[f"kept:{name}"] = determinant = found[f"determinant {name}"] * self._signs[name]
            passed = t.logic("and", passed, t.compare("less", 0.0, determinant))
        for name, value in values.items():
            orders = (value, found[f"{name}'"], found[f"{name}''"])
            made |= {f"then:{name}|{k}": each for k, each in enumerate(orders)}
        return Program.of(t, {**made, "margin": 1.0 - doubt, "ok": select(passed, found["ok"], 0.0)})

    @cached_property
    def _signs(self) -> dict[str, float]:
        """Signs of the determinants of groups that are iterated."""
        placed = self.motion.solver.motion.placed.items()
        names = {name: each.determinant for name, each in placed if each.coordinates}
        program = NumpyProgram(Program.of(self.motion.solver.motion.trace, names))
        numbers = [self.motion.design.parameters[name] for name in program.program.parameters]
        arrays, count = {**self.motion.positions.arrays, **self.motion.modes}, self.motion.steps
        rows = program.run(numbers, arrays, self.motion.states, length=count)
        return dict(zip(names, np.sign(rows[:, 0]).tolist(), strict=True))

    @cached_property
    def starts(self) -> dict[str, float]:
        """Coordinates that go from one position to the next, at the first one."""
        coordinates = chain_coordinates(self.solver.motion) if self.iterated else ()
        return {each.name: float(each.value(self.motion.states)[0]) for each in coordinates}

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
        names += [row_name("fact", name, on=fact) for name, placed in motion.placed.items() for fact in placed.facts]
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
            moving_name(each): self._moving(each) for load in self.found for each in load.magnitude.phase.outputs
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
        carried = {f"{name}|{k}" for name in self.starts for k in range(3)}
        return {name: self.forces.fields.get(name, empty) for name in self.main.fields if name not in carried}

    def arrays(self) -> dict[str, Floats]:
        """The inputs per position."""
        found = {**self.motion.positions.arrays, **self.motion.modes}
        count = self.motion.positions.count
        time = self.motion.positions.time
        found["step"] = np.append(0.0, np.full(count - 1, time[1] - time[0] if count > 1 else 0.0))
        return {name: found[name] for name in found if name in self.main.positions}


def found_again(load: Load, motion: Motion) -> bool:
    """Whether a page finds it: its size is a formula, and limits that it goes between are those of the positions, not
    of a turn of which these are a part."""
    magnitude = load.magnitude
    if magnitude.limits is None or not magnitude.has_formula:
        return magnitude.has_formula
    return known_between(motion) and (motion.positions.closed or MotionSignals(motion).full_cycle.period is None)


def traced_name(load: Load) -> str:
    """The load as the trace of forces takes it: wholly, or but for its phase."""
    return load.name if isinstance(load.magnitude.phase, Always) else acts_name(load.name)


def phases(loads: Iterable[Load], motion: Motion) -> list[Plain]:
    """The phases, with what they go by: the coordinate of the first driver, or an output by rows of the program."""
    return [
        {"load": load.name, "ramp": load.magnitude.size.ramp, **_phase(load, motion)}
        for load in loads
        if not isinstance(load.magnitude.phase, Always)
    ]


def _phase(load: Load, motion: Motion) -> Plain:
    phase = load.magnitude.phase
    if isinstance(phase, InputPhase):
        return {"kind": "input", "between": interval(load)}
    assert isinstance(phase, MovingPhase | SwingPhase)
    rows, (rate, second) = program_names(motion.mechanism, phase.output)
    part = phase.part if isinstance(phase, SwingPhase) else None
    return {
        "kind": "moving" if isinstance(phase, MovingPhase) else "stroke",
        "rows": list(rows),
        "rate": rate,
        "second": second,
        "moving": moving_name(phase.output),
        "ends": (phase.start, phase.end),
        "part": part and {"word": part.word, "amounts": [[a.value, a.share] for a in part.amounts]},
    }


def interval(load: Load) -> list[str]:
    """Addresses of the coordinates between which a load acts by its input."""
    phase = load.magnitude.phase
    return [f"loads.{load.name}.phase{end}" for end in phase.numbers] if isinstance(phase, InputPhase) else []


def moving_name(output: Output) -> str:
    """Name of the program's output that is the rate of an output, zero at rest."""
    return f"moving {output}"


def angles(loads: Iterable[Load], motion: Motion) -> list[Plain]:
    """The angles that loads take at every position: of link b against a.

    ``near``: where given, a dimension's address, and its value where it is no parameter; the angle begins within half
    a turn of it.
    """
    found: dict[str, Plain] = {}
    for load in loads:
        for (a, b), near in load.magnitude.angles(motion.mechanism).items():
            begin = None if near is None else [f"loads.{load.name}.free_angle", near]
            found[middle_name(a, b)] = {"field": middle_name(a, b), "a": a, "b": b, "near": begin}
    return list(found.values())
