"""Motion and forces of one mechanism evaluated together, by traced programs cached with those of its motion."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any, NoReturn

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output
from linkwright.core.table import Cell, Table
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.trace import Scalar
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.programs import MotionPrograms, locked_property
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinetostatics.friction import (
    FrictionTerms,
    SolvedFriction,
    Wrenches,
    caused,
    pressing,
    solved_friction,
)
from linkwright.kinetostatics.load_site import RestingSite, TracedSite
from linkwright.kinetostatics.named_outputs import Named
from linkwright.kinetostatics.self_check import ForceChecks
from linkwright.kinetostatics.trace import ForceOutputs, ForceTrace, Size, trace_forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _


class ForceSolver:
    """Evaluates the forces of a motion solver's mechanism."""

    def __init__(
        self,
        motion: MotionSolver,
        *,
        inertia: bool = True,
        along_input: frozenset[str] = frozenset(),
        rubbing: bool = False,
        site: Callable[..., TracedSite] = TracedSite,
    ) -> None:
        self.motion = motion
        self.inertia = inertia
        self.along_input = along_input
        self.rubbing = rubbing
        self.site = site

    def __getstate__(self) -> dict[str, Any]:
        """All but what every process makes for itself."""
        return {name: each for name, each in self.__dict__.items() if name not in ("programs", "friction")}

    @cached_property
    def programs(self) -> ForcePrograms:
        """The programs of the mechanism's shape."""
        return force_programs(
            self.motion.programs,
            inertia=self.inertia,
            along_input=self.along_input,
            rubbing=self.rubbing,
            site=self.site,
        )

    @cached_property
    def friction(self) -> FrictionTerms:
        """Friction of the mechanism's joints."""
        return FrictionTerms.of(self.motion.mechanism, self.motion.motion)

    @property
    def forces(self) -> ForceTrace:
        """Reactions and efforts as traced values."""
        return self.programs.forces

    @property
    def resting(self) -> ForceTrace:
        """The same of what holds the mechanism still."""
        return self.programs.resting

    @property
    def outputs(self) -> ForceOutputs:
        """The forces' outputs by name."""
        return self.programs.outputs

    def program(self, names: tuple[str, ...]) -> NumpyProgram:
        """The program for some outputs, of the forces or of the motion."""
        return self.programs.program(names)

    def fields_needed(self) -> tuple[str, ...]:
        """Inputs per position that are found from the motion: load magnitudes, angles, friction."""
        carried = self.motion.motion.next_states
        return tuple(name for name in self.program(self.programs.checks.names).program.fields if name not in carried)

    def evaluate(self, names: tuple[str, ...], motion: Motion, fields: Mapping[str, Floats]) -> Floats:
        """Outputs by name, shape (names, n)."""
        program = self.program(names)
        values = [motion.design.parameters[name] for name in program.program.parameters]
        arrays = {**motion.positions.arrays, **motion.modes}
        states_and_fields = {**motion.states, **fields}
        return np.asarray(program.run(values, arrays, states_and_fields, length=motion.steps))


#: Before an output in words among the names of outputs.
_WORDS = "words:"
#: Before the field of a friction that is not taken but found.
_CAUSED = "caused:"
#: Before the name of a force whose size matters.
_SIGNED = "signed:"


def words_name(words: str) -> str:
    """The name under which programs know an output in the user's words (see :class:`Named`)."""
    return _WORDS + words


def in_words(name: str) -> bool:
    """Whether a name is one of these."""
    return name.startswith(_WORDS)


def caused_name(field: str) -> str:
    """The name under which programs know the friction that the joint forces cause, by its field."""
    return _CAUSED + field


def signed_name(name: str) -> str:
    """The name under which programs know a force whose size matters, see :attr:`ForcePrograms.signed`."""
    return _SIGNED + name


def _no_angle(link: str) -> NoReturn:
    raise AssertionError(f"the angle of {link} is continuous in a motion, not in a program")


class ForcePrograms:
    """The traced forces of all mechanisms of one shape, and the programs made of them."""

    def __init__(
        self,
        motion: MotionPrograms,
        inertia: bool,
        along_input: frozenset[str],
        rubbing: bool,
        site: Callable[..., TracedSite],
    ) -> None:
        self.site = site
        self.motion = motion
        self.lock = motion.lock
        self.inertia = inertia
        self.along_input = along_input
        self.rubbing = rubbing
        self._programs: dict[tuple[str, ...], NumpyProgram] = {}

    @locked_property
    def forces(self) -> ForceTrace:
        """Reactions and efforts as traced values."""
        solved = self.friction
        wrenches = self._terms.wrenches(None if solved is None else solved.sizes)
        return self._under(wrenches)

    @locked_property
    def friction(self) -> SolvedFriction | None:
        """The friction where it is traced; None where it is an input, or there is none."""
        if not self.rubbing or not self._terms.terms:
            return None
        return solved_friction(self._terms, self._under)

    @locked_property
    def resting(self) -> ForceTrace:
        """What holds the mechanism still in its positions: no inertia, no rates, no friction of joints."""
        return trace_forces(self.motion.motion, inertia=False, along_input=self.along_input, site=RestingSite)

    @locked_property
    def signed(self) -> dict[str, Scalar]:
        """Forces, N, by name, with whose sizes others go, which so bend where these are zero: those that press guides
        with friction, and those between teeth or in strands that press on pins."""
        if not any(term.slides for term in self._terms.terms):
            return self.forces.between
        sliding = (term for term in self._terms.terms if term.slides)
        return {term.field: pressing(self.forces, term).x for term in sliding} | self.forces.between

    @locked_property
    def _terms(self) -> FrictionTerms:
        return FrictionTerms.of(self.motion.mechanism, self.motion.motion)

    def _under(self, wrenches: Wrenches, **teeth: Size) -> ForceTrace:
        """The forces under further wrenches."""
        return trace_forces(
            self.motion.motion,
            inertia=self.inertia,
            extra=wrenches,
            along_input=self.along_input,
            site=self.site,
            **teeth,
        )

    @locked_property
    def outputs(self) -> ForceOutputs:
        """The forces' outputs by name."""
        return ForceOutputs(self.forces)

    @locked_property
    def checks(self) -> ForceChecks:
        """What of them is checked."""
        return ForceChecks(self.outputs, self.motion.outputs, self.motion.mechanism.size)

    def program(self, names: tuple[str, ...]) -> NumpyProgram:
        """The program for some outputs, of the forces or of the motion."""
        with self.lock:
            if names not in self._programs:
                values = {name: self.value(name) for name in names}
                self._programs[names] = NumpyProgram(Program.of(self.motion.motion.trace, values))
            return self._programs[names]

    @locked_property
    def named(self) -> Named:
        """Outputs in the user's words."""
        return Named(self, _no_angle, _no_angle)

    def value(self, name: str) -> Scalar:
        """The traced value of a row of the forces or of the motion."""
        if name.startswith(_WORDS):
            return self.named.quantity(name.removeprefix(_WORDS)).value
        if name.startswith(_CAUSED):
            return caused(self._terms, self.forces, name.removeprefix(_CAUSED))
        if name.startswith(_SIGNED):
            return self.signed[name.removeprefix(_SIGNED)]
        output = Output.of_row(name)
        return (self.motion.outputs if output.of_motion else self.outputs).value(name)


def force_programs(
    motion: MotionPrograms,
    *,
    inertia: bool = True,
    along_input: frozenset[str] = frozenset(),
    rubbing: bool = False,
    site: Callable[..., TracedSite] = TracedSite,
) -> ForcePrograms:
    """The programs of the forces that belong to those of a motion; arguments as for ``trace_forces``, ``rubbing``:
    the friction is traced, else an input per position."""
    key = (inertia, along_input, rubbing, site)
    return _cache.get(motion, key, lambda: ForcePrograms(motion, *key))


_cache: Recent[MotionPrograms, ForcePrograms] = Recent(48)


def program_of_results(mechanism: Mechanism, *, forces: bool) -> Program:
    """The program of a motion, or of a motion with its joint forces."""
    solver = MotionSolver(mechanism)
    names = solver.outputs.standard
    if not forces:
        return solver.program(names).program
    with_forces = ForceSolver(solver)
    return with_forces.program((*names[:-1], *with_forces.outputs.standard)).program


def operations(program: Program) -> Table:
    """How many operations of every kind a program has: once per design, once per position."""
    counts = program.counts()
    design, position = counts["design"], counts["position"]
    kinds = sorted({*design, *position})
    rows: list[list[Cell]] = [[kind, design.get(kind, 0), position.get(kind, 0)] for kind in kinds]
    rows.append([_("total"), sum(design.values()), sum(position.values())])
    return Table((_("operation"), _("per design"), _("per position")), rows)
