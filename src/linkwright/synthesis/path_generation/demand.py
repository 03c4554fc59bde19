"""Demands on paths of crank-driven four-bars, and the crank angles and points of starts.

A path is linear in three complex numbers: P_j = z + α A_j + β U_j with A_j = e^{iθ_j}: z the crank's pivot, |α| its
length, arg α the direction of the frame, β/α the coupler point in units of the crank. For given ratios (b, c, d) and
crank angles the best z, α, β follow from linear least squares; only ratios, phase and free crank angles remain for
the iteration (variable projection, Golub and Pereyra 1973; Jacobian after Kaufman 1975: the projection of ∂P/∂p at
fixed z, α, β), which ``kernels`` does.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Complexes, Flags, Floats, Integers
from linkwright.synthesis.crank_family import CrankFamily


@dataclass(frozen=True, eq=False)
class Demand:
    """What a path must do.

    ``points``: complex (n,); ``angles``: crank angles (n,), rad; ``phase``: a common angle may be added to them;
    ``timed``: they are fixed, else each is free; ``pivot``: the crank's pivot where it is given; ``direction``: angle
    of the line O1→O2 where it is given, rad (crank angles count from it).
    """

    points: Complexes
    angles: Floats
    phase: bool
    timed: bool
    pivot: complex | None = None
    direction: float | None = None

    @property
    def same(self) -> Integers:
        """Number of the crank angle of each point; a last point equal to the first is the first again."""
        numbers = np.arange(len(self.points))
        if self.closed:
            numbers[-1] = 0
        return numbers

    @property
    def closed(self) -> bool:
        """Whether the last point is the first one again."""
        return len(self.points) > 3 and bool(abs(self.points[-1] - self.points[0]) <= 1e-9 * self.size)

    @property
    def excess(self) -> int:
        """Number of equations beyond that of the unknowns."""
        placed, turned = 2 * (self.pivot is None), int(self.direction is None)
        points = int(self.same.max()) + 1
        times = int(self.phase) if self.timed else points
        return 2 * points - (placed + 1 + turned + 2 + 3 + times)

    @property
    def size(self) -> float:
        """Root mean square distance of the points from their centre."""
        return float(np.sqrt(np.mean(np.abs(self.points - self.points.mean()) ** 2)))


class PathStarts:
    """Crank angles and points of K starts of a demand; a start is (x, y, z), then phase or crank angles.

    ``mirrored``: starts whose coupler lies on the other side: they work on mirrored points and mirrored crank angles.
    """

    def __init__(self, demand: Demand, family: CrankFamily, mirrored: Flags) -> None:
        self.demand, self.family, self.mirrored = demand, family, mirrored

    def theta(self, free: Floats, who: Integers) -> Floats:
        """Crank angles (K, n); of mirrored starts in the mirrored plane."""
        if not self.demand.timed:
            return free[:, 3:][:, self.demand.same]
        shift = free[:, 3:4] if self.demand.phase else 0.0
        sign = np.where(self.mirrored[who], -1.0, 1.0)[:, None]
        return np.asarray(sign * self.demand.angles + shift)

    def target(self, who: Integers) -> Complexes:
        """Points (K, n), mirrored where the start is; less the given pivot."""
        z = self.demand.points - (self.demand.pivot or 0.0)
        return np.where(self.mirrored[who][:, None], z.conj(), z)
