"""Equilibrium of a structure as one linear system A·X = B."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.kinetostatics.forces import Forces
from linkwright.parts.statics.structure import balance_step, structure_balance
from linkwright.reports.document import Block
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.section import section
from linkwright.reports.sections.method import printed
from linkwright.words import _


@section("balance", _("Equilibrium in matrix form"), 8.4, optional=True)
def blocks(case: ReportContext) -> Iterator[Block]:
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
    yield from printed(balance_step(found, "1", case.say))
