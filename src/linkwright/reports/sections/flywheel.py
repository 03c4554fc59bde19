"""Motor and flywheel for steady running."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.core.table import Table
from linkwright.equations.notation import quantity, row, sign
from linkwright.equations.reading import read, read_name
from linkwright.errors import LinkwrightError
from linkwright.machine.running import SteadyRunning
from linkwright.reports.document import Block, Figure, Formula, Paragraph, literal, printed
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.section import section
from linkwright.reports.sections.curves import pictures
from linkwright.words import _

#: Why machines have neither motor nor flywheel: another drive, no work over full turns.
WITHOUT = ("running.one_driver", "running.not_constant", "running.not_whole_turns", "running.no_work")


@section("flywheel", _("Motor and flywheel"), 11.0, optional=True)
def blocks(case: ReportContext) -> Iterator[Block]:
    """Mean torque, motor, energy fluctuation, flywheel by the formula and exactly."""
    say, running = case.say, _running(case)
    yield Paragraph(
        say(
            _(
                "For a coefficient of speed fluctuation $\\delta = {fluctuation}$, with the energy "
                "fluctuation $\\Delta E$, the mean speed $\\omega_{{\\mathrm{{m}}}}$ and the machine's "
                "own mean equivalent inertia:",
                fluctuation=f"{running.required:g}",
            )
        )
    )
    for remark in running.remarks:
        yield Paragraph(literal(remark.say(case.language)))
    speed, energy, mean = running.equivalent.speed, running.energy.value, running.equivalent.mean_inertia
    shown = [read("J_F"), row((read("ΔE/(δ ω_m²)"), sign("-"), read_name("J_e,m")))]
    if running.flywheel:
        numbers = f"{energy:.6g}/({running.required:g}·{speed:.6g}²) − {mean:.6g}"
        shown += [read(numbers), row(quantity(f"{running.flywheel:.6g}", "kg·m²"))]
    yield Formula(tuple(shown), "flywheel-formula")
    if not running.flywheel:
        yield Paragraph(
            say(
                _(
                    "The machine's own inertia is enough: it runs more evenly than {most} without a flywheel.",
                    most=f"{running.required:g}",
                )
            )
        )
    head = (_("design number"), _("value"), _("unit"), _("at the input"))
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
    yield Figure(case.say(_("True speed over the cycle with the flywheel")), ((shown, 0.92),), "speed")
