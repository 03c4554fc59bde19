"""Curves over the cycle: displacement, velocity, acceleration of what the machine puts out; paths of points."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.errors import LinkwrightError
from linkwright.report.case import Case, Missing
from linkwright.report.document import Block, Figure, Paragraph, literal
from linkwright.report.section import section

KINDS = ("sva", "angles", "paths")
#: Share of the text's width of a diagram, and its height, mm: two of them share a page.
SHARE, TALLEST = 0.78, 104.0


@section("curves", 7.0)
def blocks(case: Case) -> Iterator[Block]:
    """Diagrams of the motion."""
    if not case.mechanism.drivers:
        raise Missing("report.no_motion")
    yield Paragraph(case.say("report.curves_text"))
    yield from pictures(case, KINDS)


def pictures(case: Case, kinds: tuple[str, ...], share: float = SHARE) -> Iterator[Block]:
    """A figure per kind of diagram, or why there is none."""
    for kind in kinds:
        try:
            shown = case.diagram(kind, case.motion if kind in KINDS else None)
        except LinkwrightError as error:
            yield Paragraph(f"{case.say(f'plot.kind.{kind}')}: {literal(case.told(error))}", "missing")
            continue
        yield Figure(case.say(f"report.caption_{kind}"), ((shown, share),), kind, TALLEST)
