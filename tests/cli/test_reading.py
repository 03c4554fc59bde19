"""How the words of a command are taken apart: files after lists, values with a minus, slips."""

import argparse

import pytest

from linkwright.cli.errors import UsageError
from linkwright.cli.help import command_parser
from linkwright.words import speaker


def options(command: str, *words: str) -> argparse.Namespace:
    return command_parser(command, speaker("en")).read(words)


def refusal(command: str, *words: str) -> str:
    with pytest.raises(UsageError) as caught:
        options(command, *words)
    assert caught.value.say("zh") != str(caught.value)
    return str(caught.value)


def test_the_file_may_follow_a_list_as_usage_shows_it() -> None:
    found = options("study", "--vary", "a=1..2", "b=3..4", "model")
    assert (found.vary, found.file) == (["a=1..2", "b=3..4"], "model")
    found = options("study", "--vary", "a=1..2", "b=3..4", "--metrics", "travel", "x.yaml", "--steps", "8")
    assert (found.vary, found.metrics, found.file, found.steps) == (
        ["a=1..2", "b=3..4"],
        ["travel"],
        "x.yaml",
        8,
    )
    found = options("study", "--vary", "a=1..2", "gallery:kite", "--metrics", "travel", "flywheel")
    assert (found.vary, found.metrics, found.file) == (["a=1..2"], ["travel", "flywheel"], "gallery:kite")


def test_several_files_may_follow_a_list() -> None:
    found = options("compare", "--metrics", "travel", "flywheel", "a.yaml", "gallery:kite")
    assert (found.metrics, found.files) == (["travel", "flywheel"], ["a.yaml", "gallery:kite"])
    found = options("compare", "a.yaml", "--of", "jaw", "ram", "b.yaml")
    assert (found.of, sorted(found.files)) == (["jaw", "ram"], ["a.yaml", "b.yaml"])


def test_a_list_keeps_what_is_no_file() -> None:
    found = options("study", "model", "--vary", "a=1..2", "b=3..4")
    assert (found.vary, found.file) == (["a=1..2", "b=3..4"], "model")
    found = options("draw", "m.yaml", "--forces", "--output", "a.svg")
    assert (found.forces, found.file) == ([], "m.yaml")
    found = options("draw", "--output", "a.svg", "--forces", "m.yaml")
    assert (found.forces, found.file) == ([], "m.yaml")
    assert "FILE is missing" in refusal("study", "--vary", "a=1..2")


def test_values_may_begin_with_a_minus() -> None:
    assert options("solve", "m.yaml", "--at", "-30deg").at == ["-30deg"]
    assert options("solve", "m.yaml", "--at=-30deg").at == ["-30deg"]
    assert options("solve", "--at", "-.5 rad", "--", "-m.yaml").file == "-m.yaml"


def test_switches() -> None:
    assert options("solve", "m").forces is None
    assert options("solve", "m", "--forces").forces is True
    assert options("solve", "m", "--no-forces").forces is False
    assert options("solve", "m", "--force").force is True


@pytest.mark.parametrize(
    ("command", "words", "sentence"),
    [
        (
            "solve",
            ["m", "--steps", "2.5"],
            '--steps takes a whole number, not "2.5"; see linkwright solve --help',
        ),
        ("solve", ["m", "--steps", "0"], '--steps takes a whole number, not "0"'),
        ("study", ["m", "--vary", "a=1", "--fluctuation", "x"], '--fluctuation takes a number, not "x"'),
        ("solve", ["m", "--force=yes"], "--force takes no value"),
        ("solve", ["m", "--times"], "--times needs a value"),
        ("study", ["m", "--vary"], "--vary needs a value"),
        ("study", ["m"], "--vary is missing"),
        ("study", ["m", "--vary", "a=1", "--sampling", "lhs"], '"lhs"; choose from grid, sobol'),
        ("solve", ["m", "--times", "1 s", "--at", "0 deg"], "--at cannot be used together with --times"),
        ("solve", ["m", "n"], 'the argument "n" is not expected here'),
        ("solve", ["m", "--colums", "x"], 'there is no option "--colums"; did you mean "--columns"?'),
        ("solve", ["m", "-x"], 'there is no option "-x"; see linkwright solve --help'),
    ],
)
def test_slips(command: str, words: list[str], sentence: str) -> None:
    assert sentence in refusal(command, *words)


def test_every_declared_option_can_be_read() -> None:
    """No action of argparse is declared that the reader does not know."""
    from linkwright.cli import commands

    known = {"_StoreAction", "_StoreTrueAction", "BooleanOptionalAction"}
    for name in commands.names():
        parser = command_parser(name, speaker("en"))
        assert {type(action).__name__ for action in parser._actions} <= known, name


@pytest.mark.parametrize(
    ("command", "word", "remedy"),
    [
        ("metrics", "stroke", "write --names stroke"),
        ("solve", "30deg", "write --at 30deg"),
        ("draw", "out.svg", "write --output out.svg"),
        ("tolerance", "strok", "of: [stroke]"),
        ("sweep", "strok", "see linkwright sweep --help"),
    ],
)
def test_a_word_without_its_option_is_told_what_to_write(command: str, word: str, remedy: str) -> None:
    told = refusal(command, "gallery:crank_rocker", word)
    assert f'the argument "{word}" is not expected here' in told and remedy in told
