"""What is there before any model: start page, help, versions, slips in names, exit codes."""

import re
import sys
from pathlib import Path

import pytest
from tests.cli.commands import data, is_refused, run, shown
from tests.every import every

import linkwright
from linkwright import words
from linkwright.cli import commands, main
from linkwright.words import _


def test_bare_command_offers_three_commands_that_work() -> None:
    offered = [line.split("  ")[0] for line in shown().split("\n  linkwright ")[1:]]
    assert len(offered) == 3
    for line in offered:
        assert main(line.split("\n")[0].split()) == 0


@pytest.mark.parametrize("asked", [["--help"], ["-h"], ["help"]])
def test_help_lists_every_command(asked: list[str]) -> None:
    printed = shown(*asked)
    for name in every(commands.names(), least=30):
        assert f"  {name} " in printed
    for code in ("0 ", "1 ", "2 ", "130 "):
        assert f"\n  {code}" in printed


@pytest.mark.parametrize("language", words.LANGUAGES)
@pytest.mark.parametrize("name", commands.names())
def test_help_of_a_command_has_examples_and_exit_codes(name: str, language: str) -> None:
    printed = shown("help", name, "--lang", language)
    assert f"linkwright {name}" in printed
    assert _("examples").translate(language) in printed
    assert (
        _(
            "0    done, nothing to complain about\n"
            "1    an error in the model, or a position that cannot be reached\n"
            "2    the command itself is wrong: an unknown option, name or file\n"
            "130  interrupted"
        )
        .translate(language)
        .splitlines()[-1]
        in printed
    )


def test_version_says_whether_compiled_evaluation_is_there(monkeypatch: pytest.MonkeyPatch) -> None:
    first, second, third = shown("--version").splitlines()
    assert first == f"linkwright {linkwright.__version__}"
    assert "numpy" in second and third.startswith("llvmlite")
    assert re.fullmatch(r"\d+\.\d+\.\d+", data("--version")["llvmlite"])
    monkeypatch.setitem(sys.modules, "llvmlite", None)
    without = shown("--version").splitlines()[2]
    assert "llvmlite" in without and not re.search(r"\d", without)
    assert data("--version")["llvmlite"] is None


SLIPS: list[tuple[list[str], str, dict[str, object]]] = [
    (["sovle", "x.yaml"], "cli.unknown_command", {"name": "sovle", "offer": "solve"}),
    (["solve", "m", "--step", "3"], "cli.unknown_option", {"name": "--step", "offer": "--steps"}),
    (["solve"], "cli.missing", {"names": {"FILE"}}),
    (["solve", "gallery:crank_rokcer"], "no-file", {"name": "crank_rokcer"}),
    (["solve", "m", "--steps", "0"], "range", {"text": "0"}),
    (["solve", "m", "--steps"], "cli.needs_value", {"name": "--steps"}),
    (["solve", "m", "--steps", "3", "--at", "0 deg"], "cli.not_together", {"name": "--at", "other": "--steps"}),
    (
        ["solve", "gallery:crank_rocker", "--static", "--no-forces"],
        "cli.not_together",
        {"name": "--static", "other": "--no-forces"},
    ),
    (["structure", "gallery:kite", "more"], "cli.unknown_argument", {"name": "more"}),
    (["gallery", "lst"], "cli.bad_choice", {"offer": "list"}),
    (["gallery", "show", "kiet"], "gallery.unknown", {"name": "kiet", "offer": "kite"}),
    (["gallery", "copy"], "gallery.which", {"action": "copy"}),
    (["--verson"], "cli.unknown_option", {"offer": "--version"}),
    (["--lang", "de"], "cli.bad_choice", {"name": "--lang", "value": "de"}),
    (["--lang"], "cli.needs_value", {"name": "--lang"}),
]


@pytest.mark.parametrize(("arguments", "code", "values"), SLIPS)
def test_slips_are_named_in_one_sentence(arguments: list[str], code: str, values: dict[str, object]) -> None:
    assert "\n" not in str(is_refused(arguments, code, **values))


def test_data_of_a_refusal_have_its_code() -> None:
    slip = data("solve", "gallery:kite", "--steps", "0", code=2)
    assert (slip["ok"], slip["code"]) == (False, "range")
    assert [each["key"] for each in slip["findings"]] == ["--steps"]
    slip = data("solve", "gallery:kite", "--colums", "x", code=2)
    assert (slip["ok"], slip["code"], slip["findings"]) == (False, "cli.unknown_option", [])


@pytest.mark.parametrize(
    ("there", "asked"), [("crusher.yaml", "crasher.yaml"), (None, "gallery:crank_rokcer")], ids=["file", "gallery"]
)
def test_a_file_name_with_a_slip_offers_the_nearest(
    there: str | None, asked: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    if there:
        Path(there).write_text("format: 1\n")
    assert f'"{there or "gallery:crank_rocker"}"' in str(is_refused(["solve", asked], "no-file"))


def test_the_language_is_that_of_the_option_or_of_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    slip = ["gallery", "show", "kiet"]
    english, chinese = (_("error").translate(language) for language in ("en", "zh"))
    for arguments, environment, head in (
        ([], None, english),
        ([], "zh", chinese),
        (["--lang=en"], "zh", english),
        (["--lang", "zh"], None, chinese),
        ([], "de", english),
    ):
        if environment:
            monkeypatch.setenv("LINKWRIGHT_LANG", environment)
        else:
            monkeypatch.delenv("LINKWRIGHT_LANG", raising=False)
        ended = run(*slip, *arguments)
        assert ended.told is not None
        assert ended.err.startswith(head)
        assert ended.told.translate("en" if head == english else "zh") in ended.err
