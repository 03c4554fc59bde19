"""What the drivers must supply, torque and power, with its mean."""

from __future__ import annotations

from functools import partial

from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output
from linkwright.errors import RequestError
from linkwright.kinetostatics.forces import Forces
from linkwright.metrics.analysis import Analysis
from linkwright.plot.diagrams.base import DIAGRAMS, Request
from linkwright.plot.diagrams.marks import Curve
from linkwright.plot.diagrams.outputs import main_output
from linkwright.plot.diagrams.panels import OverInput, Panel, with_mean
from linkwright.plot.diagrams.source import Source


@DIAGRAMS.register("torque")
class Torque(OverInput):
    """Driver effort from the joint forces: torque of a turning driver, force of a sliding one; one panel a driver."""

    options = ("static",)

    def output(self, source: Source, request: Request) -> Output | None:
        return main_output(source.motion)

    def panels(self, source: Source, request: Request) -> list[Panel]:
        motion, forces, say = source.motion, source.forces, request.say
        if not motion.mechanism.drivers:
            raise RequestError("picture.no_torque", name=motion.mechanism.name)
        found = []
        several = len(motion.mechanism.drivers) > 1
        for name in motion.mechanism.drivers:
            turning = motion.positions.rotary[name]
            effort = forces.driver_effort(name)
            exact = source.extremes(partial(Forces.driver_effort, name=name), "forces")
            dimension = "torque" if turning else "force"
            title = f"{say(f'input_{dimension}')} {'T' if turning else 'F'}{f' {name}' if several else ''}"
            curve = Curve("", source.closed(effort), extremes=exact)
            mean = Analysis.of(forces).mean_of(partial(Forces.driver_effort, name=name))
            found.append(with_mean(title, dimension, curve, mean, request, f"{name}: " if several else ""))
        return found


@DIAGRAMS.register("power")
class Power(OverInput):
    """Power that all drivers supply together, from the powers of all forces."""

    options = ("static",)

    def output(self, source: Source, request: Request) -> Output | None:
        return main_output(source.motion)

    def panels(self, source: Source, request: Request) -> list[Panel]:
        power = source.forces.power
        curve = Curve("", source.closed(power), extremes=source.extremes(_total, "forces"))
        mean = Analysis.of(source.forces).mean_of(_total)
        return [with_mean(f"{request.say('power')} P", "power", curve, mean, request)]


def _total(forces: Forces) -> Floats:
    return forces.power
