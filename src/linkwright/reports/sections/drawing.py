"""The kinematic drawing with its dimensions."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.errors import LinkwrightError
from linkwright.plotting.drawing.draw import draw
from linkwright.reports.document import Block, Figure, Paragraph
from linkwright.reports.font_scaling import font_scaling
from linkwright.reports.machine_results import ReportContext
from linkwright.reports.section import section
from linkwright.words import _

#: Share of the width and height, mm, of a drawing: two of them share a page.
WIDE, TALLEST = 0.85, 104.0


@section("drawing", _("Kinematic drawing"), 2.0)
def blocks(case: ReportContext) -> Iterator[Block]:
    """The machine at the worked position, and its limit positions."""
    say = case.say
    motion, index = case.worked_motion
    yield Paragraph(
        say(
            _(
                "The machine in the standard symbols is shown in {figure}, at the position that is worked out below.",
                figure="[[drawing]]",
            )
        )
    )
    language = case.language

    def shown(diagonal: float) -> str:
        return draw(motion, position=index, centres=True, diagonal=diagonal, language=language).svg

    def faded(diagonal: float) -> str:
        limits = draw(case.motion, overlay="limits", labels="points", diagonal=diagonal, language=language)
        return limits.svg

    loaded = any(link.mass for link in case.mechanism.links.values()) or bool(case.mechanism.loads)
    caption = say(_("Kinematic drawing with mass centres and loads") if loaded else _("Kinematic drawing"))
    yield Figure(caption, ((font_scaling(shown, WIDE, TALLEST), WIDE),), "drawing", TALLEST)
    try:
        limits = font_scaling(faded, WIDE, TALLEST)
    except LinkwrightError:
        return
    yield Figure(say(_("Limit positions of the output, dashed")), ((limits, WIDE),), "limit-drawing", TALLEST)
