"""``linkwright completion``: the script with which a shell completes commands, options and models."""

from __future__ import annotations

import argparse

from linkwright.cli.session import Session
from linkwright.cli.shells import SHELLS, script
from linkwright.words import Say


def arguments(parser: argparse.ArgumentParser, say: Say) -> None:
    """The command's options."""
    parser.add_argument("shell", metavar="|".join(SHELLS), choices=SHELLS, help=say("completion.shell_help"))


def run(options: argparse.Namespace, session: Session) -> int:
    """Prints the script."""
    session.show(script(options.shell, session.say).rstrip())
    return 0
