"""``linkwright completion``: the script with which a shell completes commands, options and models."""

from __future__ import annotations

import argparse

from linkwright.cli.parser import Options
from linkwright.cli.session import Session
from linkwright.cli.shells import SHELLS, script


def arguments(option: Options) -> None:
    option("shell", "|".join(SHELLS), choices=SHELLS)


def run(options: argparse.Namespace, session: Session) -> int:
    """Prints the script."""
    session.show_as_is(script(options.shell, session.say).rstrip())
    return 0
