"""How the words of a command are taken apart: files after lists, values with a minus, slips."""

from types import SimpleNamespace

import pytest
from tests.refusals import refused

from linkwright.cli import commands
from linkwright.cli.errors import UsageError
from linkwright.cli.session import Session
from linkwright.errors import speaker


def options(command: str, *words: str) -> SimpleNamespace:
    made = commands.command(command)
    session = Session(speaker("en"))
    return SimpleNamespace(**made.make_context(f"linkwright {command}", [*words], obj=session).params)


def test_the_file_may_follow_a_list_as_usage_shows_it() -> None:
    found = options("study", "--vary", "a=1..2", "b=3..4", "model")
    assert (found.vary, found.file) == ({"a": "1..2", "b": "3..4"}, "model")
    found = options("study", "--vary", "a=1..2", "b=3..4", "--metrics", "travel", "x.yaml", "--steps", "8")
    assert (found.vary, found.metrics, found.file, found.steps) == (
        {"a": "1..2", "b": "3..4"},
        ["travel"],
        "x.yaml",
        8,
    )
    found = options("study", "--vary", "a=1..2", "gallery:kite", "--metrics", "travel", "flywheel")
    assert (found.vary, found.metrics, found.file) == ({"a": "1..2"}, ["travel", "flywheel"], "gallery:kite")


def test_several_files_may_follow_a_list() -> None:
    found = options("compare", "--metrics", "travel", "flywheel", "a.yaml", "gallery:kite")
    assert (found.metrics, [*found.files]) == (["travel", "flywheel"], ["a.yaml", "gallery:kite"])
    found = options("compare", "a.yaml", "--of", "jaw", "ram", "b.yaml")
    assert (found.of, sorted(found.files)) == (["jaw", "ram"], ["a.yaml", "b.yaml"])


def test_a_list_keeps_what_is_no_file() -> None:
    found = options("study", "model", "--vary", "a=1..2", "b=3..4")
    assert (found.vary, found.file) == ({"a": "1..2", "b": "3..4"}, "model")
    found = options("draw", "m.yaml", "--forces", "--output", "a.svg")
    assert (found.forces, found.file) == ([], "m.yaml")
    found = options("draw", "--output", "a.svg", "--forces", "m.yaml")
    assert (found.forces, found.file) == ([], "m.yaml")
    with refused("cli.missing", UsageError, names={"FILE"}):
        options("study", "--vary", "a=1..2")


def test_values_may_begin_with_a_minus() -> None:
    assert options("solve", "m.yaml", "--at", "-30deg").at == ["-30deg"]
    assert options("solve", "m.yaml", "--at=-30deg").at == ["-30deg"]
    assert options("solve", "--at", "-.5 rad", "--", "-m.yaml").file == "-m.yaml"


def test_switches() -> None:
    assert options("solve", "m").forces is None
    assert options("solve", "m", "--forces").forces is True
    assert options("solve", "m", "--no-forces").forces is False
    assert options("solve", "m", "--force").force is True


SLIPS: list[tuple[str, list[str], str, dict[str, object]]] = [
    ("solve", ["m", "--steps", "2.5"], "range", {"text": "2.5"}),
    ("solve", ["m", "--steps", "0"], "range", {"text": "0"}),
    ("study", ["m", "--vary", "a=1", "--fluctuation", "x"], "type", {"text": "x"}),
    ("solve", ["m", "--force=yes"], "cli.takes_no_value", {"name": "--force"}),
    ("solve", ["m", "--times"], "cli.needs_value", {"name": "--times"}),
    ("study", ["m", "--vary"], "cli.needs_value", {"name": "--vary"}),
    ("study", ["m"], "cli.missing", {"names": {"--vary"}}),
    ("study", ["m", "--vary", "a=1", "--sampling", "lhs"], "cli.bad_choice", {"choices": {"grid", "sobol"}}),
    ("solve", ["m", "--times", "1 s", "--at", "0 deg"], "cli.not_together", {"name": "--times", "other": "--at"}),
    ("solve", ["m", "n"], "cli.unknown_argument", {"name": "n"}),
    ("solve", ["m", "--colums", "x"], "cli.unknown_option", {"name": "--colums", "offer": "--columns"}),
    ("solve", ["m", "-x"], "cli.unknown_option", {"name": "-x", "command": "linkwright solve"}),
]


@pytest.mark.parametrize(("command", "words", "code", "values"), SLIPS)
def test_slips(command: str, words: list[str], code: str, values: dict[str, object]) -> None:
    with refused(code, UsageError, **values) as caught:
        options(command, *words)
    assert caught.value.translate("zh") != str(caught.value)


@pytest.mark.parametrize(
    ("command", "word", "remedy"),
    [
        ("metrics", "stroke", "--names stroke"),
        ("solve", "30deg", "--at 30deg"),
        ("draw", "out.svg", "--output out.svg"),
        ("tolerance", "strok", "of: [stroke]"),
        ("structure", "strok", "linkwright structure --help"),
    ],
)
def test_a_word_without_its_option_is_told_what_to_write(command: str, word: str, remedy: str) -> None:
    with refused("cli.unknown_argument", UsageError, name=word) as caught:
        options(command, "gallery:crank_rocker", word)
    assert remedy in str(caught.value)
