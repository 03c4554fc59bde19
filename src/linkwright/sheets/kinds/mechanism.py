"""The sheet of a mechanism: positions, polygons, diagrams over the cycle and tables."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

from linkwright.core.outputs import Output
from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinetostatics.forces import Forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.pictures.picture import as_runs, indexed
from linkwright.plotting.diagrams.axes import SYMBOLS, InputAxis
from linkwright.plotting.diagrams.base import Request
from linkwright.plotting.diagrams.forces import Torque
from linkwright.plotting.diagrams.motion import Sva
from linkwright.plotting.diagrams.pages import link_forces, worth_drawing
from linkwright.plotting.diagrams.panels import Panel as Plotted
from linkwright.plotting.diagrams.source import PlotInput, main_output
from linkwright.sheets.curves import CurvePanel
from linkwright.sheets.machine import MachinePanel
from linkwright.sheets.machine_tables import data_table, force_table, motion_table
from linkwright.sheets.panel import Panel
from linkwright.sheets.polygons import AccelerationPanel, ForcePanel, VelocityPanel
from linkwright.sheets.positions import Positions
from linkwright.sheets.settings import SHEETS, Content, Subject
from linkwright.words import _

#: Names of the diagrams of an output, with their ranks: where it is, its velocity, its acceleration.
_MOTION = (
    ("displacement", 3.0, _("Motion of {output}")),
    ("velocity", 3.5, _("Velocity of {output}")),
    ("acceleration", 4.0, _("Acceleration of {output}")),
)


@SHEETS.register("mechanism")
def mechanism(subject: Subject) -> Content:
    """Mechanism, polygons of the positions, force polygons, diagrams, tables; what a machine does not have is left
    out."""
    if not isinstance(subject.drawn, Mechanism):
        raise RequestError(
            _(
                "a sheet of the kind mechanism needs a mechanism; this file holds a calculation",
                code="sheet.no_mechanism",
            )
        )
    positions = Positions(subject)
    if not positions.shown:
        raise LinkwrightError(
            _(
                "{name}: none of the positions of the sheet is reached; choose others with `sheet: positions`",
                code="sheet.nothing_reached",
                name=subject.drawn.name,
            )
        )
    machine = MachinePanel("mechanism", positions)
    panels: list[Panel] = [machine]
    if subject.drawn.drivers:
        panels += _motion_polygons(positions)
    forces = positions.forces
    if forces is not None:
        panels += _force_polygons(positions, forces)
    panels += _curves(positions)
    panels += [data_table(positions), *motion_table(positions), *force_table(positions)]
    return Content(panels)


def _motion_polygons(positions: Positions) -> Iterator[Panel]:
    """Velocity and acceleration polygon of each position; left out where all is at rest."""
    for shown in positions.shown:
        later, number = (5.0, 2) if shown.number == "II" else (0.0, 1)
        for kind, name, rank in ((VelocityPanel, "velocity", 1.0), (AccelerationPanel, "acceleration", 1.5)):
            with suppress(LinkwrightError):
                yield kind(f"{name}_{number}", rank + later, positions, shown)


def _force_polygons(positions: Positions, forces: Forces) -> Iterator[Panel]:
    """The force polygons of the links in the order of statics, for each position."""
    for shown in positions.shown:
        rank = 5.0 if shown.number == "I" else 8.0
        found = link_forces(forces, shown.index)
        for link, acting in worth_drawing(found).items():
            if len(acting) > 2 or not positions.mechanism.drivers:
                yield ForcePanel(f"force_{len(shown.number)}_{link}", rank, positions, shown, link, acting)


def _curves(positions: Positions) -> Iterator[Panel]:
    """Displacement, velocity and acceleration of the main output, and the driving torque or force, over the cycle."""
    if not positions.mechanism.drivers or positions.case.motion.steps < 3:
        return
    subject = positions.subject
    request = Request("sva", language=subject.language)
    source = PlotInput(positions.case.motion)
    try:
        name = _moving(positions.mechanism, main_output(source.motion))
        for (word, rank, title), plotted in zip(_MOTION, Sva().panels(source, request), strict=False):
            yield _curve(word, rank, subject.words(title.format(output=name)), source.axis, plotted)
    except LinkwrightError as error:
        subject.note(_("No diagrams on the sheet: {sentence}", sentence=error.sentence))
    if positions.forces is None:
        return
    efforts = Torque().panels(PlotInput(positions.case.forces), request)
    for number, plotted in enumerate(efforts, 1):
        title = _("Driving torque") if plotted.dimension == "torque" else _("Driving force")
        key = "balance" if len(efforts) == 1 else f"balance_{number}"
        yield _curve(key, 4.5, subject.words(title), source.axis, plotted)


def _moving(mechanism: Mechanism, output: Output) -> str:
    """What an output is of: the block of a guide, a link, a point."""
    guide = mechanism.guides.get(output.owner)
    return output.owner if guide is None else guide.block


def _curve(name: str, rank: float, caption: str, axis: InputAxis, plotted: Plotted) -> CurvePanel:
    """The curves of a diagram's panel on the sheet."""
    symbols = {"torque": indexed("M", "b"), "force": indexed("F", "b")}
    symbol = symbols.get(plotted.dimension, as_runs(plotted.title.rpartition(" ")[2]))
    return CurvePanel(name, rank, caption, (as_runs(SYMBOLS[axis.dimension]), symbol), axis, plotted)
