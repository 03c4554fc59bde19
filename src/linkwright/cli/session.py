"""What a command knows about where it runs: language, form of the output, terminal, progress of long work."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, cast

from rich.console import Console, Group, RenderableType
from rich.table import Table as Columns
from rich.text import Text

from linkwright.cli.errors import OutputError
from linkwright.core.progress import Progress, reporting
from linkwright.errors import Finding, LinkwrightError
from linkwright.words import Message, Translate, _
from linkwright.words.characters import terminal_text
from linkwright.words.message import in_language, reason_of

if TYPE_CHECKING:
    from linkwright.core.table import Table, Tabular


#: Width of tables where there is no terminal, as in a pipe or a file.
PIPE_WIDTH = 100
STYLES = {"error": "red", "warning": "yellow", "note": "cyan"}
_SIDES: dict[str, Literal["left", "right", "center"]] = {"<": "left", ">": "right", "^": "center"}


class Session:
    """``translate`` gives words in the chosen language, ``json`` asks for data, ``debug`` for tracebacks."""

    def __init__(
        self, translate: Translate, language: str = "en", *, json: bool = False, debug: bool = False
    ) -> None:
        self.translate, self.language, self.json, self.debug = translate, language, json, debug

    @cached_property
    def output(self) -> Console:
        """The standard output."""
        return _console(stderr=False)

    @cached_property
    def errors(self) -> Console:
        """The standard error, for what is not part of the result."""
        return _console(stderr=True)

    def show(self, *lines: str | Text) -> None:
        """Prints sentences and tables; raises OutputError where the standard output is full or closed.

        On a terminal they are wrapped to its width; elsewhere every line is as long as it is.
        """
        self._print(Text("\n").join(each if isinstance(each, Text) else plain(each) for each in lines or [""]))

    def show_as_is(self, text: str) -> None:
        """Prints a file or data without wrapping; raises OutputError where the output is full or closed."""
        with _writing():
            print(terminal_text(text), file=sys.stdout)

    def show_data(self, value: object) -> None:
        """Prints plain data and arrays as JSON."""
        from linkwright.core.data import json_text

        self.show_as_is(json_text(value))

    def show_tables(self, found: Tabular, **options: Any) -> None:
        """Prints the tables of a result; on a terminal in its width, the title bold and warnings yellow."""
        if not self.output.is_terminal:
            self.show(found.text(self.language, **options))
            return
        for number, table in enumerate(found.tables(self.language, **options)):
            self._print(Group(*([Text("")] if number else []), *self._parts(table, first=not number)))

    def show_result(
        self,
        found: Tabular,
        *written: object,
        text: str = "",
        data: Mapping[str, object] | None = None,
        spaced: bool = True,
        **options: Any,
    ) -> None:
        """Prints a result (``options``: of its tables) or ``text`` in its place, and which files were written; with
        ``json`` its data, and ``data``."""
        if self.json:
            self.show_data({"ok": True, **found.data(), **(data or {})})
            return
        if text:
            self.show(text)
        else:
            self.show_tables(found, **options)
        self.show_written(*written, spaced=spaced)

    def show_written(self, *paths: object, spaced: bool = False, data: object = None) -> None:
        """Names the files that were written, but for those that are None; ``spaced``: each behind an empty line;
        ``data``: what is printed instead with ``json``."""
        if self.json and data is not None:
            self.show_data(data)
            return
        for path in paths:
            if path is not None:
                self.show("\n" * spaced + self.translate(_("written: {path}", path=path)))

    def flush(self) -> None:
        """Flushes the standard output; raises OutputError where that fails."""
        with _writing():
            sys.stdout.flush()

    def tell(self, text: str | Text) -> None:
        """Prints to the standard error: what is not part of the result."""
        with suppress(OSError):
            styled = plain(text) if isinstance(text, str) else text
            self.errors.print(styled, soft_wrap=not self.errors.is_terminal)

    def tell_error(self, sentence: str) -> None:
        """Prints an error to the standard error."""
        head = self.translate(_("error"))
        styled = plain(self.translate(_("{head}: {sentence}", head=head, sentence=sentence)))
        styled.stylize(STYLES["error"], 0, len(head))
        self.tell(styled)

    def tell_unmet(self, error: LinkwrightError, nearest: Tabular | None) -> None:
        """Prints why a demand cannot be met; with ``json`` also what comes nearest."""
        sentence = error.translate(self.language)
        self.tell_error(sentence)
        if self.json:
            self.show_data({"ok": False, "error": sentence, "nearest": None if nearest is None else nearest.data()})

    @property
    def width(self) -> int:
        """Columns that a table may take."""
        return self.output.width if self.output.is_terminal or "COLUMNS" in os.environ else PIPE_WIDTH

    def finding(self, found: Finding) -> Text:
        """A finding in the chosen language: the place bold, the rest by its severity."""
        styled = plain(found.translate(self.language))
        place = "".join(f"{part}: " for part in (found.where, found.key) if part)
        styled.stylize("bold", 0, len(place.rstrip()))
        styled.stylize(STYLES[found.severity], len(place))
        return styled

    def _parts(self, table: Table, *, first: bool) -> Iterator[RenderableType]:
        """A table as rich prints it: title, columns within the terminal, notes."""
        title, notes = (in_language(table.title, self.language), [in_language(n, self.language) for n in table.notes])
        head, *rows = table.texts(self.language)
        if title:
            yield plain(title, "bold" if first else "")
            yield from [Text("")] if head else []
        if rows:
            lines = [head, *rows] if head else rows
            yield grid(lines, table.alignment, indent=0 if head else 2, heads=bool(head))
            yield from [Text("")] if head and notes else []
        yield from styled_lines(notes)

    def _print(self, shown: RenderableType) -> None:
        with _writing():
            self.output.print(shown, soft_wrap=not self.output.is_terminal)


def grid(rows: Sequence[Sequence[str]], align: str, *, indent: int = 0, heads: int = 0) -> Columns:
    """Rows in columns with two spaces between; a narrow terminal wraps texts, but not numbers."""
    table = Columns.grid(padding=(0, 2, 0, 0), pad_edge=False)
    for side in align:
        table.add_column(justify=_SIDES[side], no_wrap=side == ">", overflow="fold")
    for number, row in enumerate(rows):
        cells = (plain(" " * indent * (not i) + cell) for i, cell in enumerate(row))
        table.add_row(*cells, style="bold" if number < heads else None)
    return table


def plain(text: str, style: str = "") -> Text:
    """A text without what no terminal should get."""
    return Text(terminal_text(text), style)


def bold(text: str) -> Text:
    """A text that is bold on a terminal."""
    return plain(text, "bold")


def styled_lines(lines: Sequence[str], heads: int = 0) -> list[Text]:
    """Lines of a table: the first ones bold, and those that begin with ! yellow."""
    return [
        plain(line, "bold" if k < heads else STYLES["warning"] if line.startswith("!") else "")
        for k, line in enumerate(lines)
    ]


class _Console(Console):
    """A console that leaves a reader who went away to the program."""

    def on_broken_pipe(self) -> None:
        raise  # noqa: PLE0704


def _console(*, stderr: bool) -> Console:
    colours = None if os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb" else "auto"
    return _Console(stderr=stderr, color_system=cast(Any, colours), highlight=False, markup=False, emoji=False)


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


@contextmanager
def progress(session: Session, what: Message) -> Iterator[Progress | None]:
    """A function that is called with (done, total) and moves a bar with the remaining time; None where there is no
    terminal. All long work within the block calls it as well. The bar is removed at the end."""
    console = session.errors
    if not console.is_terminal:
        yield None
        return
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeRemainingColumn
    from rich.progress import Progress as Bar

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Bar(*columns, console=console, transient=True, redirect_stdout=False) as bar:
        task = bar.add_task(session.translate(what), total=None)

        def report(done: int, total: int) -> None:
            if done < bar.tasks[0].completed:  # the next one of several pieces of work
                bar.reset(task, total=total)
            bar.update(task, completed=done, total=total)
            if done >= total:
                bar.stop()  # the result may be printed now
            elif not bar.live.is_started:
                bar.start()

        with reporting(report):
            yield report


@contextmanager
def resumable(state: str | None, name: str, inputs: Iterable[object], session: Session) -> Iterator[Progress | None]:
    """Work with a bar whose finished parts are stored in ``state``; an interruption names the file to resume from."""
    from linkwright.designs.checkpoints import RESUME, Interrupted, checkpointing

    try:
        with (
            progress(session, _("computing designs")) as report,
            checkpointing(state, name, *inputs, progress=report),
        ):
            yield report
    except Interrupted as stopped:
        session.tell(session.translate(RESUME.format(path=stopped.state)))
        raise
