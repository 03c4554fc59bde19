"""Diagrams of drives: the torque needed against the torque there is, and a motor's operating points in its curve."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.dynamics.verdicts.drive import Torques, mean_over
from linkwright.dynamics.verdicts.drive_margin import DriveMargin
from linkwright.dynamics.verdicts.motor_duty import MotorDuty, limits
from linkwright.pictures.diagram import COLOURS, FAINT, Figure, new_figure
from linkwright.plotting.diagrams.axes import InputAxis, Legend, unit_of
from linkwright.plotting.diagrams.base import Request, framed, result_diagram
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


#: From rad/s to rpm.
RPM = 30.0 / np.pi
#: Speeds at which a motor's curve is drawn.
_POINTS = 400


@result_diagram("operating_points", _("operating points of the motor"), MotorDuty)
def draw_operating_points(result: MotorDuty, request: Request) -> Figure:
    """Torque over speed of the motor: its curve and limits, the cycle of the machine in them, and its RMS point."""
    translate, rating, legend = request.translate, result.rating, Legend()
    fastest = max(rating.largest_speed or 0.0, 1.05 * float(np.abs(result.speed).max()))
    speed = np.linspace(0.0, fastest, _POINTS)
    curves: dict[str, tuple[Floats, str, str]] = {}
    if result.motor.controlled:
        curves[translate(_("peak torque"))] = limits(result.motor, speed, rating), COLOURS[1], "--"
    else:
        curves[translate(_("curve of the motor"))] = result.motor.torque_at(speed), COLOURS[1], "--"
    if rating.continuous is not None:
        curves[translate(_("continuous torque"))] = np.full(_POINTS, rating.continuous), COLOURS[2], "-."
    unit = unit_of("torque", [result.torque, *(each[0] for each in curves.values())])
    figure = new_figure(request.size or (6.4, 4.6))
    axes = figure.subplots()
    axes.axhline(0.0, color=FAINT, linewidth=0.8)
    braking = float(result.torque.min()) < 0.0 and result.motor.controlled
    for name, (torque, colour, dash) in curves.items():
        (line,) = axes.plot(RPM * speed, unit.factor * torque, color=colour, linestyle=dash)
        legend.add(name, line)
        if braking:
            axes.plot(RPM * speed, -unit.factor * torque, color=colour, linestyle=dash)
    (loop,) = axes.plot(RPM * result.speed, unit.factor * result.torque, color=COLOURS[0])
    legend.add(translate(_("operating points over the cycle")), loop)
    mean = float(np.sqrt(mean_over(result.time, result.speed**2)))
    (point,) = axes.plot([RPM * mean], [unit.factor * result.rms], "o", color=COLOURS[3], linestyle="none")
    legend.add(
        translate(_("RMS: {torque} at {speed} rpm", torque=unit.text(result.rms), speed=f"{RPM * mean:.4g}")), point
    )
    label = translate(_("torque of the motor"))
    axes.set(xlabel="n (rpm)", ylabel=unit.label(f"{label} T"))
    return framed(figure, request.titled(result.title), request, legend)
