"""The parts of a machine whose file says how it is made: list, layers, and plates with their main dimensions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from linkwright.errors import LinkwrightError
from linkwright.fabrication.cut_parts import CutParts, cut_parts
from linkwright.fabrication.part_drawing import draw_part
from linkwright.files.write import to_data
from linkwright.reports.document import Block, Figure, Heading, Paragraph, literal, printed, sentence_with_keys
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.section import section
from linkwright.reports.sections.task import element_data
from linkwright.words import _

#: Share of the page's width, and height in mm, of the drawing of a plate.
WIDE, TALLEST = 0.48, 70.0


@section("parts", _("Parts"), 12.5, optional=True)
def parts(case: ReportContext) -> Iterator[Block]:
    """What is made of what, in which layer, and how large."""
    if case.mechanism.construction is None:
        raise Missing(_("the file does not say how the machine is made: construction", code="report.no_construction"))
    try:
        found = cut_parts(case.mechanism)
    except LinkwrightError as error:
        raise Missing(error.sentence) from None
    translate = case.translate
    given = element_data(to_data(case.mechanism)["construction"], translate)
    yield Paragraph(translate(_("How the machine is made: {given}.", given=literal(given))))
    (table,) = found.tables(case.language)
    yield printed(table, case.language, "parts")
    for note in table.notes:
        yield Paragraph(sentence_with_keys(case.sentence(note)), "note")
    yield from _layers(case, found)
    yield Heading(translate(_("Plates")), 2)
    drawn = [(draw_part(each, case.language).svg, WIDE) for each in found.parts if each.sort == "plate"]
    yield Figure(translate(_("Plates with their main dimensions in mm")), tuple(drawn), "plates", TALLEST)


def _layers(case: ReportContext, found: CutParts) -> Iterator[Block]:
    """The plates from the highest layer to the frame's, and the pins."""
    yield Heading(case.translate(_("Layers")), 2)
    plates, pins, notes = found.layers.tables(case.language)
    yield printed(replace(plates, title=_("Plates by layers")), case.language, "layers")
    yield printed(pins, case.language, "pins")
    for note in (*plates.notes, *notes.notes[:2]):
        yield Paragraph(sentence_with_keys(case.sentence(note)), "note")
