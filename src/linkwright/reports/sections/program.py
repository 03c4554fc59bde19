"""A Python program that solves this machine group by group, and prints the table."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.dyads.listing import Listing
from linkwright.errors import LinkwrightError
from linkwright.kinetostatics.forces import Forces
from linkwright.reports.document import Block, Code, Paragraph
from linkwright.reports.machine_results import ReportContext
from linkwright.reports.section import section
from linkwright.words import _


@section("program", _("Program listing"), 14.5, optional=True)
def blocks(case: ReportContext) -> Iterator[Block]:
    """The program, at the positions of the tables."""
    say, numbered = case.say, case.numbered
    try:
        forces: Forces | None = case.numbered_forces
    except LinkwrightError:
        forces = None
    listing = Listing(numbered.motion, forces, say, rows=numbered.rows, source=case.source, language=case.language)
    text = listing.text()
    yield Paragraph(
        say(
            _(
                "The program solves the machine at the {count} positions of the tables, group by "
                "group in solving order, with the functions of linkwright.dyads, and prints every "
                "column as comma-separated values in SI units. `linkwright export FILE --to "
                "solution.py` writes it as a file, over the full cycle.",
                count=len(listing.rows),
            )
        )
    )
    if listing.plan.others:
        yield Paragraph(
            say(
                _(
                    "Groups of which there is no such function are solved by the library; the model file "
                    "has to be where the program runs."
                )
            ),
            "note",
        )
    yield Code(text, "python", say(_("the machine solved with linkwright.dyads")), "program")
