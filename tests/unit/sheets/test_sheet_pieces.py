"""Pieces of drawing sheets: scales, hidden lines, title blocks, rows of panels."""

import numpy as np
import pytest

from linkwright.errors import speaker
from linkwright.pictures.picture import Box, Circle, Line, Picture
from linkwright.sheets.layout import GAP, Block, Room, drawing_scale, packed, preferred, scale_text
from linkwright.sheets.paper import Fields, gb_block, iso_block, school_block, zone_count
from linkwright.sheets.settings import settings
from linkwright.sheets.written import visible


@pytest.mark.parametrize(
    ("least", "wanted"), [(1.0, 1.0), (1.01, 2.0), (2.1, 2.5), (2.6, 4.0), (0.041, 0.05), (51.0, 100.0)]
)
def test_graphical_scales_are_the_next_preferred_numbers(least: float, wanted: float) -> None:
    assert preferred(least) == pytest.approx(wanted)


@pytest.mark.parametrize(
    ("least", "iso", "gb"), [(1.0, 1.0, 1.0), (2.1, 5.0, 2.5), (3.0, 5.0, 4.0), (0.3, 0.5, 0.4), (11.0, 20.0, 20.0)]
)
def test_drawing_scales_are_those_of_the_standards(least: float, iso: float, gb: float) -> None:
    assert drawing_scale(least) == pytest.approx(iso)
    assert drawing_scale(least, allowed=True) == pytest.approx(gb)


def test_scales_as_ratios() -> None:
    assert [scale_text(each) for each in (1.0, 2.5, 0.5, 0.4, 20.0)] == ["1:1", "1:2.5", "2:1", "2.5:1", "1:20"]


def test_what_a_filled_outline_hides() -> None:
    line = np.array([(-5.0, 0.0), (5.0, 0.0)])
    left, right = visible(line, [Circle(np.zeros(2), 1.5, fill="paper")])
    assert np.allclose(left, [(-5, 0), (-1.5, 0)], atol=1e-5) and np.allclose(right, [(1.5, 0), (5, 0)], atol=1e-5)
    box = Line(np.array([(-2.0, -1.0), (2.0, -1.0), (2.0, 1.0), (-2.0, 1.0)]), closed=True, fill="paper")
    left, right = visible(line, [box])
    assert np.allclose(left[1], (-2, 0), atol=1e-5) and np.allclose(right[0], (2, 0), atol=1e-5)
    assert len(list(visible(np.array([(-1.0, 0.0), (1.0, 0.0)]), [box]))) == 0


@pytest.mark.parametrize("language", ["en", "zh"])
@pytest.mark.parametrize("make", [gb_block, iso_block, school_block])
def test_cells_of_a_title_block_fill_it_and_their_texts_lie_in_them(make, language: str) -> None:  # type: ignore[no-untyped-def]
    long = "A very long title of a course design in the theory of machines 牛头刨床机构的设计与分析"
    given = Fields(title=long, drawing=long, school=long, student="欧阳修", date="2026-11-28", scale="1:2.5")
    block = make(given, speaker(language))
    whole = Box(0.0, 0.0, block.width, block.height)
    area = {(c.x, c.y, c.width, c.height) for c in block.cells if not c.thick or c.text or c.head}
    assert whole.holds(block.picture().bounds)
    assert all(x + w <= block.width + 1e-9 and y + h <= block.height + 1e-9 for x, y, w, h in area)


def test_zones_are_even_and_about_50_mm() -> None:
    for length in (287.0, 390.0, 574.0, 806.0, 1154.0):
        count = zone_count(length)
        assert count % 2 == 0 and 25.0 <= length / count <= 75.0


def test_rows_keep_off_what_is_taken() -> None:
    room = Room(Box(0.0, 0.0, 100.0, 100.0), (Box(60.0, 0.0, 100.0, 40.0),))
    blocks = [Block(str(k), Picture(), 40.0, 30.0) for k in range(3)]
    rows = packed(blocks, room)
    assert rows is not None
    assert sum(len(column.blocks) for row in rows for column in row.columns) == 3
    lowest = [row for row in rows if row.top - row.height < 40.0 + GAP and row.columns]
    assert all(row.right <= 60.0 - GAP for row in lowest)
    assert packed([*blocks, Block("more", Picture(), 40.0, 30.0)], room) is None


def test_the_cover_of_the_report_fills_the_title_block() -> None:
    report = {"author": "A", "cover": {"school": "S", "class": "C", "number": 17, "author": "B", "adviser": "T"}}
    fields = settings({}, "en", report=report, name="machine").fields
    told = (fields.school, fields.class_name, fields.student_number, fields.student, fields.adviser)
    assert told == ("S", "C", "17", "B", "T")
    assert fields.title == "machine"
    assert settings({"student": "D"}, "en", report=report).fields.student == "D"
