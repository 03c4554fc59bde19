"""Descents of path generation against NumPy's least squares, and candidates that are one to a designer."""

from dataclasses import replace

import numpy as np
import pytest

import linkwright as lw
from linkwright.synthesis.path_generation.crank_family import CrankFamily, Demand, PathStarts, couplers
from linkwright.synthesis.path_generation.search import CompiledPaths
from linkwright.synthesis.result import different

pytestmark = pytest.mark.rotating


def projected(paths: PathStarts, free: np.ndarray) -> tuple[np.ndarray, ...]:
    """Residuals (K, 2n) of every start and its best z, α, β (K,), by NumPy's least squares of one after another."""
    who = np.arange(len(free))
    demand, sign = paths.demand, np.where(paths.mirrored, -1.0, 1.0)
    shapes = couplers(paths.theta(free, who), paths.family.lengths(free))
    found = []
    for a, u, y, side in zip(*shapes, paths.target(who), sign, strict=True):
        turned = [a, 1j * a] if demand.direction is None else [a * np.exp(1j * side * demand.direction)]
        placed = [] if demand.pivot is not None else [np.ones_like(a), 1j * np.ones_like(a)]
        columns = np.array([*placed, *turned, u, 1j * u]).T
        real = np.concatenate([columns.real, columns.imag])
        x = np.linalg.lstsq(real, np.concatenate([y.real, y.imag]), rcond=None)[0]
        left = y - columns @ x
        first, last = len(x) - 2 - len(turned), len(x) - 2
        z, alpha, beta = (
            columns[0, k:n] @ x[k:n] / columns[0, k] if n > k else 0.0
            for k, n in ((0, first), (first, last), (last, len(x)))
        )
        frame = 1.0 if demand.direction is None else np.exp(1j * side * demand.direction)
        found.append((np.concatenate([left.real, left.imag]), z, alpha * frame, beta))
    return tuple(np.array(each) for each in zip(*found, strict=True))


@pytest.mark.parametrize("given", [{}, {"pivot": 0.3 + 0.1j}, {"direction": 0.4}, {"pivot": 0j, "direction": -1.0}])
def test_compiled_deviations_are_those_of_the_projection(given: dict) -> None:
    rng = np.random.default_rng(2)
    points = rng.normal(size=9) + 1j * rng.normal(size=9)
    for timed, transmission in ((True, 0.0), (False, 0.5)):
        demand = Demand(points, np.linspace(0, 4, 9), True, timed, **given)
        family, shape = CrankFamily.random(rng, 40, transmission)
        free = np.column_stack([shape, rng.uniform(0, 7, (40, 1 if timed else 9))])
        paths = PathStarts(demand, family, rng.random(40) < 0.5)
        compiled = CompiledPaths.of(demand, family, paths.mirrored, free, None).judged()
        expected, *linear = projected(paths, free)
        assert compiled.deviation * demand.size**2 == pytest.approx((expected**2).sum(1), rel=1e-9)
        assert np.array(compiled.linear) == pytest.approx(np.array(linear), rel=1e-6, abs=1e-9)
        assert np.all(compiled.iterated(30).deviation <= compiled.deviation)


@pytest.mark.parametrize(
    ("share", "distance", "kept"), [(1e-3, 1e-9, 1), (0.03, 1e-9, 2), (1e-3, 0.0, 2), (0.03, 1.0, 1)]
)
def test_candidates_that_a_designer_takes_for_one_are_shown_once(share: float, distance: float, kept: int) -> None:
    """A linkage a thousandth larger does the same, and was a candidate of its own. Exact ones (0) all stay."""
    best = lw.path_generation([(0.02, 0.02), (0.02, 0.03), (0.02, 0.04)], seed=1).best
    places = best.linkage.points
    first = next(iter(places.values()))
    grown = {name: first + (1.0 + share) * (place - first) for name, place in places.items()}
    other = replace(best, linkage=replace(best.linkage, points=grown))
    assert len(different((best, other), distance)) == kept
