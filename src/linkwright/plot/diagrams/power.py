"""Power of the drivers, with its mean and where it goes."""

from __future__ import annotations

from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output
from linkwright.kinetostatics.forces import Forces
from linkwright.metrics.analysis import Analysis
from linkwright.plot.diagrams.base import DIAGRAMS, Request
from linkwright.plot.diagrams.outputs import main_output
from linkwright.plot.diagrams.panels import Curve, Level, OverInput, Panel
from linkwright.plot.diagrams.source import Source


@DIAGRAMS.register("power")
class Power(OverInput):
    """Power that all drivers supply together, from the powers of all forces."""

    options = ("static",)

    def output(self, source: Source, request: Request) -> Output | str | None:
        return main_output(source.motion)

    def panels(self, source: Source, request: Request) -> list[Panel]:
        power = source.forces.power
        title = f"{request.say('power')} P"
        panel = Panel(
            title, "power", (Curve("", source.closed(power), extremes=source.extremes(_total, "forces")),)
        )
        mean = Analysis(source.motion, source.forces).mean_of(_total)
        label = request.say("mean", value=panel.unit.text(mean))
        return [Panel(title, "power", panel.curves, (Level(label, mean),))]


def _total(forces: Forces) -> Floats:
    return forces.power
