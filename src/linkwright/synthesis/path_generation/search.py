"""The search for paths: many random starts, the best of them iterated, the worse half given up again and again."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkwright.engine.machine_code import available
from linkwright.synthesis.crank_family import CrankFamily
from linkwright.synthesis.least_squares import minimise
from linkwright.synthesis.path_generation.bounded import BoundedPaths
from linkwright.synthesis.path_generation.compiled import CompiledPaths
from linkwright.synthesis.path_generation.projection import Demand, ProjectedPaths

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Flags = NDArray[np.bool_]
Whole = NDArray[np.int64]

#: Starts tried, iterated, and carried to the end: timed and untimed; in arrays.
TIMED, UNTIMED = (4000, 256, 32), (20000, 1536, 128)
IN_ARRAYS = (3000, 64, 16), (16000, 256, 16)
#: Steps before the worse half is given up, and to the end.
FIRST_STEPS, LAST_STEPS = 15, 500
#: Where the points ask for more than the unknowns can give, a share of 1/FEW of the starts is tried first; a sum of
#: squares below EXACT, in units of the size squared, is then the least.
FEW, EXACT = 5, 1e-24
#: Rounds within a bound: steps, rounds, starts kept, greatest weight of the bound, which doubles from FIRST_WEIGHT.
ROUNDS = ((12, 12, 24, 100.0), (40, 40, 8, 100.0), (150, 20, 3, 100.0))
FIRST_WEIGHT, INSIDE = 0.1, 0.97


class Found(NamedTuple):
    """Solutions: paths, their free numbers (K, m), numbers of the starts (K,), and z, α, β (K,)."""

    paths: ProjectedPaths
    free: Floats
    who: Whole
    linear: tuple[Complexes, Complexes, Complexes]


def search(
    demand: Demand, bound: float | None, transmission: float, rocking: bool, rng: np.random.Generator
) -> Found:
    """The best paths for a demand; ``rocking``: of any four-bars, else of those with a turning crank."""
    if not available():
        return _in_arrays(demand, bound, transmission, rocking, rng)
    tried, kept, last = TIMED if demand.timed else UNTIMED

    def judged(share: int) -> CompiledPaths:
        family, mirrored, free = _random(demand, _fewer(demand, tried // share), transmission, rocking, rng)
        return CompiledPaths.of(demand, family, mirrored, free, bound).judged()

    if bound is not None:
        return _bounded(judged(1), kept)
    if demand.excess > 0:
        paths = _iterated(judged(FEW).best(kept // FEW), last // FEW)
        if paths.deviation[0] < EXACT:
            return _found(paths)
    return _found(_iterated(judged(1).best(kept), last))


def _iterated(paths: CompiledPaths, last: int) -> CompiledPaths:
    """The last ones of paths, iterated to the end."""
    while len(paths.starts) > last:
        paths = paths.iterated(FIRST_STEPS).best(max(last, len(paths.starts) // 2))
    return paths.iterated(LAST_STEPS).best(last)


def _fewer(demand: Demand, tried: int) -> int:
    return max(1000, min(tried, 600_000 // len(demand.points)))


def _found(paths: CompiledPaths) -> Found:
    return Found(paths.paths, paths.free, np.arange(len(paths.starts)), paths.linear)


def _bounded(paths: CompiledPaths, kept: int) -> Found:
    """Solutions within the bound: iterated with shifted penalties; timed ones then along the bound."""
    near, within = paths.best(kept // 4).inside(INSIDE), paths.inside(INSIDE).best(kept)
    paths, weight = paths.of_starts(np.concatenate([near.starts, within.starts])), FIRST_WEIGHT
    others = paths
    for steps, rounds, last, greatest in ROUNDS:
        others = paths
        for _ in range(rounds):
            paths = paths.iterated(steps, weight).best(max(last, 2 * len(paths.starts) // 3)).shifted(weight)
            weight = min(greatest, 2 * weight)
    paths = paths.of_starts(np.concatenate([paths.starts, others.starts]))
    found = _found(paths.iterated(LAST_STEPS, weight).inside(1.0))
    assert paths.bound is not None
    return _finished(found, paths.bound) if paths.demand.timed else found


def _finished(found: Found, bound: float) -> Found:
    """The solutions carried to the end along their active bounds."""
    paths = BoundedPaths(found.paths, bound)
    measures = paths.finished(paths.of(found.free, found.linear), found.who)
    return Found(found.paths, measures[:, : paths.inner], found.who, paths.linear(measures, found.who))


def _in_arrays(
    demand: Demand, bound: float | None, transmission: float, rocking: bool, rng: np.random.Generator
) -> Found:
    """The same without a compiler, from fewer starts."""
    tried, kept, last = IN_ARRAYS[not demand.timed]
    tried = _fewer(demand, tried)
    family, mirrored, free = _random(demand, tried, transmission, rocking, rng)
    paths, who = ProjectedPaths(demand, family, mirrored), np.arange(tried)
    best = np.argsort(_squares(paths.fit(free, who)[0]))[:kept]
    if bound is not None:
        bounded = BoundedPaths(paths, bound)
        inside = np.argsort(_squares(bounded.residual(bounded.start(free, who), who)))[:kept]
        best = np.unique(np.concatenate([best[: kept // 2], inside]))
    paths, free = ProjectedPaths(demand, family.chosen(best), mirrored[best]), free[best]
    if bound is not None:
        free, who, linear = BoundedPaths(paths, bound).solve(free)
        return Found(paths, free, who, linear)
    solved, _, who = minimise(paths, free, keep=last, steps=80 if demand.timed else 120)
    return Found(paths, solved, who, paths.fit(solved, who)[1:])


def _squares(residual: Floats) -> Floats:
    return np.asarray(np.einsum("ki,ki->k", residual, residual))


def _random(
    demand: Demand, tried: int, transmission: float, rocking: bool, rng: np.random.Generator
) -> tuple[CrankFamily, Flags, Floats]:
    """Random starts: family, which are mirrored, free numbers."""
    family, shape = CrankFamily.random(rng, tried, transmission, rocking)
    mirrored = rng.random(tried) < 0.5
    if not demand.timed:
        return family, mirrored, np.column_stack([shape, _timing(demand, family, shape, rng)])
    phase = rng.uniform(0, 2 * np.pi, (tried, int(demand.phase)))
    return family, mirrored, np.column_stack([shape, phase])


def _timing(demand: Demand, family: CrankFamily, shape: Floats, rng: np.random.Generator) -> Floats:
    """Crank angles (tried, distinct points): chord lengths over a random part of the range, warped, either way."""
    tried = len(shape)
    chords = np.abs(np.diff(demand.points))
    share = np.concatenate([[0.0], np.cumsum(chords)]) / chords.sum()
    wave = rng.uniform(0, 0.8, tried)[:, None] / (2 * np.pi)
    warped = share + wave * np.sin(2 * np.pi * share + rng.uniform(0, 2 * np.pi, (tried, 1)))
    warped = (warped - warped[:, :1])[:, : int(demand.same.max()) + 1]
    way = rng.choice([-1, 1], (tried, 1))
    if family.rocking:
        first, last = _ranges(family.lengths(shape), rng)
        return np.asarray(first[:, None] + (last - first)[:, None] * np.where(way > 0, warped, 1 - warped))
    span = 2 * np.pi * np.ones(tried) if demand.closed else rng.uniform(0.15, 1.9 * np.pi, tried)
    return np.asarray(rng.uniform(0, 2 * np.pi, (tried, 1)) + way * span[:, None] * warped)


def _ranges(lengths: Floats, rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Parts of the input's range of four-bars with a crank of length 1."""
    b, c, d = lengths
    low, high = (1 + d * d - (b + c) ** 2) / (2 * d), (1 + d * d - (b - c) ** 2) / (2 * d)
    greatest, least = np.arccos(np.clip(low, -1, 1)), np.arccos(np.clip(high, -1, 1))
    around_pi = (low < -1) & (rng.random(len(b)) < 0.5)
    around_zero = (high > 1) & (rng.random(len(b)) < 0.5)
    greatest = np.where(around_pi, 2 * np.pi - least, greatest)
    least = np.where(around_zero, -greatest, least)
    ends = np.sort(rng.uniform(0.02, 0.98, (2, len(b))), axis=0)
    return least + ends[0] * (greatest - least), least + ends[1] * (greatest - least)
