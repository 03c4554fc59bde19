"""Limit positions, quick-return ratio, transmission angle, and all other design numbers."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.analysis.base import CELLS, MetricValue
from linkwright.analysis.table import cells_of_values
from linkwright.core.quantity import number
from linkwright.core.table import Table
from linkwright.equations.reading import sides
from linkwright.reports.document import Block, Formula, Paragraph, literal, printed
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.section import section
from linkwright.words import _

#: Numbers that other sections print.
ELSEWHERE = ("peak_reaction", "rms_reaction", "flywheel")


@section("limits", _("Limit positions and design numbers"), 10.0, optional=True)
def blocks(case: ReportContext) -> Iterator[Block]:
    """Design numbers of the motion and the forces, with the limits that are recommended."""
    say = case.say
    rows = [row for row in case.metrics if row.metric not in ELSEWHERE]
    if not rows:
        raise Missing(_("no design number applies to this machine", code="report.no_numbers"))
    yield Paragraph(say(_("Largest and smallest values are exact, found between the solved positions.")))
    yield from _quick_return(case, rows)
    for metric in dict.fromkeys(row.metric for row in rows):
        case.used[metric] = None
    head = (*CELLS[:4], _("at the input"), _("recommended"))
    cells = [cells for cells, _unused in cells_of_values(rows, case.language)]
    yield printed(Table(head, cells, "<<><>>", _("Design numbers")), case.language, "numbers")
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
            case.say(
                _(
                    "Quick-return ratio of {subject}, with the angle $\\theta$ of the crank between the limits:",
                    subject=literal(row.subject),
                )
            )
        )
        yield Formula(sides(f"K = {symbols} = {numbers} = {ratio.value:.5g}"))
