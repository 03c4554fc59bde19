"""Change points: positions where two assembly modes meet and the motion passes from one sign to the other.

Between two positions of a cycle the square under a dyad's root may touch zero without crossing it, as in a
parallelogram on the frame line. The motion goes on smoothly, the sign of the mode changes. Where the square
falls below zero the mechanism cannot pass.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from linkwright.kinematics.assembly import modal_groups
from linkwright.kinematics.cycle import Floats, Positions
from linkwright.kinematics.solver import MotionSolver

#: Groups whose quality (square of the sine of their transmission angle) stays above this are left alone.
NEAR = 0.02
#: A refined minimum of the quality within this distance of zero is a touch.
TOUCH = 1e-11


@dataclass(frozen=True)
class Passage:
    """A refined minimum of a group's quality between the positions ``before`` and ``after``."""

    group: str
    before: int
    after: int
    share: float
    quality: float

    @property
    def touches(self) -> bool:
        """Whether both modes meet there."""
        return abs(self.quality) <= TOUCH

    @property
    def barred(self) -> bool:
        """Whether the group cannot be assembled there, though it can be before and after."""
        return self.quality < -TOUCH


def passages(solver: MotionSolver, positions: Positions, states: Mapping[str, Floats]) -> list[Passage]:
    """All places between solved positions where a group's quality comes to zero or below."""
    groups = tuple(modal_groups(solver.structure))
    if positions.count < 3 or not groups:
        return []
    names = tuple(f"quality:{group}" for group in groups)
    ones = {
        f"mode:{group}": np.full(positions.count, solver.assembly.modes[group]) for group in solver.flipping
    }
    quality = solver.evaluate(names, positions, states, ones)
    found = []
    for group, row in zip(groups, quality, strict=True):
        for before, after in _valleys(row, positions.closed):
            found.append(_refined(solver, positions, group, before, after))
    return [p for p in found if p.touches or p.barred]


def _valleys(row: Floats, closed: bool) -> list[tuple[int, int]]:
    """Neighbouring positions between which a small minimum may lie."""
    n = len(row)
    valleys = []
    for i in range(n):
        left, right = i - 1, (i + 1) % n
        if not closed and (i == 0 or i == n - 1):
            continue
        here = row[i]
        if np.isfinite(here) and abs(here) < NEAR and here <= row[left] and here < row[right]:
            valleys += [(left % n, i), (i, right)]
    return valleys


def _refined(solver: MotionSolver, positions: Positions, group: str, before: int, after: int) -> Passage:
    """Minimum of the quality between two positions, by golden sections over blocks of shares."""
    low, high = 0.0, 1.0
    name = (f"quality:{group}",)
    best, share = np.inf, 0.5
    for _ in range(14):
        shares = np.linspace(low, high, 17)
        block = _block(positions, before, after, shares)
        modes = {f"mode:{g}": np.ones(len(shares)) for g in solver.flipping}
        quality = solver.evaluate(name, block, _no_states(solver, len(shares)), modes)[0]
        place = int(np.nanargmin(quality)) if np.isfinite(quality).any() else 8
        best, share = float(quality[place]), float(shares[place])
        low, high = float(shares[max(place - 1, 0)]), float(shares[min(place + 1, 16)])
    return Passage(group, before, after, share, best)


def _no_states(solver: MotionSolver, count: int) -> dict[str, Floats]:
    """Groups without closed form do not matter for the quality of the others that are refined."""
    return {name: np.ones(count) for name in solver.motion.next_states}


def _block(positions: Positions, before: int, after: int, shares: Floats) -> Positions:
    mixed = {}
    for name, (q, rate, second) in positions.coordinates.items():
        a, b = q[before], q[after]
        if after < before and positions.closed and positions.rotary[name]:
            step = q[1] - q[0]
            b = a + step
        values = a + shares * (b - a)
        mixed[name] = (values, np.full_like(values, rate[before]), np.full_like(values, second[before]))
    return Positions(np.zeros(len(shares)), mixed, positions.rotary, False, None)


def signs(passing: list[Passage], modes: Mapping[str, float], count: int) -> dict[str, Floats]:
    """Sign of every flipping group's mode per position, the first position as the file says."""
    found: dict[str, Floats] = {}
    for group in dict.fromkeys(p.group for p in passing if p.touches):
        row = np.full(count, modes[group])
        for p in passing:
            if p.group == group and p.touches and p.after > p.before and p.share > 0.0:
                row[p.after :] *= -1.0
        found[f"mode:{group}"] = row
    return found
