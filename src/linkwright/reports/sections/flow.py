"""The flow chart of the solution, in the solving order of the machine."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.plotting.flow_chart import TALLEST, flow_chart_pages
from linkwright.plotting.solution_steps import flow_chart_steps
from linkwright.reports.document import Block, Figure, Paragraph
from linkwright.reports.machine_results import ReportContext
from linkwright.reports.own_size import own_share
from linkwright.reports.section import section
from linkwright.words import _


@section("flow", _("Flow chart of the solution"), 3.5)
def blocks(case: ReportContext) -> Iterator[Block]:
    """The steps of the solution over the numbered positions, in as many pages as they need."""
    say, numbered = case.say, case.numbered
    nodes = flow_chart_steps(numbered.motion, numbered.rows, case.language)
    message = (
        _(
            "{figure} shows in which order the machine is solved: what each step needs is known "
            "from the steps before it. The calls have the names of the teaching texts (bark, "
            "rrrk …); i counts the numbered positions."
        )
        if case.mechanism.drivers
        else _(
            "{figure} shows in which order the machine is solved: what each step needs is known "
            "from the steps before it. The calls have the names of the teaching texts (rrrk, "
            "rrrf …)."
        )
    )
    yield Paragraph(say(message.format(figure="[[flow]]")))
    caption = say(_("Flow chart of the solution"))
    pages = flow_chart_pages(nodes, caption)
    for number, svg in enumerate(pages, 1):
        shown = (
            caption
            if len(pages) == 1
            else say(_("{caption} ({number} of {count})", caption=caption, number=number, count=len(pages)))
        )
        yield Figure(shown, ((svg, own_share(svg)),), "flow" if number == 1 else "", TALLEST)
