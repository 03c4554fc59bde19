"""Equilibrium of a structure as one linear system A·X = B."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.kinetostatics.forces import Forces
from linkwright.parts.statics.balance import structure_balance
from linkwright.parts.statics.structure import balance_step
from linkwright.report.document import Block
from linkwright.report.machine_results import Case, Missing
from linkwright.report.section import section
from linkwright.report.sections.method import printed


@section("balance", 8.4, optional=True)
def blocks(case: Case) -> Iterator[Block]:
    """Names of unknowns and rows, the matrix, and its solution, of a machine without drivers."""
    if case.mechanism.drivers or not isinstance(case.result, Forces):
        raise Missing("report.no_balance")
    balance = structure_balance(case.result)
    if balance is None:
        raise Missing("report.no_balance")
    yield from printed(balance_step(balance, "1", case.say))
