"""Convex hulls against SciPy's, and of points that have no area."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from linkwright.metrics.plane import area, convex_hull


def _tracks(count: int, seed: int) -> np.ndarray:
    """Points on arcs and on a cloud, as links leave them."""
    random = np.random.default_rng(seed)
    turn = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    swing = 0.4 * np.sin(turn) + random.uniform(0.0, 6.0)
    crank = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    rocker = 3.0 * np.stack([np.cos(swing), np.sin(swing)], axis=1) + random.normal(size=2)
    return np.concatenate([crank, rocker, random.normal(size=(count, 2))])


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("count", [2, 10, 360])
def test_hull_is_that_of_scipy(count: int, seed: int) -> None:
    points = _tracks(count, seed) + 100.0 * (seed % 3)
    corners, known = convex_hull(points), ConvexHull(points)
    assert area(corners) == pytest.approx(known.volume, rel=1e-9)
    assert set(map(tuple, corners.tolist())) <= set(map(tuple, points.tolist()))
    side = np.roll(corners, -1, axis=0) - corners
    ahead = points[:, None] - corners
    assert (side[:, 0] * ahead[:, :, 1] - side[:, 1] * ahead[:, :, 0]).min() >= -1e-11


@pytest.mark.parametrize("count", [1, 3, 900])
def test_points_on_one_line_or_on_one_place_have_no_area(count: int) -> None:
    along = np.linspace(0.0, 1.0, count)
    assert area(convex_hull(np.stack([along, 2.0 * along], axis=1))) == pytest.approx(0.0, abs=1e-12)
    assert area(convex_hull(np.full((count, 2), 0.3))) == 0.0
