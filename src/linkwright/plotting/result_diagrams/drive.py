"""Diagrams of drives: the torque needed against the torque there is."""

from __future__ import annotations

from linkwright.dynamics.verdicts.drive import Torques
from linkwright.dynamics.verdicts.drive_margin import DriveMargin
from linkwright.pictures.diagram import COLOURS, Figure
from linkwright.plotting.diagrams.axes import InputAxis
from linkwright.plotting.diagrams.base import Request, result_diagram
from linkwright.plotting.diagrams.marks import Curve
from linkwright.plotting.diagrams.panels import DASHES, Panel, stacked
from linkwright.words import Message, _


@result_diagram("drive_margin", _("torque needed and available"), DriveMargin)
def draw_drive_margin(result: DriveMargin, request: Request) -> Figure:
    """At rest, and at the speed of the cycle: what the machine needs and what its drive has, over the input."""
    panels = [_panel(_("at rest"), result.starting, result, request)]
    if result.running is not None:
        panels.append(_panel(_("at speed"), result.running, result, request))
    axis = InputAxis("angle" if result.rotary else "length", result.starting.input)
    return stacked(panels, axis, request, request.titled(result.title))


def _panel(when: Message, torques: Torques, result: DriveMargin, request: Request) -> Panel:
    letter = "T" if result.rotary else "F"
    curves = [Curve(request.translate(_("needed")), torques.needed, "max", COLOURS[0], DASHES[0], torques.input)]
    if result.driven:
        name = request.translate(_("available"))
        curves.append(Curve(name, torques.available, "", COLOURS[1], DASHES[1], torques.input))
    return Panel(f"{letter} {request.translate(when)}", result.dimension, tuple(curves))
