"""``linkwright grade``: sheets of variants against their key."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from linkwright.cli.session import Session
from linkwright.words import Say

ENDINGS = (".csv",)


def arguments(parser: argparse.ArgumentParser, say: Say) -> None:
    """The command's options."""
    parser.add_argument("key", metavar="KEY", help=say("grade.key_help"))
    parser.add_argument("answers", metavar="ANSWERS", help=say("grade.answers_help"))
    parser.add_argument("--output", metavar="FILE", help=say("grade.output_help"))
    parser.add_argument("--force", action="store_true", help=say("cli.force_help"))


def run(options: argparse.Namespace, session: Session) -> int:
    """Grades, prints a row per sheet, writes them where asked."""
    from linkwright.cli.files import write_whole
    from linkwright.cli.tables import refuse_output
    from linkwright.course.grade import grade, text
    from linkwright.course.questions import csv_bytes
    from linkwright.words.width import aligned

    refuse_output(options.output, ENDINGS, session.say, force=options.force)
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
    if options.output is not None:
        session.show(f"\n{session.say('cli.written', path=options.output)}")
    return 0
