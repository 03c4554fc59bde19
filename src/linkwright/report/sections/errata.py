"""Mistakes of the source, where the file tells of some."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.report.document import Block, Paragraph, Table, literal
from linkwright.report.machine_results import Case, Missing
from linkwright.report.section import section


@section("errata", 13.0, optional=True)
def blocks(case: Case) -> Iterator[Block]:
    """What is printed in the source, what is right, and why."""
    say, found = case.say, case.settings.errata
    if not found:
        raise Missing("report.no_errata")
    yield Paragraph(say("report.errata_text", source=literal(case.origin or "–")))
    head = tuple(say(f"report.{key}") for key in ("where", "printed", "right", "why"))
    rows = tuple(tuple(map(literal, (e.where, e.printed, e.right, e.why))) for e in found)
    yield Table(say("report.errata_table"), head, rows, "<<<<", "errata")
