"""Mistakes of the source, where the file tells of some."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from linkwright.core.table import Table
from linkwright.reports.document import Block, Paragraph, literal, printed
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.section import section
from linkwright.reports.settings import Erratum
from linkwright.words import Translate, _, language_of


@section("errata", _("Mistakes of the source"), 13.0, optional=True)
def blocks(case: ReportContext) -> Iterator[Block]:
    """What is printed in the source, what is right, and why."""
    say, found = case.say, case.settings.errata
    if not found:
        raise Missing(_("the file tells of no mistakes of its source", code="report.no_errata"))
    yield from errata_blocks(found, case.origin, say)


def errata_blocks(found: Sequence[Erratum], source: str, say: Translate) -> Iterator[Block]:
    """The mistakes of a source as a table."""
    yield Paragraph(
        say(
            _(
                "The numbers of the source ({source}) were compared with those of this report. Where they differ:",
                source=literal(source or "–"),
            )
        )
    )
    rows = [(e.where, e.printed, e.right, e.why) for e in found]
    table = Table((_("where"), _("printed"), _("right"), _("why")), rows, "<<<<", _("Mistakes of the source"))
    yield printed(table, language_of(say), "errata")
