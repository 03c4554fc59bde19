"""Joint forces over the cycle and their hodographs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from linkwright.errors import LinkwrightError
from linkwright.metrics.quantities import shown
from linkwright.plot.force_names import reaction_pairs
from linkwright.report.case import Case
from linkwright.report.document import Block, Figure, Paragraph, Table, literal
from linkwright.report.numbers import faded
from linkwright.report.section import SECTIONS, Section
from linkwright.report.sections.curves import pictures

#: Hodographs in one figure, and its height, mm.
MOST, TALLEST = 12, 225.0


@SECTIONS.register("reactions")
class Reactions(Section):
    """Sizes of all joint forces, the largest of each, and their hodographs."""

    name, rank = "reactions", 8.0

    def blocks(self, case: Case) -> Iterator[Block]:
        say, _ = case.say, case.forces
        yield Paragraph(say("report.reactions_text"))
        peaks = [row for row in case.metrics if row.metric == "peak_reaction"]
        rows = tuple(
            (literal(row.subject), shown(row.value, row.dimension),
             "" if row.at is None else shown(faded(row.at), row.at_dimension)) for row in peaks
        )  # fmt: skip
        if rows:
            head = tuple(say(f"report.{key}") for key in ("joint", "largest_force", "at_input"))
            yield Table(say("report.peaks"), head, rows, "<>>", "peaks")
        if not case.mechanism.drivers:
            return
        yield from pictures(case, ("reactions",))
        yield from _hodographs(case)


def _hodographs(case: Case) -> Iterator[Block]:
    """Hodographs of all joint forces, a page full in each figure."""
    panels = Counter(joint for joint, _ in reaction_pairs(case.mechanism))
    figures: list[list[str]] = [[]]
    for joint, count in panels.items():
        if figures[-1] and sum(panels[each] for each in figures[-1]) + count > MOST:
            figures.append([])
        figures[-1].append(joint)
    for number, joints in enumerate(figures):
        try:
            picture = case.diagram("hodographs", of=joints)
        except LinkwrightError as error:
            yield Paragraph(literal(case.told(error)), "missing")
            continue
        caption = case.say("report.caption_hodographs")
        share = min(1.0, 0.34 * min(3, sum(panels[each] for each in joints)))
        if number:
            caption = case.say("report.continued", caption=caption)
        yield Figure(caption, ((picture, share),), "" if number else "hodographs", TALLEST)
