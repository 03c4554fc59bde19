"""Chosen outputs of a mechanism in one program, ready for many designs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from copy import copy
from dataclasses import replace
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.inputs import mode_inputs
from linkwright.core.outputs import row_name
from linkwright.cycle.machine import CLEAR, line_near
from linkwright.errors import RequestError
from linkwright.formula.program import Program
from linkwright.formula.trace import Mask, Scalar, absolute, select
from linkwright.kinematics.assembly import modal_groups
from linkwright.kinematics.change_points import nearness
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.positions import Positions
from linkwright.kinematics.programs import Manner, motion_programs
from linkwright.kinematics.solve import solve_motion
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinetostatics.named_outputs import Named, Quantity
from linkwright.kinetostatics.solver import ForceSolver
from linkwright.kinetostatics.traced_loads import TURNING
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

#: The truth output that says which positions of a design are solved.
VALID = "valid"
#: The output that tells how near the dyads are to a change point.
NEAREST = "nearest change point"


class TurnsThrough(RequestError):
    """An angle is wanted of a link that turns by more than programs can tell from each other."""


class Traced:
    """Programs of one mechanism for outputs in the user's words.

    ``free``: dimensions that will vary; ``iterations``: Newton steps of groups without closed form;
    ``turning``: angles of links that turn through may be asked; ``flipping``: the programs take the signs of assembly
    modes per position.
    """

    def __init__(
        self,
        mechanism: Mechanism,
        free: Iterable[str],
        positions: Positions,
        *,
        iterations: int = 1,
        turning: bool = False,
        flipping: bool = False,
    ) -> None:
        self.mechanism = mechanism
        self.positions = positions
        self.turning = turning
        manner = Manner(frozenset(free), iterations=iterations)
        if flipping:
            groups = modal_groups(motion_programs(mechanism, manner).structure)
            manner = replace(manner, flipping=frozenset(groups))
        self.solver = MotionSolver(mechanism, manner)
        self._under_loads(frozenset(), rubbing=False)

    def _under_loads(self, names: frozenset[str], *, rubbing: bool) -> None:
        self.forces = ForceSolver(self.solver, along_input=names, rubbing=rubbing)
        self.named = Named(self.forces, self._middle, self._line)

    def with_loads(self, names: frozenset[str], *, rubbing: bool) -> Traced:
        """The same with the magnitudes of some loads traced over the input, and with the friction."""
        if not names and not rubbing:
            return self
        found = copy(self)
        found._under_loads(names, rubbing=rubbing)
        return found

    @cached_property
    def nominal(self) -> Motion:
        """The motion of the mechanism as it is."""
        return solve_motion(self.mechanism, steps=self.positions.steps, failures="mark")

    @cached_property
    def arrays(self) -> dict[str, Floats]:
        """Inputs per position; with ``flipping`` the signs of the assembly modes of the mechanism as it is."""
        found = dict(self.positions.arrays)
        if self.solver.manner.flipping:
            signs, count = mode_inputs(self.solver.assembly.modes), self.positions.count
            found |= {name: np.full(count, sign) for name, sign in signs.items()}
            found |= self.nominal.modes
        return found

    def quantities(self, names: Iterable[str]) -> dict[str, Quantity]:
        """The outputs by their names."""
        return {name: self.named.quantity(name) for name in dict.fromkeys(names)}

    def program(self, quantities: Mapping[str, Quantity], more: Mapping[str, Scalar | bool] | None = None) -> Program:
        """What the quantities need, ``more`` outputs, the truth output ``valid``, and how near change points are."""
        motion = self.solver.motion
        outputs: dict[str, Scalar | bool] = {name: each.carrier for name, each in quantities.items()}
        outputs[NEAREST] = self.nearest
        outputs[VALID] = motion.valid
        return Program.of(motion.trace, {**outputs, **(more or {})})

    @cached_property
    def nearest(self) -> Scalar:
        """How near the dyads are to a change point or a gap, as a traced value."""
        return nearness(self.solver)

    def table(
        self, program: Program, columns: Mapping[str, Floats], known: Mapping[str, float] | None = None
    ) -> Floats:
        """The parameters of the designs with the given columns, (designs, parameters); ``known``: of those that are
        no dimensions."""
        numbers = {**self.solver.nominal.parameters, **(known or {})}
        return design_table(program.parameters, numbers, columns)

    @property
    def counted_for_certain(self) -> Mask:
        """Where a position is reached, and no such rotation is far from its line."""
        motion = self.solver.motion
        found: Mask = motion.valid
        for name, rotation in motion.angles.carried.items():
            near = absolute(rotation - motion.trace.field_input(name)) < CLEAR
            found = motion.trace.logic("and", found, near)
        return found

    def failure_flags(self) -> dict[str, Scalar]:
        """Per group 1 where it is the first that fails, by the rows of ``unreachable`` and ``singular``."""
        motion = self.solver.motion
        flags: dict[str, Scalar] = {}
        before: Mask = True
        logic = motion.trace.logic
        for name, placed in motion.placed.items():
            if placed.valid is True:
                continue
            bad = logic("and", before, _not(placed.valid))
            flags[row_name("unreachable", name)] = select(logic("and", bad, _not(placed.reached)), 1.0, 0.0)
            flags[row_name("singular", name)] = select(logic("and", bad, placed.reached), 1.0, 0.0)
            before = logic("and", before, placed.valid)
        return flags

    def _line(self, link: str) -> tuple[float, float]:
        """The line near which the angle of a link runs: rad where the input is zero, and turns in a turn of it."""
        rotation, rotary = self.nominal.link(link).angle, next(iter(self.positions.rotary.values()), False)
        good = np.isfinite(rotation)
        if not good.any():
            return 0.0, 0.0
        q = self.nominal.input[good] if rotary else np.zeros(int(good.sum()))
        line = line_near(rotation[good], q)
        if line is None:
            raise TurnsThrough(
                _(
                    "{link!r} turns unevenly with the input, so its turns cannot be counted; use another "
                    "output in the formula",
                    code="study.turns_unevenly",
                    link=link,
                )
            )
        return line

    def _middle(self, link: str) -> float:
        """The direction that is farthest from where the link never points: the middle of its swing."""
        angle = self.nominal.link(link).angle
        angle = angle[np.isfinite(angle)]
        if not len(angle):
            return 0.0
        low, high = float(angle.min()), float(angle.max())
        if high - low <= TURNING:
            return 0.5 * (low + high)
        if not self.turning:
            raise TurnsThrough(
                _(
                    "{link!r} turns through, so its angle has no smallest and largest value; ask for "
                    "{link}.angular_velocity instead",
                    code="study.turns_through",
                    link=link,
                )
            )
        around = np.sort(angle % (2 * np.pi))
        gaps = np.diff(np.append(around, around[0] + 2 * np.pi))
        widest = int(np.argmax(gaps))
        return float(around[widest] + 0.5 * gaps[widest] - np.pi)


def design_table(names: Sequence[str], known: Mapping[str, float], columns: Mapping[str, Floats]) -> Floats:
    """What a program takes of some designs, (designs, names): the columns (designs,), else what is known of all."""
    count = len(next(iter(columns.values())))
    table = np.empty((count, len(names)))
    for place, name in enumerate(names):
        table[:, place] = columns[name] if name in columns else known[name]
    return table


def _not(mask: Mask) -> Mask:
    return (not mask) if isinstance(mask, bool) else ~mask
