"""Commands are found by their files."""

import re
import sys
from pathlib import Path

import pytest

from linkwright.cli import commands, main


def test_a_command_is_added_by_files_alone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "greet.py").write_text(
        "from linkwright.cli.command import command\n"
        "from linkwright.cli.options import argument\n"
        "from linkwright.words import _\n"
        "@command(_('greets'), _('d'), 'e')\n"
        "@argument('who', 'WHO', help=_('w'))\n"
        "def run(options, session):\n    session.show(f'hello {options.who}')\n    return 0\n"
    )
    monkeypatch.setattr(commands, "__path__", [*commands.__path__, str(tmp_path)])
    assert main(["--help"]) == 0
    assert re.search(r"\n  greet +greets\n", capsys.readouterr().out)
    assert main(["greet", "world"]) == 0
    assert capsys.readouterr().out == "hello world\n"
    monkeypatch.delitem(sys.modules, "linkwright.cli.commands.greet")
