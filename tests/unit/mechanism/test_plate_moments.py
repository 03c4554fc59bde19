"""Area, first and polar moments of plates by closed forms, against the exact outline and by hand."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest

from linkwright.core.plane import convex_hull
from linkwright.mechanism.plate_moments import disc_moments, hull_moments, outline_moments
from linkwright.shapes.properties import area_moments
from linkwright.shapes.shape import Piece, Shape, bar, polygon


def plates() -> list[tuple[str, list[tuple[float, float]], float]]:
    chance = random.Random(45)

    def place() -> tuple[float, float]:
        return chance.uniform(-1.0, 1.0), chance.uniform(-1.0, 1.0)

    found = [("random", [place() for _ in range(chance.randint(3, 7))], chance.uniform(0.01, 0.5)) for _ in range(60)]
    corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)]
    found.append(("on the sides", [*corners, (1.0, 0.0), (2.0, 0.5), (0.7, 1.0)], 0.1))
    found.append(("twice", [*corners, (2.0, 1.0), (0.3, 0.4)], 0.1))
    return found


@pytest.mark.parametrize("kind", ["random", "on the sides", "twice"])
def test_a_plate_has_the_moments_of_its_outline(kind: str) -> None:
    for name, points, radius in plates():
        if name != kind:
            continue
        area, (x, y), polar = hull_moments(points, radius).about_centre
        corners = convex_hull(np.array([complex(*each) for each in points]))
        exact = area_moments(Shape((Piece((corners,), radius, filled=True),)))
        assert (area, x, y, polar) == pytest.approx(
            (exact.area, exact.centre.real, exact.centre.imag, exact.polar), rel=1e-11, abs=1e-12
        )


@pytest.mark.parametrize("points", [[0.2, 1.0], [0.0, 1.3, -0.4], [0.5, 0.1, 0.9, 0.3]])
@pytest.mark.parametrize("way", [1.0, 0.6 + 0.8j, 1j])
def test_points_in_line_make_a_bar(points: list[float], way: complex) -> None:
    places = [each * complex(way) for each in points]
    area, (x, y), polar = hull_moments([(each.real, each.imag) for each in places], 0.05).about_centre
    exact = area_moments(bar([min(points) * way, max(points) * way], 0.1))
    assert (area, x, y, polar) == pytest.approx(
        (exact.area, exact.centre.real, exact.centre.imag, exact.polar), rel=1e-12, abs=1e-15
    )


def test_one_point_makes_a_disc() -> None:
    area, centre, polar = hull_moments([(0.3, -0.2)], 0.1).about_centre
    assert area == pytest.approx(math.pi * 0.01)
    assert centre == pytest.approx((0.3, -0.2))
    assert polar == pytest.approx(0.5 * math.pi * 0.1**4)
    assert disc_moments((0.3, -0.2), 0.1) == hull_moments([(0.3, -0.2)], 0.1)


def test_a_square_with_round_corners_by_hand() -> None:
    """Square of side 2, radius 1: 4 + 4·2·1 + π; polar moments of the square 8/3, of each strip
    (2·1)(4 + 1)/12 + 2·1.5², of each quarter disc π/8 - (4/3π)² π/4 + (π/4) d², d² = 2(1 + 4/3π)²."""
    area, centre, polar = hull_moments([(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)], 1.0).about_centre
    off = 4.0 / (3.0 * math.pi)
    strip = 2.0 * 5.0 / 12.0 + 2.0 * 1.5**2
    quarter = math.pi / 8.0 - 2.0 * off**2 * math.pi / 4.0 + math.pi / 4.0 * 2.0 * (1.0 + off) ** 2
    assert area == pytest.approx(12.0 + math.pi)
    assert centre == pytest.approx((0.0, 0.0), abs=1e-15)
    assert polar == pytest.approx(8.0 / 3.0 + 4.0 * strip + 4.0 * quarter)


@pytest.mark.parametrize("turned", [1, -1])
def test_an_outline_is_without_its_openings(turned: int) -> None:
    outer = ((0.0, 0.0), (3.0, 0.0), (3.0, 2.0), (0.0, 2.0))
    hole = ((0.5, 0.5), (1.0, 0.5), (1.0, 1.5))[::turned]
    area, (x, y), polar = outline_moments([outer, hole]).about_centre
    exact = area_moments(polygon([complex(*each) for each in outer], [[complex(*each) for each in hole]]))
    assert area == pytest.approx(6.0 - 0.25)
    assert (x, y, polar) == pytest.approx((exact.centre.real, exact.centre.imag, exact.polar))
