"""Curves over the cycle: displacement, velocity, acceleration of what the machine puts out; paths of points."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.errors import LinkwrightError
from linkwright.plotting.diagrams.base import title_of
from linkwright.plotting.diagrams.source import main_outputs
from linkwright.reports.document import Block, Figure, Paragraph, literal
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.section import section
from linkwright.words import _, pgettext

KINDS = ("sva", "angles", "paths")
#: What is no fault of a machine: none of its links turns.
WITHOUT = ("picture.none_turns",)
#: Share of the text's width of a diagram, and its height, mm: two of them share a page.
SHARE, TALLEST = 0.78, 104.0
#: Captions of diagrams over the cycle.
CAPTIONS = {
    "sva": _("Displacement, velocity and acceleration of the output over the input"),
    "angles": _("Angles of the links over the input"),
    "paths": _("Paths of the points"),
    "torque": _("Driving effort over the input"),
    "energy": _("Torque, work and excess energy over the cycle"),
}


@section("curves", pgettext("report", "Curves"), 7.0, optional=True)
def blocks(case: ReportContext) -> Iterator[Block]:
    """Diagrams of the motion."""
    if not case.mechanism.drivers:
        raise Missing(_("the machine has no driver, so nothing moves", code="report.no_motion"))
    yield Paragraph(case.translate(_("The marks on the curves are limit positions and peaks.")))
    outputs = main_outputs(case.motion)
    if len(outputs) == 1:
        outputs = []
    for output in outputs:
        caption = case.translate(
            _("Displacement, velocity and acceleration of {output} over the input", output=str(output))
        )
        if (shown := _figure(case, "sva", caption, of=(str(output),))) is not None:
            yield shown
    yield from pictures(case, KINDS[bool(outputs) :])


def pictures(case: ReportContext, kinds: tuple[str, ...]) -> Iterator[Block]:
    """A figure per kind of diagram, or why there is none."""
    for kind in kinds:
        shown = _figure(case, kind, case.translate(CAPTIONS[kind]))
        if shown is not None:
            yield shown


def _figure(case: ReportContext, kind: str, caption: str, **options: object) -> Block | None:
    """A diagram, or why there is none; None where the machine has nothing of its kind."""
    try:
        shown = case.diagram(kind, case.motion if kind in KINDS else None, **options)
    except LinkwrightError as error:
        if error.code in WITHOUT:
            return None
        return Paragraph(f"{case.translate(title_of(kind))}: {literal(case.message(error))}", "missing")
    return Figure(caption, ((shown, SHARE),), "" if options else kind, TALLEST)
