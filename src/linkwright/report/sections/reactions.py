"""Joint forces over the cycle and their hodographs."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.errors import LinkwrightError
from linkwright.metrics.quantities import shown
from linkwright.plot.force_names import reaction_pairs
from linkwright.report.case import Case
from linkwright.report.document import Block, Figure, Paragraph, Table, literal
from linkwright.report.section import SECTIONS, Section
from linkwright.report.sections.curves import pictures

#: Hodographs that are drawn, of the joints that carry most.
MOST = 2


@SECTIONS.register("reactions")
class Reactions(Section):
    """Sizes of all joint forces, the largest of each, hodographs of those that carry most."""

    name, rank = "reactions", 8.0

    def blocks(self, case: Case) -> Iterator[Block]:
        say, forces = case.say, case.forces
        yield Paragraph(say("report.reactions_text"))
        peaks = [row for row in case.metrics if row.metric == "peak_reaction"]
        rows = tuple(
            (literal(row.subject), shown(row.value, row.dimension),
             "" if row.at is None else shown(row.at, row.at_dimension)) for row in peaks
        )  # fmt: skip
        if rows:
            head = tuple(say(f"report.{key}") for key in ("joint", "largest_force", "at_input"))
            yield Table(say("report.peaks"), head, rows, "<>>", "peaks")
        if not case.mechanism.drivers:
            return
        yield from pictures(case, ("reactions",))
        ordered = sorted(reaction_pairs(forces.mechanism), key=lambda pair: -_peak(case, *pair))
        found = []
        for joint, link in ordered[:MOST]:
            try:
                found.append((joint, link, case.diagram("hodograph", joint=joint, on=link)))
            except LinkwrightError as error:
                yield Paragraph(f"{joint}: {literal(case.told(error))}", "missing")
        if found:
            names = literal(", ".join(f"{joint}→{link}" for joint, link, _ in found))
            svgs = tuple((svg, 0.48) for *_, svg in found)
            yield Figure(say("report.caption_hodograph", names=names), svgs, "hodographs")


def _peak(case: Case, joint: str, link: str) -> float:
    import numpy as np

    force = case.forces.reaction(joint, on=link)
    return float(np.nanmax(np.hypot(force[:, 0], force[:, 1])))
