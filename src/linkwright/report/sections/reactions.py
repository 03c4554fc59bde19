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
from linkwright.report.sections.curves import SHARE
from linkwright.report.sections.curves import TALLEST as SHORT

#: Joint forces in one figure; hodographs in one where there are more, two rows, of which a page has room for two
#: figures; the height of one of hodographs, mm.
MOST, IN_ROWS, TALLEST = 12, 6, 225.0


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
        parts = _parts(case, MOST)
        yield from _figures(case, "reactions", parts, [SHARE] * len(parts), SHORT)
        parts = parts if len(parts) == 1 else _parts(case, IN_ROWS)
        panels = [sum(joint in part for joint, _ in reaction_pairs(case.mechanism)) for part in parts]
        yield from _figures(case, "hodographs", parts, [min(1.0, 0.34 * min(3, n)) for n in panels], TALLEST)


def _parts(case: Case, most: int) -> list[list[str]]:
    """The joints, as many together as have no more forces than ``most``."""
    forces = Counter(joint for joint, _ in reaction_pairs(case.mechanism))
    parts: list[list[str]] = [[]]
    for joint, count in forces.items():
        if parts[-1] and sum(forces[each] for each in parts[-1]) + count > most:
            parts.append([])
        parts[-1].append(joint)
    return parts


def _figures(
    case: Case, kind: str, parts: list[list[str]], shares: list[float], tallest: float
) -> Iterator[Block]:
    """A figure of some joints each, or why there is none."""
    caption = case.say(f"report.caption_{kind}")
    for number, (joints, share) in enumerate(zip(parts, shares, strict=True)):
        try:
            picture = case.diagram(kind, of=joints)
        except LinkwrightError as error:
            yield Paragraph(f"{case.say(f'plot.kind.{kind}')}: {literal(case.told(error))}", "missing")
            continue
        title = case.say("report.continued", caption=caption) if number else caption
        yield Figure(title, ((picture, share),), "" if number else kind, tallest)
