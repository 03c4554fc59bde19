"""The solution as a program: its flow chart, the calls of the teaching subprograms, a Python program."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from linkwright.core.table import Table
from linkwright.dyads.calls import FORMAL, Call, Calls, NumberedLink, NumberedPoint, calls, length
from linkwright.dyads.listing import Listing
from linkwright.dyads.plan import plan
from linkwright.errors import LinkwrightError
from linkwright.kinetostatics.forces import Forces
from linkwright.plotting.flow_chart import TALLEST, flow_chart_pages
from linkwright.plotting.solution_steps import flow_chart_steps
from linkwright.reports.document import Block, Code, Figure, Heading, Paragraph, literal, printed
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.numbers import typeset
from linkwright.reports.pictures import own_share
from linkwright.reports.section import section
from linkwright.words import _, pgettext


@section("flow", _("Flow chart of the solution"), 3.5)
def flow(case: ReportContext) -> Iterator[Block]:
    """The steps of the solution over the numbered positions, in as many pages as they need."""
    translate, numbered = case.translate, case.numbered
    nodes = flow_chart_steps(numbered.motion, numbered.rows, case.language)
    message = (
        _(
            "{figure} shows in which order the machine is solved: what each step needs is known "
            "from the steps before it. The calls have the names of the teaching texts (bark, "
            "rrrk …); i counts the numbered positions."
        )
        if case.mechanism.drivers
        else _(
            "{figure} shows in which order the machine is solved: what each step needs is known "
            "from the steps before it. The calls have the names of the teaching texts (rrrk, "
            "rrrf …)."
        )
    )
    yield Paragraph(translate(message.format(figure="[[flow]]")))
    caption = translate(_("Flow chart of the solution"))
    pages = flow_chart_pages(nodes, caption)
    for number, svg in enumerate(pages, 1):
        shown = (
            caption
            if len(pages) == 1
            else translate(_("{caption} ({number} of {count})", caption=caption, number=number, count=len(pages)))
        )
        yield Figure(shown, ((svg, own_share(svg)),), "flow" if number == 1 else "", TALLEST)


#: Why steps have no call of their own.
KINDS = {
    "weld": _("it is fixed to a link solved before"),
    "slider": _("its displacement along the guide is given, so p, vp and ap of its points are written at once"),
}


@section("calls", _("Calls of the teaching subprograms"), 14.0, optional=True)
def subprogram_calls(case: ReportContext) -> Iterator[Block]:
    """Numbering, the calls in solving order, a table of formal and actual arguments for every subprogram."""
    translate = case.translate
    numbered = case.numbered
    forces = case.mechanism.has_loads
    made = calls(plan(numbered.motion, numbered.rows), case.heads.numbers, forces=forces)
    if not made.motion:
        raise Missing(_("no group of this machine has a subprogram of these texts", code="calls.none"))
    yield Paragraph(
        translate(
            _(
                "The machine in the subprograms of the teaching texts (bark for a bar, rrrk to rppk "
                "for the motion of the five dyads, barf and rrrf to rppf for their joint forces). "
                "Points have the numbers n and links the numbers k of the tables below; $p$, $v_p$, "
                "$a_p$ are the motion of the points, $t$, $w$, $e$ the directions of the links with "
                "their rates. Lengths in m, angles in rad, 0: not used."
            )
        )
    )
    yield _points(case, made.points)
    yield _links(case, made)
    yield from _others(case, made)
    for title, program, group in (
        (_("Motion, in solving order"), _("calls for the motion"), made.motion),
        (_("Joint forces, from the last group to the first"), _("calls for the joint forces"), made.forces),
    ):
        if group:
            yield Heading(translate(title), 2)
            yield Code(_program(group), "", translate(program))
            yield from _tables(case, group)
    for note in dict.fromkeys(map(str, made.notes)):
        message = next(each for each in made.notes if str(each) == note)
        yield Paragraph(literal(case.sentence(message)), "note")


def _points(case: ReportContext, points: Sequence[NumberedPoint]) -> Block:
    translate = case.translate
    rows = []
    for point in points:
        links = ", ".join(translate(_("frame")) if link == "frame" else link for link in point.links)
        place = "–" if point.place is None else f"({length(point.place.real)}, {length(point.place.imag)})"
        rows.append((point.number, case.sentence(point.name), links, place))
    head = (_("n"), _("point"), pgettext("calls", "on"), _("fixed place / m"))
    return printed(Table(head, rows, "><<<", _("Numbers of the points")), case.language)


def _links(case: ReportContext, made: Calls) -> Block:
    """Links, and guides that need a direction of their own; masses where forces are found."""
    translate, width = case.translate, 5 if made.forces else 3
    rows = []
    for link in sorted(made.links, key=lambda each: each.number):
        part = case.mechanism.links.get(link.name)
        mass, inertia = (length(part.mass), length(part.inertia)) if part else ("–", "–")
        name = link.name if part else translate(_("direction of guide {guide}", guide=link.name))
        cells = (str(link.number), name, _direction(case, link), mass, inertia)
        rows.append(tuple(map(typeset, cells[:width])))
    head = (_("k"), _("link"), _("t(k)"), _("mass / kg"), _("moment of inertia / kg·m²"))[:width]
    return printed(Table(head, rows, "><<>>"[:width], _("Numbers of the links")), case.language)


def _direction(case: ReportContext, link: NumberedLink) -> str:
    """What t(k) of a link is."""
    translate = case.translate
    if link.line is not None:
        return translate(_("from point {first} to {second}", first=link.line[0], second=link.line[1]))
    if link.along:
        return translate(_("along guide {guide}", guide=link.along))
    if link.name in case.mechanism.links:
        return translate(_("x axis of the link"))
    if not link.against:
        return translate(_("{angle} rad, constant", angle=length(link.angle)))
    return translate(_("t({link}) + {angle} rad", angle=length(link.angle), link=link.against))


def _others(case: ReportContext, made: Calls) -> Iterator[Paragraph]:
    """Which steps have no call, and why; once for each reason."""
    translate = case.translate
    groups: dict[str, list[str]] = {}
    for step in made.others:
        reason: str = translate(KINDS[step.kind]) if step.kind else case.sentence(step.reason)
        groups.setdefault(reason, []).append(
            translate(_("{signature} ({links})", signature=step.group.signature, links=", ".join(step.group.links)))
        )
    for reason, named in groups.items():
        message = translate(
            _(
                "No subprogram of these texts for {groups}: {reason}.",
                groups=translate(_(", ")).join(named),
                reason=reason,
            )
        )
        yield Paragraph(literal(message), "note")
    if made.forces and any(not step.kind for step in made.others):
        yield Paragraph(
            translate(
                _(
                    "What groups without a subprogram exert on the links of the others is not in the "
                    "calls for the joint forces; it is added as a force at a point (nn)."
                )
            ),
            "note",
        )


def _program(group: Sequence[Call]) -> str:
    return "\n".join(f"Call {call.text}" for call in group)


def _tables(case: ReportContext, group: Sequence[Call]) -> Iterator[Block]:
    """A table for every subprogram, a row for every call."""
    for name in FORMAL:
        mine = [call for call in group if call.name == name]
        if mine:
            head = (_("formal:"), *FORMAL[name])
            rows = [(", ".join(call.links), *map(typeset, call.actual)) for call in mine]
            title = _("{name}: formal arguments (head) and actual ones", name=name)
            yield printed(Table(head, rows, "<" + "^" * len(FORMAL[name]), title), case.language)


@section("program", _("Program listing"), 14.5, optional=True)
def program(case: ReportContext) -> Iterator[Block]:
    """The program, at the positions of the tables."""
    translate, numbered = case.translate, case.numbered
    try:
        forces: Forces | None = case.numbered_forces
    except LinkwrightError:
        forces = None
    listing = Listing(
        numbered.motion, forces, translate, rows=numbered.rows, source=case.source, language=case.language
    )
    text = listing.text()
    yield Paragraph(
        translate(
            _(
                "The program solves the machine at the {count} positions of the tables, group by "
                "group in solving order, with the functions of linkwright.dyads, and prints every "
                "column as comma-separated values in SI units. `linkwright export FILE --to "
                "solution.py` writes it as a file, over the full cycle.",
                count=len(listing.rows),
            )
        )
    )
    if listing.plan.others:
        yield Paragraph(
            translate(
                _(
                    "Groups of which there is no such function are solved by the library; the model file "
                    "has to be where the program runs."
                )
            ),
            "note",
        )
    yield Code(text, "python", translate(_("the machine solved with linkwright.dyads")), "program")
