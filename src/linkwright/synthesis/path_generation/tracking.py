"""Many solutions carried along a change of the points: predictor and corrector, all paths side by side.

First point at 0, displacements d_j and their partners e_j (conjugates where the points are real), j = 1 … 8. At the
first point a dyad has its moving pin at x and its fixed pivot at x + w, with partners X, W; the coupler has turned by
1 + g_j, f = -g/(1 + g) is the partner of g. Constant length of the crank is, for each point and both dyads (x, w) and
(y, v),

    m n - m W - n w = 0,  m = d + x g,  n = e + X f:

16 equations for u = (x, X, w, W, y, Y, v, V, g₁ … g₈). With w and g instead of pivots and rotations nothing cancels
near translations. In a linear solve the two equations of a point lose dg_j by one combination; an 8 × 8 system is
left. At a pose g_j is given, and both of its equations stay in that system: M poses after the first and 8 - 2 M
points make one as well.

Along the straight way from the first places to the last a path takes a step by Runge and Kutta's fourth order and two
Newton corrections; the first correction's size sets the next step.
Source: Wampler, Morgan and Sommese 1992, J. Mech. Des. 114; Allgower and Georg 1990, Numerical Continuation Methods.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Complexes, Flags, Floats
from linkwright.designs.checkpoints import checkpointed
from linkwright.formula.threads import cores, spread_over

#: Paths that are carried together: their matrices stay in the processor's cache.
CHUNK = 181
TOLERANCE, SMALLEST_STEP, LARGEST_STEP, MOST_STEPS = 1e-3, 1e-12, 0.2, 3000
ROUNDING = 1e-7


@dataclass(frozen=True, eq=False)
class Ends:
    """Where paths ended: solutions (N, 8 + points), and which of them arrived (N,)."""

    solutions: Complexes
    arrived: Flags


@dataclass(frozen=True, eq=False)
class Places:
    """Displacements d, partners e (n,) of the places after the first, the poses first, and g (M,) of those."""

    d: Complexes
    e: Complexes
    g: Complexes

    def toward(self, other: Places, t: Floats) -> tuple[Complexes, Complexes, Complexes]:
        """d, e (n, K) and g (M, K) at the parts t (K,) of the way."""
        pairs = ((self.d, other.d), (self.e, other.e), (self.g, other.g))
        d, e, g = (a[:, None] + t * (b - a)[:, None] for a, b in pairs)
        return d, e, g

    def turned(self, way: complex) -> Places:
        """The places turned about the first."""
        return Places(self.d * way, self.e / way, self.g)


def track(
    start: Complexes,
    q0: Complexes,
    q1: Complexes,
    *,
    tolerance: float = TOLERANCE,
    most: int = MOST_STEPS,
    rounding: float = ROUNDING,
) -> Ends:
    """Solutions (N, 16) of the points q0 (2, 8) carried to the points q1, in compiled code.

    A second correction below ``rounding`` is taken for the rounding of ill-conditioned solutions.
    """
    places = [Places(q[0], q[1], np.empty(0, complex)) for q in (q0, q1)]

    def all_carried() -> tuple[Complexes, Flags]:
        done, arrived = start.copy(), np.zeros(len(start), bool)

        def carry(first: int, last: int) -> None:
            ends = _carried_compiled(start[first:last], places[0], places[1], tolerance, most, rounding)
            done[first:last], arrived[first:last] = ends.solutions, ends.arrived

        spread_over(len(start), CHUNK, cores(), carry)
        return done, arrived

    done, arrived = checkpointed(all_carried, lambda: (start, q0, q1, tolerance, most, rounding))
    with np.errstate(all="ignore"):
        right = arrived & np.isfinite(done).all(1)
        right &= residual(np.where(right[:, None], done, 1.0), q1) < 1e-9
    return Ends(done, right)


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


def carried(
    start: Complexes,
    first: Places,
    last: Places,
    tolerance: float = TOLERANCE,
    most: int = MOST_STEPS,
    rounding: float = ROUNDING,
) -> Ends:
    """Solutions (N, 8 + points) of the places ``first`` carried straight to ``last``, until every path has arrived or
    is abandoned."""
    done, arrived = start.T.copy(), np.zeros(len(start), bool)
    change = (last.d - first.d)[:, None], (last.e - first.e)[:, None], (last.g - first.g)[:, None]

    def tangent(u: Complexes, t: Floats) -> Complexes:
        return linear_step(u, first.toward(last, t), change)

    with np.errstate(all="ignore"):
        u, who = done.copy(), np.arange(len(start))
        t, h = np.zeros(len(who)), np.full(len(who), 0.02)
        for _ in range(most):
            final = t + h >= 1.0 - 1e-14
            h = np.where(final, 1.0 - t, h)
            moved = _predicted(u, t, h, tangent)
            good, size, moved = _corrected(moved, first.toward(last, t + h), tolerance, rounding)
            u = np.where(good, moved, u)
            t = np.where(good, np.where(final, 1.0, t + h), t)
            growth = 0.85 * (tolerance / (size + 1e-30)) ** 0.2
            near = (size > tolerance) & (size < 1e3)
            shrink = np.where(near, np.clip(growth, 0.2, 0.6), 0.5)
            h = np.where(good, np.minimum(LARGEST_STEP, h * np.clip(growth, 0.4, 2.0)), h * shrink)
            ended = t >= 1.0
            stay = ~ended & (h > SMALLEST_STEP)
            if not stay.all():
                done[:, who[ended]], arrived[who[ended]] = u[:, ended], True
                u, t, h, who = u[:, stay], t[stay], h[stay], who[stay]
            if not len(who):
                break
    return Ends(polished(done.T, arrived, last), arrived)


def _predicted(u: Complexes, t: Floats, h: Floats, tangent: Callable[[Complexes, Floats], Complexes]) -> Complexes:
    """A step of Runge and Kutta's fourth order."""
    k1 = tangent(u, t)
    k2 = tangent(u + (0.5 * h) * k1, t + 0.5 * h)
    k3 = tangent(u + (0.5 * h) * k2, t + 0.5 * h)
    k4 = tangent(u + h * k3, t + h)
    return u + (h / 6.0) * (k1 + 2.0 * (k2 + k3) + k4)


def _corrected(
    u: Complexes, places: tuple[Complexes, Complexes, Complexes], tolerance: float, rounding: float
) -> tuple[Flags, Floats, Complexes]:
    """Whether a step holds, the size of its first correction, and where two of them lead."""
    du = linear_step(u, places, None)
    first = relative_size(du, u)
    u = u + du
    du = linear_step(u, places, None)
    second = relative_size(du, u)
    good = (first < 8.0 * tolerance) & (second < 1e-5) & (second < np.maximum(rounding, 0.1 * first))
    return good, np.where(np.isfinite(first), first, 1e9), u + du


def _carried_compiled(
    start: Complexes, first: Places, last: Places, tolerance: float, most: int, rounding: float
) -> Ends:
    """The same steps for points alone in compiled code."""
    from linkwright.formula.kernel_writer import LANES
    from linkwright.synthesis.path_generation.tracking_kernels import ROOM, kernels

    rows, arrived, room = start.copy(), np.zeros(len(start)), np.zeros(ROOM)
    along = [
        _in_lanes(np.concatenate(each), LANES) for each in ((first.d, first.e), (last.d - first.d, last.e - first.e))
    ]
    limits = np.array([tolerance, SMALLEST_STEP, LARGEST_STEP, most, rounding])
    places = [each.ctypes.data for each in (rows, *along, arrived, limits)]
    kernels()("carry", len(rows), *places, room.ctypes.data)
    return Ends(polished(rows, arrived > 0.5, last), arrived > 0.5)


def polished(u: Complexes, which: Flags, places: Places) -> Complexes:
    """Solutions (N, 8 + points), of ``which`` the rounding is mended by corrections as long as they are small."""
    u = u.copy()
    still = places.toward(places, np.zeros(int(which.sum())))
    with np.errstate(all="ignore"):
        for _ in range(3):
            du = linear_step(u[which].T, still, None)
            small = relative_size(du, u[which].T) < 1e-6
            u[which] += np.where(small, du, 0.0).T
    return u


def _in_lanes(flat: Complexes, lanes: int) -> Floats:
    """Numbers (n,) as entries of compiled code, equal in all lanes."""
    return np.ascontiguousarray(np.repeat(np.stack([flat.real, flat.imag], 1), lanes, 1))


def linear_step(
    u: Complexes,
    places: tuple[Complexes, Complexes, Complexes],
    change: tuple[Complexes, Complexes, Complexes] | None,
) -> Complexes:
    """du/dt (8 + points, K) where d, e and the poses' g move by ``change``, or the Newton correction where that is
    None."""
    d, e, fixed_angles = places
    poses, count = len(fixed_angles), u.shape[1]
    g = np.concatenate([fixed_angles, u[8:]])
    inverse = 1.0 / (1.0 + g)
    f = -g * inverse
    gradients, slopes, rights = [], [], []
    for o in (0, 4):
        x, xc, w, wc = u[o], u[o + 1], u[o + 2], u[o + 3]
        m, n = d + x * g, e + xc * f
        mw, nw = m - w, n - wc
        gradients.append(np.stack([g * nw, f * mw, -n, -m], 1))
        slope = x * nw - xc * mw * inverse * inverse
        slopes.append(slope[poses:])
        right = n * w - m * nw if change is None else -(change[0] * nw + change[1] * mw)
        if change is not None:
            right[:poses] -= slope[:poses] * change[2]
        rights.append(right)
    first, second = slopes
    size = np.sqrt(_square(first) + _square(second)) + 1e-150
    p, r = second / size, -first / size
    system, right = np.zeros((count, 8, 8), complex), np.empty((count, 8), complex)
    for k, share in enumerate((p, r)):
        rows, columns = slice(k * poses, (k + 1) * poses), slice(4 * k, 4 * k + 4)
        system[:, rows, columns] = gradients[k][:poses].transpose(2, 0, 1)
        system[:, 2 * poses :, columns] = (share[:, None] * gradients[k][poses:]).transpose(2, 0, 1)
        right[:, rows] = rights[k][:poses].T
    right[:, 2 * poses :] = (p * rights[0][poses:] + r * rights[1][poses:]).T
    out = np.empty((len(u), count), complex)
    out[:8] = _solved(system, right)
    by_first = _square(first) > _square(second)
    rest = [rights[k][poses:] - (gradients[k][poses:] * out[4 * k : 4 * k + 4]).sum(1) for k in (0, 1)]
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
