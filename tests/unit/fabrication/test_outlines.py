"""Outlines for a cut of some width against shapely's buffers."""

import numpy as np
import pytest
import shapely

from linkwright.fabrication.outlines import outline
from linkwright.gears.gear import Gear
from linkwright.shapes.boundary import boundary
from linkwright.shapes.loop import Loop
from linkwright.shapes.shape import Piece, Shape, bar, corners_of, joined, polygon

FINE = 1e-7


def polygon_of(loops: tuple[Loop, ...]) -> shapely.Geometry:
    """The area within loops, arcs as fine chords."""
    rings = [shapely.Polygon([(each.real, each.imag) for each in loop.points(FINE)]) for loop in loops]
    outer = shapely.union_all([ring for ring, loop in zip(rings, loops, strict=True) if loop.area > 0])
    return outer.difference(shapely.union_all([r for r, loop in zip(rings, loops, strict=True) if loop.area <= 0]))


def plain(ring: np.ndarray) -> list[tuple[float, float]]:
    return [(each.real, each.imag) for each in ring]


def frame_with_slot() -> Shape:
    outer = [0j, 0.1 + 0j, 0.1 + 0.06j, 0.05 + 0.04j, 0.06j]
    return polygon(outer, [[0.02 + 0.01j, 0.08 + 0.01j, 0.08 + 0.02j, 0.02 + 0.02j]])


@pytest.mark.parametrize("by", [0.0, 0.1e-3, 2e-3])
def test_sharp_corners_and_slots_are_offset_as_shapely_does(by: float) -> None:
    shape = frame_with_slot()
    rings = shape.pieces[0].rings
    wanted = shapely.Polygon(plain(rings[0]), [plain(rings[1])]).buffer(by, quad_segs=400)
    found = polygon_of(outline(shape, by))
    assert found.symmetric_difference(wanted).area < 1e-8 * wanted.area + 2e-9
    assert sum(each.area for each in outline(shape, by)) == pytest.approx(wanted.area, rel=2e-5)


def test_a_bar_grows_by_its_radius() -> None:
    (loop,) = outline(bar([0j, 0.1 + 0j], 0.02), 0.5e-3)
    assert loop.area == pytest.approx(0.1 * 0.021 + np.pi * 0.0105**2, rel=1e-12)


@pytest.mark.parametrize("internal", [False, True])
def test_many_corners_go_the_short_way_with_the_same_area(internal: bool) -> None:
    teeth = corners_of(Gear(18 if not internal else 50, 0.002, internal=internal).outline(6))
    rim = 0.07 * np.exp(2j * np.pi * np.arange(90) / 90)
    shape = polygon(rim, [teeth]) if internal else polygon(teeth)
    for by in (0.0, 0.1e-3):
        found = outline(shape, by)
        wanted = shapely.Polygon(plain(rim), [plain(teeth)]) if internal else shapely.Polygon(plain(teeth))
        assert sum(each.area for each in found) == pytest.approx(wanted.buffer(by, quad_segs=200).area, rel=1e-6)


def test_where_lines_would_cross_the_outline_is_that_of_the_union() -> None:
    """A gap of 0.4 mm between two arms closes under a kerf of 1 mm."""
    turn = np.exp(1j * np.linspace(0.1, 2 * np.pi - 0.1, 200))
    ring = np.concatenate([0.02 * turn, 0.016 * turn[::-1]])
    narrow = polygon(ring * np.exp(0j))
    gap = abs(ring[0] - ring[199])
    found = outline(narrow, 0.6 * gap)
    assert len(found) == 2 and found[1].area < 0
    wanted = shapely.Polygon(plain(ring)).buffer(0.6 * gap, quad_segs=200)
    assert sum(each.area for each in found) == pytest.approx(wanted.area, rel=1e-5)


def test_without_a_distance_it_is_the_boundary() -> None:
    shape = joined([bar([0j, 0.1 + 0j], 0.02), bar([0.05 + 0j, 0.05 + 0.05j], 0.01)])
    assert outline(shape) == boundary(shape)
    assert outline(Shape((Piece((np.array([0j]),), 0.01),)))[0].area == pytest.approx(np.pi * 1e-4)
