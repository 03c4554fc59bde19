"""Colour on a terminal that wants it, and nowhere else."""

from pathlib import Path

import pytest
from tests.cli.commands import data, on_terminal, shown
from tests.every import every

BOLD, RED, YELLOW, PLAIN = "\x1b[1m", "\x1b[31m", "\x1b[33m", "\x1b[0m"
FAULTY = """format: 1
name: faulty
frame: {points: {O: [0 m, 0 m]}}
parameters: {unused: 3 m}
links: {crank: {points: [O, A], lenght: 50 mm}}
"""


@pytest.fixture
def faulty(tmp_path: Path) -> str:
    path = tmp_path / "faulty.yaml"
    path.write_text(FAULTY, encoding="utf-8")
    return str(path)


def test_check_marks_places_and_severities(faulty: str) -> None:
    """Places bold, errors red, warnings yellow; without the marks it is what a pipe gets."""
    printed = on_terminal("check", faulty, columns=1000)
    (file,) = data("check", faulty, code=1)["files"]
    colours = {"error": RED, "warning": YELLOW}
    for found in every(file["findings"], least=2):
        place = ": ".join(part for part in (found["where"], found["key"]) if part)
        assert f"{BOLD}{place}:{PLAIN} {colours[found['severity']]}" in printed
    for mark in (BOLD, RED, YELLOW, PLAIN):
        printed = printed.replace(mark, "")
    assert printed == shown("check", faulty, code=1)


@pytest.mark.parametrize("variable", [{"NO_COLOR": "1"}, {"TERM": "dumb"}])
def test_no_colour_where_it_is_not_wanted(variable: dict[str, str], faulty: str) -> None:
    assert "\x1b" not in on_terminal("check", faulty, **variable)


def test_heads_of_tables_are_bold_and_warnings_yellow() -> None:
    _, table, warnings = on_terminal("metrics", "gallery:excavator").split("\n\n")
    assert [line.startswith(BOLD) for line in table.splitlines()[:3]] == [True, False, False]
    assert warnings.startswith(f"{YELLOW}! ")
    lines = on_terminal("solve", "gallery:crank_rocker").split("\n\n")[1].splitlines()
    bold = [line.startswith(BOLD) for line in lines]
    heads = bold.index(False)
    assert heads in (2, 3) and not any(bold[heads:])


def test_a_pipe_gets_no_colour(faulty: str) -> None:
    assert "\x1b" not in shown("check", faulty, code=1)
    assert "\x1b" not in shown("metrics", "gallery:excavator")
