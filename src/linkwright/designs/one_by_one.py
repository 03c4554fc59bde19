"""What the programs of forces take per design and position: load magnitudes, angles, friction."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.core.inputs import mode_inputs
from linkwright.designs.traced_outputs import Traced
from linkwright.errors import LinkwrightError
from linkwright.formula.trace import Mask
from linkwright.kinematics.cycle_angles import STEPS
from linkwright.kinematics.design import Design
from linkwright.kinematics.motion import Motion, Rows
from linkwright.kinematics.solve import MotionRun
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinetostatics.run import run_forces
from linkwright.words.sentence import Sentence

#: The field that is 1 at the positions that a design reaches on its way through change points, else 0.
REACHED = "reached"


class OneByOne:
    """Finds, from the motion of each design alone, what a program takes as inputs per position.

    These are load magnitudes and friction, the chain coordinates of groups without closed form and, with
    ``flipping``, the signs of assembly modes on the way through change points.
    """

    def __init__(self, traced: Traced, *, flipping: bool = False) -> None:
        self.traced = traced
        self.flipping = flipping
        closed = traced.positions.closed and traced.positions.count >= STEPS
        self.shared = closed and not traced.solver.motion.next_states

    def motion(self, changes: Mapping[str, float]) -> Motion:
        """The motion of a design; positions that are not reached are marked."""
        traced = self.traced
        if self.flipping:
            solver = MotionSolver(traced.mechanism.with_dimensions(changes))
            return MotionRun(solver, traced.positions).solve("mark")
        if self.shared:
            design = Design(traced.mechanism, traced.solver.assembly.modes, changes)
            return evaluated(traced.solver, design, traced)
        solver = MotionSolver(traced.mechanism.with_dimensions(changes))
        return evaluated(solver, solver.nominal, traced)

    @property
    def valid(self) -> Mask:
        """Whether a position is solved and, on a way through change points, reached."""
        motion = self.traced.solver.motion
        if not self.flipping:
            return motion.valid
        reached = motion.trace.compare("less", 0.5, motion.trace.field_input(REACHED))
        return motion.trace.logic("and", motion.valid, reached)

    def inputs(self, names: tuple[str, ...], motion: Motion) -> dict[str, Floats]:
        """The inputs (n,) by name; raises LinkwrightError where a load fails for this design."""
        signs = mode_inputs(motion.solver.assembly.modes)
        found = {name: np.full(motion.steps, sign) for name, sign in signs.items()}
        found |= {**motion.states, **motion.modes, REACHED: motion.ok.astype(float)}
        if any(name not in found for name in names):
            found |= run_forces(motion, False).fields
        return {name: found[name] for name in names}

    def rows(
        self, names: tuple[str, ...], columns: Mapping[str, Floats]
    ) -> tuple[dict[str, Floats], dict[int, str], Flags]:
        """Inputs (designs, n) by name, the sentences of the designs for which they cannot be found, and whether the
        way of each design leads through all positions that it reaches, (designs,)."""
        designs = len(next(iter(columns.values())))
        rows = {name: np.ones((designs, self.traced.positions.count)) for name in names}
        failed: dict[int, str] = {}
        through = np.ones(designs, dtype=np.bool_)
        for index in range(designs):
            try:
                motion = self.motion(changes_of(columns, index))
                through[index] = not motion.breaks
                for name, row in self.inputs(names, motion).items():
                    rows[name][index] = row
            except LinkwrightError as error:
                failed[index] = error.sentence
        return rows, failed, through


def changes_of(columns: Mapping[str, Floats], index: int) -> dict[str, float]:
    """The varied dimensions of one design."""
    return {address: float(column[index]) for address, column in columns.items()}


def evaluated(solver: MotionSolver, design: Design, traced: Traced) -> Motion:
    """The motion of one design over the study's positions."""
    positions = traced.positions
    followed = solver.follow(positions, design)
    states = {} if followed is None else followed.states
    names = solver.outputs.standard
    values = solver.evaluate(names, positions, states, {}, design)
    barred = np.zeros(positions.count)
    for row in states.values():
        barred = np.where(np.isfinite(row), barred, 1.0)
    values[:-1, (values[-1] != 0.0) | (barred != 0.0)] = np.nan
    index = {name: i for i, name in enumerate(names)}
    return Motion(solver, design, positions, states, {}, Rows(values, index), (), barred, followed)


def sentence_of(traced: Traced, changes: Mapping[str, float]) -> str:
    """Why a design cannot pass its cycle."""
    try:
        motion = OneByOne(traced, flipping=True).motion(changes)
    except LinkwrightError as error:
        return error.sentence
    if motion.whole:
        return Sentence("study.not_followed")
    return motion.refusal().sentence
