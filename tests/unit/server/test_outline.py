"""The values and lines of a text that the studio shows beside the drawing."""

from __future__ import annotations

from linkwright.server.outline import outline

TEXT = """# mine
frame: {points: {O: [0 mm, 0 mm]}}
links:
  crank:  # of steel
    points: [O, A]
    length: 140 mm
"""


def test_values_are_as_written_and_lines_count_from_one() -> None:
    found = outline(TEXT)
    assert found["entries"] == {
        "frame": {"points": {"O": ["0 mm", "0 mm"]}},
        "links": {"crank": {"points": ["O", "A"], "length": "140 mm"}},
    }
    assert found["lines"]["links.crank"] == 4
    assert found["lines"]["links.crank.length"] == 6
    assert found["lines"]["frame.points.O"] == 2
    for unread in ("", "- 1", "a: {", "x"):
        assert outline(unread) == {"entries": {}, "lines": {}}
