"""What README and its Chinese counterpart show as a command's output is what the command prints."""

import shlex

import pytest
from tests.every import every
from tests.files.documentation import ROOT, blocks

from linkwright.cli import main


@pytest.mark.parametrize("page", ["README.md", "docs/zh/index.md"])
def test_the_output_of_the_command_is_real(page: str, capsys: pytest.CaptureFixture[str]) -> None:
    for block in every(blocks(ROOT / page, "console")):
        command, shown = block.split("\n", 1)
        assert main(shlex.split(command)[2:]) == 0
        printed = [line.rstrip() for line in capsys.readouterr().out.splitlines()]
        assert shown.splitlines() == printed
