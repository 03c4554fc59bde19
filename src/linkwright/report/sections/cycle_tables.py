"""Tables over the cycle, positions numbered from a limit position."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from linkwright.errors import LinkwrightError
from linkwright.kinematics.cycle import Floats
from linkwright.report.case import Case
from linkwright.report.document import Block, Paragraph, Table, literal
from linkwright.report.numbers import column, faded, residual, typeset, without_rounding
from linkwright.report.section import SECTIONS, Section


@SECTIONS.register("tables")
class CycleTables(Section):
    """Angles and rates of links, guides, points; joint forces and driver effort: at the numbered positions."""

    name, rank = "tables", 6.0

    def blocks(self, case: Case) -> Iterator[Block]:
        say, numbered = case.say, case.numbered
        count = str(len(numbered.rows))
        if numbered.start is not None:
            place = f"{case.input_text(numbered.start.input)}{case.input_unit}"
            yield Paragraph(say("report.numbered_limit", count=count, input=place))
        elif case.mechanism.drivers:
            yield Paragraph(say("report.numbered_start", count=count))
        yield Paragraph(literal(case.links_text))
        columns = without_rounding(numbered.motion.columns())
        for title, wanted in _motion_tables(case, columns):
            yield table(case, say(title), columns, wanted)
        try:
            columns = without_rounding(case.numbered_forces.columns())
        except LinkwrightError as error:
            yield Paragraph(literal(case.told(error)), "missing")
            return
        sizes = [name for name in columns if name.endswith((".magnitude [N]", ".couple [N·m]"))]
        efforts = [name for name in columns if ".effort [" in name]
        yield from varying(case, "report.reactions_table", columns, sizes)
        if efforts:
            shaking = _starting(columns, "shaking")
            yield from varying(case, "report.effort_table", columns, [*efforts, *shaking])


def _motion_tables(case: Case, columns: Mapping[str, Floats]) -> Iterator[tuple[str, list[str]]]:
    """Titles and columns: of links that turn, of guides, of points."""
    turning = [link for link in case.mechanism.links if f"{link}.angle [rad]" in columns]
    links = [name for link in turning for name in _starting(columns, f"{link}.angle", f"{link}.angular")
             if varies(columns[name])]  # fmt: skip
    if links:
        yield "report.links_table", links
    ends = (".displacement [m]", ".velocity [m/s]", ".acceleration [m/s²]")
    guides = [name for name in columns if name.endswith(ends)
              and name.partition(".")[0] in case.mechanism.joints]  # fmt: skip
    if guides:
        yield "report.guides_table", guides
    points = [name for name in columns if ".position." in name and varies(columns[name])]
    if points:
        yield "report.points_table", points
    rates = [
        name
        for name in columns
        if (".velocity." in name or ".acceleration." in name) and varies(columns[name])
    ]
    if rates:
        yield "report.rates_table", rates


def _starting(columns: Mapping[str, Floats], *starts: str) -> list[str]:
    return [name for name in columns if name.startswith(starts)]


def varies(values: Floats) -> bool:
    """Whether a result changes over the cycle."""
    known = values[np.isfinite(values)]
    return bool(len(known)) and float(np.ptp(known)) > 1e-12 * max(float(np.abs(known).max()), 1e-300)


def varying(case: Case, title: str, columns: Mapping[str, Floats], names: Sequence[str]) -> Iterator[Block]:
    """What does not change over the cycle in a sentence, the others in a table; all in it without a driver."""
    moving = [name for name in names if varies(columns[name])] if case.mechanism.drivers else names
    still = [name for name in names if name not in moving and np.isfinite(columns[name]).any()]
    if still:
        yield Paragraph(
            case.say("report.constant", values=", ".join(_equal(case, columns, each) for each in still))
        )
    if moving:
        yield table(case, case.say(title), columns, moving)


def _equal(case: Case, columns: Mapping[str, Floats], name: str) -> str:
    """What a result that does not change is equal to."""
    head, factor = case.heads.head(name)
    quantity, _, unit = head.rpartition("\u00a0/\u00a0")
    known = columns[name][np.isfinite(columns[name])]
    value = typeset(f"{faded(float(known[0])) * factor:.6g}")
    return f"{quantity} = {value} {unit}".replace(" °", "°")


def table(case: Case, title: str, columns: Mapping[str, Floats], names: Sequence[str]) -> Table:
    """Columns at the numbered positions, in shown units."""
    numbered = case.numbered
    rows = list(numbered.rows)
    first = case.inputs_of(numbered)
    shown = [case.heads.head(name) for name in names]
    printed = [
        (residual if "_residual [" in name else column)(columns[name][rows] * factor)
        for name, (_, factor) in zip(names, shown, strict=True)
    ]
    body = tuple((str(k + 1), first[k], *(each[k] for each in printed)) for k in range(len(rows)))
    head = (
        case.say("report.position_number"),
        f"$q$ / {case.input_unit}",
        *(head for head, _ in shown),
    )
    return Table(title, head, body, ">" * len(head), "", 2)
