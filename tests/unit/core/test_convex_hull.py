"""Convex hulls against SciPy's, and of points that have no area; crossings of stars, cross products."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from linkwright.core.plane import area, convex_hull, cross, crossings


def _tracks(count: int, seed: int) -> np.ndarray:
    """Points on arcs and on a cloud, as links leave them."""
    random = np.random.default_rng(seed)
    turn = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    swing = 0.4 * np.sin(turn) + random.uniform(0.0, 6.0)
    crank = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    rocker = 3.0 * np.stack([np.cos(swing), np.sin(swing)], axis=1) + random.normal(size=2)
    return np.concatenate([crank, rocker, random.normal(size=(count, 2))])


@pytest.mark.rotating
@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("count", [2, 10, 360])
def test_hull_is_that_of_scipy(count: int, seed: int) -> None:
    points = _tracks(count, seed) + 100.0 * (seed % 3)
    places, known = convex_hull(points @ [1, 1j]), ConvexHull(points)
    assert area(places) == pytest.approx(known.volume, rel=1e-9)
    corners = np.stack([places.real, places.imag], axis=1)
    assert set(map(tuple, corners.tolist())) <= set(map(tuple, points.tolist()))
    side = np.roll(corners, -1, axis=0) - corners
    ahead = points[:, None] - corners
    assert (side[:, 0] * ahead[:, :, 1] - side[:, 1] * ahead[:, :, 0]).min() >= -1e-11


@pytest.mark.parametrize("count", [1, 3, 900])
def test_points_on_one_line_or_on_one_place_have_no_area(count: int) -> None:
    along = np.linspace(0.0, 1.0, count)
    assert area(convex_hull((1.0 + 2.0j) * along)) == pytest.approx(0.0, abs=1e-12)
    assert area(convex_hull(np.full(count, 0.3 + 0.3j))) == 0.0


@pytest.mark.parametrize("turn", [0.0, 0.3, -1.1])
@pytest.mark.parametrize("sense", [1, -1])
def test_every_side_of_a_pentagram_is_crossed_twice_by_the_golden_section(turn: float, sense: int) -> None:
    """Sides are numbered by their first corner; neighbours, the last and the first among them, only meet."""
    at = turn + sense * 4.0 * np.pi * np.arange(5) / 5.0
    star = np.stack([np.cos(at), np.sin(at)], axis=1) + 7.0
    short = 2.0 / (3.0 + np.sqrt(5.0))
    found = crossings(star)
    sides = sorted((int(a), int(b)) for a, b in found)
    assert sides == [(0, 2), (0, 3), (1, 3), (1, 4), (2, 4)]
    shares = sorted(place % 1.0 for pair in found for place in pair)
    assert shares == pytest.approx([short] * 5 + [1.0 - short] * 5)
    for a, b in found:
        spots = [star[int(p)] + (p % 1.0) * (star[(int(p) + 1) % 5] - star[int(p)]) for p in (a, b)]
        assert spots[0] == pytest.approx(spots[1])
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    assert crossings(square) == []
    assert crossings(square[[0, 2, 1, 3]]) == [(0.5, 2.5)] and crossings(square[[1, 3, 0, 2]]) == [(0.5, 2.5)]
    assert cross(np.array([[3.0, 0.0]]), np.array([[0.0, 2.0]])).tolist() == [6.0]
