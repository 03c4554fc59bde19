"""Diagrams of cams: the motion, the checks over the turn, and the profile with colours."""

from __future__ import annotations

import math

import numpy as np

from linkwright.cams.report import RATES
from linkwright.cams.result import NO_FOLLOWER, CamDesign
from linkwright.curves.curve import Extreme
from linkwright.errors import RequestError
from linkwright.pictures.diagram import FAINT, INK, Figure
from linkwright.plotting.diagrams.axes import InputAxis
from linkwright.plotting.diagrams.base import Request, result_diagram
from linkwright.plotting.diagrams.marks import Curve
from linkwright.plotting.diagrams.panels import Panel, fit_plane, plane, stacked
from linkwright.words import _, pgettext

#: Points of the coloured profile, and speeds of the vibration's diagram.
_POINTS, _SPEEDS = 1440, 240
#: Dimensions of lift and its derivatives over the cam's angle, by what the lift is.
_PER_ANGLE = {
    "length": ("length", "length_per_angle", "length_per_angle_squared", "length_per_angle_cubed"),
    "angle": ("angle", "dimensionless", "per_angle", "per_angle_squared"),
}
#: Titles of lift and derivatives.
_MOTION = (_("lift s"), _("velocity v"), _("acceleration a"), _("jerk j"))


@result_diagram("cam_motion", _("motion over the turn"), CamDesign)
def draw_cam_motion(result: CamDesign, request: Request) -> Figure:
    """s, v, a and j over the cam's angle: over time at its speed, over the angle without one."""
    speed = result.loading.speed
    kinds = (RATES if speed else _PER_ANGLE)[result.cam.follower.lift_dimension]
    panels = []
    for order, title in enumerate(_MOTION):
        values = result.motion[order] * (speed**order if speed else 1.0)
        ends = [result.cam.program.extreme(order, kind) for kind in ("max", "min")]
        peaks = tuple((each.place, each.value * (speed**order if speed else 1.0)) for each in ends)
        panels.append(Panel(request.translate(title), kinds[order], (Curve("", values, marks=peaks),)))
    return stacked(panels, _turn(result, request), request, request.titled(result.title))


@result_diagram("cam_checks", _("checks over the turn"), CamDesign, usual=False)
def draw_cam_checks(result: CamDesign, request: Request) -> Figure:
    """Pressure angle, radius of curvature, contact force, Hertz's pressure and torque over the cam's angle."""
    contact = result.contact
    steepest = _peaks(result.pressure_angle_rise, result.pressure_angle_fall)
    pressed = Curve("", contact.pressure_angle, marks=steepest if contact.pressure_angle.any() else ())
    panels = [Panel(request.translate(_("pressure angle α")), "angle", (pressed,))]
    largest = 5.0 * result.size
    with np.errstate(divide="ignore"):
        radius = 1.0 / contact.curvature
    bent = np.where(np.abs(radius) < largest, radius, np.nan)
    panels.append(Panel(request.translate(_("radius of curvature ρ")), "length", (Curve("", bent),)))
    if result.loaded and result.cam.barrel_radius is None:
        force, torque = (
            _peaks(extreme("max"), extreme("min")) for extreme in (result.extreme_force, result.extreme_torque)
        )
        panels.append(
            Panel(request.translate(_("contact force N")), "force", (Curve("", result.contact_force, marks=force),))
        )
        if result.pressure is not None and result.largest_pressure is not None:
            line = Curve("", result.pressure, marks=_peaks(result.largest_pressure))
            panels.append(Panel(request.translate(_("contact pressure p")), "pressure", (line,)))
        panels.append(Panel(request.translate(_("torque T")), "torque", (Curve("", result.torque, marks=torque),)))
    return stacked(panels, _turn(result, request), request, request.titled(result.title))


def _turn(result: CamDesign, request: Request) -> InputAxis:
    """The axis of the cam's angle."""
    return InputAxis("angle", result.angles, request.translate(_("cam angle φ")))


def _peaks(*found: Extreme) -> tuple[tuple[float, float], ...]:
    """Places and values of extremes, as the table has them."""
    return tuple((each.place, each.value) for each in found)


@result_diagram("cam_profile", pgettext("plot", "profile"), CamDesign, usual=False)
def draw_cam_profile(result: CamDesign, request: Request) -> Figure:
    """The profile at true shape; its colour is Hertz's pressure, else the contact force, else the pressure angle
    (no colours where that is the same all round)."""
    from matplotlib.collections import LineCollection

    figure, axes = plane(request.titled(result.title), request)
    values, label = _coloured(result, request)
    places = 1e3 * np.stack([result.contact.point.real, result.contact.point.imag], axis=1)
    pieces = np.stack([places[:-1], places[1:]], axis=1)
    varied = bool(np.ptp(values) > 1e-9 * (1.0 + np.abs(values).max()))
    shown = LineCollection(list(pieces), cmap="viridis", linewidths=4.0, capstyle="round")
    if not varied:
        shown.set(color=INK, linewidth=1.8)
    for k in range(1, len(result.cam.walls)):
        other = 1e3 * result.profile(_POINTS, k)
        if result.cam.conjugate is not None and not result.cam.follower.oscillating:
            other = -other
        axes.plot(*other.T, color=INK, linewidth=0.9)
    if result.cam.follower.kind == "roller":
        axes.plot(*(1e3 * result.pitch_curve(_POINTS)).T, color=FAINT, linewidth=0.8, linestyle="-.")
    if result.cam.barrel_radius is None:
        turn = np.linspace(0.0, 2 * math.pi, 361)
        base = 1e3 * (result.cam.base_radius or 0.0)
        axes.plot(base * np.cos(turn), base * np.sin(turn), color=FAINT, linewidth=0.8)
        axes.plot(0.0, 0.0, "+", color=INK)
    axes.add_collection(shown)
    axes.autoscale_view()
    if varied:
        shown.set_array(0.5 * (values[:-1] + values[1:]))
        figure.colorbar(shown, ax=axes, label=label, shrink=0.8)
    fit_plane(figure, axes, request)
    return figure


def _coloured(result: CamDesign, request: Request) -> tuple[np.ndarray, str]:
    """What the profile is coloured by, and its name with unit."""
    if result.pressure is not None:
        return 1e-6 * result.pressure, request.translate(_("contact pressure p")) + " (MPa)"
    if result.loaded and result.cam.barrel_radius is None:
        return result.contact_force, request.translate(_("contact force N")) + " (N)"
    return np.degrees(result.contact.pressure_angle), request.translate(_("pressure angle α")) + " (°)"


@result_diagram("cam_vibration", _("vibration over the speed"), CamDesign, usual=False)
def draw_cam_vibration(result: CamDesign, request: Request) -> Figure:
    """The follower's deviation from the cam's motion, over the speed."""
    if result.cam.elasticity is None:
        raise RequestError(NO_FOLLOWER)
    top = 2.0 * (result.loading.speed or 0.25 * result.own_frequency)
    speeds = np.linspace(top / _SPEEDS, top, _SPEEDS)
    left = result.residual_vibration(speeds)
    kind = result.cam.follower.lift_dimension
    panels = [
        Panel(request.translate(_("deviation z")), kind, (Curve("", result.steady_deviation(speeds)),)),
        Panel(
            request.translate(_("amplitude left A")),
            kind,
            tuple(
                Curve(request.translate(_("after rise or fall {number}", number=k)), column)
                for k, column in enumerate(left.T, 1)
            ),
        ),
    ]
    axis = InputAxis("angular_velocity", speeds, request.translate(_("speed of the cam")))
    return stacked(panels, axis, request, request.titled(result.title))
