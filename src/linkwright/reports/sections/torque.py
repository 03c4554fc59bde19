"""The driver's effort by both methods, and their difference."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.cycle.summaries import Summary
from linkwright.equations.reading import sides
from linkwright.reports.document import Block, Formula, Paragraph, Table
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.numbers import column, small, typeset
from linkwright.reports.section import section
from linkwright.reports.sections.curves import pictures
from linkwright.reports.sections.cycle_tables import leading
from linkwright.words import _


@section("torque", _("Driving effort by two methods"), 9.0, optional=True)
def blocks(case: ReportContext) -> Iterator[Block]:
    """Effort from the joint forces next to effort from the powers of all forces."""
    if not case.mechanism.drivers:
        raise Missing(_("the machine has no driver, so nothing moves", code="report.no_motion"))
    say, forces, numbered = case.say, case.forces, case.numbered
    unit = "N·m" if case.rotary else "N"
    letter = "M" if case.rotary else "F"
    yield Paragraph(
        say(
            _(
                "The effort of the driver is found twice: from the equilibrium of the driven link "
                "with all joint forces, and from the sum of the powers of weight, inertia and loads, "
                "which with the driver's own must be zero."
            )
        )
    )
    if len(case.mechanism.drivers) == 1:
        virtual = f"{letter}_d q\u0307 + Σ(K\u20d7·v\u20d7_G + M_J ω) + ΣF\u20d7·v\u20d7 = 0"
        yield Formula(sides(virtual), "virtual-power")
        at = case.numbered_forces
        rows = list(numbered.rows)
        joint, power = at.input_torque[rows], at.input_torque_from_power[rows]
        printed = (column(joint), column(power))
        gaps = [small(float(gap), 2) for gap in joint - power]
        key, first = leading(case)
        body = tuple((*first[k], printed[0][k], printed[1][k], gaps[k]) for k in range(len(rows)))
        head = (
            *key,
            say(_("from joint forces")) + f" / {unit}",
            say(_("from powers")) + f" / {unit}",
            say(_("difference")) + f" / {unit}",
        )
        yield Table(
            say(_("Driving effort from the joint forces and from the powers")),
            head,
            body,
            ">" * len(head),
            "torque-both",
            len(key),
        )
        known = forces.input_torque - forces.input_torque_from_power
        largest = float(np.nanmax(np.abs(known)))
        (driver,) = case.mechanism.drivers
        top = Analysis.of(forces).part(Summary(f"{driver}.effort", "peak")).value
        yield Paragraph(
            say(
                _(
                    "The largest difference of both methods over the cycle is {gap}, against an effort "
                    "of up to {top} ({table}).",
                    gap=f"{_number(largest, 2)} {unit}",
                    top=f"{_number(top, 6)} {unit}",
                    table="[[torque-both]]",
                )
            )
        )
    yield from pictures(case, ("torque",))


def _number(value: float, digits: int) -> str:
    """A number in a sentence."""
    return typeset(f"{value:.{digits}g}")
