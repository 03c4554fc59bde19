"""On a terminal sentences and tables take its width; in a pipe and in files lines are whole."""

import re
import subprocess
import sys

import pytest
from tests.cli.test_colour import on_terminal

from linkwright.words.characters import aligned, aligned_within, cells, folded, folded_lines

CODES = re.compile("\x1b\\[[0-9;]*m")


@pytest.mark.parametrize("language", ["en", "zh"])
@pytest.mark.parametrize(
    "command",
    [
        ["metrics", "gallery:jaw_crusher_sixbar"],
        ["metrics", "gallery:theo_jansen_leg"],
        ["solve", "gallery:slider_crank_inline"],
        ["check", "gallery:planetary_two_inputs"],
        ["study", "gallery:jaw_crusher_sixbar", "--vary", "pitman.length=1.2..1.3 m:3"],
        ["compare", "gallery:jaw_crusher_sixbar", "gallery:jaw_crusher_fourbar"],
        ["structure", "gallery:jaw_crusher_sixbar"],
        ["structure", "gallery:planetary_two_inputs"],
        ["validate", "--case", "crusher"],
        ["gallery", "list"],
        ["tolerance", "gallery:pressed_pins"],
        ["statistics", "gallery:shaft_diameters"],
        ["--help"],
    ],
    ids=" ".join,
)
def test_lines_fit_a_terminal_of_80_columns(command: list[str], language: str) -> None:
    shown = CODES.sub("", on_terminal([*command, "--lang", language], COLUMNS="80"))
    assert shown.strip()
    assert [line for line in shown.split("\n") if cells(line) > 80] == []


def test_folding_loses_nothing() -> None:
    narrow = CODES.sub("", on_terminal(["metrics", "gallery:jaw_crusher_sixbar"], COLUMNS="80"))
    wide = CODES.sub("", on_terminal(["metrics", "gallery:jaw_crusher_sixbar"], COLUMNS="200"))
    assert sorted("".join(narrow.split())) == sorted("".join(wide.split()))


def test_a_pipe_has_whole_lines() -> None:
    """So that rows can be searched, whatever COLUMNS says."""
    shown = subprocess.run(
        [sys.executable, "-m", "linkwright", "solve", "gallery:jaw_crusher_sixbar", "--steps", "12"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    (line,) = [each for each in shown.split("\n") if each.startswith("Left out for width")]
    assert line.endswith("columns.")


def test_data_are_never_folded() -> None:
    shown = on_terminal(["gallery", "show", "jaw_crusher_sixbar"], COLUMNS="40")
    assert max(map(len, shown.split("\n"))) > 100


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
