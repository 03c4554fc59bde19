"""What a command knows about where it runs: language, form of the output, terminal."""

from __future__ import annotations

import os
import shutil
import sys
from dataclasses import dataclass

from linkwright.words import Say

#: Width of tables where there is no terminal, as in a pipe or a file.
PIPE_WIDTH = 100


@dataclass(frozen=True)
class Session:
    """``say`` gives words in the chosen language, ``json`` asks for data, ``force`` lets files be replaced."""

    say: Say
    language: str = "en"
    json: bool = False
    debug: bool = False

    def show(self, text: str = "") -> None:
        """Prints to the standard output."""
        print(text, file=sys.stdout)

    def tell(self, text: str) -> None:
        """Prints to the standard error: what is not part of the result."""
        print(text, file=sys.stderr)

    @property
    def width(self) -> int:
        """Columns that a table may take."""
        return shutil.get_terminal_size((PIPE_WIDTH, 24)).columns

    def strong(self, text: str) -> str:
        """Bold text where the standard output is a terminal that wants it."""
        return f"\x1b[1m{text}\x1b[0m" if _coloured(sys.stdout.isatty()) else text

    def alarm(self, text: str) -> str:
        """Red text where the standard error is a terminal that wants it."""
        return f"\x1b[31m{text}\x1b[0m" if _coloured(sys.stderr.isatty()) else text


def _coloured(terminal: bool) -> bool:
    return terminal and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"
