"""The options of a command as they are declared, and its help in the user's language."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence

from linkwright.cli.reading import read
from linkwright.words import Say


class CommandParser(argparse.ArgumentParser):
    """The declared options of a command and its help; ``reading`` takes the words apart."""

    _columns = 80

    def __init__(self, prog: str, say: Say, *, description: str = "", epilog: str = "") -> None:
        super().__init__(
            prog=prog,
            description=description,
            epilog=epilog,
            add_help=False,
            allow_abbrev=False,
            formatter_class=self._formatter,
        )
        self.say = say
        self._positionals.title = say("cli.arguments")
        self._optionals.title = say("cli.options")

    def read(self, arguments: Sequence[str]) -> argparse.Namespace:
        """The options; raises UsageError for what is wrong with them."""
        return read(self, arguments)

    def _formatter(self, prog: str) -> argparse.HelpFormatter:
        return argparse.RawDescriptionHelpFormatter(prog, width=self._columns - 2)

    def format_usage(self) -> str:
        """The line of usage, headed in the user's language."""
        return self._headed(super().format_usage())

    def format_help(self) -> str:
        """The help, headed in the user's language, as wide as the terminal."""
        from shutil import get_terminal_size

        self._columns = get_terminal_size().columns
        return self._headed(super().format_help())

    def _headed(self, text: str) -> str:
        return self.say("cli.usage") + text.removeprefix("usage: ")


def nearest_of(word: str, known: Sequence[str]) -> str | None:
    """The known word nearest to a mistyped one."""
    from linkwright.registry import nearest

    return nearest(word, list(known))


def whole_number(text: str) -> int:
    """A number of steps, 1 or more."""
    number = int(text)
    if number < 1:
        raise ValueError(text)
    return number


def number_of(text: str) -> float:
    """The number of a text; NaN where it is none."""
    try:
        return float(text)
    except ValueError:
        return math.nan


def add_common(parser: argparse.ArgumentParser, say: Say) -> None:
    """Options that every command has."""
    group = parser.add_argument_group(say("cli.common"))
    group.add_argument("--json", action="store_true", help=say("cli.json_help"))
    group.add_argument("--lang", metavar="en|zh", help=say("cli.lang_help"))
    group.add_argument("--debug", action="store_true", help=say("cli.debug_help"))
    group.add_argument("-h", "--help", action="store_true", help=say("cli.help_help"))
