"""The search for paths: many random starts, the best of them iterated, the worse half dropped on the way.

Untimed paths have many local optima, because each point may rest on a wrong part of the path. Their search is
repeated; then every point goes to the nearest part of its path, and the best ones are shaken and iterated again.

A solution is written by *measures*, in units of the bound: ratios and crank angles as in the free numbers of a start,
the crank's length, the coupler point's and the pivot's coordinates, and the angle of the frame. The end is reached
along the active bounds by sequential quadratic programming (Kraft 1988).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from linkwright.core.arrays import Complexes, Flags, Floats, Integers
from linkwright.designs.checkpoints import checkpointed
from linkwright.formula.threads import cores, spread_over
from linkwright.synthesis.least_squares import with_differences
from linkwright.synthesis.path_generation.crank_family import CrankFamily, Demand, PathStarts, couplers
from linkwright.synthesis.path_generation.kernels import (
    ANGLES,
    ANY_LENGTHS,
    EACH,
    HEAD,
    PER_POINT,
    POINTS,
    SHIFTS,
    kernels,
)

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


#: Starts of one share of a thread's work.
SHARE = 512
FIRST_DAMPING = 1e-3


@dataclass(frozen=True, eq=False)
class CompiledPaths:
    """Starts (K, numbers) of a demand as ``kernels`` has them, lengths in units of the demand's size."""

    demand: Demand
    bound: float | None
    transmission: float
    rocking: bool
    starts: Floats

    @classmethod
    def of(
        cls, demand: Demand, family: CrankFamily, mirrored: Flags, free: Floats, bound: float | None
    ) -> CompiledPaths:
        """From free numbers (K, 3 and phase or crank angles)."""
        points = int(demand.same.max()) + 1
        starts = np.zeros((len(free), ANGLES + points))
        starts[:, :3] = free[:, :3]
        if not demand.timed:
            starts[:, ANGLES:] = free[:, 3:]
        elif demand.phase:
            starts[:, 3] = free[:, 3]
        starts[:, 4] = ANY_LENGTHS if family.rocking else family.double
        starts[:, 5], starts[:, 6] = np.where(mirrored, -1.0, 1.0), FIRST_DAMPING
        return cls(demand, bound, family.transmission, family.rocking, starts)

    @property
    def paths(self) -> PathStarts:
        """Crank angles and points of the starts."""
        family = CrankFamily(self.starts[:, 4] == 1.0, self.transmission, self.rocking)
        return PathStarts(self.demand, family, self.starts[:, 5] < 0)

    @property
    def free(self) -> Floats:
        """Free numbers (K, 3 and phase or crank angles)."""
        if not self.demand.timed:
            return np.column_stack([self.starts[:, :3], self.starts[:, ANGLES:]])
        return self.starts[:, : 4 if self.demand.phase else 3]

    @property
    def deviation(self) -> Floats:
        """Sums of squares in units of the size (with the bound's share), (K,)."""
        return self.starts[:, 7]

    @property
    def linear(self) -> tuple[Complexes, Complexes, Complexes]:
        """z, α, β (K,), m."""
        parts = self.demand.size * self.starts[:, HEAD:SHIFTS].reshape(-1, 3, 2)
        numbers = np.asarray(parts[:, :, 0] + 1j * parts[:, :, 1], complex)
        return numbers[:, 0], numbers[:, 1], numbers[:, 2]

    def best(self, count: int) -> CompiledPaths:
        """The best of them, in order."""
        return self.of_starts(self.starts[np.argsort(self.deviation, kind="stable")[:count]])

    def joined(self, other: CompiledPaths) -> CompiledPaths:
        """These and others of the same demand."""
        return self.of_starts(np.concatenate([self.starts, other.starts]))

    def of_starts(self, starts: Floats) -> CompiledPaths:
        """The same demand with other starts."""
        return replace(self, starts=starts)

    def moved(self, free: Floats, angles: Floats) -> CompiledPaths:
        """Untimed starts with other free numbers (K, 3) and crank angles (K, points), judged, to be iterated anew."""
        starts = self.starts.copy()
        starts[:, :3], starts[:, ANGLES:], starts[:, 6] = free, angles, FIRST_DAMPING
        return self.of_starts(starts).judged()

    def judged(self) -> CompiledPaths:
        """With the linear numbers and the deviation of each, without the bound."""
        return self._done("judge", weight=0.0)

    def inside(self, share: float) -> CompiledPaths:
        """Brought within a share of the bound."""
        return self._done("bring_inside", share, weight=1.0)

    def iterated(self, steps: int, weight: float = 0.0) -> CompiledPaths:
        """After some steps; ``weight``: of the bound, 0: none."""
        return self._done("iterate", steps, weight=weight)

    def shifted(self, weight: float) -> CompiledPaths:
        """With the limits' shifts anew."""
        return self._done("shift", weight=weight)

    def _done(self, name: str, *further: float, weight: float) -> CompiledPaths:
        layout, data = self._layout(), self._data(weight)
        key = name, further, layout, data, self.starts
        return self.of_starts(checkpointed(lambda: self._computed(name, further, layout, data), lambda: key))

    def _computed(self, name: str, further: tuple[float, ...], layout: Integers, data: Floats) -> Floats:
        starts = self.starts.copy()
        size = 8 * starts.shape[1]

        def work(first: int, last: int) -> None:
            room = np.zeros(PER_POINT + EACH * layout[0] + starts.shape[1])
            at = layout.ctypes.data, data.ctypes.data, starts.ctypes.data + size * first
            kernels()(name, *at, last - first, *further, room.ctypes.data)

        share = max(1, min(SHARE, -(-len(starts) // (4 * cores()))))
        spread_over(len(starts), share, cores(), work)
        return starts

    def _layout(self) -> Integers:
        demand = self.demand
        placed, turned = demand.pivot is None, demand.direction is None
        phase = demand.timed and demand.phase
        unknown = 2 * placed + 1 + turned + 2 + 3 + phase
        numbers = self.starts.shape[1]
        return np.array([numbers - ANGLES, demand.timed, phase, placed, turned, unknown, numbers], np.int64)

    def _data(self, weight: float) -> Floats:
        demand, count = self.demand, self.starts.shape[1] - ANGLES
        z = (demand.points - (demand.pivot or 0.0))[:count] / demand.size
        points = np.column_stack([z.real, z.imag, np.bincount(demand.same), demand.angles[:count]])
        bound = (self.bound or 0.0) / demand.size if weight else 0.0
        head = [bound, weight, np.cos(self.transmission), demand.direction or 0.0]
        assert len(head) == POINTS
        return np.concatenate([head, points.ravel()])


Linear = tuple[Complexes, Complexes, Complexes]

#: Solutions carried to the end, timed and untimed; ratios and coordinates that differ less are one solution. Then
#: steps and tolerance of that end.
FINISHED, SAME_SHAPE = (3, 7), 0.02
ROUGH, FINISH = (150, 1e-14), (300, 1e-16)


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
            found[i] = self.finish(found[i], int(rows[i]), *FINISH)
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
