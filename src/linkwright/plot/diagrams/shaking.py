"""Shaking force and shaking moment over the input."""

from __future__ import annotations

import numpy as np

from linkwright.plot.diagrams.base import DIAGRAMS, Request
from linkwright.plot.diagrams.panels import Curve, OverInput, Panel
from linkwright.plot.diagrams.picture import COLOURS
from linkwright.plot.diagrams.reactions import require_forces
from linkwright.plot.diagrams.source import Source


@DIAGRAMS.register("shaking")
class Shaking(OverInput):
    """What the inertia of the moving links does to the frame: force with its components, moment about the origin."""

    options = ("static",)

    def panels(self, source: Source, request: Request) -> list[Panel]:
        say, forces = request.say, source.forces
        require_forces(forces)
        force = source.closed(forces.shaking_force)
        size = source.extremes(lambda f: np.hypot(*f.shaking_force.T), "forces")
        curves = (
            Curve("Fx", force[:, 0], "", COLOURS[1]),
            Curve("Fy", force[:, 1], "", COLOURS[2]),
            Curve("F", np.hypot(*force.T), "max", COLOURS[0], extremes=size),
        )
        turning = source.extremes(lambda f: f.shaking_moment, "forces")
        moment = Curve("", source.closed(forces.shaking_moment), extremes=turning)
        return [
            Panel(f"{say('shaking_force')} F", "force", curves),
            Panel(f"{say('shaking_moment')} M", "torque", (moment,)),
        ]
