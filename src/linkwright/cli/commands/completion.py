"""``linkwright completion``: the script with which a shell completes commands, options and models."""

from __future__ import annotations

import argparse

from linkwright.cli.parser import Options
from linkwright.cli.session import Session
from linkwright.cli.shells import SHELLS, script
from linkwright.words import _

SUMMARY = _("shell completion: bash, zsh, fish")
DESCRIPTION = _(
    """\
Prints the script with which a shell completes commands, options, their choices,
files and the models of the gallery."""
)
EXAMPLES = """\
linkwright completion bash >> ~/.bashrc
linkwright completion zsh > ~/.zfunc/_linkwright
linkwright completion fish > ~/.config/fish/completions/linkwright.fish"""


def arguments(option: Options) -> None:
    option("shell", "|".join(SHELLS), choices=SHELLS, help=_("the shell"))


def run(options: argparse.Namespace, session: Session) -> int:
    """Prints the script."""
    session.show_as_is(script(options.shell, session.say).rstrip())
    return 0
