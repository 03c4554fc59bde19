"""Completion: shells ask the program, as their scripts do."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from tests.cli.commands import is_refused, shown
from tests.every import every

from linkwright import words
from linkwright.cli import commands

BASH = shutil.which("bash")


def asked(shell: str, line: str, language: str = "en") -> str:
    """What the program answers to the script of a shell for the last word of a line."""
    *before, last = line.split(" ")
    environment = {
        **os.environ,
        "_LINKWRIGHT_COMPLETE": f"{shell}_complete",
        "LINKWRIGHT_LANG": language,
        "COMP_WORDS": line,
        "COMP_CWORD": last if shell == "fish" else str(len(before)),
    }
    done = subprocess.run(
        [sys.executable, "-m", "linkwright"], capture_output=True, text=True, check=False, env=environment
    )
    assert done.stderr == ""
    return done.stdout


def completed(line: str) -> set[str]:
    """The words that bash offers, files as ``FILE``."""
    answers = (each.partition(",") for each in asked("bash", line).splitlines())
    return {"FILE" if kind == "file" else word for kind, _comma, word in answers}


def test_commands_options_choices_files_and_models() -> None:
    expected = {name for name in commands.names() if name.startswith("st")}
    assert {"structure", "study"} <= expected
    assert completed("linkwright st") == expected
    assert completed("linkwright solve --ste") == {"--steps"}
    assert completed("linkwright study --sampling ") == {"grid", "sobol"}
    assert completed("linkwright solve x.yaml --lang ") == {"en", "zh"}
    assert completed("linkwright solve pr") == completed("linkwright solve x.yaml --output ") == {"FILE"}
    assert completed("linkwright draw gallery:jaw_crusher_f") == {"gallery:jaw_crusher_fourbar"}


@pytest.mark.skipif(BASH is None, reason="there is no bash")
def test_bash_takes_a_model_of_the_gallery_as_one_word(tmp_path: Path) -> None:
    program = tmp_path / "linkwright"
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m linkwright "$@"\n')
    program.chmod(0o755)
    script = f"""{shown("completion", "bash")}
COMP_WORDS=(linkwright draw gallery:jaw_crusher_f)
COMP_CWORD=2
_linkwright_completion "{program}"
printf '%s ' "$COMP_WORDBREAKS" "${{COMPREPLY[@]}}"
"""
    assert BASH is not None
    done = subprocess.run([BASH, "-c", script], capture_output=True, text=True, check=True)
    breaks, found = done.stdout.rsplit(maxsplit=1)
    assert (":" in breaks, found, done.stderr) == (False, "gallery:jaw_crusher_fourbar", "")


@pytest.mark.parametrize("language", words.LANGUAGES)
def test_help_of_completions_is_in_the_language(language: str) -> None:
    offered = asked("fish", "linkwright ", language)
    for name in every(commands.names(), least=30):
        assert f"plain,{name}\t{commands.command(name).summary.translate(language)}" in offered
    steps = next(each for each in commands.command("solve").params if each.name == "steps")
    assert str(getattr(steps, "help", "").translate(language)) in asked("fish", "linkwright solve --ste", language)


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_the_script_of_a_shell_asks_the_program(shell: str) -> None:
    assert f"_LINKWRIGHT_COMPLETE={shell}_complete" in shown("completion", shell)


def test_an_unknown_shell_is_refused() -> None:
    is_refused(["completion", "tcsh"], "cli.bad_choice", value="tcsh", choices={"bash", "zsh", "fish"})
