"""A Python program that solves this machine group by group, and prints the table."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.dyads.listing import Listing
from linkwright.errors import LinkwrightError
from linkwright.kinetostatics.forces import Forces
from linkwright.report.document import Block, Code, Paragraph
from linkwright.report.machine_results import Case
from linkwright.report.section import section


@section("program", 14.5, optional=True)
def blocks(case: Case) -> Iterator[Block]:
    """The program, at the positions of the tables."""
    say, numbered = case.say, case.numbered
    try:
        forces: Forces | None = case.numbered_forces
    except LinkwrightError:
        forces = None
    listing = Listing(
        numbered.motion, forces, say, rows=numbered.rows, source=case.source, language=case.language
    )
    text = listing.text()
    yield Paragraph(say("calls.program", count=len(listing.rows)))
    if listing.plan.others:
        yield Paragraph(say("calls.program_library"), "note")
    yield Code(text, "python", say("calls.program_caption"), "program")
