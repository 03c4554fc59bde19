"""Diagrams of beams: shear force, bending moment, slope and deflection; a link's stress over the cycle."""

from __future__ import annotations

import numpy as np

from linkwright.parts.beams.beam import BeamLine
from linkwright.parts.beams.link import LinkStress
from linkwright.pictures.diagram import Figure
from linkwright.plot.diagrams.base import Request, result_diagram
from linkwright.plot.result_diagrams.part_axes import Line, Pane, panes

PANES = (("V", "shear [N]", "force"), ("M", "moment [N·m]", "torque"), ("θ", "slope [rad]", "slope"),
         ("w", "deflection [m]", "length"))  # fmt: skip


@result_diagram("beam_line", BeamLine)
def draw_beam_line(result: BeamLine, request: Request) -> Figure:
    """V, M, θ and w over the beam."""
    columns = result.columns()
    x = columns["x [m]"]
    given = []
    for symbol, name, dimension in PANES:
        y = columns[name]
        line = Line(x, y, peaks=tuple(dict.fromkeys(result.extremes(name.split(" ")[0]))))
        given.append(Pane(symbol, dimension, (line,), fill=symbol in "VM"))
    return panes(result.title, ("x", "length"), given, request)


@result_diagram("link_stress", LinkStress)
def draw_link_stress(result: LinkStress, request: Request) -> Figure:
    """Moment, normal force and deflection along a link in the worst position, and the largest stress of the cycle."""
    i, _ = result.worst(result.stress)
    given = [
        Pane("M", "torque", (Line(result.stations, result.moment[i]),), fill=True),
        Pane("N", "force", (Line(result.stations, result.normal[i]),), fill=True),
        Pane("max σ", "pressure", (Line(result.stations, np.asarray(result.stress.max(axis=0))),)),
        Pane("w", "length", (Line(result.stations, result.deflection[i, :, 1]),), fill=True),
    ]
    return panes(result.title, ("s", "length"), given, request)
