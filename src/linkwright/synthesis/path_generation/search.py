"""The search for paths: many random starts, the best of them iterated, the worse half dropped again and again.

Untimed paths have many local optima, because each point may rest on a wrong part of the path. Their search is
repeated; then every point goes to the nearest part of its path, and the best ones are shaken and iterated again.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from linkwright.core.arrays import Complexes, Flags, Floats, Integers
from linkwright.synthesis.crank_family import CrankFamily, couplers
from linkwright.synthesis.path_generation.bounded_dimensions import BoundedPaths
from linkwright.synthesis.path_generation.compiled_starts import CompiledPaths
from linkwright.synthesis.path_generation.demand import Demand, PathStarts

#: Starts tried, iterated, and carried to the end: timed and untimed.
TIMED, UNTIMED = (4000, 256, 32), (20000, 1536, 128)
#: Steps before the worse half is dropped, and to the end.
FIRST_STEPS, LAST_STEPS = 15, 500
#: Where the points ask for more than the unknowns can give, a share of 1/FEW of the starts is tried first; a sum of
#: squares below EXACT, in units of the size squared, is then the minimum.
FEW, EXACT = 5, 1e-24
#: Untimed: further searches; places of a path among which each point's nearest is sought; rounds of shaking by how
#: much, paths shaken in each, starts made of each.
REPEATED, PLACES, SHAKES, SHAKEN, EACH_SHAKEN = 2, 240, (0.5, 0.3, 0.2, 0.1), 24, 16
#: Share of the starts that pass the points evenly along the length of some path, and positions of that path.
BY_LENGTH, SAMPLES = 0.6, 48
#: Rounds within a bound: steps, rounds, starts, maximum weight of the bound, which doubles from FIRST_WEIGHT.
ROUNDS = ((12, 12, 24, 100.0), (40, 40, 8, 100.0), (150, 20, 3, 100.0))
FIRST_WEIGHT, INSIDE = 0.1, 0.97


class Found(NamedTuple):
    """Solutions: paths, their free numbers (K, m), numbers of the starts (K,), and z, α, β (K,)."""

    paths: PathStarts
    free: Floats
    who: Integers
    linear: tuple[Complexes, Complexes, Complexes]


def search(
    demand: Demand, bound: float | None, transmission: float, rocking: bool, rng: np.random.Generator
) -> Found:
    """The best paths for a demand; ``rocking``: of any four-bars, else of those with a turning crank."""
    tried, selected, last = TIMED if demand.timed else UNTIMED

    def judged(share: int) -> CompiledPaths:
        count = _fewer(demand, tried // share)
        family, mirrored, free = _random(demand, count, transmission, rocking, rng, bound is None)
        return CompiledPaths.of(demand, family, mirrored, free, bound).judged()

    if bound is not None:
        return _bounded(judged(1), selected)
    if demand.excess > 0:
        paths = _iterated(judged(FEW).best(selected // FEW), last // FEW)
        if paths.deviation[0] < EXACT:
            return _found(paths)
    paths = _iterated(judged(1).best(selected), last)
    if demand.timed or demand.excess <= 0 or paths.deviation[0] < EXACT:
        return _found(paths)
    for _ in range(REPEATED):
        paths = paths.joined(_iterated(judged(1).best(selected), last)).best(last)
    return _found(_nearest(_shaken(_nearest(paths, last), last, rng), last))


def _iterated(paths: CompiledPaths, last: int) -> CompiledPaths:
    """The last ones of paths, iterated to the end."""
    while len(paths.starts) > last:
        paths = paths.iterated(FIRST_STEPS).best(max(last, len(paths.starts) // 2))
    return paths.iterated(LAST_STEPS).best(last)


def _nearest(paths: CompiledPaths, last: int) -> CompiledPaths:
    """With what is found where every point first goes to the nearest place of its path."""
    z, alpha, beta = (each[:, None] for each in paths.linear)
    who, before = np.arange(len(paths.starts)), paths.free[:, 3:]
    theta = 2 * np.pi * np.arange(PLACES) / PLACES
    a, u = couplers(theta, paths.paths.family.chosen(who).lengths(paths.free))
    path, target = z + alpha * a + beta * u, paths.paths.target(who)
    angles = np.stack([theta[np.abs(path - target[:, j : j + 1]).argmin(1)] for j in range(before.shape[1])], 1)
    away = np.abs((angles - before + np.pi) % (2 * np.pi) - np.pi) > 4 * np.pi / PLACES
    moved = paths.moved(paths.free[:, :3], np.where(away, angles, before))
    return paths.joined(_iterated(moved.of_starts(moved.starts[away.any(1)]), last)).best(last)


def _shaken(paths: CompiledPaths, last: int, rng: np.random.Generator) -> CompiledPaths:
    """With what is found from the best ones shaken, round after round: their ratios and their crank angles."""
    for size in SHAKES:
        best = paths.best(SHAKEN)
        many = best.of_starts(best.starts.repeat(EACH_SHAKEN, 0))
        free, angles = many.free[:, :3], many.free[:, 3:]
        free = free + rng.normal(0, size, free.shape)
        angles = angles + rng.normal(0, size, (len(angles), 1)) + rng.normal(0, size / 2, angles.shape)
        paths = paths.joined(_iterated(many.moved(free, angles), SHAKEN)).best(last)
    return paths


def _fewer(demand: Demand, tried: int) -> int:
    return max(1000, min(tried, 600_000 // len(demand.points)))


def _found(paths: CompiledPaths) -> Found:
    return Found(paths.paths, paths.free, np.arange(len(paths.starts)), paths.linear)


def _bounded(paths: CompiledPaths, selected: int) -> Found:
    """Solutions within the bound: iterated with shifted penalties; timed ones then along the bound."""
    near, within = paths.best(selected // 4).inside(INSIDE), paths.inside(INSIDE).best(selected)
    paths, weight = paths.of_starts(np.concatenate([near.starts, within.starts])), FIRST_WEIGHT
    others = paths
    for steps, rounds, last, maximum in ROUNDS:
        others = paths
        for _ in range(rounds):
            paths = paths.iterated(steps, weight).best(max(last, 2 * len(paths.starts) // 3)).shifted(weight)
            weight = min(maximum, 2 * weight)
    paths = paths.of_starts(np.concatenate([paths.starts, others.starts]))
    found = _found(paths.iterated(LAST_STEPS, weight).inside(1.0))
    assert paths.bound is not None
    return _finished(found, paths.bound) if paths.demand.timed else found


def _finished(found: Found, bound: float) -> Found:
    """The solutions carried to the end along their active bounds."""
    paths = BoundedPaths(found.paths, bound)
    measures = paths.finished(paths.of(found.free, found.linear), found.who)
    return Found(found.paths, measures[:, : paths.inner], found.who, paths.linear(measures, found.who))


def _random(
    demand: Demand, tried: int, transmission: float, rocking: bool, rng: np.random.Generator, by_length: bool
) -> tuple[CrankFamily, Flags, Floats]:
    """Random starts: family, which are mirrored, free numbers; ``by_length``: some pass the points by length."""
    family, shape = CrankFamily.random(rng, tried, transmission, rocking)
    mirrored = rng.random(tried) < 0.5
    if not demand.timed:
        return family, mirrored, np.column_stack([shape, _timing(demand, family, shape, rng, by_length)])
    phase = rng.uniform(0, 2 * np.pi, (tried, int(demand.phase)))
    return family, mirrored, np.column_stack([shape, phase])


def _timing(demand: Demand, family: CrankFamily, shape: Floats, rng: np.random.Generator, by_length: bool) -> Floats:
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
    angles = np.asarray(rng.uniform(0, 2 * np.pi, (tried, 1)) + way * span[:, None] * warped)
    if by_length:
        part = np.ones(tried) if demand.closed else rng.uniform(0.05, 0.95, tried)
        along = rng.random((tried, 1)) + way * part[:, None] * share[: warped.shape[1]]
        rows = np.flatnonzero(rng.random(tried) < BY_LENGTH)
        angles[rows] = _by_length(family.lengths(shape)[:, rows], along[rows], rng)
    return angles


def _by_length(lengths: Floats, along: Floats, rng: np.random.Generator) -> Floats:
    """Crank angles at parts (K, n) of the length of the closed paths of random coupler points."""
    theta = 2 * np.pi * np.arange(SAMPLES + 1) / SAMPLES
    a, u = couplers(theta, lengths)
    arm = rng.uniform(0.1, 2.0, len(a)) * lengths.max(0) * np.exp(2j * np.pi * rng.random(len(a)))
    far = np.cumsum(np.abs(np.diff(a + arm[:, None] * u, axis=1)), 1)
    far = np.concatenate([np.zeros((len(far), 1)), far], 1) / far[:, -1:]
    turns = np.floor(along)
    within = [np.interp(part, way, theta) for part, way in zip(along - turns, far, strict=True)]
    return np.asarray(within + 2 * np.pi * turns)


def _ranges(lengths: Floats, rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Parts of the input's range of four-bars with a crank of length 1."""
    b, c, d = lengths
    low, high = (1 + d * d - (b + c) ** 2) / (2 * d), (1 + d * d - (b - c) ** 2) / (2 * d)
    upper, lower_bound = np.arccos(np.clip(low, -1, 1)), np.arccos(np.clip(high, -1, 1))
    around_pi = (low < -1) & (rng.random(len(b)) < 0.5)
    around_zero = (high > 1) & (rng.random(len(b)) < 0.5)
    upper = np.where(around_pi, 2 * np.pi - lower_bound, upper)
    lower_bound = np.where(around_zero, -upper, lower_bound)
    ends = np.sort(rng.uniform(0.02, 0.98, (2, len(b))), axis=0)
    return lower_bound + ends[0] * (upper - lower_bound), lower_bound + ends[1] * (upper - lower_bound)
