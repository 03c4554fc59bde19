"""The positions of a page's cycle, and what it knows of the drivers between them."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from itertools import pairwise
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.json_data import Plain
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.signals import MotionSignals

#: Positions that a piece of a law has, or more, where a page goes by polynomials through them.
FEWEST = 5


def packed(row: Any) -> str:
    """Numbers as base64 of their 64-bit floats."""
    return base64.b64encode(np.ascontiguousarray(row, dtype="<f8").tobytes()).decode()


def positions(motion: Motion, arrays: Mapping[str, Floats], signs: Mapping[str, float]) -> Plain:
    """The inputs per position, ``arrays``; a single driver of constant speed is given by its law. ``signs``: of the
    assembly modes."""
    along, mechanism = motion.positions, motion.mechanism
    modes = list(motion.modes)
    found: Plain = {
        "count": along.count,
        "closed": along.closed,
        "period": along.period,
        "steady": None,
        "drift": drift(motion),
        "modes": {name: float(signs[name]) for name in modes},
    }
    drivers = list(mechanism.drivers.values())
    name = drivers[0].name if drivers else ""
    tracked = {"time", "step", "input", *modes, *(f"{kind}:{name}" for kind in ("cos", "sin", "slide", "turn"))}
    if len(drivers) == 1 and drivers[0].law.constant_speed is not None and tracked.issuperset(arrays):
        q = along.coordinates[name][0]
        step = float(q[1] - q[0]) if len(q) > 1 else 0.0
        found["steady"] = {
            "driver": name,
            "turns": along.rotary[name],
            "start": float(q[0]),
            "step": step,
            "speed": drivers[0].law.constant_speed,
            "begin": float(along.time[0]),
        }
        arrays = {each: row for each, row in arrays.items() if each in modes}
    found["breaks"] = None if found["steady"] else breaks(motion)
    found["time"] = None if found["steady"] else packed(along.time)
    found["arrays"] = {name: packed(row) for name, row in arrays.items()}
    found["inputs"] = [
        {"name": each, "turns": along.rotary[each], "values": None if found["steady"] else packed(rows[0])}
        for each, rows in along.coordinates.items()
    ]
    return found


def drift(motion: Motion) -> float:
    """What the first driver's coordinate gains in a closed cycle; 0 of an open one."""
    closes = MotionSignals(motion).closes if motion.mechanism.drivers else None
    return 0.0 if closes is None else closes[1]


def breaks(motion: Motion) -> list[float] | None:
    """Places among the positions of a cycle where a driver's law goes over; None of other positions."""
    along, drivers = motion.positions, motion.mechanism.drivers.values()
    if not along.cycle or along.count < 3 or not drivers:
        return None
    start, end = float(along.around[0]), float(along.around[-1])
    found = np.unique(np.concatenate([each.law.breaks(start, end) for each in drivers]))
    inside = found[(found > start) & (found < end)]
    return [float(each) for each in (inside - start) / (along.time[1] - start)]


def known_between(motion: Motion) -> bool:
    """Whether a page knows the drivers between all positions of a cycle: by their steady law, or by polynomials."""
    drivers, along = list(motion.mechanism.drivers.values()), motion.positions
    places = breaks(motion)
    if places is None or along.repeated:
        return False
    if len(drivers) == 1 and drivers[0].law.constant_speed is not None:
        return True
    ends = [0.0, *places, float(along.count - 1)]
    return all(int(b) - int(np.ceil(a)) >= FEWEST for a, b in pairwise(ends))
