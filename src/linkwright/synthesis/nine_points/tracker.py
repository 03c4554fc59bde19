"""Many solutions carried along a change of the points: predictor and corrector, all paths side by side.

First point at 0, displacements d_j and their partners e_j (conjugates where the points are real), j = 1 … 8. At the
first point a dyad has its moving pin at x and its fixed pivot at x + w, with partners X, W; the coupler has turned by
1 + g_j, f = -g/(1 + g) is the partner of g. Constant length of the crank is, for each point and both dyads (x, w) and
(y, v),

    m n - m W - n w = 0,  m = d + x g,  n = e + X f:

16 equations for u = (x, X, w, W, y, Y, v, V, g₁ … g₈). With w and g instead of pivots and rotations nothing cancels
near translations. In a linear solve the two equations of a point lose dg_j by one combination; an 8 × 8 system is
left.

Along (d, e) = q₀ + t (q₁ - q₀) a path takes a step by Runge and Kutta's fourth order and two Newton corrections; the
first correction's size sets the next step.
Source: Wampler, Morgan and Sommese 1992, J. Mech. Des. 114; Allgower and Georg 1990, Numerical Continuation Methods.
"""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Complexes, Flags, Floats
from linkwright.core.dataclass import dataclass
from linkwright.engine.machine_code import available
from linkwright.engine.threads import cores, spread_over

#: Paths that are carried together: their matrices stay in the processor's cache.
CHUNK = 181
TOLERANCE, SMALLEST_STEP, LARGEST_STEP, MOST_STEPS = 1e-3, 1e-12, 0.2, 3000
ROUNDING = 1e-7


@dataclass(frozen=True, eq=False)
class Ends:
    """Where paths ended: solutions (N, 16), and which of them arrived (N,)."""

    solutions: Complexes
    arrived: Flags


def track(
    start: Complexes, q0: Complexes, q1: Complexes, *,
    tolerance: float = TOLERANCE, most: int = MOST_STEPS, rounding: float = ROUNDING,
) -> Ends:  # fmt: skip
    """Solutions (N, 16) of the points q0 (2, 8) carried to the points q1.

    A second correction below ``rounding`` is taken for the rounding of ill-conditioned solutions.
    """
    done, arrived = start.copy(), np.zeros(len(start), bool)

    def carry(first: int, last: int) -> None:
        paths = _Paths(start[first:last], q0, q1, tolerance, most, rounding)
        ends = paths.run_compiled() if available() else paths.run()
        done[first:last], arrived[first:last] = ends.solutions, ends.arrived

    spread_over(len(start), CHUNK, cores(), carry)
    found = Ends(done, arrived)
    with np.errstate(all="ignore"):
        right = found.arrived & np.isfinite(found.solutions).all(1)
        right &= residual(np.where(right[:, None], found.solutions, 1.0), q1) < 1e-9
    return Ends(found.solutions, right)


def residual(u: Complexes, q: Complexes) -> Floats:
    """Largest residual of the equations of each solution (N, 16), relative to their terms."""
    g = u[:, 8:]
    f = -g / (1 + g)
    worst = np.zeros(len(u))
    for o in (0, 4):
        x, xc, w, wc = (u[:, o + i, None] for i in range(4))
        m, n = q[0] + x * g, q[1] + xc * f
        size = np.abs(m * n) + np.abs(m * wc) + np.abs(n * w) + 1e-300
        worst = np.maximum(worst, (np.abs(m * n - m * wc - n * w) / size).max(1))
    return worst


class _Paths:
    """One chunk of paths; arrays have the paths last."""

    def __init__(
        self, start: Complexes, q0: Complexes, q1: Complexes, tolerance: float, most: int, rounding: float
    ) -> None:
        self.q0, self.dq, self.q1 = q0[:, :, None], (q1 - q0)[:, :, None], q1[:, :, None]
        self.tolerance, self.most, self.rounding = tolerance, most, rounding
        self.done = start.T.copy()
        self.arrived = np.zeros(len(start), bool)

    def run_compiled(self) -> Ends:
        """The same steps in compiled code."""
        from linkwright.engine.kernel_writer import LANES
        from linkwright.synthesis.nine_points.kernels import ROOM, kernels

        rows, arrived, room = self.done.T.copy(), np.zeros(len(self.arrived)), np.zeros(ROOM)
        along = [_in_lanes(each, LANES) for each in (self.q0, self.dq)]
        limits = np.array([self.tolerance, SMALLEST_STEP, LARGEST_STEP, self.most, self.rounding])
        places = [each.ctypes.data for each in (rows, *along, arrived, limits)]
        kernels()("carry", len(rows), *places, room.ctypes.data)
        self.done, self.arrived = rows.T.copy(), arrived > 0.5
        with np.errstate(all="ignore"):
            self._polish()
        return Ends(self.done.T.copy(), self.arrived)

    def run(self) -> Ends:
        """Steps until every path has arrived or is given up."""
        with np.errstate(all="ignore"):
            u, who = self.done.copy(), np.arange(self.done.shape[1])
            t, h = np.zeros(len(who)), np.full(len(who), 0.02)
            for _ in range(self.most):
                last = t + h >= 1.0 - 1e-14
                h = np.where(last, 1.0 - t, h)
                good, first, moved = self._step(u, t, h)
                u = np.where(good, moved, u)
                t = np.where(good, np.where(last, 1.0, t + h), t)
                growth = 0.85 * (self.tolerance / (first + 1e-30)) ** 0.2
                near = (first > self.tolerance) & (first < 1e3)
                shrink = np.where(near, np.clip(growth, 0.2, 0.6), 0.5)
                h = np.where(good, np.minimum(LARGEST_STEP, h * np.clip(growth, 0.4, 2.0)), h * shrink)
                ended = t >= 1.0
                stay = ~ended & (h > SMALLEST_STEP)
                if not stay.all():
                    self.done[:, who[ended]], self.arrived[who[ended]] = u[:, ended], True
                    u, t, h, who = u[:, stay], t[stay], h[stay], who[stay]
                if not len(who):
                    break
            self._polish()
        return Ends(self.done.T.copy(), self.arrived)

    def _step(self, u: Complexes, t: Floats, h: Floats) -> tuple[Flags, Floats, Complexes]:
        """Whether a step holds, the size of its first correction, and where it leads."""
        k1 = self._tangent(u, t)
        k2 = self._tangent(u + (0.5 * h) * k1, t + 0.5 * h)
        k3 = self._tangent(u + (0.5 * h) * k2, t + 0.5 * h)
        k4 = self._tangent(u + h * k3, t + h)
        v = u + (h / 6.0) * (k1 + 2.0 * (k2 + k3) + k4)
        q = self.q0 + (t + h) * self.dq
        du = linear_step(v, q, None)
        first = relative_size(du, v)
        v = v + du
        du = linear_step(v, q, None)
        second = relative_size(du, v)
        floor = np.maximum(self.rounding, 0.1 * first)
        good = (first < 8.0 * self.tolerance) & (second < 1e-5) & (second < floor)
        return good, np.where(np.isfinite(first), first, 1e9), v + du

    def _tangent(self, u: Complexes, t: Floats) -> Complexes:
        return linear_step(u, self.q0 + t * self.dq, self.dq)

    def _polish(self) -> None:
        good = np.flatnonzero(self.arrived)
        for _ in range(3):
            u = self.done[:, good]
            du = linear_step(u, self.q1 + 0 * u[:1], None)
            better = relative_size(du, u) < 1e-6
            self.done[:, good] = np.where(better, u + du, u)


def _in_lanes(q: Complexes, lanes: int) -> Floats:
    """Points (2, 8, 1) as entries of compiled code, equal in all lanes."""
    flat = q.reshape(-1, 1)
    return np.ascontiguousarray(np.repeat(np.concatenate([flat.real, flat.imag], 1), lanes, 1))


def linear_step(u: Complexes, q: Complexes, dq: Complexes | None) -> Complexes:
    """du/dt (16, N) for points moving by ``dq`` (2, 8, 1), or the Newton correction where dq is None."""
    d, e = q
    g = u[8:]
    inverse = 1.0 / (1.0 + g)
    f = -g * inverse
    gradients, slopes, rights = [], [], []
    for o in (0, 4):
        x, xc, w, wc = u[o], u[o + 1], u[o + 2], u[o + 3]
        m, n = d + x * g, e + xc * f
        mw, nw = m - w, n - wc
        gradients.append(np.stack([g * nw, f * mw, -n, -m], 1))
        slopes.append(x * nw - xc * mw * inverse * inverse)
        rights.append(n * w - m * nw if dq is None else -(dq[0] * nw + dq[1] * mw))
    first, second = slopes
    size = np.sqrt(_square(first) + _square(second)) + 1e-150
    p, r = second / size, -first / size
    count = u.shape[1]
    system = np.empty((count, 8, 8), complex)
    system[:, :, :4] = (p[:, None] * gradients[0]).transpose(2, 0, 1)
    system[:, :, 4:] = (r[:, None] * gradients[1]).transpose(2, 0, 1)
    out = np.empty((16, count), complex)
    out[:8] = _solved(system, (p * rights[0] + r * rights[1]).T)
    by_first = _square(first) > _square(second)
    rest = [rights[k] - (gradients[k] * out[4 * k : 4 * k + 4]).sum(1) for k in (0, 1)]
    out[8:] = np.where(by_first, rest[0], rest[1]) / np.where(by_first, first, second)
    return out


def _solved(system: Complexes, right: Complexes) -> Complexes:
    """Solutions (8, N) of systems (N, 8, 8); NaN where one is singular or not finite."""
    bad = ~np.isfinite(system.sum((1, 2)))
    if bad.any():
        system[bad] = np.eye(8)
    try:
        found = np.linalg.solve(system, right[:, :, None])[:, :, 0]
    except np.linalg.LinAlgError:
        size = 1e-14 * np.abs(system).max((1, 2), keepdims=True) + 1e-300
        found = np.linalg.solve(system + size * np.eye(8), right[:, :, None])[:, :, 0]
    found[bad] = np.nan
    return np.asarray(found.T, complex)


def relative_size(du: Complexes, u: Complexes) -> Floats:
    """Largest relative component; floors: 0.01 for lengths, a tenth of the largest g for rotations."""
    g = _square(u[8:])
    lengths = _square(du[:8]) / (_square(u[:8]) + 1e-4)
    turns = _square(du[8:]) / np.minimum(g + 0.01 * g.max(0), _square(1.0 + u[8:]))
    found = np.sqrt(np.maximum(lengths.max(0), turns.max(0)))
    return np.where(np.isfinite(found), found, np.inf)


def _square(z: Complexes) -> Floats:
    return z.real * z.real + z.imag * z.imag
