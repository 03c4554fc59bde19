"""Many starts of a path iterated in compiled code: the worse ones dropped on the way."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from linkwright.core.arrays import Complexes, Flags, Floats, Integers
from linkwright.designs.checkpoints import checkpointed
from linkwright.formula.threads import cores, spread_over
from linkwright.synthesis.crank_family import CrankFamily
from linkwright.synthesis.path_generation.demand import Demand, PathStarts
from linkwright.synthesis.path_generation.kernels import (
    ANGLES,
    ANY_LENGTHS,
    EACH,
    HEAD,
    PER_POINT,
    POINTS,
    SHIFTS,
    kernels,
)

#: Starts of one share of a thread's work.
SHARE = 512
FIRST_DAMPING = 1e-3


@dataclass(frozen=True, eq=False)
class CompiledPaths:
    """Starts (K, numbers) of a demand as ``kernels`` has them, lengths in units of the demand's size."""

    demand: Demand
    bound: float | None
    transmission: float
    rocking: bool
    starts: Floats

    @classmethod
    def of(
        cls, demand: Demand, family: CrankFamily, mirrored: Flags, free: Floats, bound: float | None
    ) -> CompiledPaths:
        """From free numbers (K, 3 and phase or crank angles)."""
        points = int(demand.same.max()) + 1
        starts = np.zeros((len(free), ANGLES + points))
        starts[:, :3] = free[:, :3]
        if not demand.timed:
            starts[:, ANGLES:] = free[:, 3:]
        elif demand.phase:
            starts[:, 3] = free[:, 3]
        starts[:, 4] = ANY_LENGTHS if family.rocking else family.double
        starts[:, 5], starts[:, 6] = np.where(mirrored, -1.0, 1.0), FIRST_DAMPING
        return cls(demand, bound, family.transmission, family.rocking, starts)

    @property
    def paths(self) -> PathStarts:
        """Crank angles and points of the starts."""
        family = CrankFamily(self.starts[:, 4] == 1.0, self.transmission, self.rocking)
        return PathStarts(self.demand, family, self.starts[:, 5] < 0)

    @property
    def free(self) -> Floats:
        """Free numbers (K, 3 and phase or crank angles)."""
        if not self.demand.timed:
            return np.column_stack([self.starts[:, :3], self.starts[:, ANGLES:]])
        return self.starts[:, : 4 if self.demand.phase else 3]

    @property
    def deviation(self) -> Floats:
        """Sums of squares in units of the size (with the bound's share), (K,)."""
        return self.starts[:, 7]

    @property
    def linear(self) -> tuple[Complexes, Complexes, Complexes]:
        """z, α, β (K,), m."""
        parts = self.demand.size * self.starts[:, HEAD:SHIFTS].reshape(-1, 3, 2)
        numbers = np.asarray(parts[:, :, 0] + 1j * parts[:, :, 1], complex)
        return numbers[:, 0], numbers[:, 1], numbers[:, 2]

    def best(self, count: int) -> CompiledPaths:
        """The best of them, in order."""
        return self.of_starts(self.starts[np.argsort(self.deviation, kind="stable")[:count]])

    def joined(self, other: CompiledPaths) -> CompiledPaths:
        """These and others of the same demand."""
        return self.of_starts(np.concatenate([self.starts, other.starts]))

    def of_starts(self, starts: Floats) -> CompiledPaths:
        """The same demand with other starts."""
        return replace(self, starts=starts)

    def moved(self, free: Floats, angles: Floats) -> CompiledPaths:
        """Untimed starts with other free numbers (K, 3) and crank angles (K, points), judged, to be iterated anew."""
        starts = self.starts.copy()
        starts[:, :3], starts[:, ANGLES:], starts[:, 6] = free, angles, FIRST_DAMPING
        return self.of_starts(starts).judged()

    def judged(self) -> CompiledPaths:
        """With the linear numbers and the deviation of each, without the bound."""
        return self._done("judge", weight=0.0)

    def inside(self, share: float) -> CompiledPaths:
        """Brought within a share of the bound."""
        return self._done("bring_inside", share, weight=1.0)

    def iterated(self, steps: int, weight: float = 0.0) -> CompiledPaths:
        """After some steps; ``weight``: of the bound, 0: none."""
        return self._done("iterate", steps, weight=weight)

    def shifted(self, weight: float) -> CompiledPaths:
        """With the limits' shifts anew."""
        return self._done("shift", weight=weight)

    def _done(self, name: str, *further: float, weight: float) -> CompiledPaths:
        layout, data = self._layout(), self._data(weight)
        key = name, further, layout, data, self.starts
        return self.of_starts(checkpointed(lambda: self._computed(name, further, layout, data), lambda: key))

    def _computed(self, name: str, further: tuple[float, ...], layout: Integers, data: Floats) -> Floats:
        starts = self.starts.copy()
        size = 8 * starts.shape[1]

        def work(first: int, last: int) -> None:
            room = np.zeros(PER_POINT + EACH * layout[0] + starts.shape[1])
            at = layout.ctypes.data, data.ctypes.data, starts.ctypes.data + size * first
            kernels()(name, *at, last - first, *further, room.ctypes.data)

        share = max(1, min(SHARE, -(-len(starts) // (4 * cores()))))
        spread_over(len(starts), share, cores(), work)
        return starts

    def _layout(self) -> Integers:
        demand = self.demand
        placed, turned = demand.pivot is None, demand.direction is None
        phase = demand.timed and demand.phase
        unknown = 2 * placed + 1 + turned + 2 + 3 + phase
        numbers = self.starts.shape[1]
        return np.array([numbers - ANGLES, demand.timed, phase, placed, turned, unknown, numbers], np.int64)

    def _data(self, weight: float) -> Floats:
        demand, count = self.demand, self.starts.shape[1] - ANGLES
        z = (demand.points - (demand.pivot or 0.0))[:count] / demand.size
        points = np.column_stack([z.real, z.imag, np.bincount(demand.same), demand.angles[:count]])
        bound = (self.bound or 0.0) / demand.size if weight else 0.0
        head = [bound, weight, np.cos(self.transmission), demand.direction or 0.0]
        assert len(head) == POINTS
        return np.concatenate([head, points.ravel()])
