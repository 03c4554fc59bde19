"""Limit positions and metrics of a machine, and the comparison of all machines of the report."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from linkwright.analysis.base import CELLS, MetricValue
from linkwright.analysis.evaluate import cells_of_values
from linkwright.core.quantity import number
from linkwright.core.table import Table
from linkwright.designs.evaluation import ranking, sentences
from linkwright.equations.reading import sides
from linkwright.errors import LinkwrightError
from linkwright.reports.document import Block, Figure, Formula, Heading, Paragraph, literal, printed
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.section import section
from linkwright.words import _
from linkwright.words.message import in_language

#: Numbers that other sections print.
ELSEWHERE = ("peak_reaction", "rms_reaction", "flywheel")


@section("limits", _("Limit positions and metrics"), 10.0, optional=True)
def limits(case: ReportContext) -> Iterator[Block]:
    """Metrics of the motion and the forces, with the limits that are recommended."""
    translate = case.translate
    rows = [row for row in case.metrics if row.metric not in ELSEWHERE]
    if not rows:
        raise Missing(_("no metric applies to this machine", code="report.no_numbers"))
    yield Paragraph(translate(_("Largest and smallest values are exact, found between the solved positions.")))
    yield from _quick_return(case, rows)
    for metric in dict.fromkeys(row.metric for row in rows):
        case.used[metric] = None
    head = (*CELLS[:4], _("at the input"), _("recommended"))
    cells = [cells for cells, _unused in cells_of_values(rows, case.language)]
    yield printed(Table(head, cells, "<<><>>", _("Metrics")), case.language, "numbers")
    for sentence in case.metrics.warnings_in(case.language):
        yield Paragraph(literal(sentence), "note")


def _quick_return(case: ReportContext, rows: list[MetricValue]) -> Iterator[Block]:
    """The quick-return ratio with its formula, where the crank turns uniformly."""
    angles = [row for row in rows if row.metric == "crank_angle_between_limits"]
    ratios = {row.subject: row for row in rows if row.metric == "quick_return_ratio"}
    for row in angles:
        ratio = ratios.get(row.subject)
        if ratio is None:
            continue
        fraction = "(180° + {0})/(180° − {0})"
        symbols, numbers = fraction.format("θ"), fraction.format(f"{number(row.value, 'angle')}°")
        yield Paragraph(
            case.translate(
                _(
                    "Quick-return ratio of {subject}, with the angle $\\theta$ of the crank between the limits:",
                    subject=literal(row.subject),
                )
            )
        )
        yield Formula(sides(f"K = {symbols} = {numbers} = {ratio.value:.5g}"))


@section("comparison", _("Comparison and evaluation"), 20.0, optional=True, common=True)
def comparison(cases: Sequence[ReportContext]) -> Iterator[Block]:
    """Metrics side by side, best values marked; ranking with reasons; evaluation."""
    from linkwright.designs.compare import compare

    if len(cases) < 2:
        raise Missing(
            _("there is one machine only; name two or more files to compare them", code="report.one_machine")
        )
    first = cases[0]
    translate = first.translate
    try:
        found = compare([case.mechanism for case in cases], fluctuation=first.settings.fluctuation)
    except LinkwrightError as error:
        if error.code == "study.no_common_output":
            raise Missing(error.sentence) from None
        raise
    table = found.tables(first.language)[0]
    head = [literal(in_language(each, first.language)) for each in table.head]
    alternatives = replace(table, head=head, title=_("Metrics of the alternatives"))
    yield printed(alternatives, first.language, "comparison")
    for note in table.notes:
        yield Paragraph(literal(note))
    yield Heading(translate(_("Ranking")), 2)
    for line in ranking(found, translate):
        yield Paragraph(literal(line.strip()), "bullet" if line.startswith(" ") else "")
    yield Heading(translate(_("Evaluation")), 2)
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
        yield Figure(translate(caption), ((picture, 0.95),), kind)
