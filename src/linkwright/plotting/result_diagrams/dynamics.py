"""Diagrams of dynamics: balancing, motors, trajectories, conveyed loads, vibration, followers, machines on mounts."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from linkwright.core.arguments import CURVE_STEPS
from linkwright.core.arrays import Floats, largest
from linkwright.machine.balancing import Balancing
from linkwright.machine.torque_curve import TorqueCurve
from linkwright.parts.trajectories.conveyor import Transport
from linkwright.parts.trajectories.particle import Flight
from linkwright.parts.vibration.follower import FollowerVibration
from linkwright.parts.vibration.mounts import TITLES, Shaken
from linkwright.parts.vibration.system import Vibration
from linkwright.pictures.diagram import COLOURS, INK, Axes, Figure, new_figure
from linkwright.plotting.diagrams.axes import InputAxis, Legend, label_input, make_force_plane, unit_of
from linkwright.plotting.diagrams.base import Request, framed, result_diagram
from linkwright.plotting.diagrams.marks import Curve
from linkwright.plotting.diagrams.panels import DASHES, Panel, draw_panel, fit_plane, plane, stacked, with_mean
from linkwright.plotting.diagrams.source import PlotInput
from linkwright.words import _

#: A shaking force of this share of the one before is zero but for rounding.
VANISHED = 1e-9


@result_diagram("balancing", _("effect of the counterweights"), Balancing)
def draw_balancing(result: Balancing, request: Request) -> Figure:
    """Left the hodograph of the shaking force, right shaking moment and input torque over the input."""
    translate = request.translate
    before, after = PlotInput(result.before), PlotInput(result.after)
    names, legend = (translate(_("without counterweights")), translate(_("with counterweights"))), Legend()
    figure = new_figure(request.size or (9.6, 4.9))
    places = figure.subplot_mosaic([["force", "moment"], ["force", "torque"]])
    loops = [each.closed(each.forces.shaking_force) for each in (before, after)]
    _hodograph(places["force"], loops, names, request, legend)
    turning = next(iter(before.motion.positions.rotary.values()))
    effort = (_("input torque"), "T", "torque") if turning else (_("driving force"), "F", "force")
    moments = [each.closed(each.forces.shaking_moment) for each in (before, after)]
    torques = [each.closed(each.forces.input_torque) for each in (before, after)]
    for place, (word, letter, dimension), values in (
        ("moment", (_("shaking moment"), "M", "torque"), moments),
        ("torque", effort, torques),
    ):
        panel = Panel(f"{translate(word)} {letter}", dimension, _curves(names, values))
        draw_panel(places[place], panel, before.axis, request, legend)
        label_input(places[place], before.axis, translate)
    places["moment"].set_xlabel("")
    places["moment"].tick_params(labelbottom=False)
    figure.align_ylabels([places["moment"], places["torque"]])
    return framed(figure, request.titled(before.label), request, legend)


def _curves(names: tuple[str, str], values: list[Floats]) -> tuple[Curve, ...]:
    pairs = enumerate(zip(names, values, strict=True))
    return tuple(Curve(name, each, "", COLOURS[n], DASHES[n]) for n, (name, each) in pairs)


def _hodograph(axes: Axes, loops: list[Floats], names: tuple[str, str], request: Request, legend: Legend) -> None:
    unit = unit_of("force", loops)
    widest = max(map(largest, loops))
    for name, loop, colour, dash in zip(names, loops, COLOURS, DASHES, strict=False):
        x, y = loop.T * unit.factor
        (line,) = axes.plot(x, y, color=colour, linestyle=dash)
        legend.add(name, line)
        if largest(loop) <= VANISHED * widest:
            axes.plot([0], [0], "o", color=colour, markersize=6, zorder=4)
    axes.set_title(request.translate(_("shaking force")), color=INK)
    make_force_plane(axes, unit)


#: How far before a jump the curve is drawn, as a share of its period.
BEFORE = 1e-9


@result_diagram("torque_curve", _("torque over the angle"), TorqueCurve)
def draw_torque_curve(result: TorqueCurve, request: Request) -> Figure:
    """T(φ) over one period; jumps are drawn upright."""
    angle = _angles(result)
    panel = with_mean(
        request.translate(_("torque")) + " T", "torque", Curve("", result(angle), "both"), result.mean, request
    )
    return stacked([panel], InputAxis("angle", angle), request, request.titled(""))


def _angles(curve: TorqueCurve) -> Floats:
    """Angles over one period, each kink or jump on both of its sides."""
    end = curve.start + curve.period
    knots = np.array(curve.knots)
    near = np.concatenate([knots - BEFORE * curve.period, knots, [end - BEFORE * curve.period]])
    within = near[(near >= curve.start) & (near <= end)]
    return np.unique(np.concatenate([np.linspace(curve.start, end, CURVE_STEPS + 1), within]))


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
        axis = InputAxis("frequency", hertz, request.translate(_("frequency")), log=True)
        return stacked(panels, axis, request, request.titled(result.title))
    modes = [f"{f / (2 * math.pi):.4g} Hz" for f in result.frequencies]
    panel = Panel("φ", "", tuple(map(Curve, modes, result.shapes.T)))
    axis = InputAxis("", np.arange(1.0, len(names) + 1), ", ".join(names))
    return stacked([panel], axis, request, request.titled(result.title))


def _over_time(time: Floats, panels: Sequence[Panel], title: str, request: Request) -> Figure:
    axis = InputAxis("time", time, request.translate(_("time")))
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
