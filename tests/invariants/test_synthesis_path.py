"""Paths of hidden four-bars are found again, compiled and in arrays, and no other optimiser comes lower."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import least_squares

import linkwright as lw
from linkwright.engine.machine_code import available
from linkwright.synthesis.crank_family import CrankFamily
from linkwright.synthesis.path_generation import search
from linkwright.synthesis.path_generation.compiled_starts import CompiledPaths
from linkwright.synthesis.path_generation.projection import Demand, ProjectedPaths
from linkwright.synthesis.result import different

KINDS = ("crank_rocker", "double_crank", "double_rocker", "triple_rocker")


def hidden(rng: np.random.Generator, kind: str, count: int, share: float) -> tuple[np.ndarray, np.ndarray]:
    """Points and crank angles of a random four-bar of a kind, over a share of its input's range."""
    while True:
        lengths = a, b, c, d = np.exp(rng.normal(0, 0.5, 4))
        s, p, q, m = np.sort(lengths)
        grashof = s + m < 0.97 * (p + q)
        turning = {0: "crank_rocker", 1: "double_rocker", 3: "double_crank"}
        if m < 0.95 * (s + p + q) and kind == (
            turning.get(int(np.argmin(lengths))) if grashof else "triple_rocker"
        ):
            break
    low, high = ((a * a + d * d - (b + side * c) ** 2) / (2 * a * d) for side in (1, -1))
    first, last = np.arccos(np.clip([high, low], -1, 1))
    if kind in KINDS[:2]:
        first, last = rng.uniform(0, 2 * np.pi) + np.array([0, 2 * np.pi])
    theta = first + (last - first) * ((1 - share) / 2 + share * np.arange(count) / count)
    pin = a * np.exp(1j * theta)
    square = np.abs(d - pin) ** 2
    t = square + b * b - c * c
    turn = (d - pin) * (t + 1j * rng.choice([-1, 1]) * np.sqrt(4 * b * b * square - t * t)) / (2 * b * square)
    path = pin + complex(*rng.normal(0, b, 2)) * turn
    return path * np.exp(1j * rng.uniform(0, 7)) * rng.uniform(0.5, 2) + complex(
        *rng.uniform(-3, 3, 2)
    ), theta


def relative(best: lw.Candidate, points: np.ndarray) -> float:
    return float(np.sqrt(best.error / len(points)) / np.std(points))


def cases() -> Iterator[tuple[str, bool, int, float]]:
    for kind in KINDS:
        yield kind, True, 36, 1.0 if kind in KINDS[:2] else 0.7
        yield kind, True, 9, 0.5
        yield kind, False, 14, 0.5


@pytest.mark.parametrize(("kind", "timed", "count", "share"), list(cases()))
def test_hidden_four_bars_are_found_again(kind: str, timed: bool, count: int, share: float) -> None:
    rng = np.random.default_rng(11)
    for seed in range(1 + timed):
        points, theta = hidden(rng, kind, count, share)
        angles = {"angles": theta} if timed else {}
        best = lw.path_generation(points, turning=kind in KINDS[:2], seed=seed, **angles).best
        assert relative(best, points) < (1e-9 if timed else 1e-3)


def test_noise_leaves_the_least_that_other_descents_find() -> None:
    """From the hidden four-bar itself, and from the solution, SciPy's least squares goes no lower."""
    rng = np.random.default_rng(4)
    points, theta = hidden(rng, "crank_rocker", 20, 1.0)
    points = points + 0.03 * np.std(points) * (rng.normal(size=20) + 1j * rng.normal(size=20))
    found = [lw.path_generation(points, angles=theta, seed=seed).best.error for seed in range(3)]
    assert found == pytest.approx([found[0]] * 3, rel=1e-9)

    def off(x: np.ndarray) -> np.ndarray:
        b, c, d = np.exp(x[:3])
        pin = np.exp(1j * (theta + x[3]))
        square = np.abs(d - pin) ** 2
        t = square + b * b - c * c
        turn = (
            (d - pin)
            * (t + 1j * x[10] * np.sqrt(np.maximum(4 * b * b * square - t * t, 0)))
            / (2 * b * square)
        )
        z = x[4] + 1j * x[5] + (x[6] + 1j * x[7]) * pin + (x[8] + 1j * x[9]) * turn - points
        return np.concatenate([z.real, z.imag])

    for _ in range(10):
        start = np.concatenate([rng.normal(1, 0.5, 3), rng.uniform(0, 7, 1), rng.normal(0, 1, 6)])
        side = rng.choice([-1.0, 1.0])
        tried = least_squares(lambda x, side=side: off(np.append(x, side)), start, max_nfev=200)
        assert 2 * tried.cost > found[0] * (1 - 1e-9) or not _turns(np.exp(tried.x[:3]))


def _turns(lengths: np.ndarray) -> bool:
    b, c, d = lengths
    return bool(b + c > d + 1 and abs(b - c) < abs(d - 1))


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
