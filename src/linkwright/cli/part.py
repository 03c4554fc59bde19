"""What the commands for machine parts have in common: one file in, numbers, worked text, curves, a diagram."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from linkwright.cli.errors import UsageError
from linkwright.cli.parser import Options
from linkwright.cli.session import Session
from linkwright.files.calculations import COMMANDS
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.parts.base import Problem, Result

ENDINGS = (".csv", ".json")
#: Digits that numbers can be shown with.
DIGITS = range(3, 16)


def part_arguments(option: Options) -> None:
    """The options that all commands for machine parts have."""
    option = option.of("part")
    option("file", "FILE")
    option.flag("--worked")
    option("--digits", "N", type=int, choices=DIGITS, default=6)
    option("--plot", "FILE")
    option("--output", "FILE")
    option.fonts()
    option.force()


def run_part(options: argparse.Namespace, session: Session, command: str) -> int:
    """Reads a file of a kind that the command takes, solves it, and shows or writes what came out."""
    from linkwright.parts.file import solve

    refuse_outputs(options, session)
    show(solve(read(options.file, command, session), options.file), options, session)
    return 0


class PartCommand:
    """A command that solves a file of its kinds and does nothing else."""

    def __init__(self, name: str) -> None:
        self.name = name

    def arguments(self, option: Options) -> None:
        """The options that all commands for machine parts have."""
        part_arguments(option)

    def run(self, options: argparse.Namespace, session: Session) -> int:
        """Solves the file's problem."""
        return run_part(options, session, self.name)


def refuse_outputs(options: argparse.Namespace, session: Session) -> None:
    """Raises UsageError for files that could not be written, before any work is done."""
    from linkwright.cli.files import PICTURES, refuse_output

    refuse_output(options.output, ENDINGS, force=options.force)
    refuse_output(options.plot, PICTURES, force=options.force)


def read(source: str, command: str, session: Session) -> Problem:
    """The problem of a file; UsageError where its kind belongs to another command."""
    from linkwright.parts.file import GALLERY, kind_of, load
    from linkwright.words.titles import title_said

    kind = kind_of(source)
    if kind in COMMANDS and COMMANDS[kind] != command:
        raise UsageError(
            _(
                "the file is of kind {kind}; call: linkwright {command} {file}",
                code="part.other_command",
                kind=kind,
                command=COMMANDS[kind],
                file=source,
            )
        )
    problem = load(source)
    for each in problem.warnings:
        session.tell(session.finding(each))
    if source.startswith(GALLERY) and not session.json:
        title = title_said(problem.name, session.language)
        if title != problem.name:  # a copy finds again what the problem has found of itself
            return replace(problem, name=title)  # type: ignore[call-arg]
    return problem


def show(result: Result, options: argparse.Namespace, session: Session, *, kind: str | None = None) -> None:
    """Prints the result; writes its curves and its diagram (``kind``: another than its usual one) where asked."""
    from linkwright.cli.files import write_diagram, write_table
    from linkwright.core.table import csv_text

    def table() -> str:
        columns = result.columns()
        if not columns:
            raise UsageError(
                _(
                    "{path}: this result has no curves to write; choose an ending .json",
                    code="part.no_curves",
                    path=Path(options.output),
                )
            )
        return csv_text(columns)

    write_table(options.output, table, result.data, force=options.force)
    write_diagram(options.plot, result, session, force=options.force, kind=kind)
    language = session.language
    text = result.worked(language) if options.worked else result.text(language, options.digits)
    session.show_result(result, options.output, options.plot, text=text)
