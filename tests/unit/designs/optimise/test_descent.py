"""The local search of many designs at once against optima known in closed form and by linear programming."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import linprog, minimize

from linkwright.designs.optimise.evolution import Scale, nearest, picked, spread, without_own
from linkwright.designs.optimise.local_search import Model, descended, quadratic
from linkwright.designs.optimise.task import Judged

Floats = NDArray[np.float64]


def test_quadratic_programs_beside_scipy() -> None:
    draw, n, m = np.random.default_rng(0), 5, 7
    root = draw.normal(size=(6, n, n))
    curved = root @ root.swapaxes(1, 2) + 0.1 * np.eye(n)
    slope, rows, least = draw.normal(size=(6, n)), draw.normal(size=(6, m, n)), draw.normal(size=(6, m)) - 0.5
    low, high = -np.ones((6, n)), draw.uniform(0.2, 1.0, (6, n))
    found, forces = quadratic(curved, slope, rows, least, low, high, np.full((6, m), 30.0))
    for k in range(6):

        def value(z: Floats, k: int = k) -> float:
            return float(0.5 * z[:n] @ curved[k] @ z[:n] + slope[k] @ z[:n] + 30.0 * z[n:].sum())

        keep = {"type": "ineq", "fun": lambda z, k=k: rows[k] @ z[:n] + z[n:] - least[k]}
        lack = np.maximum(least[k] - rows[k] @ found[k], 0.0)
        other = minimize(
            value,
            np.full(n + m, 0.1),
            method="SLSQP",
            constraints=keep,
            options={"maxiter": 500, "ftol": 1e-12},
            bounds=[*zip(low[k], high[k], strict=True), *[(0.0, None)] * m],
        )
        assert value(np.concatenate([found[k], lack])) == pytest.approx(other.fun, abs=1e-7)
        # multipliers: stationary where no bound holds
        inside = (found[k] > low[k] + 1e-4) & (found[k] < high[k] - 1e-4)
        rest = curved[k] @ found[k] + slope[k] - forces[k] @ rows[k]
        assert np.abs(rest[inside]).max(initial=0.0) < 1e-4


def _valley(x: Floats, _: object) -> Model:
    """Rosenbrock's valley over -2..2 within a circle that leaves out its bottom (1, 1)."""
    z = 4.0 * x - 2.0
    bend = z[:, 1] - z[:, 0] ** 2
    value = bend**2 + 0.01 * (1.0 - z[:, 0]) ** 2
    slope = np.stack([-4.0 * z[:, 0] * bend - 0.02 * (1.0 - z[:, 0]), 2.0 * bend], axis=1)
    free = (1.0 - (z**2).sum(axis=1))[:, None]
    return Model(x, value[:, None], free, 4.0 * slope[:, None], -8.0 * z[:, None], np.zeros((len(x), 1, 2, 2)))


def test_a_curved_valley_and_a_demand_that_holds_at_the_optimum() -> None:
    starts = np.random.default_rng(1).random((12, 2))
    z = 4.0 * descended(_valley, starts, 60) - 2.0
    # on the circle z = (cos t, sin t) the least value, by looking at a million places
    t = np.linspace(0.0, 0.5 * np.pi, 1_000_001)
    value = (np.sin(t) - np.cos(t) ** 2) ** 2 + 0.01 * (1.0 - np.cos(t)) ** 2
    place = np.array([np.cos(t[value.argmin()]), np.sin(t[value.argmin()])])
    assert np.abs(z - place).max() < 1e-4


def test_known_curvature_ends_a_narrow_valley_in_few_steps() -> None:
    draw = np.random.default_rng(4)
    root = np.linalg.qr(draw.normal(size=(6, 6)))[0] * 10.0 ** np.linspace(0.0, -2.0, 6)
    least = draw.uniform(0.3, 0.7, 6)

    def squares(known: float) -> Callable[[Floats, object], Model]:
        def model(x: Floats, _: object) -> Model:
            rest = (x - least) @ root
            slope = 2.0 * rest @ root.T
            bends = np.tile(2.0 * known * root @ root.T, (len(x), 1, 1, 1))
            none = np.zeros((len(x), 1, 6))
            return Model(x, (rest**2).sum(axis=1)[:, None], 1.0 + 0.0 * x[:, :1], slope[:, None], none, bends)

        return model

    starts = np.clip(least + draw.uniform(-0.3, 0.3, (5, 6)), 0.0, 1.0)
    assert np.abs(descended(squares(1.0), starts, 8) - least).max() < 1e-3
    assert np.abs(descended(squares(0.0), starts, 8) - least).max() > 1e-2


@pytest.mark.rotating
def test_the_least_largest_of_many_beside_linear_programming() -> None:
    draw = np.random.default_rng(2)
    rows, wanted = draw.normal(size=(15, 5)), draw.normal(size=15)

    def largest(x: Floats, _: object) -> Model:
        off = x @ rows.T - wanted
        worst, each = np.abs(off).argmax(axis=1), np.arange(len(x))
        value, sense = np.abs(off)[each, worst], np.sign(off[each, worst])
        free = np.ones((len(x), 1))
        none, bends = np.zeros((len(x), 1, 5)), np.zeros((len(x), 1, 5, 5))
        return Model(x, value[:, None], free, (sense[:, None] * rows[worst])[:, None], none, bends)

    found = descended(largest, draw.random((10, 5)), 60)
    one = -np.ones((15, 1))
    least = linprog(
        [0, 0, 0, 0, 0, 1],
        np.block([[rows, one], [-rows, one]]),
        np.concatenate([wanted, -wanted]),
        bounds=[(0, 1)] * 5 + [(0, None)],
    ).fun
    reached = np.sort(largest(found, None).goals[:, 0])
    assert reached[:6] == pytest.approx(np.full(6, least), rel=1e-4)
    assert reached[-1] < 1.03 * least  # six functions meet there, of which three stay in a step


def test_places_that_do_not_move_stay_and_never_lead_others_astray() -> None:
    def half(x: Floats, _: object) -> Model:
        value = np.where(x[:, 0] < 0.3, np.nan, x[:, 0] + (x[:, 1] - 0.5) ** 2)
        slope = np.stack([np.ones(len(x)), 2.0 * (x[:, 1] - 0.5)], axis=1)
        none, bends = np.zeros((len(x), 1, 2)), np.zeros((len(x), 1, 2, 2))
        return Model(x, value[:, None], np.ones((len(x), 1)), slope[:, None], none, bends)

    found = descended(half, np.array([[0.1, 0.2], [0.9, 0.9]]), 60)
    assert (found[0] == [0.1, 0.2]).all()
    assert found[1] == pytest.approx([0.3, 0.5], abs=0.02) and found[1, 0] >= 0.3


def test_places_without_a_design_of_their_own_are_told() -> None:
    goals = np.array([[0.0, 1.0], [0.1, 0.9], [1.0, 0.0]])
    judged = Judged(np.zeros((3, 1)), goals, np.zeros((3, 1)), {})
    points = np.array([[0.0, 1.0], [0.45, 0.55], [0.12, 0.88], [1.0, 0.0]])
    assert without_own(judged, points).tolist() == [1]  # nearest is the second design, which is nearer to another


@pytest.mark.parametrize(("goals", "count", "points"), [(1, 16, 1), (2, 48, 48), (3, 48, 45), (4, 48, 35)])
def test_points_of_a_front_are_spread_evenly(goals: int, count: int, points: int) -> None:
    found = spread(goals, count)
    assert found.shape == (points, goals) and len(np.unique(found, axis=0)) == points
    assert found.sum(axis=1) == pytest.approx(np.ones(points)) and (found >= 0.0).all()
    assert all((found == row).all(axis=1).any() for row in np.eye(goals))


def test_designs_nearest_to_points_by_turns() -> None:
    goals = np.array([[0.0, 1.0], [1.0, 0.0], [0.4, 0.4], [0.1, 0.1], [0.5, 2.0]])
    missed = np.array([[0.0], [0.0], [0.0], [0.2], [0.0]])  # the fourth misses a demand
    judged = Judged(np.linspace(0.0, 1.0, 5)[:, None], goals, missed, {})
    scale = Scale.of(judged)
    assert scale.minimum.tolist() == [0.0, 0.0] and scale.span.tolist() == [1.0, 1.0]
    distance = nearest(judged, scale, spread(2, 3))
    assert picked(judged, distance, 3, 0.0) == [1, 2, 0]
    assert picked(judged, distance, 5, 0.0) == [1, 2, 0, 4, 3]
    assert picked(judged, distance, 5, 0.3) == [1, 4]
