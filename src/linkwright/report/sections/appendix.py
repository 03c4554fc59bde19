"""Appendix: all numbers at the numbered positions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from linkwright.errors import LinkwrightError
from linkwright.kinematics.cycle import Floats
from linkwright.report.case import Case
from linkwright.report.document import Block, Paragraph
from linkwright.report.numbers import faded, typeset, without_rounding
from linkwright.report.section import SECTIONS, Section
from linkwright.report.sections.cycle_tables import table, varies


@SECTIONS.register("appendix")
class Appendix(Section):
    """Every column of the result."""

    name, rank = "appendix", 30.0

    def blocks(self, case: Case) -> Iterator[Block]:
        say = case.say
        try:
            columns = without_rounding(case.numbered_forces.columns())
        except LinkwrightError:
            columns = without_rounding(case.numbered.motion.columns())
        yield Paragraph(say("report.appendix_text"))
        names = [name for name in columns if not name.startswith("driver [")]
        moving = [name for name in names if varies(columns[name])]
        still = [name for name in names if name not in moving and np.isfinite(columns[name]).any()]
        if case.mechanism.drivers and still:
            yield Paragraph(
                say("report.constant", values=", ".join(_equal(case, columns, each) for each in still))
            )
        yield table(case, say("report.appendix_table"), columns, moving if case.mechanism.drivers else names)


def _equal(case: Case, columns: Mapping[str, Floats], name: str) -> str:
    """What a result that does not change is equal to."""
    head, factor = case.heads.head(name)
    quantity, _, unit = head.rpartition("\u00a0/\u00a0")
    known = columns[name][np.isfinite(columns[name])]
    value = typeset(f"{faded(float(known[0])) * factor:.6g}")
    return f"{quantity} = {value} {unit}".replace(" °", "°")
