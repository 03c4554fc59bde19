"""Paths whose lengths and coordinates are bounded: the best solutions carried to the end within the bounds.

A solution is written by *measures*, in units of the bound: ratios and crank angles as in the free numbers of a start,
the crank's length, the coupler point's and the pivot's coordinates, and the angle of the frame. The end is reached
along the active bounds by sequential quadratic programming (Kraft 1988).
"""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Complexes, Floats, Integers
from linkwright.synthesis.crank_family import couplers
from linkwright.synthesis.least_squares import with_differences
from linkwright.synthesis.path_generation.demand import PathStarts

Linear = tuple[Complexes, Complexes, Complexes]

#: Solutions carried to the end, timed and untimed; ratios and coordinates that differ less are one solution. Then
#: steps and tolerance of that end.
FINISHED, SAME_SHAPE = (3, 7), 0.02
ROUGH, EXACT = (150, 1e-14), (300, 1e-16)


class BoundedPaths:
    """A demand's paths with lengths and coordinates of coupler point and crank pivot up to ``bound`` (m)."""

    def __init__(self, paths: PathStarts, bound: float) -> None:
        self.paths, self.bound = paths, bound
        demand = paths.demand
        self.inner = 3 + (int(demand.phase) if demand.timed else int(demand.same.max()) + 1)
        self.placed, self.turned = demand.pivot is None, demand.direction is None

    def finished(self, found: Floats, rows: Integers) -> Floats:
        """Measures, the best of them carried to the end along their active bounds."""
        found = found.copy()
        best = _different(np.column_stack([found[:, :3], found[:, self.inner :]]))
        best = best[: FINISHED[not self.paths.demand.timed]]
        for i in best:
            found[i] = self.finish(found[i], int(rows[i]), *ROUGH)
        squares = (self.residual(found, rows) ** 2).sum(1)
        for i in sorted(best, key=lambda j: float(squares[j]))[:2]:
            found[i] = self.finish(found[i], int(rows[i]), *EXACT)
        return found

    def of(self, free: Floats, linear: Linear) -> Floats:
        """Measures of solutions: free numbers of starts and z, α, β."""
        z, alpha, beta = linear
        crank = np.abs(alpha)
        local = beta * alpha.conj() / crank
        columns = [crank, local.real, local.imag, *((z.real, z.imag) if self.placed else ())]
        angle = [np.angle(alpha)] if self.turned else []
        return np.column_stack([free, *(each / self.bound for each in columns), *angle])

    def linear(self, measures: Floats, who: Integers) -> Linear:
        """z, α, β (K,), m."""
        rest = measures[:, self.inner :]
        sign = np.where(self.paths.mirrored[who], -1.0, 1.0)
        angle = rest[:, -1] if self.turned else sign * (self.paths.demand.direction or 0.0)
        frame = self.bound * np.exp(1j * angle)
        z = self.bound * (rest[:, 3] + 1j * rest[:, 4]) if self.placed else 0j * frame
        return np.asarray(z), rest[:, 0] * frame, (rest[:, 1] + 1j * rest[:, 2]) * frame

    def residual(self, measures: Floats, who: Integers) -> Floats:
        """Deviations (K, 2n), m."""
        shape = self.paths.family.chosen(who).lengths(measures)
        a, u = couplers(self.paths.theta(measures[:, : self.inner], who), shape)
        z, alpha, beta = self.linear(measures, who)
        off = self.paths.target(who) - (z[:, None] + alpha[:, None] * a + beta[:, None] * u)
        return np.concatenate([off.real, off.imag], 1)

    def finish(self, measures: Floats, who: int, steps: int, tolerance: float) -> Floats:
        """One solution carried to the end along its active bounds."""
        from scipy.optimize import minimize

        system, number, m = with_differences(self.residual), np.array([who]), len(measures)
        scale = self.paths.demand.size**-2

        def value(x: Floats) -> tuple[float, Floats]:
            r, jacobian = system(x[None], number)
            return float(scale * (r @ r.T)[0, 0]), 2 * scale * (r @ jacobian[0])[0]

        def room(x: Floats) -> Floats:
            return np.asarray(1.0 - self.paths.family.chosen(number).lengths(x[None])[:, 0] * x[self.inner])

        def room_slope(x: Floats) -> Floats:
            slope = np.zeros((3, m))
            slope[:, :3] = -self.paths.family.chosen(number).rates(x[None])[:, 0] * x[self.inner]
            slope[:, self.inner] = -self.paths.family.chosen(number).lengths(x[None])[:, 0]
            return slope

        boxes: list[tuple[float | None, float | None]] = [(None, None)] * self.inner + [(1e-6, 1.0)]
        boxes += [(-1.0, 1.0)] * (m - self.inner - 1 - int(self.turned)) + [(None, None)] * int(self.turned)
        limits = {"type": "ineq", "fun": room, "jac": room_slope}
        options = {"maxiter": steps, "ftol": tolerance}
        done = minimize(value, measures, jac=True, method="SLSQP", bounds=boxes, constraints=limits, options=options)
        inside = np.isfinite(done.x).all() and float(room(done.x).min()) > -1e-9
        return np.asarray(done.x) if inside and done.fun < value(measures)[0] else measures


def _different(shapes: Floats) -> list[int]:
    """Rows whose ratios differ from those of all rows before."""
    distinct: list[int] = []
    for i, shape in enumerate(shapes):
        if all(np.abs(shape - shapes[j]).max() > SAME_SHAPE for j in distinct):
            distinct.append(i)
    return distinct
