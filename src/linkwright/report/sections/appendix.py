"""Appendix: all numbers at the numbered positions."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.errors import LinkwrightError
from linkwright.report.case import Case
from linkwright.report.document import Block, Paragraph
from linkwright.report.section import SECTIONS, Section
from linkwright.report.sections.cycle_tables import table


@SECTIONS.register("appendix")
class Appendix(Section):
    """Every column of the result."""

    name, rank = "appendix", 30.0

    def blocks(self, case: Case) -> Iterator[Block]:
        say = case.say
        try:
            columns = case.numbered_forces.columns()
        except LinkwrightError:
            columns = case.numbered.motion.columns()
        yield Paragraph(say("report.appendix_text"))
        names = [name for name in columns if not name.startswith("driver [")]
        yield table(case, say("report.appendix_table"), columns, names)
