"""The machine's run under its loads and actuators: how it ends, what happens, its speed over time."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.core.table import Table
from linkwright.dynamics.run import run as run_machine
from linkwright.dynamics.run_text import RunText
from linkwright.equations.reading import sides
from linkwright.errors import LinkwrightError
from linkwright.reports.document import Block, Figure, Formula, Paragraph, printed
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.section import section
from linkwright.words import _


@section("run", _("Motion under forces"), 11.5, optional=True)
def run(case: ReportContext) -> Iterator[Block]:
    """The run that the file asks for; left out where it has neither actuators nor conditions of a run."""
    mechanism, translate = case.mechanism, case.translate
    if not mechanism.drivers or not (mechanism.actuators or mechanism.run is not None):
        raise Missing(_("the model has no actuators and asks for no run", code="report.no_run"))
    try:
        found = run_machine(mechanism)
        text = RunText(found)
        name, driver = next(iter(mechanism.drivers.items()))
        of = driver.link if case.rotary else driver.joint
        shown = case.diagram("sva", found, of=(of,))
    except LinkwrightError as error:
        raise Missing(error.sentence) from None
    yield Paragraph(
        translate(
            _(
                "The drivers' coordinates $q$ are free; loads, weights and actuators move the machine. Inertia and "
                "forces are reduced to the coordinates, and their equation of motion is integrated from event to "
                "event. What the work of all forces and the kinetic energy differ by is the error:"
            )
        )
    )
    yield Formula(sides("M(q) q\u0308 + h(q, q\u0307, t) = 0"), "motion-under-forces")
    summary, *events = text.tables(case.language)
    end = Table((_("result"), _("value"), ""), summary.rows, "<><", _("How the run ends"))
    yield printed(end, case.language, "run-end")
    for table in events:
        yield printed(table, case.language, "run-events")
    own = translate(_("driver", code="nouns.driver")) if name == "driver" else name
    yield Figure(translate(_("Coordinate of {name} over the time", name=own)), ((shown, 0.92),), "run")
