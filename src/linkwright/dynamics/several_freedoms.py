"""Positions at rest of several free inputs, by Newton's method from many starts."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.dynamics.equilibria import Equilibria
from linkwright.dynamics.equilibrium_search import BALANCED, SAME, EquilibriumSearch
from linkwright.dynamics.extent import TURN
from linkwright.dynamics.static_forces import StaticForces
from linkwright.errors import LinkwrightError
from linkwright.words import _

#: Starts by the number of free inputs, and Newton's steps from each.
STARTS, MOST_STARTS, ITERATIONS = {2: 1024, 3: 2048}, 4096, 80
#: A step of Newton's method at most, of an input that turns in rad, of one that slides as share of the machine.
LONGEST = 0.3
#: How far an input that slides is searched, in sizes of the machine.
NEAR = 2.0
#: Positions that are listed at most; more lie on lines.
MOST = 100


class SeveralFreedoms(EquilibriumSearch):
    """Positions at rest by Newton's method from many starts."""

    def __init__(self, forces: StaticForces, asked: Mapping[str, tuple[float, float]]) -> None:
        super().__init__(forces)
        self.rotary = np.array([forces.equation.rotary[name] for name in forces.free])
        self.asked = asked
        start = forces.start
        default = [
            (0.0, TURN) if turns else (begin - NEAR * self.units[k], begin + NEAR * self.units[k])
            for k, (turns, begin) in enumerate(zip(self.rotary, start, strict=True))
        ]
        self.ranges = np.array([asked.get(name, each) for name, each in zip(forces.free, default, strict=True)])

    @cached_property
    def found(self) -> Equilibria:
        """The result."""
        starts = self._starts()
        q = self._newton(starts)
        self.scale = self.sizes(starts)
        good = self._balanced(q, self.scale) & self._inside(q)
        positions = [self.described(each) for each in self._distinct(q[:, good])]
        positions.sort(key=lambda each: tuple(each.place))
        ranges = {
            name: (float(low), float(high)) for name, (low, high) in zip(self.forces.free, self.ranges, strict=True)
        }
        if not positions and not self.forces.reached(starts).any():
            raise LinkwrightError(
                _(
                    "{name!r} cannot be assembled at any of the {starts} starts in its ranges; give ranges that it "
                    "reaches",
                    code="dynamics.no_start",
                    name=self.forces.mechanism.name,
                    starts=starts.shape[1],
                )
            )
        return Equilibria(self.forces, tuple(positions), ranges, starts=starts.shape[1])

    def _starts(self) -> Floats:
        """Evenly spread over the ranges, and the drawing, (freedoms, starts)."""
        from scipy.stats import qmc

        n = self.forces.freedoms
        count = STARTS.get(n, MOST_STARTS)
        even = qmc.Sobol(n, scramble=False).random(count).T
        low, high = self.ranges.T[:, :, None]
        return np.concatenate([self.forces.start[:, None], low + (high - low) * even], axis=1)

    def _newton(self, q: Floats) -> Floats:
        units = self.units[:, None]
        for _iteration in range(ITERATIONS):
            effort, slopes = self.forces.efforts(q), self.forces.slopes(q)
            fine = np.isfinite(effort).all(axis=0) & np.isfinite(slopes).all(axis=(0, 1))
            q, effort, slopes = q[:, fine], effort[:, fine], slopes[:, :, fine]
            if not q.shape[1]:
                return q
            scaled = np.moveaxis(slopes, 2, 0) * self.units
            step = -np.einsum("nij,jn->in", np.linalg.pinv(scaled, rcond=1e-12), effort)
            size = np.abs(step).max(axis=0)
            q = q + units * step * np.minimum(1.0, LONGEST / np.maximum(size, LONGEST * 1e-3))
            if size.max() < 1e-14:
                break
        return q

    def _balanced(self, q: Floats, scale: Floats) -> Flags:
        if not q.shape[1]:
            return np.zeros(0, dtype=bool)
        left = np.abs(self.forces.efforts(q)) / scale[:, None]
        free = self.forces.reached(q)
        if self.forces.stops:
            free &= (self.forces.stop_gaps(q) >= -SAME).all(axis=0)
        return np.asarray((left < BALANCED).all(axis=0) & free)

    def _inside(self, q: Floats) -> Flags:
        """Within the ranges that were asked for; those that slide, within what was searched."""
        fine = np.ones(q.shape[1], dtype=bool)
        for row, (low, high), turns, name in zip(q, self.ranges, self.rotary, self.forces.free, strict=True):
            if name in self.asked or not turns:
                place = low + (row - low) % TURN if turns else row
                fine &= (place >= low - SAME) & (place <= high + SAME)
        return fine

    def _distinct(self, q: Floats) -> list[Floats]:
        """One of each, inputs that turn within a turn from the begin of their range."""
        low = self.ranges[:, 0]
        found: list[Floats] = []
        for each in q.T:
            place = np.where(self.rotary, low + (each - low + SAME) % TURN - SAME, each)
            gaps = [np.abs(place - other) for other in found]
            gaps = [np.where(self.rotary, np.minimum(gap, np.abs(TURN - gap)), gap / self.units) for gap in gaps]
            if all(gap.max() > SAME for gap in gaps) and len(found) < MOST:
                found.append(place)
        return found
