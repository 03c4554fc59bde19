"""Torque against its mean, and the energy indicator diagram."""

from __future__ import annotations

import numpy as np

from linkwright.machine.energy import EnergyFluctuation
from linkwright.machine.equivalent import Equivalent, equivalent
from linkwright.plot.diagrams.base import DIAGRAMS, Request
from linkwright.plot.diagrams.panels import Curve, Level, OverInput, Panel
from linkwright.plot.diagrams.source import InputAxis, Source
from linkwright.plot.diagrams.units import unit_of


@DIAGRAMS.register("energy")
class Energy(OverInput):
    """Torque at constant speed with its mean and the areas between, and the energy E(φ) that the areas leave.

    ΔE = max E - min E is what a flywheel has to take up. Angles are those turned from the cycle's begin.
    """

    options = ("static",)

    def axis(self, source: Source) -> InputAxis:
        reduced, found = _reduced(source)
        return InputAxis("", "angle", reduced.start + reduced.direction * found.angle)

    def panels(self, source: Source, request: Request) -> list[Panel]:
        say = request.say
        reduced, found = _reduced(source)
        place = reduced.start + reduced.direction * np.append(reduced.angle, reduced.period)
        steady = reduced.torque + 0.5 * reduced.slope * reduced.speed**2
        torque = reduced.direction * np.append(steady, steady[0])
        mean = reduced.direction * reduced.load.mean
        curve = Curve("", torque, x=place)
        title = f"{say('input_torque')} T"
        unit = Panel(title, "torque", (curve,)).unit
        level = Level(say("mean", value=unit.text(mean)), mean)
        change = say("energy_fluctuation", value=unit_of("energy", [found.energy]).text(found.value))
        return [
            Panel(title, "torque", (curve,), (level,), fill=True),
            Panel(f"{say('energy')} E", "energy", (Curve(change, found.energy),)),
        ]


def _reduced(source: Source) -> tuple[Equivalent, EnergyFluctuation]:
    if source.result_running is not None:
        return source.result_running.equivalent, source.result_running.energy
    reduced = source.once("energy", lambda: equivalent(source.forces))
    return reduced, reduced.energy
