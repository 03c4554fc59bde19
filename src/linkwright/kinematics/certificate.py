r"""Proof that a step of the drivers leads from one assembly to the same one, and how near another one may be.

Certificate of a step of the way's parameter x from x₀ to x₁ = x₀ + h, with roots y₀, y₁ of the closed loops F and
their exact rates there. p: the cubic through both with these rates, the drivers' coordinates included; x_m the
middle, A = (∂F/∂z)⁻¹ at p(x_m), N = A d(∂F/∂z)/dx there, A(x) = (I - (x - x_m) N) A. With

    b ≥ |A(x) F(p(x))|,      M(ρ) ≥ |I - A(x) J(u)|      for all x of the step and all |u - p(x)| ≤ ρ

(componentwise), the step is certified if one positive vector ρ satisfies b + M(ρ) ρ ≤ ρ: then u ↦ u - A(x) F(u) takes
the box around p(x) into itself and contracts it, so for every x it holds exactly one root, J is regular in the
whole tube, and one continuous branch joins y₀ and y₁ (Krawczyk 1969; Newton–Kantorovich with moving centre and
preconditioner; Neumaier, Interval Methods for Systems of Equations, ch. 5).

The bounds take lengths and the cubic's Bernstein coefficients only, for each loop term turns as a whole. With w, g, c
≥ |θ′|, |θ″|, |θ‴|, e2 = w² + g, e3 = w³ + 3wg + c, e4 = w⁴ + 6w²g + 3g² + 4wc, and s′, s″, s‴ for the slides:

    b    = (I + h/2 |N|) (h⁴/384 |A F(p)|⁗ + deviation + ends),    as F(p) and its slope vanish at both ends,
    M(ρ) = h²/4 |N²| + (I + h/2 |N|) (h²/8 |A J(p)|″ + |A (J(u) - J(p))| + rounding).

``deviation``: the law of a driver may leave the cubic by as much at the positions within the step; the root there is
then proved for every place between. Rigorous up to the rounding model of ``_ends`` (no directed rounding).
"""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Complexes, Floats
from linkwright.core.dataclass import dataclass
from linkwright.kinematics.closed_loops import ClosedLoops

#: Above this contraction without tube a step is not tried.
LARGEST_CONTRACTION = 0.95
#: Rounding of one entry, relative.
ROUNDING = 4e-16


@dataclass(frozen=True)
class End:
    """One end of a step: place x, coordinates y (n + d,) with two derivatives, sign of the determinant."""

    x: float
    y: Floats
    rate: Floats
    second: Floats
    sign: float


@dataclass(frozen=True)
class Certificate:
    """``certified`` with the ``tube`` (n,) around the cubic; ``contraction`` steers the next step."""

    certified: bool
    contraction: float
    tube: Floats | None = None


REFUSED = Certificate(False, np.inf)


def cubic(a: End, b: End, x: Floats) -> Floats:
    """The cubic through both ends with their rates at places x (m,), (m, n + d)."""
    h = b.x - a.x
    t = ((x - a.x) / h)[:, None]
    square, cube = t * t, t * t * t
    rise = 3.0 * square - 2.0 * cube
    slopes = (cube - 2.0 * square + t) * h * a.rate + (cube - square) * h * b.rate
    return np.asarray(a.y + rise * (b.y - a.y) + slopes)


def certify(loops: ClosedLoops, a: End, b: End, deviation: Floats) -> Certificate:
    """Whether one continuous branch leads from a to b; ``deviation`` (d,): of the drivers' laws from the cubic."""
    try:
        step = _Step(loops, a, b, deviation)
    except np.linalg.LinAlgError:
        return REFUSED
    flat = step.deviation_of_jacobian(np.zeros(loops.n))
    contraction = float(np.abs(np.linalg.eigvals(flat)).max())
    if not contraction < LARGEST_CONTRACTION:
        return Certificate(False, contraction)
    off = step.residual_bound()
    tube = np.asarray(2.0 * np.linalg.solve(np.eye(loops.n) - flat, off), float)
    certified = bool((off + step.deviation_of_jacobian(tube) @ tube <= tube).all() and (tube > 0.0).all())
    return Certificate(certified, contraction, tube)


class _Step:
    """The bounds of one step."""

    def __init__(self, loops: ClosedLoops, a: End, b: End, deviation: Floats) -> None:
        self.loops, self.a, self.b = loops, a, b
        self.h = h = b.x - a.x
        mean = (b.y - a.y) / h
        inner = 3.0 * mean - a.rate - b.rate
        firsts = loops.coordinates @ np.stack([a.rate, inner, b.rate], axis=1)
        v1 = np.abs(firsts).max(axis=1)
        v2 = 2.0 / h * np.abs(np.diff(firsts)).max(axis=1)
        v3 = 2.0 / h**2 * np.abs(firsts @ [1.0, -2.0, 1.0])
        C = loops.C
        self.w, self.g, self.c = v1[:C], v2[:C], v3[:C]
        self.s1, self.s2, self.s3 = v1[C:], v2[C:], v3[C:]
        off = loops.coordinates[:, loops.n :] @ deviation if deviation.any() else np.zeros(C + loops.S)
        self.off_turn, self.off_slide = np.abs(off[:C]), np.abs(off[C:])
        middle = 0.5 * (a.y + b.y) + h / 8.0 * (a.rate - b.rate)
        at = loops.turned(middle)
        self.J = loops.jacobian(loops.slopes(at))
        self.A = np.asarray(np.linalg.inv(self.J), float)
        row = self.A[:, : loops.K] - 1j * self.A[:, loops.K :]
        turned, slid = row @ (at.unit[:, None] * at.arms).T, row @ at.slides.T
        self.slid = np.abs(slid)
        self.reach = np.abs(turned) + (self.slid * self.s1 * (h / 2.0)) @ loops.own
        self.N = self._turning(turned, slid, loops.coordinates @ (1.5 * mean - 0.25 * (a.rate + b.rate)))
        self.spread = np.eye(loops.n) + h / 2.0 * np.abs(self.N)
        self.square = h * h / 4.0 * np.abs(self.N @ self.N)
        self.bend = h * h / 8.0 * self._bend() + np.abs(np.eye(loops.n) - self.A @ self.J) + 1e-15

    def _columns(self, of_rotations: Floats, of_slides: Floats) -> Floats:
        """Bounds by rotation and slide (n, C), (n, S) as columns of the unknowns, by absolute shares."""
        n, loops = self.loops.n, self.loops
        return of_rotations @ np.abs(loops.turning[:, :n]) + of_slides @ np.abs(loops.sliding[:, :n])

    def _turning(self, turned: Complexes, slid: Complexes, rate: Floats) -> Floats:
        """N = A dJ/dx in the middle."""
        loops = self.loops
        theta, s = rate[: loops.C], rate[loops.C :]
        of_rotations = -theta * turned.real - (slid.imag * s) @ loops.own
        of_slides = -theta[loops.owner] * slid.imag
        found: Floats = of_rotations @ loops.turning[:, : loops.n] + of_slides @ loops.sliding[:, : loops.n]
        return found

    def _bend(self) -> Floats:
        """Bound of |A J(p(x))″|."""
        loops, w, slid = self.loops, self.w, self.slid
        e2 = w * w + self.g
        of_rotations = (
            self.reach * e2 + (slid * self.s2) @ loops.own + 2.0 * ((slid * self.s1) @ loops.own) * w
        )
        return self._columns(of_rotations, slid * e2[loops.owner])

    def residual_bound(self) -> Floats:
        """b, (n,)."""
        w, g, c, owner = self.w, self.g, self.c, self.loops.owner
        e2, e3 = w * w + g, w**3 + 3.0 * w * g + c
        e4 = w**4 + 6.0 * w * w * g + 3.0 * g * g + 4.0 * w * c
        fourth = self.reach @ e4 + self.slid @ (
            4.0 * self.s1 * e3[owner] + 6.0 * self.s2 * e2[owner] + 4.0 * self.s3 * w[owner]
        )
        deviation = self.reach @ self.off_turn + self.slid @ self.off_slide
        found: Floats = self.spread @ (self.h**4 / 384.0 * fourth + deviation + self._ends() + 1e-15)
        return found

    def deviation_of_jacobian(self, tube: Floats) -> Floats:
        """M(ρ), (n, n)."""
        loops = self.loops
        turn = np.abs(loops.turning[:, : loops.n]) @ tube + self.off_turn
        slide = np.abs(loops.sliding[:, : loops.n]) @ tube + self.off_slide
        tilt = self._columns(
            self.reach * turn + (self.slid * slide) @ loops.own, self.slid * turn[loops.owner]
        )
        found: Floats = self.square + self.spread @ (self.bend + tilt)
        return found

    def _ends(self) -> Floats:
        """What rounding and Newton's method leave of F and F′ at the ends, through |A|, (n,)."""
        loops = self.loops
        left, size = np.zeros(loops.n), np.zeros(loops.K)
        for end in (self.a, self.b):
            at = loops.turned(end.y)
            slope = end.rate @ loops.slopes(at)
            left += np.abs(self.A @ loops.gap(at))
            left += 4.0 / 27.0 * self.h * np.abs(self.A @ np.concatenate([slope.real, slope.imag]))
            size = np.maximum(size, np.abs(at.arms).sum(axis=-2))
        rounding: Floats = np.abs(self.A) @ np.concatenate([size, size])
        return left + ROUNDING * rounding


def distance_to_others(loops: ClosedLoops, y: Floats) -> Floats:
    """Lower bound (m,) of how far any other assembly lies from roots y (m, n + d) with the same drivers.

    Largest change of an unknown, in rad or as share of the mechanism's size. With A = J(y)⁻¹ and v another root,
    0 = A (F(v) - F(y)) gives |v - y| ≤ ½ T(|v - y|) |v - y|, T(ρ) ≥ |A (J(u) - J(y))| for |u - y| ≤ ρ.
    """
    at = loops.turned(y)
    n = loops.n
    A = np.linalg.inv(loops.jacobian(loops.slopes(at)))
    row = A[..., : loops.K] - 1j * A[..., loops.K :]
    reach = np.abs(row @ np.swapaxes(at.unit[..., None] * at.arms, -1, -2))
    slid = np.abs(row @ np.swapaxes(at.slides, -1, -2))
    turn, slide = np.abs(loops.turning[:, :n]) @ loops.scale, np.abs(loops.sliding[:, :n]) @ loops.scale
    tilt = (reach * turn + (slid * slide) @ loops.own) @ turn + slid @ (turn[loops.owner] * slide)
    with np.errstate(divide="ignore"):
        return np.asarray(2.0 * (loops.scale / tilt).min(axis=-1))
