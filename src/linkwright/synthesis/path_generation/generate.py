"""Path generation: the four-bars with a turning crank whose coupler point comes nearest to given points."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkwright.synthesis.assessment import assess_four_bars
from linkwright.synthesis.build import four_bar_candidate, path_of_four_bar
from linkwright.synthesis.crank_family import CrankFamily, couplers
from linkwright.synthesis.least_squares import minimise
from linkwright.synthesis.path_generation.bounded import BoundedPaths
from linkwright.synthesis.path_generation.projection import Demand, ProjectedPaths
from linkwright.synthesis.result import Candidate, Synthesis, different, note, ranked, refuse

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Whole = NDArray[np.int64]

#: Starts tried, and those that are iterated: timed and untimed.
TIMED, UNTIMED = (3000, 64), (16000, 256)
#: Solutions whose lengths agree so far (relative) are one.
ALIKE = 1e-4


def path_generation(
    points: ArrayLike,
    *,
    angles: ArrayLike | None = None,
    phase: bool = True,
    pivot: tuple[float, float] | None = None,
    direction: float | None = None,
    bound: float | None = None,
    transmission_angle: float = 0.0,
    count: int = 6,
    seed: int = 0,
) -> Synthesis:
    """Four-bars with a fully turning crank whose coupler point passes near the points, least squares, globally.

    Args:
        points: (n, 2) or complex (n,), m, in the order in which they are passed; n ≥ 3; a last point equal to the
            first closes the curve.
        angles: crank angles of the points, rad (timed); None: the timing is free (untimed).
        phase: a common angle may be added to ``angles``; without it they count from the line O1→O2.
        pivot: the crank's pivot (m) where it is given.
        direction: angle of the line O1→O2 (rad) where it is given.
        bound: largest length, and largest absolute coordinate of the crank's pivot and of the coupler point in the
            coupler's axes, m.
        transmission_angle: the smallest that is allowed over the turn, rad.
        count: candidates wanted.
        seed: of the random starts.

    Returns:
        Candidates; ``error``: Σ |P_j - target_j|², m². P = z + α e^{iθ} + β U(θ; b, c, d): place, size and coupler
        point are projected out, ratios and timing iterated from an atlas of starts.

    Raises:
        SynthesisError: fewer than three points, points that coincide, angles that do not fit.
    """
    demand = _demand(points, angles, phase, pivot, direction)
    paths, free = _starts(demand, bound, transmission_angle, np.random.default_rng(seed))
    who = np.arange(len(free))
    if bound is None:
        solved, _, who = minimise(paths, free, keep=16, steps=80 if demand.timed else 120)
        linear = paths.fit(solved, who)[1:]
    else:
        solved, who, linear = BoundedPaths(paths, bound).solve(free)
    candidates = _candidates(paths, solved, who, linear)
    chosen = different(ranked(candidates, demand.size**2), ALIKE * demand.size)[:count]
    if not chosen:
        raise refuse("path.none")
    notes = (note("path.ordered"),) if chosen[0].defects else ()
    return Synthesis("path", chosen, "squares", demand.points, {"starts": len(free)}, notes)


def _demand(
    points: ArrayLike, angles: ArrayLike | None, phase: bool, pivot: tuple[float, float] | None,
    direction: float | None,
) -> Demand:  # fmt: skip
    z = complex_points(points)
    if len(z) < 3:
        raise refuse("path.few", count=len(z))
    theta = np.zeros(len(z)) if angles is None else np.asarray(angles, float)
    if theta.shape != z.shape:
        raise refuse("path.angles", angles=len(theta), points=len(z))
    place = None if pivot is None else complex(*pivot)
    found = Demand(z, theta, phase, angles is not None, place, direction)
    if not found.size > 0:
        raise refuse("path.one_place")
    return found


def complex_points(points: ArrayLike) -> Complexes:
    """Points (n, 2) or complex (n,) as complex (n,); raises SynthesisError for what is neither, or not finite."""
    given = np.asarray(points)
    if given.ndim == 2 and given.shape[1] == 2:
        given = given[:, 0].astype(float) + 1j * given[:, 1].astype(float)
    if given.ndim != 1 or not np.isfinite(given).all():
        raise refuse("points")
    return given.astype(complex)


def _starts(
    demand: Demand, bound: float | None, transmission: float, rng: np.random.Generator
) -> tuple[ProjectedPaths, Floats]:
    """The best of many random starts by their residual, within bounds where there are any."""
    tried, kept = TIMED if demand.timed else UNTIMED
    tried = max(1000, min(tried, 400_000 // len(demand.points)))
    family, shape = CrankFamily.random(rng, tried, transmission)
    mirrored = rng.random(tried) < 0.5
    if demand.timed:
        free = np.column_stack([shape, rng.uniform(0, 2 * np.pi, tried)]) if demand.phase else shape
    else:
        free = np.column_stack([shape, _timing(demand, rng, tried)])
    paths, who = ProjectedPaths(demand, family, mirrored), np.arange(tried)
    best = np.argsort(_squares(paths.fit(free, who)[0]))[:kept]
    if bound is not None:
        bounded = BoundedPaths(paths, bound)
        inside = np.argsort(_squares(bounded.residual(bounded.start(free, who), who)))[:kept]
        best = np.unique(np.concatenate([best[: kept // 2], inside]))
    return ProjectedPaths(demand, family.chosen(best), mirrored[best]), free[best]


def _squares(residual: Floats) -> Floats:
    return np.asarray(np.einsum("ki,ki->k", residual, residual))


def _timing(demand: Demand, rng: np.random.Generator, tried: int) -> Floats:
    """Crank angles (tried, distinct points): chord lengths over a random part of the turn, warped, either way."""
    chords = np.abs(np.diff(demand.points))
    share = np.concatenate([[0.0], np.cumsum(chords)]) / chords.sum()
    span = 2 * np.pi * np.ones(tried) if demand.closed else rng.uniform(0.15, 1.9 * np.pi, tried)
    wave = rng.uniform(0, 0.8, tried)[:, None] / (2 * np.pi)
    warped = share + wave * np.sin(2 * np.pi * share + rng.uniform(0, 2 * np.pi, (tried, 1)))
    warped = warped - warped[:, :1]
    theta = rng.uniform(0, 2 * np.pi, (tried, 1)) + rng.choice([-1, 1], (tried, 1)) * span[:, None] * warped
    return np.asarray(theta[:, : int(demand.same.max()) + 1])


def _candidates(
    paths: ProjectedPaths, free: Floats, who: Whole, linear: tuple[Complexes, Complexes, Complexes]
) -> list[Candidate]:
    """Four-bars in the plane of the points, mirrored ones mirrored back."""
    z, alpha, beta = (v[:, None] for v in linear)
    shape = paths.family.chosen(who).lengths(free)
    a, u = couplers(paths.theta(free, who), shape)
    b, _, d = shape
    flip = paths.mirrored[who][:, None]
    pivot = np.where(flip, z.conj(), z) + (paths.demand.pivot or 0.0)

    def back(v: Complexes) -> Complexes:
        return np.where(flip, v.conj(), v)

    pin_a, pin_b = pivot + back(alpha * a), pivot + back(alpha * (a + b[:, None] * u))
    o2, p = pivot + back(alpha * d[:, None]), pivot + back(alpha * a + beta * u)
    facts = assess_four_bars(pivot[:, 0], pin_a, pin_b, o2[:, 0])
    off = np.abs(p - paths.demand.points)
    error = (off**2).sum(1)
    return [
        four_bar_candidate(
            complex(pivot[i, 0]), pin_a[i], pin_b[i], complex(o2[i, 0]), facts, i, error[i], p=complex(p[i, 0]),
            worst=off[i].max(),
            curve=path_of_four_bar(complex(pivot[i, 0]), pin_a[i, 0], pin_b[i, 0], complex(o2[i, 0]), p[i, 0]),
        )
        for i in range(len(free))
    ]  # fmt: skip
