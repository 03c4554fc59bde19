"""Four-bars through three, four or five pairs of angles exactly.

With the frame 1, A = a e^{iφ} and B = 1 + c e^{iψ}, the coupler's constant length is Freudenstein's equation

    cos φ = P₀ cos ψ + P₁ cos(φ - ψ) + P₂,   P₀ = c/a, P₁ = -c, P₂ = (1 + a² + c² - b²)/(2 a):

linear for three pairs. Four pairs: one zero angle ζ is the root of a determinant that is a trigonometric polynomial
of degree two, so of a quartic in e^{iζ}. Five pairs with both zero angles free: relative to the output link, the
input link takes five poses; pins A that stay on circles about points B of the output are Burmester's, at most four,
one of which is the pair of fixed pivots itself.
Sources: Freudenstein 1955, Trans. ASME 77; Hartenberg and Denavit 1964, Kinematic Synthesis of Linkages, ch. 10.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from linkwright.core.arrays import Complexes, Floats
from linkwright.synthesis.motion_generation.burmester import five_poses

ZEROS = 72
#: Share of the largest singular value below which pairs of angles do not determine a four-bar.
DEPENDENT = 1e-13


@dataclass(frozen=True, eq=False)
class Freudenstein:
    """Freudenstein's equation for N sets of n pairs of angles, ``rows`` · P = ``right``, solved.

    ``phi``, ``psi`` (N, n): angles of input and output link, rad; ``rows`` (N, n, 3): cos ψ, cos(φ - ψ), 1;
    ``right`` (N, n): cos φ; ``p`` (N, 3); ``lengths`` a, b, c (N, 3) in units of the frame; NaN: none.
    """

    phi: Floats
    psi: Floats
    rows: Floats
    right: Floats
    p: Floats
    lengths: Floats

    def __getitem__(self, rows: Any) -> Freudenstein:
        parts = (self.phi, self.psi, self.rows, self.right, self.p, self.lengths)
        return Freudenstein(*(each[rows] for each in parts))

    @property
    def normal(self) -> Floats:
        """Matrix of the normal equations (…, 3, 3): sums of products of the columns."""
        return np.asarray(self.rows.swapaxes(-1, -2) @ self.rows)

    @property
    def moment(self) -> Floats:
        """Right side of the normal equations (…, 3)."""
        return np.asarray((self.rows.swapaxes(-1, -2) @ self.right[..., None])[..., 0])

    @property
    def residual(self) -> Floats:
        """What is left of every equation, (…, n)."""
        return np.asarray((self.rows @ self.p[..., None])[..., 0] - self.right)


def freudenstein(phi: Floats, psi: Floats) -> Freudenstein:
    """The equation of pairs of angles (N, n), n ≥ 3 by least squares.

    A negative a or c is measured to the opposite end of its link.
    """
    rows = np.stack([np.cos(psi), np.cos(phi - psi), np.ones_like(phi)], -1)
    right = np.cos(phi)
    u, size, v = np.linalg.svd(rows, full_matrices=False)
    across = (u.swapaxes(1, 2) @ right[..., None])[..., 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        p = (v.swapaxes(1, 2) @ (across / size)[..., None])[..., 0]
        p[size[:, 2] <= DEPENDENT * size[:, 0]] = np.nan
        c = -p[:, 1]
        a = c / p[:, 0]
        b = np.sqrt(1 + a * a + c * c - 2 * a * p[:, 2])
    return Freudenstein(phi, psi, rows, right, p, np.stack([a, b, c], 1))


def zero_angles(phi: Floats, psi: Floats, which: str) -> Floats:
    """Real zero angles ζ (K,) that put four pairs (4,) on one four-bar, added to ``input`` or ``output``."""
    h = harmonics(phi, psi, which)
    roots = np.roots(h[[2, 1, 0, 4, 3]])
    real = np.abs(np.abs(roots) - 1) < 1e-7
    return np.asarray(np.angle(roots[real]))


def harmonics(phi: Floats, psi: Floats, which: str) -> Complexes:
    """Coefficients (5,) of e^{ikζ}, k = 0, 1, 2, -2, -1, of the determinant of four pairs."""
    zeta = 2 * np.pi * np.arange(5) / 5
    values = np.array([_determinant(phi, psi, z, which) for z in zeta])
    return np.asarray(np.fft.fft(values) / 5)


def _determinant(phi: Floats, psi: Floats, zeta: float, which: str) -> float:
    f, s = (phi + zeta, psi) if which == "input" else (phi, psi + zeta)
    return float(np.linalg.det(np.stack([np.cos(s), -np.cos(f), np.ones_like(f), -np.cos(f - s)], 1)))


def five_pairs(phi: Floats, psi: Floats) -> tuple[Floats, Floats]:
    """Zero angles (K, 2) of input and output and lengths a, b, c (K, 3) of all four-bars through five pairs (5,)."""
    places = -np.exp(-1j * (psi - psi[0]))
    z, centre, real, far = five_poses(places[None], (phi - psi)[None])
    z, centre = z[0][real[0] & ~far[0]], centre[0][real[0] & ~far[0]] + places[0]
    own = (np.abs(z) < 1e-6) & (np.abs(centre) < 1e-6)
    z, centre = z[~own], centre[~own]
    lengths = np.stack([np.abs(z), np.abs(places[0] + z - centre), np.abs(centre)], 1)
    zeros = np.stack([np.angle(z) - phi[0], np.angle(centre) - psi[0]], 1)
    return zeros, lengths


def families(
    phi: Floats, psi: Floats, zeros: tuple[float | None, float | None]
) -> tuple[Floats, Floats, Freudenstein | None]:
    """Zero angles (K, 2) and lengths (K, 3) of the exact four-bars of three, four or five pairs, and the equation
    that they were found by (None for five pairs, where they are Burmester's).

    A zero angle that is None is free; where more is free than the pairs need it is sampled evenly.
    """
    if len(phi) == 5:
        return *five_pairs(phi, psi), None
    grid = 2 * np.pi * np.arange(ZEROS) / ZEROS
    inputs = grid if zeros[0] is None else np.array([zeros[0]])
    outputs = grid if zeros[1] is None else np.array([zeros[1]])
    if len(phi) == 3:
        pairs = np.stack(np.meshgrid(inputs, outputs, indexing="ij"), -1).reshape(-1, 2)
    elif zeros[1] is None:
        pairs = np.array([(i, o) for i in inputs for o in zero_angles(phi + i, psi, "output")]).reshape(-1, 2)
    else:
        pairs = np.array([(i, outputs[0]) for i in zero_angles(phi, psi + outputs[0], "input")]).reshape(-1, 2)
    found = freudenstein(phi + pairs[:, :1], psi + pairs[:, 1:])
    return pairs, found.lengths, found


def chebyshev_spacing(low: float, high: float, count: int) -> Floats:
    """Precision points (count,) that make the structural error about equal over a range.

    x_j = (low + high)/2 - (high - low)/2 cos((2 j - 1) π / (2 n)), j = 1 … n. Source: Freudenstein 1955.
    """
    j = np.arange(1, count + 1)
    return np.asarray(0.5 * (low + high) - 0.5 * (high - low) * np.cos((2 * j - 1) * np.pi / (2 * count)))
