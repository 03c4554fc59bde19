"""Loads whose phases, or angles of links that turn through, a page finds at every position once it has the motion.

What no cycle program finds beforehand: several reversals in a cycle of many turns, groups without closed form,
several drivers. The magnitudes themselves are traced.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.json_data import Plain
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import program_names
from linkwright.kinetostatics.load_site import ACTS, middle_name
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.loads.base import Load
from linkwright.loads.over_cycle import activity
from linkwright.loads.phases import Always, InputPhase, MovingPhase, SwingPhase


def found_again(load: Load, motion: Motion) -> bool:
    """Whether a page finds it: its kind traces its magnitude, and limits that it takes lie in a steady cycle."""
    if not load.magnitude.has_formula:
        return False
    drivers = list(motion.mechanism.drivers.values())
    steady = len(drivers) == 1 and drivers[0].law.constant_speed is not None and motion.positions.closed
    return steady or load.magnitude.limits is None


def traced_names(loads: Iterable[Load], motion: Motion) -> frozenset[str]:
    """The loads as ``cycle_programs/traced_outputs.py`` takes them: wholly, or but for their phases."""
    return frozenset(
        f"{ACTS}:{each.name}" if _phase_per_position(each, motion) else each.name for each in loads
    )


def _phase_per_position(load: Load, motion: Motion) -> bool:
    """All phases but those of the coordinate of a driver that turns steadily, which are formulas."""
    phase = load.magnitude.phase
    if not isinstance(phase, InputPhase):
        return not isinstance(phase, Always)
    first = next(iter(motion.mechanism.drivers.values()))
    return first.law.constant_speed is None or not motion.positions.rotary[first.name]


def phases(loads: Iterable[Load], motion: Motion) -> list[Plain]:
    """The phases that follow the motion: their outputs by rows of a page's main program."""
    found: list[Plain] = []
    for load in loads:
        given = load.magnitude
        phase = given.phase
        if isinstance(phase, MovingPhase | SwingPhase):
            rows, (rate, _) = program_names(motion.mechanism, phase.output)
            part = phase.part if isinstance(phase, SwingPhase) else None
            shares = part and {"word": part.word, "amounts": [[a.value, a.share] for a in part.amounts]}
            found.append({
                "load": load.name, "rows": list(rows), "rate": rate, "ramp": given.size.ramp,
                "moving": isinstance(phase, MovingPhase), "part": shares, "ends": (phase.start, phase.end),
            })  # fmt: skip
    return found


def angles(loads: Iterable[Load], motion: Motion, constants: Iterable[str]) -> list[Plain]:
    """The angles that loads take at every position: of link b against a.

    ``near``: where given, a dimension's address, and its value where it is no parameter; the angle begins within half
    a turn of it. ``constants``: those that stay near a number.
    """
    found: dict[str, Plain] = {}
    for load in loads:
        for (a, b), near in load.magnitude.angles(motion.mechanism).items():
            begin = None if near is None else [f"loads.{load.name}.free_angle", near]
            found[middle_name(a, b)] = {"field": middle_name(a, b), "a": a, "b": b, "near": begin}
    return [each for name, each in found.items() if name not in set(constants)]


def fields(loads: Iterable[Load], motion: Motion) -> dict[str, Floats]:
    """Phases of the input, which no change of a page moves, per position; zeros for what the page finds."""
    signals = MotionSignals(motion)
    found: dict[str, Floats] = {}
    for load in loads:
        if not _phase_per_position(load, motion):
            continue
        acts = share = np.zeros(motion.positions.count)
        if isinstance(load.magnitude.phase, InputPhase):
            active = activity(load, signals)
            acts, share = active.where.astype(float), active.share
        found |= {f"{ACTS}:{load.name}": acts, f"share:{load.name}": share}
    return found
