"""Completion: bash is asked as it asks; the other scripts hold every command and option."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from tests.cli.commands import is_refused, shown
from tests.every import every

from linkwright import words
from linkwright.cli import commands

BASH = shutil.which("bash")


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
def test_bash_completes_commands_options_choices_files_and_models(tmp_path: Path) -> None:
    (tmp_path / "press.yaml").write_text("format: 1\n")
    script = shown("completion", "bash")
    expected = {name for name in commands.names() if name.startswith("st")}
    assert {"structure", "study"} <= expected
    assert completed(script, "linkwright st", tmp_path) == expected
    assert completed(script, "linkwright solve --ste", tmp_path) == {"--steps"}
    assert completed(script, "linkwright study --sampling ", tmp_path) == {"grid", "sobol"}
    assert completed(script, "linkwright solve x.yaml --lang ", tmp_path) == {"en", "zh"}
    assert completed(script, "linkwright solve pr", tmp_path) == {"press.yaml"}
    assert completed(script, "linkwright draw gallery:jaw_crusher_f", tmp_path) == {"jaw_crusher_fourbar"}


def options_of(name: str) -> set[str]:
    """The options that the help of a command lists."""
    listed = re.findall(r"^  (-.*?)(?:  |$)", shown("help", name), re.MULTILINE)
    return {word for line in listed for word in re.findall(r"(?<![\w-])--?[a-z][a-z-]*", line)}


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_every_command_and_option_is_in_the_script(shell: str) -> None:
    script = shown("completion", shell)
    for name in every(commands.names(), least=30):
        assert name in script
        for word in every(options_of(name), least=5):
            dash = "-l" if word.startswith("--") else "-s"
            spelled = f"{dash} {word.lstrip('-')}" if shell == "fish" else word
            assert spelled in script, (name, word)


def test_fish_says_what_a_command_does_in_the_language() -> None:
    for language in words.LANGUAGES:
        script = shown("completion", "fish", "--lang", language)
        for name in every(commands.names()):
            summary = commands.command(name).SUMMARY.translate(language).replace("'", "\\'")
            assert f"-a {name} -d '{summary}'" in script


def test_an_unknown_shell_is_refused() -> None:
    is_refused(["completion", "tcsh"], "cli.bad_choice", value="tcsh", choices={"bash", "zsh", "fish"})
