"""The kinematic drawing with its dimensions."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.errors import LinkwrightError
from linkwright.plot.drawing.draw import draw
from linkwright.report.document import Block, Figure, Paragraph
from linkwright.report.machine_results import Case
from linkwright.report.section import section

#: Height of a drawing, mm: two of them share a page.
TALLEST = 104.0


@section("drawing", 2.0)
def blocks(case: Case) -> Iterator[Block]:
    """The machine at the worked position, and its limit positions."""
    say = case.say
    motion, index = case.worked_motion
    yield Paragraph(say("report.drawing_text", figure="[[drawing]]"))
    shown = draw(motion, position=index, centres=True, language=case.language)
    loaded = any(link.mass for link in case.mechanism.links.values()) or bool(case.mechanism.loads)
    caption = say("report.drawing_caption" if loaded else "report.drawing_plain_caption")
    yield Figure(caption, ((shown.svg, 0.85),), "drawing", TALLEST)
    try:
        faded = draw(case.motion, overlay="limits", labels="points", language=case.language)
    except LinkwrightError:
        return
    yield Figure(say("report.limits_caption"), ((faded.svg, 0.85),), "limit-drawing", TALLEST)
