"""Kinds of diagrams of a machine with its actuators: torque needed and available, operating points of its motor."""

from __future__ import annotations

from collections.abc import Sequence

from linkwright.dynamics.verdicts.drive_margin import drive_margin
from linkwright.dynamics.verdicts.motor_duty import motor_duty
from linkwright.pictures.diagram import Figure
from linkwright.plotting.diagrams.base import DIAGRAMS, Kind, Request
from linkwright.plotting.diagrams.source import PlotInput
from linkwright.plotting.result_diagrams.drive import draw_drive_margin, draw_operating_points
from linkwright.words import _


class OfOneMachine(Kind):
    """A diagram of one machine."""

    single = _("a diagram of a drive shows one machine; give one", code="picture.one_drive")


@DIAGRAMS.register("drive_margin")
class TorqueOfDrive(OfOneMachine):
    """What the machine needs over the input, at rest and at speed, and what its actuators have."""

    title = _("torque needed and available")

    def draw(self, sources: Sequence[PlotInput], request: Request) -> Figure:
        return draw_drive_margin(drive_margin(sources[0].mechanism), request)


@DIAGRAMS.register("operating_points")
class OperatingPoints(OfOneMachine):
    """Torque over speed of the machine's motor: its curve and limits with the cycle in them."""

    title = _("operating points of the motor")

    def draw(self, sources: Sequence[PlotInput], request: Request) -> Figure:
        return draw_operating_points(motor_duty(sources[0].mechanism), request)
