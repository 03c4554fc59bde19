"""``linkwright solve``: motion and forces over a cycle."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from linkwright.cli.errors import UsageError
from linkwright.cli.parser import Options
from linkwright.cli.session import Session
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.cli.solving import Solved

ENDINGS = (".csv", ".json")


def arguments(option: Options) -> None:
    option.model()
    where = option.group("where_title").exclusive()
    where.count("--steps")
    where("--at", "INPUTS", nargs="+")
    where("--times", "TIMES", nargs="+")
    what = option.group("what_title")
    what("--columns", "PATTERN", nargs="+")
    what("--points", "POINT", nargs="+")
    what.either("--forces", None)
    what.flag("--static")
    what.flag("--mark")
    what.flag("--prove")
    what.flag("--worked", words="worked.help")
    form = option.group("form_title")
    form.flag("--si")
    form("--output", "FILE")
    form.force()


def run(options: argparse.Namespace, session: Session) -> int:
    """Solves a model and prints or writes the results; 1 where a position or the forces failed."""
    _refuse_contradictions(options)
    from linkwright.cli.solving import solve
    from linkwright.cli.source import read_model

    solved = solve(*read_model(options.file, session), options)
    if options.worked and solved.trouble is None:
        _show_worked(solved, options, session)
        return 0
    if options.output is not None:
        _write(solved, options, session)
    if session.json:
        from linkwright.cli.solve_remarks import data

        session.show_data(data(solved, options))
    elif options.output is None:
        from linkwright.cli.solve_text import report

        session.show("\n".join(report(solved, options, session)))
    if solved.trouble is not None:
        session.tell_error(solved.trouble.say(session.language))
    return int(solved.trouble is not None or not solved.motion.whole)


def _show_worked(solved: Solved, options: argparse.Namespace, session: Session) -> None:
    """The worked solution of the positions that were named, or of the first one."""
    from linkwright.worked.solution import worked

    rows = solved.rows if options.at or options.times else solved.rows[:1]
    source = solved.motion if solved.forces is None else solved.forces
    pages = [worked(source, int(row), language=session.language) for row in rows]
    if session.json:
        session.show_data({"worked": [page.data() for page in pages]})
    else:
        session.show("\n\n\n".join(page.text() for page in pages))


def _refuse_contradictions(options: argparse.Namespace) -> None:
    if options.worked and options.output is not None:
        raise UsageError(
            _(
                "{name} cannot be used together with {other}",
                code="cli.not_together",
                name="--worked",
                other="--output",
            )
        )
    if options.static and options.forces is False:
        raise UsageError(
            _(
                "{name} cannot be used together with {other}",
                code="cli.not_together",
                name="--static",
                other="--no-forces",
            )
        )
    if options.output is not None:
        from linkwright.cli.files import refuse_output

        refuse_output(options.output, ENDINGS, force=options.force)


def _write(solved: Solved, options: argparse.Namespace, session: Session) -> None:
    from pathlib import Path

    from linkwright.cli.files import write_table
    from linkwright.cli.solve_remarks import data
    from linkwright.cli.solving import named_columns
    from linkwright.core.table import csv_text

    asked = solved, options
    write_table(
        options.output, lambda: csv_text(named_columns(*asked)), lambda: data(*asked), force=options.force
    )
    if not session.json:
        session.show_written(Path(options.output))
