"""Free-body diagrams of every link at the worked position."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.kinetostatics.forces import Forces
from linkwright.plotting.free_bodies import idle_loads
from linkwright.plotting.free_body_pages import free_body_pages
from linkwright.reports.document import Block, Figure, Paragraph, literal
from linkwright.reports.machine_results import NO_LOADS, Missing, ReportContext
from linkwright.reports.own_size import own_share
from linkwright.reports.section import section
from linkwright.words import _

#: Height of a figure, mm, that a page has room for, and of the pictures below the text that begins the section.
TALLEST, FIRST = 228.0, 178.0


@section("free_bodies", _("Free-body diagrams"), 8.45, optional=True)
def blocks(case: ReportContext) -> Iterator[Block]:
    """All that acts on each link, drawn and in numbers."""
    say = case.say
    forces, index = case.worked_result
    if not isinstance(forces, Forces):
        raise Missing(NO_LOADS)
    pages = free_body_pages(forces, index, say, case.language, first=FIRST)
    place = literal(case.worked_text)
    message = (
        _(
            "{figure} shows every link by itself, in its position at {place}, with all that acts on "
            "it; the links come in the order of the force analysis. A joint force F with the "
            "index 12 is what link 1 exerts on link 2."
        )
        if place
        else _(
            "{figure} shows every link by itself with all that acts on it; the links come in the "
            "order of the force analysis. A joint force F with the index 12 is what link 1 "
            "exerts on link 2."
        )
    )
    yield Paragraph(say(message.format(figure="[[free-bodies]]", place=place)))
    if idle := idle_loads(forces, index):
        yield Paragraph(literal(say(_("Not acting at this position: {names}.", names=", ".join(idle)))), "note")
    caption = say(_("Free-body diagrams of the links"))
    for number, svg in enumerate(pages, 1):
        shown = (
            caption
            if len(pages) == 1
            else say(_("{caption} ({number} of {count})", caption=caption, number=number, count=len(pages)))
        )
        yield Figure(shown, ((svg, own_share(svg)),), "free-bodies" if number == 1 else "", TALLEST)
