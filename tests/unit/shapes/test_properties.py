"""Areas, centres and moments: closed forms, and fine polygons by their triangles."""

import math

import numpy as np
import pytest
import shapely
from tests.unit.shapes.oracle import random_shape, union_of

from linkwright.shapes.properties import area_moments
from linkwright.shapes.shape import Shape, bar, disc, polygon, rectangle


def test_a_disc() -> None:
    found = area_moments(disc(2 + 1j, 0.3))
    assert (found.area, found.polar) == (pytest.approx(math.pi * 0.09), pytest.approx(0.5 * math.pi * 0.3**4))
    assert found.centre == pytest.approx(2 + 1j)


def test_a_rectangle() -> None:
    found = area_moments(rectangle(1 - 2j, 0.4, 0.5, 0.2))
    assert (found.area, found.centre) == (pytest.approx(0.1), pytest.approx(1 - 2j))
    assert found.polar == pytest.approx(0.5 * 0.2 * (0.5**2 + 0.2**2) / 12.0)


def test_a_bar() -> None:
    """A rectangle and two half discs, whose centres lie 4r/3π from their diameters."""
    length, r = 0.7, 0.06
    found = area_moments(bar([0j, length * np.exp(0.3j)], 2.0 * r))
    half, out = 0.5 * math.pi * r**2, 4.0 * r / (3.0 * math.pi)
    about_end = 0.25 * math.pi * r**4
    about_own = about_end - half * out**2
    polar = 2.0 * r * length * (length**2 + 4.0 * r**2) / 12.0 + 2.0 * (about_own + half * (0.5 * length + out) ** 2)
    assert found.area == pytest.approx(2.0 * r * length + 2.0 * half, rel=1e-13)
    assert found.centre == pytest.approx(0.5 * length * np.exp(0.3j))
    assert found.polar == pytest.approx(polar, rel=1e-12)


def test_bored_holes_are_taken_off() -> None:
    r = 0.02
    found = area_moments(Shape(rectangle(0j, 0.0, 0.4, 0.2).pieces, ((0.1 + 0j, r), (-0.1 + 0j, r))))
    hole = math.pi * r**2
    assert found.area == pytest.approx(0.08 - 2.0 * hole)
    polar = 0.08 * (0.16 + 0.04) / 12.0 - 2.0 * (0.5 * hole * r**2 + hole * 0.01)
    assert (found.centre, found.polar) == (pytest.approx(0.0, abs=1e-15), pytest.approx(polar))


def test_an_outline_far_from_the_origin_keeps_its_digits() -> None:
    square = np.array([0j, 0.1 + 0j, 0.1 + 0.1j, 0.1j])
    found = area_moments(polygon(1000.0 + square))
    assert found.polar == pytest.approx(1e-4 / 6.0, rel=1e-8)


@pytest.mark.parametrize("seed", range(200, 230))
def test_random_unions(seed: int) -> None:
    shape = random_shape(np.random.default_rng(seed))
    found, expected = area_moments(shape), union_of(shape, 300)
    assert found.area == pytest.approx(expected.area, rel=1e-5)
    centre = complex(expected.centroid.x, expected.centroid.y)
    assert found.centre == pytest.approx(centre, abs=2e-6)
    polar = 0.0
    for part in shapely.get_parts(shapely.normalize(expected)):
        for k, ring in enumerate((part.exterior, *part.interiors)):
            z = shapely.get_coordinates(ring) @ [1.0, 1j] - centre
            a, b = z[:-1], z[1:]
            turned = (a.conj() * b).imag * (abs(a) ** 2 + (a.conj() * b).real + abs(b) ** 2) / 12.0
            polar += abs(turned.sum()) * (-1.0 if k else 1.0)
    assert found.polar == pytest.approx(polar, rel=1e-5)
