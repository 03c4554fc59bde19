"""``linkwright grade``: sheets of variants against their key."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from linkwright.cli.parser import Options
from linkwright.cli.session import Session

ENDINGS = (".csv",)


def arguments(option: Options) -> None:
    option("key", "KEY")
    option("answers", "ANSWERS")
    option("--output", "FILE")
    option.force()


def run(options: argparse.Namespace, session: Session) -> int:
    """Grades, prints a row per sheet, writes them where asked."""
    from linkwright.cli.files import refuse_output, write_whole
    from linkwright.course.grade import grade, text
    from linkwright.course.questions import csv_bytes
    from linkwright.words.characters import aligned

    refuse_output(options.output, ENDINGS, force=options.force)
    grades = grade(options.key, options.answers)
    names = [each["name"] for each in json.loads(Path(options.key).read_text("utf-8"))["questions"]]
    rows = text(grades, names, session.language)
    if options.output is not None:
        write_whole(Path(options.output), csv_bytes(rows), force=options.force)
    if session.json:
        sheets = [
            {"student": g.student, "variant": g.variant, "right": list(g.right), "mistakes": list(g.mistakes),
             "where": g.where} for g in grades
        ]  # fmt: skip
        session.show_data({"ok": True, "sheets": sheets})
        return 0
    session.show("\n".join(session.table(aligned(rows, "<>><<"))))
    session.show_written(options.output, apart=True)
    return 0
