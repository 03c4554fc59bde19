"""Commands are found by their files."""

import re
import sys
from pathlib import Path

import pytest

from linkwright import words
from linkwright.cli import commands, main


def test_a_command_is_added_by_files_alone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "greet.py").write_text(
        "def arguments(option):\n    option('who')\n"
        "def run(options, session):\n    session.show(session.say('greet.hello', who=options.who))\n    return 0\n"
    )
    package = __import__("linkwright.words.en", fromlist=["x"])
    folder = tmp_path / "en"
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
