"""Descents of path generation, compiled and in arrays, and candidates that are one to a designer."""

from dataclasses import replace

import numpy as np
import pytest
from tests.invariants.hidden_paths import hidden

import linkwright as lw
from linkwright.formula.machine_code import available
from linkwright.synthesis.crank_family import CrankFamily
from linkwright.synthesis.path_generation import search
from linkwright.synthesis.path_generation.compiled_starts import CompiledPaths
from linkwright.synthesis.path_generation.projection import Demand, ProjectedPaths
from linkwright.synthesis.result import different

pytestmark = pytest.mark.rotating


@pytest.mark.skipif(not available(), reason="llvmlite does not run here")
@pytest.mark.parametrize(
    "given", [{}, {"pivot": 0.3 + 0.1j}, {"direction": 0.4}, {"pivot": 0j, "direction": -1.0}]
)
def test_compiled_deviations_are_those_of_the_projection(given: dict) -> None:
    rng = np.random.default_rng(2)
    points = rng.normal(size=9) + 1j * rng.normal(size=9)
    for timed, transmission in ((True, 0.0), (False, 0.5)):
        demand = Demand(points, np.linspace(0, 4, 9), True, timed, **given)
        family, shape = CrankFamily.random(rng, 40, transmission)
        free = np.column_stack([shape, rng.uniform(0, 7, (40, 1 if timed else 9))])
        paths, who = ProjectedPaths(demand, family, rng.random(40) < 0.5), np.arange(40)
        compiled = CompiledPaths.of(demand, family, paths.mirrored, free, None).judged()
        expected, *linear = paths.fit(free, who)
        assert compiled.deviation * demand.size**2 == pytest.approx((expected**2).sum(1), rel=1e-9)
        assert np.array(compiled.linear) == pytest.approx(np.array(linear), rel=1e-6, abs=1e-9)
        assert np.all(compiled.iterated(30).deviation <= compiled.deviation)


def test_without_a_compiler_the_same_optimum_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    points, theta = hidden(np.random.default_rng(8), "crank_rocker", 12, 1.0)
    points[::3] += 0.1
    compiled = lw.path_generation(points, angles=theta).best.error
    monkeypatch.setattr(search, "available", lambda: False)
    assert lw.path_generation(points, angles=theta).best.error == pytest.approx(compiled, rel=1e-8)


@pytest.mark.parametrize(
    ("share", "distance", "kept"), [(1e-3, 1e-9, 1), (0.03, 1e-9, 2), (1e-3, 0.0, 2), (0.03, 1.0, 1)]
)
def test_candidates_that_a_designer_takes_for_one_are_shown_once(
    share: float, distance: float, kept: int
) -> None:
    """A linkage a thousandth larger does the same, and was a candidate of its own. Exact ones (0) all stay."""
    best = lw.path_generation([(0.02, 0.02), (0.02, 0.03), (0.02, 0.04)], seed=1).best
    places = best.linkage.points
    first = next(iter(places.values()))
    grown = {name: first + (1.0 + share) * (place - first) for name, place in places.items()}
    other = replace(best, linkage=replace(best.linkage, points=grown))
    assert len(different((best, other), distance)) == kept
