"""Diagrams of beams: shear force, bending moment, slope and deflection; a link's stress over the cycle."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from linkwright.parts.beams.beam import BeamLine
from linkwright.parts.beams.link import LinkStress
from linkwright.plot.diagrams.base import RESULT_DIAGRAMS, Request, ResultKind
from linkwright.plot.result_diagrams.part_axes import Line, Pane, panes

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PANES = (("V", "shear [N]", "force"), ("M", "moment [N·m]", "torque"), ("θ", "slope [rad]", "slope"),
         ("w", "deflection [m]", "length"))  # fmt: skip


@RESULT_DIAGRAMS.register("beam_line")
class BeamDiagram(ResultKind):
    """V, M, θ and w over the beam."""

    name = "beam_line"
    takes = BeamLine

    def draw(self, result: BeamLine, request: Request) -> Figure:
        columns = result.columns()
        x = columns["x [m]"]
        given = []
        for symbol, name, dimension in PANES:
            y = columns[name]
            line = Line(x, y, marks=tuple({int(y.argmin()), int(y.argmax())}))
            given.append(Pane(symbol, dimension, (line,), fill=symbol in "VM"))
        title = request.titled(result.title, request.say("kind.beam_line"))
        return panes(title, ("x", "length"), given, request)


@RESULT_DIAGRAMS.register("link_stress")
class LinkDiagram(ResultKind):
    """Moment, normal force and deflection along a link in the worst position, and the largest stress of the cycle."""

    name = "link_stress"
    takes = LinkStress

    def draw(self, result: LinkStress, request: Request) -> Figure:
        i, _ = result.worst(result.stress)
        given = [
            Pane("M", "torque", (Line(result.stations, result.moment[i]),), fill=True),
            Pane("N", "force", (Line(result.stations, result.normal[i]),), fill=True),
            Pane("max σ", "pressure", (Line(result.stations, np.asarray(result.stress.max(axis=0))),)),
            Pane("w", "length", (Line(result.stations, result.deflection[i, :, 1]),), fill=True),
        ]
        title = request.titled(result.title, request.say("kind.link_stress"))
        return panes(title, ("s", "length"), given, request)
