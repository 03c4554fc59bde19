"""Four-bars with a turning crank of length 1, by three free numbers, and demands on their paths.

With the crank of length 1, coupler b, output c and frame d, the transmission angle never falls below μ just where
(κ = cos μ, s = b + c, m = b - c)

    s² (1 + κ) + m² (1 - κ) ≥ 2 (d + 1)²  and  s² (1 - κ) + m² (1 + κ) ≤ 2 (d - 1)²

(the law of cosines where the crank lies along the frame; κ = 1 is Grashof's b + c ≥ d + 1, |b - c| ≤ |d - 1|: the
crank turns fully). So with d₀ = (1 + tan μ/2)/(1 - tan μ/2) three free numbers reach every such four-bar and no
other, the border included:

    d = d₀ + eˣ (crank-rockers) or 1/(d₀ + eˣ) (double cranks),
    m = sin z √((d - 1)²(1 + κ) - (d + 1)²(1 - κ)) / √(2κ),   s² = lowest + (highest - lowest) sin² y;

for μ = 0, where s has no highest value, s = d + 1 + y².

The coupler's unit vector U at crank angle θ, with A = e^{iθ} and D = d - A, is
U = D (t + i √(4 b² D·D - t²)) / (2 b D·D), t = D·D + b² - c².

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


@dataclass(frozen=True, eq=False)
class CrankFamily:
    """K four-bars by free numbers (K, 3): ``double`` (K,): True for double cranks, ``transmission`` is μ in rad.

    ``rocking``: any four-bars, whose input need not turn; the free numbers are the logarithms of b, c, d.
    """

    double: Flags
    transmission: float = 0.0
    rocking: bool = False

    @classmethod
    def random(
        cls, rng: np.random.Generator, count: int, transmission: float = 0.0, rocking: bool = False
    ) -> tuple[CrankFamily, Floats]:
        """A family and free numbers spread over link ratios up to about eight."""
        if rocking:
            shape = rng.normal(0.0, 0.8, (count, 3))
            return cls(np.zeros(count, bool), transmission, True), shape
        x = rng.uniform(np.log(0.08), np.log(7.0), count)
        y = rng.uniform(0.05, 2.6 if transmission == 0.0 else np.pi / 2, count)
        z = rng.uniform(-np.pi / 2, np.pi / 2, count)
        return cls(rng.random(count) < 0.3, transmission), np.stack([x, y, z], 1)

    def chosen(self, rows: Integers) -> CrankFamily:
        """The family of some of its rows."""
        return CrankFamily(self.double[rows], self.transmission, self.rocking)

    def lengths(self, free: Floats) -> Floats:
        """Lengths b, c, d, (3, K)."""
        if self.rocking:
            return np.exp(free[:, :3]).T
        grown = np.exp(np.clip(free[:, 0], -30, 12))
        slope = np.tan(self.transmission / 2)
        d = (1 + slope) / (1 - slope) + grown
        d = np.where(self.double, 1 / d, d)
        k = np.cos(self.transmission)
        room = np.maximum((d - 1) ** 2 * (1 + k) - (d + 1) ** 2 * (1 - k), 0.0)
        difference = np.sin(free[:, 2]) * np.sqrt(room / (2 * k))
        lowest = (2 * (d + 1) ** 2 - difference**2 * (1 - k)) / (1 + k)
        if self.transmission == 0.0:
            total = np.sqrt(lowest) + free[:, 1] ** 2
        else:
            highest = (2 * (d - 1) ** 2 - difference**2 * (1 + k)) / (1 - k)
            total = np.sqrt(lowest + np.maximum(highest - lowest, 0.0) * np.sin(free[:, 1]) ** 2)
        return np.stack([0.5 * (total + difference), 0.5 * (total - difference), d])

    def rates(self, free: Floats) -> Floats:
        """Derivatives of b, c, d by the free numbers, (3, K, 3): central differences."""
        step = 1e-6
        moved = [step * np.eye(3)[j] for j in range(3)]
        x = free[:, :3]
        return np.stack([(self.lengths(x + h) - self.lengths(x - h)) / (2 * step) for h in moved], 2)


def couplers(theta: Floats, shape: Floats) -> tuple[Complexes, Complexes]:
    """Crank pin A and coupler's unit vector U, (K, n), of angles (K, n) or (n,) and lengths (3, K)."""
    b, c, d = shape[:, :, None]
    a = np.exp(1j * theta) * np.ones_like(b)
    reach = d - a
    square = reach.real**2 + reach.imag**2
    t = square + b * b - c * c
    root = np.sqrt(np.maximum(4 * b * b * square - t * t, 0.0))
    return a, reach * (t + 1j * root) / (2 * b * square)


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
