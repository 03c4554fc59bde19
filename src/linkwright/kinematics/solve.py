"""Solving the motion: one call from a mechanism to its positions, velocities and accelerations."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arguments import STEPS, require
from linkwright.core.arrays import Floats
from linkwright.core.inputs import mode_groups
from linkwright.errors import RequestError
from linkwright.kinematics.change_points import crossings, cut_off, mark_singular, outputs_at_crossings, signs
from linkwright.kinematics.cycle import over_cycle, time_span
from linkwright.kinematics.dimensions import Design
from linkwright.kinematics.motion import Motion, Rows
from linkwright.kinematics.passing import ChangePointCrossing, clear_of_zero
from linkwright.kinematics.positions import Positions, at_inputs, at_times
from linkwright.kinematics.reach_messages import branch_notes, passage_notes, turn_notes
from linkwright.kinematics.solver import MotionSolver
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

#: Positions of the turn along which change points are looked for.
LOOKS = 360


def solve_motion(
    mechanism: Mechanism,
    *,
    steps: int = STEPS,
    at: ArrayLike | Mapping[str, ArrayLike] | None = None,
    times: ArrayLike | None = None,
    endpoint: bool = False,
    failures: Literal["raise", "mark"] = "raise",
) -> Motion:
    """Positions, velocities and accelerations of all links and points.

    Args:
        mechanism: what to solve.
        steps: equal steps over the cycle (see ``over_cycle``); used if neither ``at`` nor ``times`` is set.
        at: coordinates of the first driver (rad or m), or of drivers by name.
        times: times in s.
        endpoint: repeat the first position of a closed cycle at its end.
        failures: ``raise`` refuses if any position cannot be reached; ``mark`` gives NaN there and says why in
            ``Motion.outcomes``.

    Returns:
        The motion; arrays have the position first.

    Raises:
        PositionError: a position is out of reach or singular, and ``failures`` is ``raise``.
        StructureError, AssemblyError, CycleError: the model is not determined, cannot be put together, or has no
            cycle.
    """
    require(mechanism, Mechanism)
    positions = _positions(mechanism, steps, at, times, endpoint)
    single = at is not None or times is not None
    return MotionRun(MotionSolver(mechanism), positions, single=single).solve(failures)


def _positions(
    mechanism: Mechanism,
    steps: int,
    at: ArrayLike | Mapping[str, ArrayLike] | None,
    times: ArrayLike | None,
    endpoint: bool,
) -> Positions:
    if at is not None and times is not None:
        raise RequestError(
            _("positions are given by inputs (at) and by times; give one of the two", code="motion.at_and_times")
        )
    if at is not None:
        positions = at_inputs(mechanism, at)
    elif times is not None:
        positions = at_times(mechanism, times)
    else:
        return over_cycle(mechanism, steps, endpoint)
    if not positions.count:
        raise RequestError(
            _(
                "no positions; give an input or a time, or leave at and times out for the full cycle",
                code="motion.no_positions",
            )
        )
    return positions


def try_motion(mechanism: Mechanism, steps: int) -> Motion:
    """The motion over the cycle with its outcomes only, positions that are not reached marked.

    Everything else is evaluated when it is asked for. Raises as :func:`solve_motion`.
    """
    return MotionRun(MotionSolver(mechanism), over_cycle(mechanism, steps)).solve("mark", ("outcome",))


def with_times(motion: Motion, times: Iterable[float]) -> tuple[Motion, list[int]]:
    """A motion with further times, s, among its own ones, positions that are not reached marked, and where they are
    in it. What follows a way goes on along it; raises as :func:`solve_motion`."""
    own, wanted = motion.time, np.array([*times], dtype=float)
    near = 1e-9 * (abs(float(own[1] - own[0])) if len(own) > 1 else 1.0)
    every = np.unique(np.concatenate([own, wanted]))
    every = every[np.diff(every, prepend=-np.inf) > near]
    if len(own) > 1 and own[-1] < own[0]:
        every = every[::-1]
    positions = at_times(motion.mechanism, every, motion.positions.period)
    found = MotionRun(MotionSolver(motion.mechanism), positions, single=not motion.positions.is_way).solve("mark")
    return found, [int(np.argmin(np.abs(every - each))) for each in wanted]


class MotionRun:
    """One evaluation of a solver over positions; ``single``: inputs for themselves, not a cycle."""

    def __init__(self, solver: MotionSolver, positions: Positions, *, single: bool = False) -> None:
        self.solver = solver
        self.positions = positions
        self.single = single

    def solve(self, failures: str = "raise", stored: tuple[str, ...] = ()) -> Motion:
        """The motion, with change points passed smoothly; ``stored``: the outputs evaluated at once, all if empty."""
        if failures not in ("raise", "mark"):
            raise RequestError(
                _(
                    "invalid failures {value!r}; give 'raise' to refuse positions that cannot be reached, or "
                    "'mark' to mark them",
                    code="motion.no_failures",
                    value=failures,
                )
            )
        tracked = self.solver.track(self.positions, separate=self.single)
        at_once = None if tracked or stored or self.single else self._at_once()
        if at_once is not None:
            return at_once
        states = {} if tracked is None else tracked.states
        modes, messages = reached_modes(self.solver, self.positions) if self.single else ({}, ())
        found = [] if modes else crossings(self.solver, self.positions, tracked)
        if any(p.touches for p in found):
            modes = signs(found, self.solver.assembly.modes, self.positions.count)
        if modes:
            self.solver = self.solver.with_flips(mode_groups(modes))
        breaks = frozenset() if tracked is None else tracked.breaks
        breaks |= {p.before for p in found if p.kind == "end" or p.barred}
        names = stored or self.solver.outputs.standard
        motion = self._evaluate(states, modes, found, breaks, names)
        motion.tracked = tracked
        motion.notes += messages + turn_notes(motion) + branch_notes(motion)
        if failures == "raise" and not motion.complete:
            raise motion.refusal()
        return motion

    def _at_once(self) -> Motion | None:
        """The motion where all positions are reached and show that nothing is passed between two of them; None where
        they do not."""
        measures = outputs_at_crossings(self.solver, self.positions)
        if measures is None:
            return None
        names = (*self.solver.outputs.standard, *measures)
        rows = Rows(self.solver.evaluate(names, self.positions, {}, {}), self.solver.programs.places(names))
        if np.count_nonzero(rows.values[rows.index["outcome"]]):
            return None
        if measures and not _clear(measures, rows.values[-len(measures) :]):
            return None
        motion = Motion(self.solver, self.solver.nominal, self.positions, rows)
        motion.notes = turn_notes(motion) + branch_notes(motion)
        return motion

    def _evaluate(
        self,
        states: Mapping[str, Floats],
        modes: Mapping[str, Floats],
        found: list[ChangePointCrossing],
        breaks: frozenset[int],
        names: tuple[str, ...],
    ) -> Motion:
        values = self.solver.evaluate(names, self.positions, states, modes)
        codes = values[-1]
        mark_singular(codes, found, self.solver.structure)
        barred = cut_off(codes, self.positions, breaks)
        motion = marked(self.solver, self.solver.nominal, self.positions, names, values, states, modes, barred)
        motion.notes = passage_notes(found, self.positions)
        motion.breaks = breaks if self.positions.is_way else frozenset()
        return motion


def marked(
    solver: MotionSolver,
    design: Design,
    positions: Positions,
    names: tuple[str, ...],
    values: Floats,
    states: Mapping[str, Floats],
    modes: Mapping[str, Floats],
    barred: Floats,
) -> Motion:
    """The motion of outputs (names, n), NaN at positions that are not solved, ``barred`` or not tracked."""
    for row in states.values():
        barred = np.where(np.isfinite(row), barred, 1.0)
    rows = Rows(values, solver.programs.places(names))
    motion = Motion(solver, design, positions, rows, states, modes, barred=barred)
    values[:-1, ~motion.ok] = np.nan
    return motion


def _clear(measures: tuple[str, ...], rows: Floats) -> bool:
    """Whether these outputs (measures, n) show that nothing is passed between two positions."""
    lows, highs = rows.min(axis=1).tolist(), rows.max(axis=1).tolist()
    return clear_of_zero(measures, lows, highs, lambda k: float(np.abs(np.diff(rows[k], append=rows[k, 0])).max()))


def reached_modes(solver: MotionSolver, positions: Positions) -> tuple[dict[str, Floats], tuple[str, ...]]:
    """Signs (n,) of the groups that pass change points on the way to each position, and what to say of it.

    Empty if no change point is passed.

    For mechanisms of dyads with one driver that turns at constant speed and passes the full turn. The way
    begins at the start of the cycle; after an odd number of change points in one turn the second turn has the
    other sign.
    """
    drivers = list(solver.mechanism.drivers.values())
    if len(drivers) != 1 or drivers[0].law.constant_speed is None or solver.motion.next_states:
        return {}, ()
    duration = drivers[0].law.natural_duration()
    if duration is None:
        return {}, ()
    begin = time_span(solver.mechanism)[0]
    turn = at_times(solver.mechanism, begin + duration * np.arange(LOOKS) / LOOKS, duration)
    passing = crossings(solver, turn, None)
    if not passing or any(p.barred for p in passing):
        return {}, ()
    turns, share = np.divmod((positions.time - begin) / duration, 1.0)
    found = signs(passing, solver.assembly.modes, share * LOOKS)
    for group, row in zip(mode_groups(found), found.values(), strict=True):
        count = sum(p.group == group and p.touches for p in passing)
        if count % 2:
            row[turns % 2 == 1] *= -1.0
    return found, passage_notes(passing, turn)
