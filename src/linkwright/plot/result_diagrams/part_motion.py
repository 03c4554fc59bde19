"""Diagrams of trajectories and vibration: flights, conveyed loads, responses, followers, machines on mounts."""

from __future__ import annotations

import math

import numpy as np

from linkwright.parts.trajectories.conveyor import Transport
from linkwright.parts.trajectories.particle import Flight
from linkwright.parts.vibration.follower import FollowerVibration
from linkwright.parts.vibration.mounts import TITLES, Shaken
from linkwright.parts.vibration.system import Vibration
from linkwright.pictures.diagram import COLOURS, Figure
from linkwright.plot.diagrams.base import Request, result_diagram
from linkwright.plot.result_diagrams.part_axes import Line, Pane, fitted, panes, plane
from linkwright.words import _


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
    return panes(result.title, (request.say(_("time")), "time"), given, request)


@result_diagram("vibration_response", Vibration)
def draw_vibration_response(result: Vibration, request: Request) -> Figure:
    """Amplitudes over frequency, displacements over time, or the modes."""
    names = list(result.system.masses)
    length = "angle" if result.system.turning else "length"
    if result.in_time:
        time, moved = result.response()
        lines = tuple(Line(time, moved[:, i], name) for i, name in enumerate(names))
        return panes(result.title, (request.say(_("time")), "time"), [Pane("x", length, lines)], request)
    if result.harmonic:
        frequency, amplitudes = result.sweep()
        hertz = frequency / (2 * math.pi)
        size = tuple(Line(hertz, np.abs(amplitudes[:, i]), name) for i, name in enumerate(names))
        turn = tuple(Line(hertz, np.unwrap(np.angle(amplitudes[:, i])), name) for i, name in enumerate(names))
        passed = (Line(hertz, result.transmissibility(frequency)),)
        given = [
            Pane("|X|", length, size, log=True),
            Pane("∠X", "angle", turn),
            Pane("T", "", passed, log=True),
        ]
        return panes(result.title, (request.say(_("frequency")), "frequency"), given, request, logx=True)
    place = np.arange(1.0, len(names) + 1)
    shapes = tuple(
        Line(place, result.shapes[:, i], f"{f / (2 * math.pi):.4g} Hz")
        for i, f in enumerate(result.frequencies)
    )
    return panes(result.title, (", ".join(names), ""), [Pane("φ", "", shapes)], request)


@result_diagram("follower_vibration", FollowerVibration)
def draw_follower_vibration(result: FollowerVibration, request: Request) -> Figure:
    """Cam and follower over time, and the residual spectrum of the law."""
    time, cam, follower = result.curves
    given = [
        Pane("s, x", "length", (Line(time, cam, "s"), Line(time, follower, "x", dash="--"))),
        Pane("x − s", "length", (Line(time, follower - cam),)),
    ]
    return panes(result.title, (request.say(_("time")), "time"), given, request)


@result_diagram("residual_spectrum", FollowerVibration, usual=False)
def draw_residual_spectrum(result: FollowerVibration, request: Request) -> Figure:
    """Residual amplitude over the ratio of rise time and natural period."""
    n = np.linspace(0.2, max(6.0, 1.3 * result.ratio), 1200)
    pane = Pane("A", "length", (Line(n, result.residual(n)),), log=True)
    return panes(result.title, ("n = T/Tₙ", ""), [pane], request)


@result_diagram("mounts", Shaken)
def draw_mounts(result: Shaken, request: Request) -> Figure:
    """Shaking force, motion of the machine and force on the ground over a cycle."""
    columns = result.columns()
    time = columns["time [s]"]
    given = [
        Pane(symbol, dimension, tuple(Line(time, columns[name.format(axis)], axis) for axis in "xy"))
        for symbol, name, dimension in (
            ("F", "shaking force {} [N]", "force"),
            ("X", "machine {} [m]", "length"),
            ("G", "force on ground {} [N]", "force"),
        )
    ]
    for symbol, (name, dimension) in zip("MθG", TITLES["turn"], strict=True) if "turn" in result.axes else ():
        given.append(Pane(symbol, dimension, (Line(time, columns[name]),)))
    return panes(result.title, (request.say(_("time")), "time"), given, request)
