"""Burmester's points: points of a moving plane whose positions lie on a circle or a straight line.

A pose j puts the body point z at Z_j = p_j + z e^{iφ_j}. With the first pose as p = 0, φ = 0 and e_j = e^{iφ_j}, the
point z lies on a circle about C at every pose where, for j = 1 … n - 1,

    (1 - e_j) z C* + (1 - e_j*) z* C + p_j* e_j z + p_j e_j* z* - p_j* C - p_j C* + p_j p_j* = 0.

Five poses: the four equations are linear in (zC*, z*C, z, z*, C, C*, 1). Their null space has three dimensions, and
the two products are two conics in it: four solutions, all found, real where z* is the conjugate of z. A solution
whose centre is at infinity is a slider. Four poses: the circle-point curve, a cubic; three: every point.
Source: Burmester 1888, Lehrbuch der Kinematik; Bottema and Roth 1979, Theoretical Kinematics, ch. 8.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from linkwright.core.arrays import Complexes, Flags, Floats

#: A solution is real where its conjugate differs by less than this, relative; centres farther than FAR are sliders.
REAL, FAR = 1e-6, 1e7


@dataclass(frozen=True, eq=False)
class Dyads:
    """K guided points of the body: ``point`` z in the axes of the first pose (from its p₀), ``positions`` (K, n) in
    the frame, ``centre`` of the circle (nan for a slider), ``direction`` of the slider's line (nan else).
    """

    point: Complexes
    positions: Complexes
    centre: Complexes
    direction: Complexes

    @property
    def slides(self) -> Flags:
        """Which of them are sliders."""
        return ~np.isnan(self.direction.real)

    def __len__(self) -> int:
        return len(self.point)

    def __getitem__(self, rows: NDArray[np.generic] | slice) -> Dyads:
        return Dyads(self.point[rows], self.positions[rows], self.centre[rows], self.direction[rows])


def relative_poses(p: Complexes, phi: Floats) -> tuple[Complexes, Complexes]:
    """Displacements p_j - p_0 (…, n) and rotations e^{i(φ_j - φ_0)} (…, n)."""
    return p - p[..., :1], np.exp(1j * (phi - phi[..., :1]))


def moved(z: Complexes, d: Complexes, e: Complexes) -> Complexes:
    """Displacements of body points z (K,) from the first pose to every pose, (K, n)."""
    return np.asarray(d + (e - 1) * z[:, None])


def at_poses(z: Complexes, p: Complexes, d: Complexes, e: Complexes) -> Complexes:
    """Positions (K, n) of body points z (K,) in the frame; p: positions of the poses (n,)."""
    return np.asarray(p[0] + z[:, None] + moved(z, d, e))


def join(*parts: Dyads) -> Dyads:
    """Several sets of dyads as one."""
    fields = ("point", "positions", "centre", "direction")
    return Dyads(*(np.concatenate([getattr(each, name) for each in parts]) for name in fields))


def circles(z: Complexes, p: Complexes, d: Complexes, e: Complexes) -> Dyads:
    """Dyads of body points that lie on circles: centres from the bisectors, least squares over the poses."""
    centre = centres(z, moved(z, d, e)) + p[0]
    return Dyads(z, at_poses(z, p, d, e), centre, np.full(len(z), np.nan + 0j))


def sliders(z: Complexes, p: Complexes, d: Complexes, e: Complexes) -> Dyads:
    """Dyads of body points that lie on straight lines."""
    positions = at_poses(z, p, d, e)
    off = positions - positions.mean(1, keepdims=True)
    along = np.exp(0.5j * np.angle((off**2).sum(1)))
    return Dyads(z, positions, np.full(len(z), np.nan + 0j), along)


def centres(z: Complexes, q: Complexes) -> Complexes:
    """Centres (K,) from Re(q_j* C) = Re(q_j* z) + |q_j|²/2, in axes at the first pose; q (K, n)."""
    q = q[:, 1:]
    right = (q.conj() * z[:, None]).real + np.abs(q) ** 2 / 2
    xx, yy, xy = (q.real**2).sum(1), (q.imag**2).sum(1), (q.real * q.imag).sum(1)
    bx, by = (q.real * right).sum(1), (q.imag * right).sum(1)
    with np.errstate(divide="ignore", invalid="ignore"):
        determinant = xx * yy - xy * xy
        return np.asarray(((yy * bx - xy * by) + 1j * (xx * by - xy * bx)) / determinant)


def five_poses(p: Complexes, phi: Floats) -> tuple[Complexes, Complexes, Flags, Flags]:
    """All four Burmester pairs of N times five poses (N, 5).

    Returns:
        Body points z (N, 4) and centres C (N, 4) in axes at the first pose; which are real; which are sliders.
    """
    d, e = relative_poses(p, phi)
    size = np.sqrt((np.abs(d) ** 2).mean(-1, keepdims=True)) + 1e-300
    d, e = (d / size)[:, 1:], e[:, 1:]
    space = np.linalg.svd(_coefficients(d, e))[2][:, 4:].conj().swapaxes(1, 2)
    product, product_c, z, zc, c, cc, one = (space[:, k] for k in range(7))
    t = _conics(_quadric(product, one, z, cc), _quadric(product_c, one, zc, c))
    product, product_c, z, zc, c, cc, one = ((space[:, k, None] * t).sum(-1) for k in range(7))
    far = np.abs(one) < 1e-9 * np.abs(np.stack([c, cc, z, zc])).max(0)
    with np.errstate(divide="ignore", invalid="ignore"):
        points = np.where(far, product / cc, z / one), np.where(far, product_c / c, zc / one)
        middle = (
            np.where(far, FAR * 10 * c / np.abs(c), c / one),
            np.where(far, FAR * 10 * cc / np.abs(cc), cc / one),
        )
    x = _polished(np.stack([*points, *middle], -1), d, e, ~far)
    slides = np.abs(x[..., 2]) > FAR
    conjugate = np.abs(x[..., 1] - x[..., 0].conj()) <= REAL * (1 + np.abs(x[..., 0]))
    same = np.abs(x[..., 3] - x[..., 2].conj()) <= REAL * (1 + np.abs(x[..., 2]))
    real = conjugate & (same | slides) & np.isfinite(x).all(-1)
    x = np.where(real[..., None], 0.5 * (x + x[..., [1, 0, 3, 2]].conj()), x)
    return x[..., 0] * size, x[..., 2] * size, real, slides


def _coefficients(d: Complexes, e: Complexes) -> Complexes:
    """Rows (N, 4, 7) of the equations in (zC*, z*C, z, z*, C, C*, 1)."""
    dc, ec = d.conj(), e.conj()
    return np.stack([1 - e, 1 - ec, dc * e, d * ec, -dc, -d, d * dc], -1)


def _quadric(a: Complexes, b: Complexes, c: Complexes, d: Complexes) -> Complexes:
    """Symmetric coefficients (N, 3, 3) of the quadratic form (a·t)(b·t) - (c·t)(d·t)."""
    outer = a[:, :, None] * b[:, None] - c[:, :, None] * d[:, None]
    return np.asarray(outer + outer.swapaxes(1, 2))


def _conics(first: Complexes, second: Complexes) -> Complexes:
    """The four common points (N, 4, 3) of two conics tᵀ M t = 0, by the resultant in t = (s, r, 1)."""
    a1, b1, c1 = _in_s(first)
    a2, b2, c2 = _in_s(second)
    ac = a1 * c2 - a2 * c1
    ab = a1 * b2 - a2 * b1
    bc = _times(b1, c2) - _times(b2, c1)
    quartic = _times(ac, ac) - _times(ab, bc)
    r = _quartic_roots(quartic)
    with np.errstate(divide="ignore", invalid="ignore"):
        s = -_value(ac, r) / _value(ab, r)
    return np.stack([s, r, np.ones_like(r)], -1)


def _in_s(m: Complexes) -> tuple[Complexes, Complexes, Complexes]:
    """Coefficients of s², s and 1 as polynomials in r, rising powers, (N, 3)."""
    zero = np.zeros_like(m[:, 0, 0])
    square = np.stack([m[:, 0, 0] / 2, zero, zero], 1)[:, :1]
    linear = np.stack([m[:, 0, 2], m[:, 0, 1]], 1)
    rest = np.stack([m[:, 2, 2] / 2, m[:, 1, 2], m[:, 1, 1] / 2], 1)
    return square, linear, rest


def _times(a: Complexes, b: Complexes) -> Complexes:
    out = np.zeros((len(a), a.shape[1] + b.shape[1] - 1), complex)
    for k in range(a.shape[1]):
        out[:, k : k + b.shape[1]] += a[:, k : k + 1] * b
    return out


def _value(a: Complexes, r: Complexes) -> Complexes:
    return sum((a[:, k : k + 1] * r**k for k in range(a.shape[1])), np.zeros_like(r))


def _quartic_roots(c: Complexes) -> Complexes:
    """Roots (N, 4) of polynomials with rising coefficients (N, 5), as eigenvalues of companion matrices."""
    lead = np.where(np.abs(c[:, 4]) > 1e-14 * np.abs(c).max(1), c[:, 4], 1e-14 * np.abs(c).max(1) + 1e-300)
    companion = np.zeros((len(c), 4, 4), complex)
    companion[:, [1, 2, 3], [0, 1, 2]] = 1
    companion[:, :, 3] = -c[:, :4] / lead[:, None]
    return np.linalg.eigvals(companion).astype(complex)


def _polished(x: Complexes, d: Complexes, e: Complexes, use: Flags) -> Complexes:
    """Newton's steps on the four equations for (z, z*, C, C*), (N, 4, 4)."""
    rows = _coefficients(d, e)[:, None]
    for _ in range(4):
        z, zc, c, cc = (x[..., k] for k in range(4))
        one, zero = np.ones_like(z), np.zeros_like(z)
        monomials = np.stack([z * cc, zc * c, z, zc, c, cc, one], -1)
        slopes = np.stack(
            [
                np.stack([cc, zero, one, zero, zero, zero, zero], -1),
                np.stack([zero, c, zero, one, zero, zero, zero], -1),
                np.stack([zero, zc, zero, zero, one, zero, zero], -1),
                np.stack([z, zero, zero, zero, zero, one, zero], -1),
            ],
            -1,
        )
        f = (rows @ monomials[..., None])[..., 0]
        jacobian = rows @ slopes
        good = use & np.isfinite(jacobian).all((-1, -2)) & (np.abs(c) < FAR)
        jacobian = np.where(good[..., None, None], jacobian, np.eye(4))
        try:
            step = np.linalg.solve(jacobian, np.where(good[..., None], f, 0)[..., None])[..., 0]
        except np.linalg.LinAlgError:
            break
        smaller = good & (np.abs(step) <= 0.5 * (1 + np.abs(x))).all(-1)
        x = np.where(smaller[..., None], x - step, x)
    return x
