"""What a command knows about where it runs: language, form of the output, terminal."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

from linkwright.cli.errors import OutputError
from linkwright.errors import Finding
from linkwright.words import Say, _
from linkwright.words.characters import folded_lines, terminal_text
from linkwright.words.sentence import reason_of

if TYPE_CHECKING:
    from linkwright.core.table import Tabular

#: Width of tables where there is no terminal, as in a pipe or a file.
PIPE_WIDTH = 100
BOLD = "1"
#: Red, yellow, cyan.
COLOURS = {"error": "31", "warning": "33", "note": "36"}


@dataclass(frozen=True)
class Session:
    """``say`` gives words in the chosen language, ``json`` asks for data, ``force`` lets files be replaced."""

    say: Say
    language: str = "en"
    json: bool = False
    debug: bool = False

    def show(self, text: str = "") -> None:
        """Prints sentences and tables to the standard output, folded where that is a terminal.

        Raises OutputError where it is full or closed.
        """
        self.show_as_is(folded_lines(text, self.width) if sys.stdout.isatty() else text)

    def show_as_is(self, text: str) -> None:
        """Prints a file or data to the standard output; raises OutputError where that is full or closed."""
        with _writing():
            print(terminal_text(text), file=sys.stdout)

    def show_data(self, value: object) -> None:
        """Prints plain data and arrays as JSON."""
        from linkwright.core.json_data import json_text

        self.show_as_is(json_text(value))

    def show_result(
        self, found: Tabular, *written: object, text: str = "", apart: bool = True, **options: object
    ) -> None:
        """Prints a result (``options``: of its tables) or ``text`` in its place, the first line bold, and which files
        were written; with ``json`` its data."""
        if self.json:
            self.show_data({"ok": True, **found.data()})
            return
        title, *lines = (text or found.text(self.language, self.room, **options)).split("\n")
        self.show("\n".join([self.strong(title), *self.table(lines, heads=0)]))
        self.show_written(*written, apart=apart)

    def show_written(self, *paths: object, apart: bool = False) -> None:
        """Says which files were written, but for those that are None; ``apart``: each behind an empty line."""
        for path in paths:
            if path is not None:
                self.show("\n" * apart + self.say(_("written: {path}", path=path)))

    def flush(self) -> None:
        """Sees to it that everything shown is written."""
        with _writing():
            sys.stdout.flush()

    def tell(self, text: str) -> None:
        """Prints to the standard error: what is not part of the result."""
        with suppress(OSError):
            folds = folded_lines(text, self.width) if sys.stderr.isatty() else text
            print(terminal_text(folds), file=sys.stderr)

    def tell_error(self, sentence: str) -> None:
        """Prints an error to the standard error."""
        head = self.alarm(self.say(_("error")))
        self.tell(self.say(_("{head}: {sentence}", head=head, sentence=sentence)))

    @property
    def room(self) -> int | None:
        """Columns that a table must not leave; None where there is no terminal."""
        return self.width if sys.stdout.isatty() else None

    @property
    def width(self) -> int:
        """Columns that a table may take."""
        with suppress(KeyError, ValueError):
            if (told := int(os.environ["COLUMNS"])) > 0:
                return told
        with suppress(AttributeError, ValueError, OSError):  # no terminal, or none that tells
            return os.get_terminal_size(sys.__stdout__.fileno()).columns or PIPE_WIDTH  # type: ignore[union-attr]
        return PIPE_WIDTH

    def strong(self, text: str) -> str:
        """Bold text where the standard output is a terminal that wants it."""
        return _in(BOLD, text) if _coloured(sys.stdout.isatty()) else text

    def alarm(self, text: str) -> str:
        """Red text where the standard error is a terminal that wants it."""
        return _in(COLOURS["error"], text) if _coloured(sys.stderr.isatty()) else text

    def finding(self, found: Finding) -> str:
        """A finding in the chosen language; on a terminal the place bold, the rest by its severity."""
        said = found.say(self.language)
        if not _coloured(sys.stdout.isatty()):
            return said
        place = "".join(f"{part}: " for part in (found.where, found.key) if part)
        return (
            self.strong(place.rstrip()) + " " * bool(place) + _in(COLOURS[found.severity], said[len(place) :])
        )

    def table(self, lines: Sequence[str], heads: int = 1) -> list[str]:
        """Lines of a table, the first ``heads`` bold and those that begin with ! yellow on a terminal."""
        if not _coloured(sys.stdout.isatty()):
            return list(lines)
        body = (_in(COLOURS["warning"], line) if line.startswith("!") else line for line in lines[heads:])
        return [*map(self.strong, lines[:heads]), *body]


def _in(code: str, text: str) -> str:
    return f"\x1b[{code}m{text}\x1b[0m" if text else text


@contextmanager
def _writing() -> Iterator[None]:
    try:
        yield
    except BrokenPipeError:
        raise
    except OSError as problem:
        raise OutputError(
            _("the output cannot be written ({reason})", code="cli.output_lost", reason=reason_of(problem))
        ) from None


def _coloured(terminal: bool) -> bool:
    return terminal and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"
