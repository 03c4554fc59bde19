"""The commands, one module each, imported only when the command is called.

A module ``NAME`` has ``arguments(option)``, which declares its options, and ``run(options, session)``, which
returns the exit code; it may have ``surplus(word)``, what to write for a word that it does not take. Its help says
``SUMMARY`` (one line for the list of commands), ``DESCRIPTION`` and ``EXAMPLES``. The commands ``PARTS`` have help
alone, in :mod:`linkwright.cli.part`.
"""

from __future__ import annotations

import argparse
import importlib
from typing import Protocol, cast

from linkwright.cli.parser import Options
from linkwright.cli.session import Session
from linkwright.core.entry_points import modules_within
from linkwright.words import Message

#: Commands that solve the file of a machine part and do nothing else.
PARTS = ("beam", "program", "statistics", "trajectory", "vibration")


class Command(Protocol):
    """What a command's module has."""

    @property
    def SUMMARY(self) -> Message:
        """What it does, in one line."""

    @property
    def DESCRIPTION(self) -> Message:
        """What it does, in one paragraph."""

    @property
    def EXAMPLES(self) -> str:
        """Commands that do something."""

    def arguments(self, option: Options) -> None:
        """Declares the command's own options."""

    def run(self, options: argparse.Namespace, session: Session) -> int:
        """Does the work and returns the exit code."""


def names() -> tuple[str, ...]:
    """Names of all commands, without importing any."""
    return tuple(sorted([*modules_within(__path__), *PARTS]))


def command(name: str) -> Command:
    """The module of a command, or what does its work."""
    if name in PARTS:
        from linkwright.cli.part import PART_COMMANDS

        return PART_COMMANDS[name]
    return cast(Command, importlib.import_module(f"{__name__}.{name}"))
