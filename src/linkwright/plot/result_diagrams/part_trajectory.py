"""Diagrams of trajectories: a flight, and the load on a conveyor."""

from __future__ import annotations

from linkwright.parts.trajectories.conveyor import Transport
from linkwright.parts.trajectories.particle import Flight
from linkwright.pictures.diagram import COLOURS, Figure
from linkwright.plot.diagrams.base import Request, result_diagram
from linkwright.plot.result_diagrams.part_axes import Line, Pane, fitted, panes, plane


@result_diagram("flight", Flight)
def draw_flight(result: Flight, request: Request) -> Figure:
    """The path, to one scale."""
    columns = result.columns()
    figure, (axes,) = plane(result.title, request)
    axes.plot(columns["x [m]"], columns["y [m]"], color=COLOURS[0])
    axes.axhline(0.0, color="#555555", linewidth=0.9)
    axes.set_xlabel("x (m)")
    axes.set_ylabel("y (m)")
    fitted(figure, [axes], request)
    return figure


@result_diagram("transport", Transport)
def draw_transport(result: Transport, request: Request) -> Figure:
    """Displacement and velocity of the load on the trough over a cycle, and its height where it is thrown."""
    time, position, velocity, height = result.columns().values()
    given = [
        Pane("s", "length", (Line(time, position),)),
        Pane("v", "velocity", (Line(time, velocity),), fill=True),
    ]
    if height.any():
        given.append(Pane("n", "length", (Line(time, height),)))
    return panes(result.title, (request.say("time"), "time"), given, request)
