"""``linkwright grade``: sheets of variants against their key."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.options import RESULTS, Options, argument, force, output
from linkwright.cli.session import Session
from linkwright.words import _


@command(
    _("grade sheets of variants: which numbers are off, and by what usual mistake"),
    _(
        """\
Compares the answers of a CSV file (columns student, variant, and one per question)
with an answer key that "linkwright variants" wrote. Wrong numbers are named, with
the usual mistake that leads to just these numbers: degrees for radians, wrong
assembly mode, missing parenthesis, quadrant of the arctangent, sign of the inertia
couple, missing Coriolis term, mass centre at the wrong end, rpm for rad/s."""
    ),
    """\
linkwright grade exercise/key.json answers.csv""",
)
@argument("key", "KEY", help=_("key.json of the variants"))
@argument("answers", "ANSWERS", help=_("CSV file of the answers"))
@output(RESULTS, _("write the grades to a .csv, .json, .xlsx, .md or .html file"))
@force
def run(options: Options, session: Session) -> int:
    """Grades, prints a row per sheet, writes them where asked; 1 where a sheet cannot be graded."""
    from linkwright.cli.files import present
    from linkwright.course.grade import grade
    from linkwright.words.message import in_language

    found = grade(options.key, options.answers)
    faults = found.faults
    present(found, options, session)
    if faults and not session.json:
        session.tell_error(
            session.translate(
                _("{count} of {of} sheets cannot be graded; the others are", count=len(faults), of=len(found))
            )
        )
        for fault in faults:
            session.tell(f"  {in_language(fault, session.language)}")
    return int(bool(faults))
