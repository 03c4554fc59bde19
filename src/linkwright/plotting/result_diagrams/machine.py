"""Diagrams of machines: balancing, torque curves of motors."""

from __future__ import annotations

import numpy as np

from linkwright.core.arguments import CURVE_STEPS
from linkwright.core.arrays import Floats, largest
from linkwright.machine.balancing import Balancing
from linkwright.machine.torque_curve import TorqueCurve
from linkwright.pictures.diagram import COLOURS, INK, Axes, Figure, new_figure
from linkwright.plotting.diagrams.axes import InputAxis, Legend, label_input, make_force_plane, unit_of
from linkwright.plotting.diagrams.base import Request, framed, result_diagram
from linkwright.plotting.diagrams.marks import Curve
from linkwright.plotting.diagrams.panels import DASHES, Panel, draw_panel, stacked, with_mean
from linkwright.plotting.diagrams.source import PlotInput
from linkwright.words import _

#: A shaking force of this share of the one before is zero but for rounding.
VANISHED = 1e-9


@result_diagram("balancing", _("effect of the counterweights"), Balancing)
def draw_balancing(result: Balancing, request: Request) -> Figure:
    """Left the hodograph of the shaking force, right shaking moment and input torque over the input."""
    say = request.say
    before, after = PlotInput(result.before), PlotInput(result.after)
    names, legend = (say(_("without counterweights")), say(_("with counterweights"))), Legend()
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
        panel = Panel(f"{say(word)} {letter}", dimension, _curves(names, values))
        draw_panel(places[place], panel, before.axis, request, legend)
        label_input(places[place], before.axis, say)
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
    axes.set_title(request.say(_("shaking force")), color=INK)
    make_force_plane(axes, unit)


#: How far before a jump the curve is drawn, as a share of its period.
BEFORE = 1e-9


@result_diagram("torque_curve", _("torque over the angle"), TorqueCurve)
def draw_torque_curve(result: TorqueCurve, request: Request) -> Figure:
    """T(φ) over one period; jumps are drawn upright."""
    angle = _angles(result)
    panel = with_mean(
        request.say(_("torque")) + " T", "torque", Curve("", result(angle), "both"), result.mean, request
    )
    return stacked([panel], InputAxis("angle", angle), request, request.titled(""))


def _angles(curve: TorqueCurve) -> Floats:
    """Angles over one period, each kink or jump on both of its sides."""
    end = curve.start + curve.period
    knots = np.array(curve.knots)
    near = np.concatenate([knots - BEFORE * curve.period, knots, [end - BEFORE * curve.period]])
    within = near[(near >= curve.start) & (near <= end)]
    return np.unique(np.concatenate([np.linspace(curve.start, end, CURVE_STEPS + 1), within]))
