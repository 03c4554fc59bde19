"""Outlines of unions: against closed forms, and against shapely for random ones."""

import math

import numpy as np
import pytest
from tests.unit.shapes.oracle import area_within, random_shape, union_of

from linkwright.errors import RequestError
from linkwright.shapes.boundary import boundary
from linkwright.shapes.loop import Loop
from linkwright.shapes.shape import Piece, Shape, bar, disc, joined, polygon, rectangle


def area_of(shape: Shape) -> float:
    return sum(loop.area for loop in boundary(shape))


def is_closed(loop: Loop) -> bool:
    return all(
        one.end == other.start for one, other in zip(loop.edges, (*loop.edges[1:], loop.edges[0]), strict=True)
    )


@pytest.mark.parametrize("seed", range(80))
def test_unions_of_random_pieces_are_those_of_shapely(seed: int) -> None:
    shape = random_shape(np.random.default_rng(seed))
    loops = boundary(shape)
    expected, found = union_of(shape, 150), area_within(loops, 1e-5)
    assert all(is_closed(loop) for loop in loops)
    assert found.symmetric_difference(expected).area < 3e-5 * (1.0 + expected.length)
    # no two loops overlap: what each adds or takes off is there
    assert sum(loop.area for loop in loops) == pytest.approx(expected.area, abs=3e-5 * (1.0 + expected.length))
    outer = [loop.area > 0.0 for loop in loops]
    assert outer == sorted(outer, reverse=True)


@pytest.mark.long
def test_areas_of_many_random_unions() -> None:
    for seed in range(1000, 3000):
        shape = random_shape(np.random.default_rng(seed))
        expected = union_of(shape, 100)
        assert area_of(shape) == pytest.approx(expected.area, abs=6e-5 * (1.0 + expected.length)), seed


def test_a_bar_has_two_lines_and_two_half_arcs() -> None:
    (loop,) = boundary(bar([0j, 0.3 + 0.4j], 0.2))
    assert sorted(edge.bulge for edge in loop.edges) == pytest.approx([0.0, 0.0, 1.0, 1.0])
    assert loop.area == pytest.approx(0.5 * 0.2 + math.pi * 0.01, rel=1e-14)
    assert loop.length == pytest.approx(2.0 * 0.5 + math.pi * 0.2, rel=1e-14)
    low, high = loop.box
    assert (low, high) == (pytest.approx(-0.1 - 0.1j), pytest.approx(0.4 + 0.5j))


@pytest.mark.parametrize(
    "points", [[0j, 0.5 + 0.1j, 1 + 0.2j], [0.5 + 0.1j, 0j, 1 + 0.2j, 1 + 0.2j], [0j, 1 + 0.2j, 0j]]
)
def test_points_in_line_make_a_straight_bar(points: list[complex]) -> None:
    for shape in (bar(points, 0.2), joined([bar(points, 0.2), disc(0j, 0.1)])):
        (loop,) = boundary(shape)
        assert len(loop.edges) == 4
        assert loop.area == pytest.approx(math.hypot(1.0, 0.2) * 0.2 + math.pi * 0.01, rel=1e-12)


def test_a_plate_has_an_arc_at_every_corner() -> None:
    corners = np.array([0j, 1 + 0j, 0.4 + 0.9j])
    (loop,) = boundary(Shape((Piece((corners,), 0.1, filled=True),)))
    girth = float(np.abs(np.roll(corners, -1) - corners).sum())
    # Steiner: area of the core, its girth times the radius, and a disc
    assert loop.area == pytest.approx(0.45 + girth * 0.1 + math.pi * 0.01, rel=1e-14)
    assert loop.length == pytest.approx(girth + 2.0 * math.pi * 0.1, rel=1e-14)
    assert [bool(edge.bulge) for edge in loop.edges] == [False, True] * 3


@pytest.mark.parametrize(
    "corners", [[0j], [0j, 0j, 0j], [0j, 1 + 0j], [0j, 1 + 0j, 0.5 + 0j], [0j, 0j, 1 + 0j, 1 + 0j]]
)
def test_a_plate_of_points_in_line_is_a_bar(corners: list[complex]) -> None:
    places = np.array(corners)
    length = float(np.ptp(places.real))
    (loop,) = boundary(Shape((Piece((places,), 0.1, filled=True),)))
    assert loop.area == pytest.approx(0.2 * length + math.pi * 0.01)


def test_the_middle_of_a_pentagram_is_open_by_the_even_odd_rule() -> None:
    star = np.exp(0.8j * np.pi * np.arange(5) + 0.5j * np.pi)
    loops = boundary(polygon(star))
    # tips of a pentagram in the unit circle: triangles on the sides of the inner pentagon
    inner = 1.0 / ((1.0 + math.sqrt(5.0)) / 2.0) ** 2
    side = 2.0 * inner * math.sin(math.pi / 5.0)
    tips = 5.0 * 0.5 * side * (1.0 - inner * math.cos(math.pi / 5.0))
    assert sum(loop.area for loop in loops) == pytest.approx(tips)


def test_a_ring_of_bars_has_an_opening() -> None:
    corners = [0j, 1 + 0j, 1 + 1j, 1j, 0j]
    outer, inner = boundary(bar(corners, 0.2))
    assert outer.area == pytest.approx(1.0 + 4.0 * 0.1 + math.pi * 0.01)
    assert inner.area == pytest.approx(-0.64)
    assert len(inner.edges) == 4


def test_discs_that_cross_make_a_lens_less() -> None:
    (loop,) = boundary(joined([disc(0j, 1.0), disc(1 + 0j, 1.0)]))
    lens = 2.0 * math.pi / 3.0 - math.sqrt(3.0) / 2.0
    assert loop.area == pytest.approx(2.0 * math.pi - lens, rel=1e-13)
    assert len(loop.edges) == 2


@pytest.mark.parametrize("apart", [2.0, 2.0 + 1e-12, 2.0 - 1e-12, 2.0 + 1e-9, 2.0 - 1e-9, 2.0 - 1e-7, 2.0 + 1e-7])
def test_discs_that_barely_touch(apart: float) -> None:
    assert area_of(joined([disc(0j, 1.0), disc(apart * np.exp(0.7j), 1.0)])) == pytest.approx(2.0 * math.pi, abs=1e-7)


@pytest.mark.parametrize(
    "apart", [0.5, 0.5 + 1e-12, 0.5 - 1e-12, 0.5 + 1e-9, 0.5 - 1e-9, 0.5 + 1e-7, 1e-12, 1e-10, 0.0]
)
@pytest.mark.parametrize("radius", [0.5, 1.0])
def test_a_disc_that_touches_another_from_within(apart: float, radius: float) -> None:
    apart = apart if radius == 0.5 else 0.0 if apart >= 0.4 else apart
    assert area_of(joined([disc(0j, 1.0), disc(apart * np.exp(0.7j), radius)])) == pytest.approx(math.pi, abs=1e-7)


@pytest.mark.parametrize("bend", [1e-13, 1e-11, 1e-10, 3e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.1])
def test_a_bar_that_is_barely_bent(bend: float) -> None:
    points = [0j, 1 + 0j, 1 + np.exp(1j * bend)]
    (loop,) = boundary(bar(points, 0.2))
    # sides overlap on the inner side of the bend, an arc fills the outer one
    expected = 2.0 * 0.2 + math.pi * 0.01 + 0.01 * (0.5 * bend - math.tan(0.5 * bend))
    assert loop.area == pytest.approx(expected, abs=1e-12)


def test_rectangles_with_a_common_side_are_one() -> None:
    (loop,) = boundary(joined([rectangle(0j, 0.0, 1.0, 1.0), rectangle(1 + 0j, 0.0, 1.0, 1.0)]))
    assert loop.area == pytest.approx(2.0)
    assert len(loop.edges) == 4


def test_a_polygon_given_clockwise_keeps_its_holes() -> None:
    square = np.array([0j, 1j, 1 + 1j, 1 + 0j])
    outer, inner = boundary(polygon(square, [0.25 + 0.5 * square[::-1] + 0.25j]))
    assert (outer.area, inner.area) == (pytest.approx(1.0), pytest.approx(-0.25))


def test_holes_are_bored_last() -> None:
    shape = Shape(bar([0j, 1 + 0j], 0.2).pieces, ((0j, 0.05), (1 + 0j, 0.05), (1 + 0j, 0.04)))
    _plate, *holes = boundary(shape)
    assert [hole.area for hole in holes] == pytest.approx([-math.pi * 0.0025] * 2)
    assert all(edge.bulge == -1.0 for hole in holes for edge in hole.edges)


@pytest.mark.parametrize(
    ("hole", "code"), [((0.02j, 0.09), "shapes.bore_outside"), ((3j, 0.01), "shapes.bore_outside")]
)
def test_a_hole_through_the_edge_is_refused(hole: tuple[complex, float], code: str) -> None:
    with pytest.raises(RequestError, match=r"mm breaks through the edge") as refused:
        boundary(Shape(bar([0j, 1 + 0j], 0.2).pieces, (hole,)))
    assert refused.value.code == code


def test_holes_that_overlap_are_refused() -> None:
    with pytest.raises(RequestError, match=r"the holes at \(0, 0\) mm and \(80, 0\) mm overlap") as refused:
        boundary(Shape(bar([0j, 1 + 0j], 0.2).pieces, ((0j, 0.05), (0.08 + 0j, 0.05))))
    assert refused.value.code == "shapes.bores_overlap"


def test_a_line_without_width_is_refused() -> None:
    with pytest.raises(RequestError, match="no area") as refused:
        boundary(bar([0j, 1 + 0j], 0.0))
    assert refused.value.code == "shapes.empty"


def test_flattened_arcs_stay_within_the_tolerance() -> None:
    (loop,) = boundary(disc(1 + 1j, 0.5))
    for tolerance in (1e-2, 1e-4, 1e-6):
        places = loop.points(tolerance)
        middles = 0.5 * (places + np.roll(places, -1))
        sag = 0.5 - np.abs(middles - 1 - 1j)
        assert 0.2 * tolerance < sag.max() <= tolerance * (1.0 + 1e-6)


def test_a_moved_outline_keeps_its_form() -> None:
    (loop,) = boundary(bar([0j, 1 + 0j, 1 + 1j], 0.2))
    moved = loop.moved(turn=0.5 * math.pi, to=2 + 0j)
    assert moved.area == pytest.approx(loop.area)
    assert moved.reversed.area == pytest.approx(-loop.area)
    low, high = loop.box
    assert moved.box[0] == pytest.approx(complex(2.0 - high.imag, low.real))


def test_a_wheel_of_many_corners_is_followed_corner_by_corner() -> None:
    turns = np.linspace(0.0, 2.0 * np.pi, 2000, endpoint=False)
    wheel = np.exp(1j * turns) * (1.0 + 0.05 * np.sin(30.0 * turns))
    outer, inner = boundary(polygon(wheel, [0.5 * wheel]))
    assert (len(outer.edges), len(inner.edges)) == (2000, 2000)
    z = np.append(wheel, wheel[0])
    assert outer.area == pytest.approx(0.5 * float((z[:-1].conj() * z[1:]).imag.sum()))
    assert inner.area == pytest.approx(-0.25 * outer.area)


def test_islands_in_openings_are_material_again() -> None:
    square = np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j])
    loops = boundary(polygon(square, [0.8 * square, 0.5 * square[::-1]]))
    assert [loop.area for loop in loops] == pytest.approx([4.0, 1.0, -2.56])
