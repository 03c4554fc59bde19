"""Appendix: all numbers at the numbered positions."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.errors import LinkwrightError
from linkwright.kinetostatics.table import force_results, motion_results
from linkwright.reports.document import Block, Paragraph
from linkwright.reports.machine_results import ReportContext
from linkwright.reports.numbers import without_rounding
from linkwright.reports.section import section
from linkwright.reports.sections.cycle_tables import varying
from linkwright.words import _


@section("appendix", _("Appendix: all numbers"), 30.0)
def blocks(case: ReportContext) -> Iterator[Block]:
    """Every column of the result."""
    say = case.say
    try:
        columns = without_rounding(force_results(case.numbered_forces))
    except LinkwrightError:
        columns = without_rounding(motion_results(case.numbered.motion))
    yield Paragraph(
        say(
            _(
                "All results at the numbered positions; $\\Delta P$ and $\\Delta F$ are what is left "
                "over in the balance of powers and of forces."
            )
        )
    )
    alone = len(case.mechanism.drivers) < 2
    names = [each for each in columns if each.kind != "input" or not alone]
    yield from varying(case, _("All results"), columns, names)
