"""Completion: bash is asked as it asks; the other scripts hold every command and option."""

import shutil
import subprocess
from pathlib import Path

import pytest

from linkwright.cli import commands, main
from linkwright.cli.help import command_parser
from linkwright.cli.shells import SHELLS, options_of
from linkwright.words import speaker

BASH = shutil.which("bash")


def printed(shell: str, capsys: pytest.CaptureFixture[str]) -> str:
    assert main(["completion", shell]) == 0
    return capsys.readouterr().out


def completed(script: str, line: str, folder: Path) -> set[str]:
    """What bash offers for the last word of a line, its words split at colons as bash does."""
    asked = f"""
{script}
COMP_LINE={line!r}
COMP_POINT=${{#COMP_LINE}}
COMP_WORDS=({line.replace(":", " : ")}{" ''" if line.endswith(" ") else ""})
COMP_CWORD=$((${{#COMP_WORDS[@]}}-1))
_linkwright
printf '%s\\n' "${{COMPREPLY[@]}}"
"""
    assert BASH is not None
    done = subprocess.run([BASH, "-c", asked], capture_output=True, text=True, check=True, cwd=folder)
    assert done.stderr == ""
    return set(done.stdout.split())


@pytest.mark.skipif(BASH is None, reason="there is no bash")
def test_bash_completes_commands_options_choices_files_and_models(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (tmp_path / "press.yaml").write_text("format: 1\n")
    script = printed("bash", capsys)
    expected = {name for name in commands.names() if name.startswith("st")}
    assert {"structure", "study"} <= expected
    assert completed(script, "linkwright st", tmp_path) == expected
    assert completed(script, "linkwright solve --ste", tmp_path) == {"--steps"}
    assert completed(script, "linkwright study --sampling ", tmp_path) == {"grid", "sobol"}
    assert completed(script, "linkwright solve x.yaml --lang ", tmp_path) == {"en", "zh"}
    assert completed(script, "linkwright solve pr", tmp_path) == {"press.yaml"}
    assert completed(script, "linkwright draw gallery:jaw_crusher_f", tmp_path) == {"jaw_crusher_fourbar"}


@pytest.mark.parametrize("shell", SHELLS)
def test_every_command_and_option_is_in_the_script(shell: str, capsys: pytest.CaptureFixture[str]) -> None:
    script = printed(shell, capsys)
    for name in commands.names():
        assert name in script
        for option in options_of(command_parser(name, speaker("en"))):
            for word in option.names:
                spelled = (
                    word
                    if shell != "fish"
                    else f"-l {word[2:]}"
                    if word.startswith("--")
                    else f"-s {word[1:]}"
                )
                assert spelled in script, (name, word)


def test_fish_says_what_a_command_does_in_the_language(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["completion", "fish", "--lang", "zh"]) == 0
    assert "机构运动简图" in capsys.readouterr().out


def test_an_unknown_shell_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["completion", "tcsh"]) == 2
    assert '"tcsh"; choose from bash, zsh, fish' in capsys.readouterr().err
