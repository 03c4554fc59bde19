"""``linkwright trajectory``: a thrown particle, and the load on a swinging conveyor."""

from __future__ import annotations

import argparse

from linkwright.cli.part import kinds_of, part_arguments, run_part
from linkwright.cli.session import Session
from linkwright.words import Say


def arguments(parser: argparse.ArgumentParser, say: Say) -> None:
    """The command's options."""
    part_arguments(parser, say)


def run(options: argparse.Namespace, session: Session) -> int:
    """Solves the file's problem."""
    return run_part(options, session, kinds_of("trajectory"))
