"""``linkwright validate``: reference numbers and ours."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError
from linkwright.cli.options import Options, flag, option
from linkwright.cli.session import Session
from linkwright.words import _


@command(
    _("reference numbers and ours: source, digits given, difference"),
    _(
        """\
Compares every reference number that the package has with what it finds itself, to the
digits given. A number is printed by its source (course report, textbook, handbook,
certified data) or derived from what the source gives (by hand, in closed form, by an
independent solution). Where a source is wrong, the right number and the reason are shown."""
    ),
    """\
linkwright validate
linkwright validate --case crusher --every
linkwright validate --json""",
)
@option("--case", "TEXT", default="", help=_("only cases whose name or source contains this"))
@flag("--every", help=_("a line for every number"))
def run(options: Options, session: Session) -> int:
    """Compares and prints; 1 where a number differs."""
    from linkwright.cli.session import progress
    from linkwright.validation.validate import published, validate

    wanted = options.case.casefold()
    cases = [each for each in published() if wanted in f"{each.case} {each.source}".casefold()]
    if not cases:
        raise UsageError(_('no case has "{text}" in its name or source', code="validate.no_case", text=options.case))
    with progress(session, _("comparing")) as report:
        found = validate(cases, report)
    session.show_result(found, every=options.every)
    return int(not found.ok)
