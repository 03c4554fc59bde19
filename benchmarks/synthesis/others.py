"""The same demands given to general optimisers: all numbers of the four-bar free, as a user would write it."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from benchmarks.synthesis.cases import Case
from linkwright.synthesis.candidates import Assessment, assess_four_bars, coupler_unit

Floats = NDArray[np.float64]
#: a b c d u v x0 y0 rotation phase, in units of the path's size about its centre.
LOW = np.array([0.2, 0.2, 0.2, 0.2, -6.0, -6.0, -8.0, -8.0, 0.0, 0.0])
HIGH = np.array([8.0, 8.0, 8.0, 8.0, 6.0, 6.0, 8.0, 8.0, 2 * np.pi, 2 * np.pi])


class Enough(Exception):
    """The error is small enough, or the time is over."""


@dataclass
class Best:
    """The best relative error so far, when each goal was reached, and the limit of time."""

    goal: float
    limit: float
    error: float = np.inf
    seconds: float = np.inf
    design: tuple[Floats, float] | None = None

    def __post_init__(self) -> None:
        self.begin = time.process_time()

    def __call__(self, error: float, numbers: Floats, side: float) -> None:
        """Notes the error of a design (its ten numbers and the side of B); raises Enough at the goal or the limit."""
        now = time.process_time() - self.begin
        if error < self.error:
            self.error, self.design = error, (numbers.copy(), side)
            if error <= self.goal:
                self.seconds = now
        if self.error <= self.goal or now > self.limit:
            raise Enough


def differential_evolution(case: Case, best: Best, seed: int) -> None:
    """scipy.optimize.differential_evolution, vectorised."""
    from scipy.optimize import differential_evolution

    model = _Model(case)
    for attempt in range(1000):
        side = (-1.0, 1.0)[attempt % 2]

        def cost(x: Floats, side: float = side) -> Floats:
            error = model.error(x.T, side)
            best(float(error.min()), x[:, error.argmin()], side)
            return error

        differential_evolution(
            cost,
            list(zip(LOW, HIGH, strict=True)),
            polish=False,
            rng=seed + attempt,
            maxiter=3000,
            popsize=15,
            vectorized=True,
            updating="deferred",
        )


def many_starts(case: Case, best: Best, seed: int) -> None:
    """scipy.optimize.least_squares from random starts."""
    from scipy.optimize import least_squares

    model, rng = _Model(case), np.random.default_rng(seed)
    while True:
        side, start = float(rng.choice([-1.0, 1.0])), rng.uniform(LOW, HIGH)
        if model.excess(start[None])[0] > 0:
            continue

        def residual(x: Floats, side: float = side) -> Floats:
            off = model.path(x[None], side)[0] - model.target
            bad = float(model.excess(x[None])[0])
            best(float(np.sqrt(np.mean(np.abs(off) ** 2))) if bad <= 0 else np.inf, x, side)
            return np.concatenate([off.real, off.imag, [3 * bad]])

        least_squares(residual, start, bounds=(LOW, HIGH), max_nfev=60)


def pylinkage(case: Case, best: Best, seed: int) -> None:
    """pylinkage's particle swarm with its defaults, all ten numbers; needs the package."""
    from pylinkage.actuators import Crank
    from pylinkage.components import Ground
    from pylinkage.dyads import FixedDyad, RRRDyad
    from pylinkage.optimization import particle_swarm_optimization
    from pylinkage.simulation import Linkage

    model, count = _Model(case), len(case.points)
    np.random.seed(seed)  # noqa: NPY002
    first, second = Ground(0.0, 0.0), Ground(2.0, 0.0)
    crank = Crank(anchor=first, radius=1.0, angular_velocity=2 * np.pi / count)
    rocker = RRRDyad(crank.output, second, distance1=2.0, distance2=1.5)
    point = FixedDyad(crank.output, rocker, distance=1.0, angle=0.5)
    linkage = Linkage([first, second, crank, rocker, point])
    linkage.rebuild()
    linkage.step_fast(count, 1)

    def fitness(_: object, x: Floats, __: object) -> float:
        values = np.asarray(x, float)[None]
        bad = float(model.excess(values)[0])
        if bad > 0:
            best(np.inf, values[0], 1.0)
            return -5.0 - bad
        off = model.path(values, 1.0)[0] - model.target
        error = float(np.sqrt(np.mean(np.abs(off) ** 2)))
        best(error, values[0], 1.0)
        return -error

    while True:
        particle_swarm_optimization(
            fitness,
            linkage,
            dimensions=10,
            n_particles=100,
            iterations=200,
            bounds=(list(LOW), list(HIGH)),
            order_relation=max,
            verbose=False,
        )


class _Model:
    """Paths of four-bars in all ten numbers, the target brought to size 1 about 0."""

    def __init__(self, case: Case) -> None:
        z = case.points
        size = np.sqrt(np.mean(np.abs(z - z.mean()) ** 2))
        self.target = (z - z.mean()) / size
        self.angles = np.asarray(case.demands["angles"], float)

    def path(self, x: Floats, side: float) -> NDArray[np.complex128]:
        a, b, c, d, u, v, x0, y0, turn, phase = (each[:, None] for each in x.T)
        pin = a * np.exp(1j * (self.angles + phase))
        reach = d - pin
        square = np.abs(reach) ** 2
        t = square + b * b - c * c
        root = np.sqrt(np.maximum(4 * b * b * square - t * t, 0))
        unit = reach * (t + 1j * side * root) / (2 * square * b)
        return np.asarray((pin + (u + 1j * v) * unit) * np.exp(1j * turn) + x0 + 1j * y0)

    def facts(self, x: Floats, side: float) -> Assessment:
        """Type, defects and transmission angle of a design (10,) at the target's crank angles."""
        a, b, c, d, _, _, _, _, _, phase = x
        pin = a * np.exp(1j * (self.angles + phase))[None]
        one = np.ones(1, complex)
        joint = pin + b * coupler_unit(pin[0], float(b), float(c), complex(d), side)
        return assess_four_bars(0 * one, pin, joint, d * one)

    def excess(self, x: Floats) -> Floats:
        """How far the crank is from turning fully."""
        a, b, c, d = x[:, :4].T
        return np.maximum(np.abs(b - c) - np.abs(d - a), 0) + np.maximum(d + a - b - c, 0)

    def error(self, x: Floats, side: float) -> Floats:
        off = np.sqrt(np.mean(np.abs(self.path(x, side) - self.target) ** 2, 1))
        bad = self.excess(x)
        return np.where(bad > 0, 5 + bad, off)


def facts(case: Case, best: Best) -> Assessment | None:
    """Facts about the best design of an optimiser; None where it found none whose crank turns."""
    return None if best.design is None else _Model(case).facts(*best.design)


OTHERS: dict[str, Callable[[Case, Best, int], None]] = {
    "scipy differential evolution": differential_evolution,
    "scipy least squares, many starts": many_starts,
    "pylinkage particle swarm": pylinkage,
}
