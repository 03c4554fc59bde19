"""Diagrams of trajectories and vibration: flights, conveyed loads, responses, followers, machines on mounts."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.parts.trajectories.conveyor import Transport
from linkwright.parts.trajectories.particle import Flight
from linkwright.parts.vibration.follower import FollowerVibration
from linkwright.parts.vibration.mounts import TITLES, Shaken
from linkwright.parts.vibration.system import Vibration
from linkwright.pictures.diagram import COLOURS, Figure
from linkwright.plotting.diagrams.axes import InputAxis
from linkwright.plotting.diagrams.base import Request, result_diagram
from linkwright.plotting.diagrams.marks import Curve
from linkwright.plotting.diagrams.panels import Panel, fit_plane, plane, stacked
from linkwright.words import _


@result_diagram("flight", _("path of the flight"), Flight)
def draw_flight(result: Flight, request: Request) -> Figure:
    """The path, to one scale."""
    columns = result.columns()
    figure, axes = plane(request.titled(result.title), request, "m")
    axes.plot(columns["x [m]"], columns["y [m]"], color=COLOURS[0])
    axes.axhline(0.0, color="#555555", linewidth=0.9)
    fit_plane(figure, axes, request)
    return figure


@result_diagram("transport", _("motion of the load on the trough"), Transport)
def draw_transport(result: Transport, request: Request) -> Figure:
    """Displacement and velocity of the load on the trough over a cycle, and its height where it is thrown."""
    time, position, velocity, height = result.columns().values()
    panels = [Panel("s", "length", (Curve("", position),)), Panel("v", "velocity", (Curve("", velocity),), fill=True)]
    if height.any():
        panels.append(Panel("n", "length", (Curve("", height),)))
    return _over_time(time, panels, result.title, request)


@result_diagram("vibration_response", _("vibration"), Vibration)
def draw_vibration_response(result: Vibration, request: Request) -> Figure:
    """Amplitudes over frequency, displacements over time, or the modes."""
    names = list(result.system.masses)
    length = "angle" if result.system.turning else "length"
    if result.in_time:
        time, moved = result.response()
        lines = tuple(map(Curve, names, moved.T))
        return _over_time(time, [Panel("x", length, lines)], result.title, request)
    if result.harmonic:
        frequency, amplitudes = result.sweep()
        hertz = frequency / (2 * math.pi)
        size = tuple(map(Curve, names, np.abs(amplitudes.T)))
        turn = tuple(map(Curve, names, np.unwrap(np.angle(amplitudes.T))))
        passed = (Curve("", result.transmissibility(frequency)),)
        panels = [Panel("|X|", length, size, log=True), Panel("∠X", "angle", turn), Panel("T", "", passed, log=True)]
        axis = InputAxis("frequency", hertz, request.say(_("frequency")), log=True)
        return stacked(panels, axis, request, request.titled(result.title))
    modes = [f"{f / (2 * math.pi):.4g} Hz" for f in result.frequencies]
    panel = Panel("φ", "", tuple(map(Curve, modes, result.shapes.T)))
    axis = InputAxis("", np.arange(1.0, len(names) + 1), ", ".join(names))
    return stacked([panel], axis, request, request.titled(result.title))


def _over_time(time: Floats, panels: Sequence[Panel], title: str, request: Request) -> Figure:
    axis = InputAxis("time", time, request.say(_("time")))
    return stacked(panels, axis, request, request.titled(title))


@result_diagram("follower_vibration", _("cam and follower"), FollowerVibration)
def draw_follower_vibration(result: FollowerVibration, request: Request) -> Figure:
    """Cam and follower over time, and the residual spectrum of the law."""
    time, cam, follower = result.curves
    panels = [
        Panel("s, x", "length", (Curve("s", cam), Curve("x", follower, dash="--"))),
        Panel("x − s", "length", (Curve("", follower - cam),)),
    ]
    return _over_time(time, panels, result.title, request)


@result_diagram("residual_spectrum", _("residual vibration of the law"), FollowerVibration, usual=False)
def draw_residual_spectrum(result: FollowerVibration, request: Request) -> Figure:
    """Residual amplitude over the ratio of rise time and natural period."""
    n = np.linspace(0.2, max(6.0, 1.3 * result.ratio), 1200)
    panel = Panel("A", "length", (Curve("", result.residual(n)),), log=True)
    return stacked([panel], InputAxis("", n, "n = T/Tₙ"), request, request.titled(result.title))


@result_diagram("mounts", _("shaking force, motion, force on the ground"), Shaken)
def draw_mounts(result: Shaken, request: Request) -> Figure:
    """Shaking force, motion of the machine and force on the ground over a cycle."""
    columns = result.columns()
    time = columns["time [s]"]
    panels = [
        Panel(symbol, dimension, tuple(Curve(axis, columns[name.format(axis)]) for axis in "xy"))
        for symbol, name, dimension in (
            ("F", "shaking force {} [N]", "force"),
            ("X", "machine {} [m]", "length"),
            ("G", "force on ground {} [N]", "force"),
        )
    ]
    for symbol, (name, dimension) in zip("MθG", TITLES["turn"], strict=True) if "turn" in result.axes else ():
        panels.append(Panel(symbol, dimension, (Curve("", columns[name]),)))
    return _over_time(time, panels, result.title, request)
