"""The driver's effort by two methods, and motor and flywheel for steady running."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.core.table import Table
from linkwright.cycle.summaries import Summary
from linkwright.equations.notation import quantity, row, sign
from linkwright.equations.reading import read, read_name, sides
from linkwright.errors import LinkwrightError
from linkwright.machine.running import SteadyRunning
from linkwright.reports.document import Block, Figure, Formula, Paragraph, literal, printed
from linkwright.reports.document import Table as TableBlock
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.numbers import column, small, typeset
from linkwright.reports.section import section
from linkwright.reports.sections.curves import pictures
from linkwright.reports.sections.cycle_tables import leading
from linkwright.words import _


@section("torque", _("Driving effort by two methods"), 9.0, optional=True)
def torque(case: ReportContext) -> Iterator[Block]:
    """Effort from the joint forces next to effort from the powers of all forces."""
    if not case.mechanism.drivers:
        raise Missing(_("the machine has no driver, so nothing moves", code="report.no_motion"))
    translate, forces, numbered = case.translate, case.forces, case.numbered
    unit = "N·m" if case.rotary else "N"
    letter = "M" if case.rotary else "F"
    yield Paragraph(
        translate(
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
            translate(_("from joint forces")) + f" / {unit}",
            translate(_("from powers")) + f" / {unit}",
            translate(_("difference")) + f" / {unit}",
        )
        yield TableBlock(
            translate(_("Driving effort from the joint forces and from the powers")),
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
            translate(
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


#: Why machines have neither motor nor flywheel: another drive, no work over full turns.
WITHOUT = ("running.one_driver", "running.not_constant", "running.not_whole_turns", "running.no_work")


@section("flywheel", _("Motor and flywheel"), 11.0, optional=True)
def flywheel(case: ReportContext) -> Iterator[Block]:
    """Mean torque, motor, energy fluctuation, flywheel by the formula and exactly."""
    translate, running = case.translate, _running(case)
    yield Paragraph(
        translate(
            _(
                "For a coefficient of speed fluctuation $\\delta = {fluctuation}$, with the energy "
                "fluctuation $\\Delta E$, the mean speed $\\omega_{{\\mathrm{{m}}}}$ and the machine's "
                "own mean equivalent inertia:",
                fluctuation=f"{running.required:g}",
            )
        )
    )
    for remark in running.remarks:
        yield Paragraph(literal(remark.translate(case.language)))
    speed, energy, mean = running.equivalent.speed, running.energy.value, running.equivalent.mean_inertia
    shown = [read("J_F"), row((read("ΔE/(δ ω_m²)"), sign("-"), read_name("J_e,m")))]
    if running.flywheel:
        numbers = f"{energy:.6g}/({running.required:g}·{speed:.6g}²) − {mean:.6g}"
        shown += [read(numbers), row(quantity(f"{running.flywheel:.6g}", "kg·m²"))]
    yield Formula(tuple(shown), "flywheel-formula")
    if not running.flywheel:
        yield Paragraph(
            translate(
                _(
                    "The machine's own inertia is enough: it runs more evenly than {most} without a flywheel.",
                    most=f"{running.required:g}",
                )
            )
        )
    head = (_("metric"), _("value"), _("unit"), _("at the input"))
    rows = [row for table in running.tables(case.language, digits=6) for row in table.rows]
    table = Table(head, rows, "<><>", _("Motor, energy fluctuation and flywheel"))
    yield printed(table, case.language, "flywheel")
    yield from _speed(case)
    yield from pictures(case, ("energy",))


def _running(case: ReportContext) -> SteadyRunning:
    """Motor and flywheel; raises Missing for machines that have none."""
    try:
        return case.running
    except LinkwrightError as error:
        if error.code in WITHOUT:
            raise Missing(error.sentence) from None
        raise


def _speed(case: ReportContext) -> Iterator[Block]:
    try:
        shown = case.diagram("speed", case.running, fluctuation=case.settings.fluctuation)
    except LinkwrightError as error:
        yield Paragraph(literal(case.message(error)), "missing")
        return
    yield Figure(case.translate(_("True speed over the cycle with the flywheel")), ((shown, 0.92),), "speed")
