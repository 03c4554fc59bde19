"""Parts on sheets: none overlaps, all are inside, by shapely."""

from collections.abc import Sequence
from itertools import combinations

import numpy as np
import pytest
from shapely import affinity, box
from shapely.geometry.base import BaseGeometry
from tests.unit.shapes.oracle import union_of

from linkwright.fabrication.nesting import Placed, nest
from linkwright.fabrication.raster import simplified
from linkwright.shapes.shape import Piece, Shape, bar, disc, polygon, rectangle

SPACING = 0.004


def wheel(radius: float, teeth: int) -> Shape:
    turns = np.linspace(0.0, 2.0 * np.pi, 30 * teeth, endpoint=False)
    return polygon(radius * np.exp(1j * turns) * (1.0 + 0.04 * np.sin(teeth * turns)))


def parts(seed: int) -> list[Shape]:
    """Bars, hooks, plates, discs, a wheel and a frame with an opening."""
    rng = np.random.default_rng(seed)
    bars = [bar([0.1j, length + 0.1j], 0.03) for length in rng.uniform(0.08, 0.3, 6)]
    hooks = [bar([0j, 0.15 + 0j, 0.15 + 0.1j * way], 0.025) for way in (1.0, -1.0)]
    plates = [Shape((Piece((np.array([0j, 0.2 + 0j, 0.05 + 0.15j]),), 0.015, filled=True),))] * 3
    frame = polygon([0j, 0.3 + 0j, 0.3 + 0.2j, 0.2j], [[0.03 + 0.03j, 0.27 + 0.03j, 0.27 + 0.17j, 0.03 + 0.17j]])
    return [*bars, *hooks, *plates, disc(0.3 + 0j, 0.02), wheel(0.08, 20), frame]


def laid_out(shapes: Sequence[Shape], found: Sequence[Placed | None]) -> dict[int, list[BaseGeometry]]:
    """The parts on each sheet."""
    sheets: dict[int, list[BaseGeometry]] = {}
    for shape, each in zip(shapes, found, strict=True):
        if each is not None:
            turned = affinity.rotate(union_of(shape, 90), each.turn, origin=(0, 0), use_radians=True)
            sheets.setdefault(each.sheet, []).append(affinity.translate(turned, each.place.real, each.place.imag))
    return sheets


@pytest.mark.parametrize(("seed", "sheet"), [(1, (0.7, 0.5)), (2, (0.35, 0.6)), (3, (0.36, 0.4))])
def test_parts_keep_their_distance_and_stay_on_the_sheet(seed: int, sheet: tuple[float, float]) -> None:
    shapes = parts(seed)
    found = nest(shapes, sheet, SPACING)
    sheets = laid_out(shapes, found)
    assert sum(map(len, sheets.values())) == len(shapes)
    assert sorted(sheets) == list(range(len(sheets)))
    inner = box(SPACING, SPACING, sheet[0] - SPACING, sheet[1] - SPACING).buffer(1e-9)
    for on_sheet in sheets.values():
        assert all(inner.contains(each) for each in on_sheet)
        nearest = min((one.distance(other) for one, other in combinations(on_sheet, 2)), default=SPACING)
        assert nearest >= SPACING * (1.0 - 1e-9)


def test_parts_are_laid_out_the_same_way_again() -> None:
    assert nest(parts(4)[:10], (0.5, 0.4), SPACING) == nest(parts(4)[:10], (0.5, 0.4), SPACING)


def test_equal_bars_lie_side_by_side() -> None:
    """Seven bars of 30 mm with 4 mm between them and at both edges take 242 mm, and two cells more."""
    bars = [bar([0j, 0.2 + 0j], 0.03)] * 7
    for sheet in ((0.244, 0.23801), (0.23801, 0.244)):
        assert {each.sheet for each in nest(bars, sheet, SPACING) if each} == {0}


def test_small_parts_go_into_openings() -> None:
    frame = polygon([0j, 0.3 + 0j, 0.3 + 0.2j, 0.2j], [[0.02 + 0.02j, 0.28 + 0.02j, 0.28 + 0.18j, 0.02 + 0.18j]])
    shapes = [disc(0j, 0.05), frame, bar([0j, 0.2 + 0j], 0.03)]
    (on_sheet,) = laid_out(shapes, nest(shapes, (0.309, 0.209), SPACING)).values()
    assert len(on_sheet) == 3


def test_a_part_as_large_as_the_sheet_fits() -> None:
    (found,) = nest([rectangle(1 + 1j, 0.3, 0.5, 0.2)], (0.5, 0.2), 0.0)
    assert found is not None
    assert found.sheet == 0


def test_a_bar_that_fits_across_only_is_turned() -> None:
    shapes = [bar([0j, 0.42 + 0j], 0.02)]
    sheets = laid_out(shapes, nest(shapes, (0.4, 0.3), 0.0))
    assert box(0, 0, 0.4, 0.3).contains(sheets[0][0])


def test_what_fits_on_no_sheet_is_left_out() -> None:
    found = nest([disc(0j, 0.3), disc(0j, 0.1)], (0.5, 0.5), SPACING)
    assert found[0] is None
    assert found[1] is not None


def test_without_parts_there_is_no_sheet() -> None:
    assert nest([], (0.5, 0.5), SPACING) == []


def test_a_simplified_shape_holds_the_given_one() -> None:
    given = wheel(0.08, 20)
    simple = simplified(given, 1e-4)
    assert sum(len(each.corners) for each in simple.pieces) < 0.5 * sum(len(each.corners) for each in given.pieces)
    assert union_of(simple).contains(union_of(given))
    assert union_of(given).buffer(2.1e-4).contains(union_of(simple))
