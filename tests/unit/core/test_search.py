"""Searches against places known in closed form, many brackets at once."""

import math

import numpy as np
import pytest

from linkwright.core.search import ACCURACY, edge, ends, lowest, zeros


def test_zeros_of_many_functions_side_by_side():
    shift = np.linspace(-0.4, 0.4, 41)
    found = zeros(
        lambda x: (np.sin(x - shift) + 0.3 * (x - shift) ** 3, np.cos(x - shift) + 0.9 * (x - shift) ** 2),
        np.full(41, -1.0),
        np.full(41, 2.0),
        np.full(41, -1.0),
    )
    assert np.abs(found - shift).max() < 3 * ACCURACY


@pytest.mark.parametrize(
    ("function", "place"),
    [
        (lambda x: (x**9 - 1e-9, 9 * x**8), 0.1),  # flat where Newton's steps begin
        (lambda x: (np.where(x < 0.7, -1.0, 2.0), 0.0 * x), 0.7),  # a jump
        (lambda x: (1.0 / (x - 0.3), -1.0 / (x - 0.3) ** 2), 0.3),  # a pole
        (lambda x: (np.arctan(50 * (x - 0.9)), 50 / (1 + (50 * (x - 0.9)) ** 2)), 0.9),  # Newton alone diverges
    ],
)
def test_zeros_of_functions_that_mislead_newton(function, place):
    low, high = np.zeros(1), np.ones(1)
    with np.errstate(all="ignore"):
        found = zeros(function, low, high, function(low)[0])
    assert found[0] == pytest.approx(place, abs=1e-13)


def test_brackets_may_run_downwards():
    found = zeros(lambda x: (np.cos(x), -np.sin(x)), np.array([3.0]), np.array([0.5]), np.array([-1.0]))
    assert found[0] == pytest.approx(math.pi / 2, abs=1e-14)


def test_ends_of_what_holds_seen_from_both_sides():
    found = ends(lambda x: x**2 <= 2.0, np.array([0.0, -0.1]), np.array([3.0, -2.0]))
    assert found == pytest.approx([math.sqrt(2), -math.sqrt(2)], abs=1e-13)
    assert (found**2 <= 2.0).all()


@pytest.mark.parametrize("parts", [2, 16])
def test_the_edge_of_one_bracket_lies_between_two_places_next_to_each_other(parts):
    inside, outside = edge(lambda x: x**2 <= 2.0, 0.0, -3.0, parts=parts)
    assert inside**2 <= 2.0 < outside**2
    assert abs(inside - outside) <= 3 * ACCURACY
    rough = edge(lambda x: x**2 <= 2.0, 0.0, 3.0, within=0.01, parts=parts)
    assert rough[0] <= math.sqrt(2) < rough[1] <= rough[0] + 0.01
    assert rough[1] - rough[0] > 0.01 / 16
    assert edge(lambda x: x <= 1.0 / 3.0, 1.0 / 3.0, math.nextafter(1.0 / 3.0, 1.0)) == (
        1.0 / 3.0,
        math.nextafter(1.0 / 3.0, 1.0),
    )


def test_lowest_values_and_their_places():
    shift = np.linspace(0.1, 0.9, 9)[:, None]
    place, least = lowest(lambda x: np.cosh(x - shift) - 1e-3, np.zeros(9), np.ones(9))
    assert np.abs(least - 0.999).max() < 1e-15
    assert np.abs(place - shift[:, 0]).max() < 1e-7


def test_lowest_value_at_an_end_or_beside_what_does_not_exist():
    with np.errstate(invalid="ignore"):
        place, least = lowest(lambda x: np.where(x < 0.25, np.nan, x**2), np.array([0.0]), np.array([1.0]))
    assert place[0] >= 0.25
    assert least[0] == pytest.approx(0.0625, abs=1e-6)
    assert lowest(lambda x: -x, np.array([0.0]), np.array([2.0]))[1][0] == -2.0
