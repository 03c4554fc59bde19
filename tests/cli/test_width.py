"""On a terminal sentences and tables take its width; in a pipe and in files lines are whole."""

import re

import pytest
from tests.cli.commands import on_terminal, shown
from tests.cli.tables import widest, width

CODES = re.compile("\x1b\\[[0-9;]*m")


@pytest.mark.rotating
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
    printed = CODES.sub("", on_terminal(*command, "--lang", language, columns=80))
    assert printed.strip()
    assert [line for line in printed.split("\n") if width(line) > 80] == []


def test_folding_loses_nothing() -> None:
    narrow, wide = (
        CODES.sub("", on_terminal("metrics", "gallery:jaw_crusher_sixbar", columns=columns)) for columns in (80, 200)
    )
    assert widest(narrow.splitlines()) <= 80 < widest(wide.splitlines())
    assert sorted("".join(narrow.split())) == sorted("".join(wide.split()))


def test_a_pipe_has_whole_lines(monkeypatch: pytest.MonkeyPatch) -> None:
    """So that rows can be searched, whatever COLUMNS says."""
    monkeypatch.setenv("COLUMNS", "60")
    asked = ["solve", "gallery:jaw_crusher_sixbar", "--steps", "12"]
    (line,) = [each for each in shown(*asked).split("\n") if "--columns" in each]
    assert width(line) > 60 and "--output" in line
    assert not [each for each in on_terminal(*asked, columns=60).split("\n") if width(each) > 60]


def test_data_are_never_folded() -> None:
    printed = on_terminal("gallery", "show", "jaw_crusher_sixbar", columns=40)
    assert printed == shown("gallery", "show", "jaw_crusher_sixbar")
    assert widest(printed.split("\n")) > 100
