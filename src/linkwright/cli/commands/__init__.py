"""The commands, one module each, imported only when the command is called.

A module ``NAME`` has ``run``, a function of options and session that returns the exit code, declared by
:func:`linkwright.cli.command.command`; where the name is a word of Python an
underscore follows. The commands ``PARTS`` are all in :mod:`linkwright.cli.part`.
"""

from __future__ import annotations

import importlib
from keyword import iskeyword
from typing import TYPE_CHECKING, cast

from linkwright.core.entry_points import modules_within

if TYPE_CHECKING:
    from linkwright.cli.command import Command

#: Commands that solve the file of a machine part and do nothing else.
PARTS = ("beam", "program", "statics", "statistics", "trajectory", "vibration")


def names() -> tuple[str, ...]:
    """Names of all commands, without importing any."""
    return tuple(sorted([*(each.removesuffix("_") for each in modules_within(__path__)), *PARTS]))


def command(name: str) -> Command:
    """A command by its name."""
    if name in PARTS:
        from linkwright.cli.part import PART_COMMANDS

        return PART_COMMANDS[name]
    module = f"{name}_" if iskeyword(name) else name
    return cast("Command", importlib.import_module(f"{__name__}.{module}").run)
