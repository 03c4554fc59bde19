"""Lines and columns of tables, as wide as they are told to be."""

import pytest

from linkwright.words.characters import aligned, aligned_within, cells, folded, folded_lines


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


def test_what_follows_is_indented_and_narrow_columns_stay() -> None:
    assert folded_lines("  a sentence that is long", 14) == "  a sentence\n    that is\n    long"
    assert folded_lines("name  value  unit", 8) == "name  value  unit"


def test_the_last_column_is_folded_below_itself() -> None:
    line = "  1.  RRR  outer joints O3 and A, inner joint B"
    assert folded_lines(line, 34).split("\n") == [
        "  1.  RRR  outer joints O3 and A,",
        "           inner joint B",
    ]
    assert folded_lines(line, 20) == line  # no room for it


def test_tables_fold_their_widest_texts() -> None:
    rows = [
        ("name", "of", "value"),
        ("smallest transmission angle", "rocker", "40"),
        ("stroke", "slide", "3"),
    ]
    assert aligned_within(rows, "<<>", None) == [[line] for line in aligned(rows, "<<>")]
    lines = aligned_within(rows, "<<>", 34)
    assert [len(each) for each in lines] == [1, 2, 1]
    assert max(cells(line) for each in lines for line in each) <= 34
