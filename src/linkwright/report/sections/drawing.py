"""The kinematic drawing with its dimensions."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.errors import LinkwrightError
from linkwright.plot.drawing.draw import draw
from linkwright.report.case import Case
from linkwright.report.document import Block, Figure, Paragraph
from linkwright.report.section import SECTIONS, Section


@SECTIONS.register("drawing")
class KinematicDrawing(Section):
    """The machine at the worked position, and its limit positions."""

    name, rank = "drawing", 2.0

    def blocks(self, case: Case) -> Iterator[Block]:
        say = case.say
        motion, index = case.worked_motion
        yield Paragraph(say("report.drawing_text", figure="[[drawing]]"))
        shown = draw(motion, position=index, centres=True, language=case.language)
        yield Figure(say("report.drawing_caption"), ((shown.svg, 0.85),), "drawing")
        try:
            faded = draw(case.motion, overlay="limits", labels="points", language=case.language)
        except LinkwrightError:
            return
        yield Figure(say("report.limits_caption"), ((faded.svg, 0.85),), "limit-drawing")
