"""Lines of a given width, and columns of tables."""

import pytest

from linkwright.words.characters import aligned, cells, folded


@pytest.mark.parametrize(
    ("text", "width", "lines"),
    [
        ("one two three", 8, ["one two", "three"]),
        ("a mass of 5 kg here", 12, ["a mass of", "5 kg here"]),
        ("曲柄推动颚板，摆动", 12, ["曲柄推动颚", "板，摆动"]),
        ("unbreakable", 4, ["unbreakable"]),
        ("upper_rod+upper_plate", 12, ["upper_rod+", "upper_plate"]),
        ("short", 10, ["short"]),
    ],
)
def test_folded(text: str, width: int, lines: list[str]) -> None:
    assert folded(text, width) == lines


def test_columns_are_as_wide_as_their_widest_text() -> None:
    rows = [("name", "of", "value"), ("smallest transmission angle", "摇杆", "40"), ("stroke", "slide", "3")]
    lines = aligned(rows, "<<>")
    assert {cells(line) for line in lines} == {27 + 2 + 5 + 2 + 5}
    assert [line[-2:] for line in lines] == ["ue", "40", " 3"]
