"""Tables over the cycle, positions numbered from a limit position, and all numbers in an appendix."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import KINDS, NAMED, RESIDUALS, SLIDE, Output
from linkwright.errors import LinkwrightError
from linkwright.kinetostatics.table import force_results, motion_results
from linkwright.reports.document import Block, Paragraph, Table, literal
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.numbers import column, faded, residual, typeset, without_rounding
from linkwright.reports.section import section
from linkwright.words import Message, _


@section("tables", _("Tables over the cycle"), 6.0)
def tables(case: ReportContext) -> Iterator[Block]:
    """Angles and rates of links, guides, points; joint forces and driver effort: at the numbered positions."""
    translate, numbered = case.translate, case.numbered
    count = str(len(numbered.rows))
    if numbered.listed:
        yield Paragraph(
            translate(
                _(
                    "The {count} positions are those that the task asks for, in its order; limit "
                    "positions among them are exact.",
                    count=count,
                )
            )
        )
        yield from _unreached(case)
    elif numbered.start is not None:
        place = f"{case.input_text(numbered.start.input)}{case.input_unit}"
        yield Paragraph(
            translate(
                _(
                    "The {count} positions are equally spaced in time and numbered from the limit "
                    "position at the input {input} on.",
                    count=count,
                    input=place,
                )
            )
        )
    elif case.mechanism.drivers:
        yield Paragraph(
            translate(
                _(
                    "The {count} positions are equally spaced over the motion and numbered from its start.",
                    count=count,
                )
            )
        )
    if case.unnumbered:
        yield Paragraph(literal(case.unnumbered), "note")
    for note in case.motion.notes:
        yield Paragraph(literal(case.sentence(note)), "note")
    yield Paragraph(literal(case.links_text))
    columns = without_rounding(motion_results(numbered.motion))
    if len(inputs := _of(columns, "input")) > 1:
        yield table(case, translate(_("Inputs of the drivers")), columns, inputs)
    for title, wanted in _motion_tables(case, columns):
        yield table(case, translate(title), columns, wanted)
    try:
        columns = without_rounding(force_results(case.numbered_forces))
    except Missing:
        return
    except LinkwrightError as error:
        yield Paragraph(literal(case.message(error)), "missing")
        return
    sizes = [each for each in _of(columns, "reaction", "reaction_direction", "couple") if not each.component]
    efforts = _of(columns, "effort")
    yield from varying(
        case,
        _(
            "Joint forces ($F_{A,2}$: force of joint A on link 2; $\\beta$: its direction from the "
            "$x$ axis; $M$: couple of a guide)"
        ),
        columns,
        sizes,
    )
    if efforts:
        shaking = _of(columns, "shaking_force", "shaking_moment")
        yield from varying(
            case, _("Driving effort (index d), shaking force and its moment (index S)"), columns, [*efforts, *shaking]
        )


def _motion_tables(case: ReportContext, columns: Mapping[Output, Floats]) -> Iterator[tuple[Message, list[Output]]]:
    """Titles and columns: of links that turn, of guides, of outputs that the model names, of points."""
    links = [each for each in columns if KINDS[each.kind].of == "link" and each in case.varying]
    points = [each for each in columns if KINDS[each.kind].of == "point" and each in case.varying]
    places = _of(points, "position")
    for title, found in (
        (_("Angles, angular velocities and angular accelerations of the links"), links),
        (_("Displacement, velocity and acceleration of the blocks in their guides"), _of(columns, *SLIDE)),
        (_("Outputs that the model names"), _of(columns, *NAMED)),
        (_("Places of the points"), places),
        (_("Velocities and accelerations of the points"), [each for each in points if each not in places]),
    ):
        if found:
            yield title, found


def _of(columns: Iterable[Output], *kinds: str) -> list[Output]:
    return [each for each in columns if each.kind in kinds]


def _unreached(case: ReportContext) -> Iterator[Block]:
    """Why positions that are listed have no numbers, those with the same reason together."""
    reasons: dict[str, list[str]] = {}
    for number, outcome in enumerate(case.numbered.motion.outcomes, 1):
        if not outcome.ok:
            reasons.setdefault(outcome.translate(case.language), []).append(str(number))
    for reason, numbers in reasons.items():
        message = case.translate(
            _(
                "No numbers at position {numbers}: {reason}",
                numbers=case.translate(_(", ")).join(numbers),
                reason=reason,
            )
        )
        yield Paragraph(literal(message), "missing")


def varying(
    case: ReportContext, title: Message, columns: Mapping[Output, Floats], names: Sequence[Output]
) -> Iterator[Block]:
    """What does not change over the cycle in a sentence, the others in a table; all in it without a driver."""
    moving = [name for name in names if name in case.varying] if case.mechanism.drivers else names
    still = [name for name in names if name not in moving and np.isfinite(columns[name]).any()]
    if still:
        yield Paragraph(
            case.translate(
                _(
                    "Constant over the cycle: {values}.",
                    values=", ".join(_equal(case, columns, each) for each in still),
                )
            )
        )
    if moving:
        yield table(case, case.translate(title), columns, moving)


def _equal(case: ReportContext, columns: Mapping[Output, Floats], name: Output) -> str:
    """What a result that does not change is equal to."""
    head, factor = case.heads.head(name)
    quantity, _unused, unit = head.rpartition("\u00a0/\u00a0")
    known = columns[name][np.isfinite(columns[name])]
    value = typeset(f"{faded(float(known[0])) * factor:.6g}")
    return f"{quantity} = {value} {unit}".replace(" °", "°")


def table(case: ReportContext, title: str, columns: Mapping[Output, Floats], names: Sequence[Output]) -> Table:
    """Columns at the numbered positions, in shown units."""
    rows = list(case.numbered.rows)
    key, first = leading(case)
    shown = [case.heads.head(name) for name in names]
    printed = [
        (residual if name.kind in RESIDUALS else column)(columns[name][rows] * factor)
        for name, (_unused, factor) in zip(names, shown, strict=True)
    ]
    body = tuple((*first[k], *(each[k] for each in printed)) for k in range(len(rows)))
    head = (*key, *(head for head, _unused in shown))
    return Table(title, head, body, ">" * len(head), "", len(key))


def leading(case: ReportContext) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Heads and cells of what every table begins with: numbers of the positions, the time where drivers follow laws
    of their own, the input; of several drivers the first one's, or the time alone."""
    motion, rows = case.numbered.motion, list(case.numbered.rows)
    heads, columns = [case.translate(_("no."))], [[str(k + 1) for k in range(len(rows))]]
    if not case.mechanism.drivers:
        return (*heads, f"$q$ / {case.input_unit}"), [(number, "–") for number in columns[0]]
    if not case.mechanism.steady:
        heads.append("$t$ / s")
        columns.append(column(motion.time[rows]))
    if case.mechanism.steady or len(motion.inputs) == 1:
        heads.append(f"$q$ / {case.input_unit}")
        columns.append([case.input_text(float(value)) for value in motion.input[rows]])
    return tuple(heads), list(zip(*columns, strict=True))


@section("appendix", _("Appendix: all numbers"), 30.0)
def appendix(case: ReportContext) -> Iterator[Block]:
    """Every column of the result."""
    translate = case.translate
    try:
        columns = without_rounding(force_results(case.numbered_forces))
    except LinkwrightError:
        columns = without_rounding(motion_results(case.numbered.motion))
    yield Paragraph(
        translate(
            _(
                "All results at the numbered positions; $\\Delta P$ and $\\Delta F$ are what is left "
                "over in the balance of powers and of forces."
            )
        )
    )
    alone = len(case.mechanism.drivers) < 2
    names = [each for each in columns if each.kind != "input" or not alone]
    yield from varying(case, _("All results"), columns, names)
