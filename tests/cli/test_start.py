"""What is there before any model: start page, help, versions, slips in names, exit codes."""

import json
import re
import sys
from pathlib import Path

import pytest

import linkwright
from linkwright import words
from linkwright.cli import commands, main


def test_bare_command_offers_three_commands_that_work(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([]) == 0
    shown = capsys.readouterr().out
    offered = [line.split("  ")[0] for line in shown.split("\n  linkwright ")[1:]]
    assert len(offered) == 3
    for line in offered:
        assert main(line.split("\n")[0].split()) == 0


@pytest.mark.parametrize("asked", [["--help"], ["-h"], ["help"]])
def test_help_lists_every_command(asked: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(asked) == 0
    shown = capsys.readouterr().out
    for name in commands.names():
        assert f"  {name} " in shown
    for code in ("0 ", "1 ", "2 ", "130 "):
        assert f"\n  {code}" in shown


@pytest.mark.parametrize("language", words.LANGUAGES)
@pytest.mark.parametrize("name", commands.names())
def test_help_of_a_command_has_examples_and_exit_codes(
    name: str, language: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["help", name, "--lang", language]) == 0
    shown = capsys.readouterr().out
    assert f"linkwright {name}" in shown
    assert words.say("cli.examples", language) in shown
    assert words.say("cli.exit_codes", language).splitlines()[-1] in shown


def test_version_says_whether_compiled_evaluation_is_there(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert main(["--version"]) == 0
    there = capsys.readouterr().out
    assert there.startswith(f"linkwright {linkwright.__version__}\n")
    monkeypatch.setattr("linkwright.cli.help.find_spec", lambda name: None)
    assert main(["--version"]) == 0
    assert "llvmlite is not installed" in capsys.readouterr().out
    assert main(["--version", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["llvmlite"] is None


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["sovle", "x.yaml"], 'no command "sovle"; did you mean "solve"?'),
        (["solve", "gallery:crank_rocker", "--step", "3"], 'no option "--step"; did you mean "--steps"?'),
        (["solve"], "FILE is missing"),
        (["solve", "gallery:crank_rokcer"], 'did you mean "gallery:crank_rocker"?'),
        (["solve", "gallery:crank_rocker", "--steps", "0"], 'whole number, not "0"'),
        (["solve", "gallery:crank_rocker", "--steps"], "--steps needs a value"),
        (["solve", "gallery:crank_rocker", "--steps", "3", "--at", "0 deg"], "cannot be used together"),
        (["solve", "gallery:crank_rocker", "--static", "--no-forces"], "cannot be used together"),
        (["structure", "gallery:kite", "more"], 'argument "more" is not expected'),
        (["gallery", "lst"], 'did you mean "gallery list"?'),
        (["gallery", "show", "kiet"], 'did you mean "kite"?'),
        (["gallery", "copy"], "which one?"),
        (["--lang", "de"], 'no language "de"'),
        (["--lang"], "--lang needs a value"),
        (["--verson"], 'did you mean "--version"?'),
    ],
)
def test_slips_are_named_in_one_sentence(
    arguments: list[str], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(arguments) == 2
    shown = capsys.readouterr()
    assert sentence in shown.err
    assert shown.err.count("\n") == 1
    assert shown.out == ""


def test_a_file_name_with_a_slip_offers_the_nearest(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "crusher.yaml").write_text("format: 1\n")
    assert main(["solve", str(tmp_path / "crasher.yaml")]) == 2
    assert 'did you mean "crusher.yaml"?' in capsys.readouterr().err


def test_an_unexpected_error_is_one_sentence_and_a_traceback_only_on_request(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(source: str) -> None:
        raise ZeroDivisionError("of what")

    monkeypatch.setattr("linkwright.cli.source.read_source", broken)
    assert main(["structure", "gallery:kite"]) == 1
    plain = capsys.readouterr().err
    assert "ZeroDivisionError: of what" in plain and "report" in plain and "Traceback" not in plain
    assert main(["structure", "gallery:kite", "--debug"]) == 1
    assert "Traceback" in capsys.readouterr().err


def test_interrupted_work_ends_with_130(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(source: str) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("linkwright.cli.source.read_source", interrupted)
    assert main(["structure", "gallery:kite"]) == 130
    assert capsys.readouterr().err == "interrupted\n"


def test_language_from_the_environment(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LINKWRIGHT_LANG", "zh")
    main(["gallery", "show", "kiet"])
    assert capsys.readouterr().err == "错误：机构库中没有“kiet”；是不是“kite”？\n"
    main(["gallery", "show", "kiet", "--lang=en"])
    assert capsys.readouterr().err.startswith("error: ")


def test_a_command_is_added_by_files_alone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "greet.py").write_text(
        "def arguments(option):\n    option('who')\n"
        "def run(options, session):\n    session.show(session.say('greet.hello', who=options.who))\n    return 0\n"
    )
    for language in words.LANGUAGES:
        package = __import__(f"linkwright.words.{language}", fromlist=["x"])
        folder = tmp_path / language
        folder.mkdir()
        text = {
            "summary": "greets",
            "description": "d",
            "examples": "e",
            "who_help": "w",
            "hello": "hello {who}",
        }
        (folder / "greet.py").write_text(f"WORDS = {text!r}\n")
        monkeypatch.setattr(package, "__path__", [*package.__path__, str(folder)])
    monkeypatch.setattr(commands, "__path__", [*commands.__path__, str(tmp_path)])
    assert main(["--help"]) == 0
    assert re.search(r"\n  greet +greets\n", capsys.readouterr().out)
    assert "linkwright.cli.commands.greet" not in sys.modules
    assert main(["greet", "world"]) == 0
    assert capsys.readouterr().out == "hello world\n"
    monkeypatch.delitem(sys.modules, "linkwright.cli.commands.greet")
    words.catalogue.cache_clear()
