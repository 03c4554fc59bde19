"""Joint forces over the cycle with hodographs, free-body diagrams, and equilibrium as one linear system."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

import numpy as np

from linkwright.core.table import Amount, Cell, Table
from linkwright.errors import LinkwrightError
from linkwright.kinetostatics.forces import Forces, reaction_pairs, rubbing_guides
from linkwright.parts.statics.structure import balance_step, structure_balance
from linkwright.plotting.diagrams.base import title_of
from linkwright.plotting.free_bodies import idle_loads
from linkwright.plotting.free_body_pages import free_body_pages
from linkwright.reports.document import Block, Figure, Paragraph, literal, printed
from linkwright.reports.machine_results import NO_LOADS, Missing, ReportContext
from linkwright.reports.numbers import ROUNDING, faded
from linkwright.reports.pictures import own_share
from linkwright.reports.section import section
from linkwright.reports.sections.curves import SHARE
from linkwright.reports.sections.curves import TALLEST as SHORT
from linkwright.reports.sections.method import step_blocks
from linkwright.words import _
from linkwright.words.message import in_words

#: Joint forces in one figure; hodographs in one where there are more, two rows, of which a page has room for two
#: figures; the height of one of hodographs, mm.
MOST, IN_ROWS, TALLEST = 12, 6, 225.0
#: Captions of diagrams of the joint forces.
CAPTIONS = {
    "reactions": _("Sizes of the joint forces over the input"),
    "hodographs": _("Hodographs of the joint forces, in the axes of the frame"),
}


@section("reactions", _("Joint forces"), 8.0, optional=True)
def reactions(case: ReportContext) -> Iterator[Block]:
    """Sizes of all joint forces, the largest of each, and their hodographs."""
    translate, _unused = case.translate, case.forces
    yield Paragraph(
        translate(
            _("The force of every joint, found group by group in reverse order; the other link feels the reverse.")
        )
    )
    peaks = [row for row in case.metrics if row.metric == "peak_reaction"]
    rows: list[list[Cell]] = [
        [
            in_words(row.subject, case.language),
            Amount(row.value, row.dimension),
            None if row.at is None else Amount(faded(row.at), row.at_dimension),
        ]
        for row in peaks
    ]
    if rows:
        head = (_("joint"), _("largest force"), _("at the input"))
        yield printed(Table(head, rows, "<>>", _("Largest force in every joint")), case.language, "peaks")
    if rubbing := rubbing_guides(case.mechanism):
        yield Paragraph(
            literal(
                translate(
                    _(
                        "The force in a guide is what presses its parts together; its friction, μ times "
                        "that, along the guide, comes on top: {names}",
                        names=", ".join(rubbing),
                    )
                )
            )
        )
    for note in case.forces.notes:
        yield Paragraph(literal(case.sentence(note)), "note")
    if not case.mechanism.drivers:
        return
    parts = _parts(case, MOST)
    yield from _figures(case, "reactions", parts, [SHARE] * len(parts), SHORT)
    parts = parts if len(parts) == 1 else _parts(case, IN_ROWS)
    panels = [sum(joint in part for joint, _unused in loaded_joints(case)) for part in parts]
    yield from _figures(case, "hodographs", parts, [min(1.0, 0.34 * min(3, n)) for n in panels], TALLEST)


def _parts(case: ReportContext, most: int) -> list[list[str]]:
    """The joints that carry something, as many together as have no more forces than ``most``."""
    forces = Counter(joint for joint, _unused in loaded_joints(case))
    parts: list[list[str]] = [[]] if forces else []
    for joint, count in forces.items():
        if parts[-1] and sum(forces[each] for each in parts[-1]) + count > most:
            parts.append([])
        parts[-1].append(joint)
    return parts


def loaded_joints(case: ReportContext) -> list[tuple[str, str]]:
    """The joint forces, those of joints that carry nothing left out."""
    peaks = {
        pair: float(np.nanmax(np.abs(case.forces.reaction(pair[0], on=pair[1])), initial=0.0))
        for pair in reaction_pairs(case.mechanism)
    }
    threshold = ROUNDING * max(peaks.values(), default=0.0)
    carrying = {joint for (joint, _unused), peak in peaks.items() if peak > threshold}
    return [pair for pair in peaks if pair[0] in carrying]


def _figures(
    case: ReportContext, kind: str, parts: list[list[str]], shares: list[float], tallest: float
) -> Iterator[Block]:
    """A figure of some joints each, or why there is none."""
    caption = case.translate(CAPTIONS[kind])
    for number, (joints, share) in enumerate(zip(parts, shares, strict=True)):
        try:
            picture = case.diagram(kind, of=joints)
        except LinkwrightError as error:
            yield Paragraph(f"{case.translate(title_of(kind))}: {literal(case.message(error))}", "missing")
            continue
        title = case.translate(_("{caption} (continued)", caption=caption)) if number else caption
        yield Figure(title, ((picture, share),), "" if number else kind, tallest)


@section("balance", _("Equilibrium in matrix form"), 8.4, optional=True)
def balance(case: ReportContext) -> Iterator[Block]:
    """Names of unknowns and rows, the matrix, and its solution, of a machine without drivers."""
    result = None if case.mechanism.drivers else case.result
    found = structure_balance(result) if isinstance(result, Forces) else None
    if found is None:
        raise Missing(
            _(
                "only a structure of pins, guides and welds without drivers has a matrix of equilibrium",
                code="report.no_balance",
            )
        )
    yield from step_blocks(balance_step(found, "1", case.translate))


#: Height of a figure, mm, that a page has room for, and of the pictures below the text that begins the section.
PAGE, FIRST = 228.0, 178.0


@section("free_bodies", _("Free-body diagrams"), 8.45, optional=True)
def free_bodies(case: ReportContext) -> Iterator[Block]:
    """All that acts on each link, drawn and in numbers."""
    translate = case.translate
    forces, index = case.worked_result
    if not isinstance(forces, Forces):
        raise Missing(NO_LOADS)
    pages = free_body_pages(forces, index, translate, case.language, first=FIRST)
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
    yield Paragraph(translate(message.format(figure="[[free-bodies]]", place=place)))
    if idle := idle_loads(forces, index):
        yield Paragraph(literal(translate(_("Not acting at this position: {names}.", names=", ".join(idle)))), "note")
    caption = translate(_("Free-body diagrams of the links"))
    for number, svg in enumerate(pages, 1):
        shown = (
            caption
            if len(pages) == 1
            else translate(_("{caption} ({number} of {count})", caption=caption, number=number, count=len(pages)))
        )
        yield Figure(shown, ((svg, own_share(svg)),), "free-bodies" if number == 1 else "", PAGE)
