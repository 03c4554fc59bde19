"""Assembly modes at single inputs, as the motion from the start of the cycle reaches them."""

from __future__ import annotations

import numpy as np

from linkwright.kinematics.change_points import notes, passages, signs
from linkwright.kinematics.cycle import Floats, Positions, at_times, time_span
from linkwright.kinematics.solver import MotionSolver

#: Positions of the turn along which change points are looked for.
STEPS = 360


def reached_modes(solver: MotionSolver, positions: Positions) -> tuple[dict[str, Floats], tuple[str, ...]]:
    """Signs (n,) of the groups that pass change points on the way to each position, and what to say of it.

    Empty if no change point is passed.

    For mechanisms of dyads with one driver that turns at constant speed and passes the whole turn. The way
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
    turn = at_times(solver.mechanism, begin + duration * np.arange(STEPS) / STEPS, True, duration)
    passing = passages(solver, turn, None)
    if not passing or any(p.barred for p in passing):
        return {}, ()
    turns, share = np.divmod((positions.time - begin) / duration, 1.0)
    found = signs(passing, solver.assembly.modes, share * STEPS)
    for name, row in found.items():
        count = sum(p.group == name.removeprefix("mode:") and p.touches for p in passing)
        if count % 2:
            row[turns % 2 == 1] *= -1.0
    return found, notes(passing, turn)
