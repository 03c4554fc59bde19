"""Paths of crank-driven four-bars with place, size and coupler point projected out.

A path is linear in three complex numbers: P_j = z + α A_j + β U_j with A_j = e^{iθ_j}: z the crank's pivot, |α| its
length, arg α the direction of the frame, β/α the coupler point in units of the crank. For given ratios (b, c, d) and
crank angles the best z, α, β follow from linear least squares; only ratios, phase and free crank angles remain for
the iteration (variable projection, Golub and Pereyra 1973; Jacobian after Kaufman 1975: the projection of ∂P/∂p at
fixed z, α, β).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Complexes, Flags, Floats, Integers
from linkwright.synthesis.crank_family import CrankFamily, coupler_rates, couplers


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


class ProjectedPaths:
    """The projected residuals of a demand for K starts; a start is (x, y, z), then phase or crank angles.

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

    def columns(self, a: Complexes, u: Complexes, who: Integers) -> Floats:
        """The real columns (K, 2n, L) of the linear numbers."""
        one = np.ones_like(a)
        parts = [] if self.demand.pivot is not None else [one, 1j * one]
        turn = self._turn(who)
        parts += [a, 1j * a] if turn is None else [a * turn]
        parts += [u, 1j * u]
        stacked = np.stack(parts, 2)
        return np.concatenate([stacked.real, stacked.imag], 1)

    def _turn(self, who: Integers) -> Complexes | None:
        """Unit vector of the given frame direction, (K, 1), in the mirrored plane where the start is."""
        if self.demand.direction is None:
            return None
        sign = np.where(self.mirrored[who], -1.0, 1.0)
        return np.asarray(np.exp(1j * sign * self.demand.direction)[:, None])

    def linear(self, coefficients: Floats, who: Integers) -> tuple[Complexes, Complexes, Complexes]:
        """z, α, β (K,) from the coefficients (K, L) of the columns."""
        rest = coefficients
        z = np.zeros(len(rest), complex)
        if self.demand.pivot is None:
            z, rest = rest[:, 0] + 1j * rest[:, 1], rest[:, 2:]
        turn = self._turn(who)
        if turn is None:
            alpha, rest = rest[:, 0] + 1j * rest[:, 1], rest[:, 2:]
        else:
            alpha, rest = rest[:, 0] * turn[:, 0], rest[:, 1:]
        return z, alpha, rest[:, 0] + 1j * rest[:, 1]

    def fit(self, free: Floats, who: Integers) -> tuple[Floats, Complexes, Complexes, Complexes]:
        """Residuals (K, 2n) and z, α, β (K,), by Householder."""
        a, u = couplers(self.theta(free, who), self.family.chosen(who).lengths(free))
        y = self.target(who)
        q, r = np.linalg.qr(self.columns(a, u, who))
        stacked = np.concatenate([y.real, y.imag], 1)[:, :, None]
        projected = q.swapaxes(1, 2) @ stacked
        residual = (stacked - q @ projected)[:, :, 0]
        return residual, *self.linear(_back(r, projected)[:, :, 0], who)

    def __call__(self, free: Floats, who: Integers) -> tuple[Floats, Floats]:
        """Residuals (K, 2n) and their Jacobian (K, 2n, m)."""
        family = self.family.chosen(who)
        shape = family.lengths(free)
        a, u = couplers(self.theta(free, who), shape)
        y = self.target(who)
        q, r = np.linalg.qr(self.columns(a, u, who))
        stacked = np.concatenate([y.real, y.imag], 1)[:, :, None]
        projected = q.swapaxes(1, 2) @ stacked
        residual = (stacked - q @ projected)[:, :, 0]
        _, alpha, beta = self.linear(_back(r, projected)[:, :, 0], who)
        change = self._change(a, u, coupler_rates(a, u, shape, family.rates(free)), alpha, beta)
        slope = np.concatenate([change.real, change.imag], 1)
        return residual, q @ (q.swapaxes(1, 2) @ slope) - slope

    def _change(
        self,
        a: Complexes,
        u: Complexes,
        rates: tuple[Complexes, Complexes],
        alpha: Complexes,
        beta: Complexes,
    ) -> Complexes:
        """∂P/∂p (K, n, m) at fixed z, α, β."""
        by_shape, by_angle = rates
        shape = beta[:, None, None] * by_shape
        turn = alpha[:, None] * 1j * a + beta[:, None] * by_angle
        if not self.demand.timed:
            same = self.demand.same
            own = np.eye(same.max() + 1)[same]
            return np.concatenate([shape, turn[:, :, None] * own], 2)
        return np.concatenate([shape, turn[:, :, None]], 2) if self.demand.phase else shape


def _back(r: Floats, projected: Floats) -> Floats:
    """R⁻¹ of the projections, a vanishing pivot kept away from zero."""
    diagonal = np.einsum("kii->ki", r)
    floor = 1e-13 * np.abs(diagonal).max(1, keepdims=True) + 1e-300
    lift = np.where(np.abs(diagonal) < floor, floor, 0.0)
    return np.asarray(np.linalg.solve(r + lift[:, :, None] * np.eye(r.shape[1]), projected))
