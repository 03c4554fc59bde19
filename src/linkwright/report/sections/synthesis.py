"""Synthesis, where the file has a task for it."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.report.document import Block, Paragraph, literal
from linkwright.report.machine_results import Case, Missing
from linkwright.report.section import section


@section("synthesis", 12.0, optional=True)
def blocks(case: Case) -> Iterator[Block]:
    """The task and what was found for it."""
    from linkwright.synthesis.tasks import synthesize

    if not case.mechanism.synthesis or not case.source:
        raise Missing("report.no_synthesis")
    found = synthesize(case.source)
    for line in found.text(case.language).splitlines():
        if line.strip():
            yield Paragraph(literal(line.strip()))
