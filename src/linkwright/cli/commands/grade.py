"""``linkwright grade``: sheets of variants against their key."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from linkwright.cli.parser import Options
from linkwright.cli.session import Session
from linkwright.words import _

SUMMARY = _("grade sheets of variants: which numbers are off, and by what usual mistake")
DESCRIPTION = _(
    """\
Compares the answers of a CSV file (columns student, variant, and one per question)
with an answer key that "linkwright variants" wrote. Wrong numbers are named, with
the usual mistake that leads to just these numbers: degrees for radians, wrong
assembly mode, missing parenthesis, quadrant of the arctangent, sign of the inertia
couple, missing Coriolis term, mass centre at the wrong end, rpm for rad/s."""
)
EXAMPLES = """\
linkwright grade exercise/key.json answers.csv"""

ENDINGS = (".csv",)


def arguments(option: Options) -> None:
    option("key", "KEY", help=_("key.json of the variants"))
    option("answers", "ANSWERS", help=_("CSV file of the answers"))
    option("--output", "FILE", help=_("write the grades to a .csv file"))
    option.force()


def run(options: argparse.Namespace, session: Session) -> int:
    """Grades, prints a row per sheet, writes them where asked; 1 where a sheet cannot be graded."""
    from linkwright.cli.files import refuse_output, write_whole
    from linkwright.core.table import csv_rows
    from linkwright.course.grade import grade, table
    from linkwright.words.sentence import in_language

    refuse_output(options.output, ENDINGS, force=options.force)
    grades = grade(options.key, options.answers)
    faults = [each.fault for each in grades if each.fault]
    names = [each["name"] for each in json.loads(Path(options.key).read_text("utf-8"))["questions"]]
    found = table(grades, names, session.language)
    if options.output is not None:
        write_whole(Path(options.output), csv_rows(found.texts()), force=options.force)
    if session.json:
        sheets = [
            {"student": g.student, "variant": g.variant, "right": list(g.right), "mistakes": list(g.mistakes),
             "where": g.where, **({"fault": g.fault} if g.fault else {})} for g in grades
        ]  # fmt: skip
        session.show_data({"ok": not faults, "sheets": sheets})
        return int(bool(faults))
    session.show("\n".join(session.table(found.lines())))
    session.show_written(options.output, apart=True)
    if faults:
        session.tell_error(
            session.say(
                _(
                    "{count} of {of} sheets cannot be graded; the others are",
                    count=len(faults),
                    of=len(grades),
                )
            )
        )
        for fault in faults:
            session.tell(f"  {in_language(fault, session.language)}")
    return int(bool(faults))
