"""One position worked out with its numbers, and its polygons."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.errors import LinkwrightError
from linkwright.kinetostatics.forces import Forces
from linkwright.pictures.drawing import PIXELS
from linkwright.pictures.svg import natural_size
from linkwright.plotting.diagrams.base import title_of
from linkwright.plotting.diagrams.pages import link_forces
from linkwright.reports.document import Block, Figure, Heading, Paragraph, literal, symbols
from linkwright.reports.machine_results import ReportContext
from linkwright.reports.section import section
from linkwright.reports.sections.method import printed
from linkwright.words import Translate, _
from linkwright.worked_solutions.solution import Worked

#: A point, the width of the text and the tallest polygon, mm.
TEXT, TALLEST = 170.0, 225.0
#: Links whose force polygons share a page; a page that would be smaller than this share is parted.
ON_PAGE, SMALL = 5, 0.6
#: Captions of polygons.
CAPTIONS = {
    "velocity_polygon": _("Velocity polygon, next to the position"),
    "acceleration_polygon": _("Acceleration polygon, next to the position"),
    "force_polygon": _("Force polygons of the links, group by group"),
}


@section("worked", _("One position worked out"), 5.0)
def blocks(case: ReportContext) -> Iterator[Block]:
    """Every equation of the position with the numbers put in; polygons of velocities, accelerations and forces."""
    say = case.say
    case.require_position()
    if case.worked_text:
        yield Paragraph(say(_("The position {input} is worked out in full.", input=literal(case.worked_text))))
    try:
        yield from _solution(case.worked)
    except LinkwrightError as error:
        yield Paragraph(
            say(
                _(
                    "The equations with their numbers cannot be written here, the polygons can be drawn: {sentence}",
                    sentence=literal(case.message(error)),
                )
            ),
            "missing",
        )
    yield Heading(say(_("Polygons of this position")), 2)
    yield from _polygons(case)


def _solution(solution: Worked) -> Iterator[Block]:
    """All steps of a worked solution."""
    for line in solution.legend:
        yield Paragraph(symbols(line))
    for step in solution.steps:
        yield Heading(symbols(step.title), 2 if "." not in step.number else 3)
        yield from printed(step)


def _polygons(case: ReportContext) -> Iterator[Block]:
    source, index = case.worked_result
    pages: list[tuple[str, list[str]]] = []
    if case.mechanism.drivers:
        pages += [("velocity_polygon", []), ("acceleration_polygon", [])]
    if isinstance(source, Forces):
        pages += [("force_polygon", links) for links in _sheets(source, index)]
    drawn: list[str] = []
    while pages:
        kind, links = pages.pop(0)
        of = {"of": links} if links else {}
        result = source if kind == "force_polygon" else None
        try:
            picture = case.diagram(kind, result, at=case.worked_place, **of)
        except LinkwrightError as error:
            yield Paragraph(f"{case.say(title_of(kind))}: {literal(case.message(error))}", "missing")
            continue
        if len(links) > 1 and share_of(picture) < SMALL:
            half = len(links) // 2
            pages[:0] = [(kind, links[:half]), (kind, links[half:])]
            continue
        caption = case.say(CAPTIONS[kind])
        again = kind in drawn
        shown = case.say(_("{caption} (continued)", caption=caption)) if again else caption
        yield to_scale(case.say, shown, picture, "" if again else kind)
        drawn.append(kind)


def _sheets(forces: Forces, index: int) -> list[list[str]]:
    """Links whose force polygons share a page: groups in the order of statics, links with three forces or more."""
    sheets: list[list[str]] = [[]]
    found = link_forces(forces, index)
    for group in reversed(forces.motion.structure.groups):
        links = [link for link in reversed(group.links) if len(found.get(link, ())) > 2]
        if sheets[-1] and len(sheets[-1]) + len(links) > ON_PAGE:
            sheets.append([])
        sheets[-1] += links
    return sheets


def share_of(picture: str) -> float:
    """The share of its own size in which a picture fits a page."""
    wide, high = (each / PIXELS for each in natural_size(picture))
    return min(1.0, TEXT / wide, TALLEST / high)


def to_scale(say: Translate, caption: str, picture: str, label: str = "") -> Figure:
    """A picture in its own size, so that a millimetre is one; where it must be smaller the caption says so."""
    wide, share = natural_size(picture)[0] / PIXELS, share_of(picture)
    if share < 0.995:
        caption = say(
            _(
                "{caption} (printed at {percent} % of the scale that it states)",
                caption=caption,
                percent=f"{100 * share:.0f}",
            )
        )
    return Figure(caption, ((picture, share * wide / TEXT),), label, TALLEST)
