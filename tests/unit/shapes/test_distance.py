"""Distances of shapes at rest, against shapely."""

import math

import numpy as np
import pytest
import shapely
from shapely import affinity
from tests.unit.shapes.oracle import random_shape, union_of

from linkwright.shapes.distance import contains, gap
from linkwright.shapes.shape import Shape, bar, disc, polygon, rectangle


@pytest.mark.parametrize("seed", range(40))
def test_random_shapes_next_to_each_other(seed: int) -> None:
    rng = np.random.default_rng(1000 + seed)
    one, other = random_shape(rng), random_shape(rng)
    origin, turn = complex(*rng.uniform(-4.0, 4.0, 2)), float(rng.uniform(-3.0, 3.0))
    moved = affinity.translate(
        affinity.rotate(union_of(other, 150), turn, origin=(0, 0), use_radians=True), origin.real, origin.imag
    )
    still = union_of(one, 150)
    found = gap(one, other, (origin, turn))
    if still.intersection(moved).area > 1e-4:
        assert found <= 0.0
    else:
        assert found == pytest.approx(still.distance(moved), abs=3e-5)


@pytest.mark.parametrize("seed", range(20))
def test_places_within(seed: int) -> None:
    rng = np.random.default_rng(2000 + seed)
    shape = random_shape(rng)
    places = rng.uniform(-1.5, 1.5, 200) + 1j * rng.uniform(-1.5, 1.5, 200)
    area = union_of(shape, 150)
    points = shapely.points(places.real, places.imag)
    clear = shapely.distance(area.boundary, points) > 1e-4
    assert np.array_equal(contains(shape, places)[clear], shapely.contains(area, points)[clear])


def test_bars_and_discs_in_closed_form() -> None:
    assert gap(bar([0j, 1 + 0j], 0.2), disc(0.5 + 0.7j, 0.25)) == pytest.approx(0.35)
    assert gap(bar([0j, 1 + 0j], 0.2), disc(1.3 + 0.4j, 0.25)) == pytest.approx(0.5 - 0.35)
    assert gap(disc(0j, 0.1), disc(0j, 0.2), (3 + 4j, 1.0)) == pytest.approx(4.7)
    assert gap(bar([0j, 1 + 0j], 0.2), bar([0.5 - 1j, 0.5 + 1j], 0.2)) == pytest.approx(-0.2)


def test_a_pose_turns_first_and_moves_then() -> None:
    square = rectangle(1 + 0j, 0.0, 0.2, 0.2)
    assert gap(disc(0j, 0.1), square, (2j, 0.5 * math.pi)) == pytest.approx(3.0 - 0.1 - 0.1)


def test_a_core_within_a_filled_one_has_no_distance() -> None:
    assert gap(rectangle(0j, 0.0, 1.0, 1.0), disc(0.1 + 0.1j, 0.05)) == pytest.approx(-0.05)
    assert gap(disc(0.1 + 0.1j, 0.05), rectangle(0j, 0.0, 1.0, 1.0)) == pytest.approx(-0.05)


def test_what_lies_in_an_opening_is_clear_of_the_plate() -> None:
    square = 0.5 * np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j])
    plate = polygon(square, [0.6 * square])
    assert gap(plate, disc(0j, 0.1)) == pytest.approx(0.3 - 0.1)
    assert not contains(plate, np.array([0j]))[0]


def test_bored_holes_count_as_material() -> None:
    drilled = Shape(bar([0j, 1 + 0j], 0.2).pieces, ((0j, 0.05),))
    assert contains(drilled, np.array([0j]))[0]
    assert gap(drilled, disc(0j, 0.02)) < 0.0
