"""Sizes of links and pins from the largest forces, with the way to them, of machines with a construction."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.errors import LinkwrightError
from linkwright.reports.document import Block, Heading, Paragraph, literal, printed, sentence_with_keys
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.section import section
from linkwright.reports.sections.method import step_blocks
from linkwright.sizing.size_links import size_links
from linkwright.words import _


@section("sizing", _("Sizes of links and pins"), 12.4, optional=True)
def sizing(case: ReportContext) -> Iterator[Block]:
    """What the sizes are, which criterion governs each, and how it is met."""
    if case.mechanism.construction is None:
        raise Missing(_("the file does not say how the machine is made: construction", code="report.no_construction"))
    try:
        found = size_links(case.mechanism)
    except LinkwrightError as error:
        raise Missing(error.sentence) from None
    yield printed(found.link_table(), case.language, "link-sizes")
    yield printed(found.pin_table(), case.language, "pin-sizes")
    for note in (*found.notes, *found.basis):
        yield Paragraph(sentence_with_keys(case.sentence(note)), "note")
    for step in found.steps(case.translate):
        yield Heading(literal(step.title), 2)
        yield from step_blocks(step)
