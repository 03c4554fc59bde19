"""Comparison of all machines of the report, with ranking and evaluation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from linkwright.designs.evaluation import ranking, sentences
from linkwright.errors import LinkwrightError
from linkwright.reports.document import Block, Figure, Heading, Paragraph, literal, printed
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.section import section
from linkwright.words import _
from linkwright.words.sentence import in_language


@section("comparison", _("Comparison and evaluation"), 20.0, optional=True, common=True)
def blocks(cases: Sequence[ReportContext]) -> Iterator[Block]:
    """Design numbers side by side, best values marked; ranking with reasons; evaluation."""
    from linkwright.designs.compare import compare

    if len(cases) < 2:
        raise Missing(
            _("there is one machine only; name two or more files to compare them", code="report.one_machine")
        )
    first = cases[0]
    say = first.say
    try:
        found = compare([case.mechanism for case in cases], fluctuation=first.settings.fluctuation)
    except LinkwrightError as error:
        if error.code == "study.no_common_output":
            raise Missing(error.sentence) from None
        raise
    table = found.tables(first.language)[0]
    head = [literal(in_language(each, first.language)) for each in table.head]
    alternatives = replace(table, head=head, title=_("Design numbers of the alternatives"))
    yield printed(alternatives, first.language, "comparison")
    for note in table.notes:
        yield Paragraph(literal(note))
    yield Heading(say(_("Ranking")), 2)
    for line in ranking(found, say):
        yield Paragraph(literal(line.strip()), "bullet" if line.startswith(" ") else "")
    yield Heading(say(_("Evaluation")), 2)
    for line in sentences(found, first.language):
        yield Paragraph(literal(line))
    for kind, caption in (
        ("comparison", _("The alternatives over each other")),
        ("pivot_hodograph", _("Hodographs of the force in the output's pivot")),
    ):
        try:
            picture = first.diagram(kind, found)
        except LinkwrightError as error:
            yield Paragraph(literal(first.message(error)), "missing")
            continue
        yield Figure(say(caption), ((picture, 0.95),), kind)
