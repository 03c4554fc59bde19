"""Alternatives over each other: motion of the output, pivot reaction, input torque."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from linkwright.errors import RequestError
from linkwright.plot.diagrams.axes import Legend, equal, framed, label_input, unit_of
from linkwright.plot.diagrams.base import Request, result_diagram
from linkwright.plot.diagrams.panels import DASHES, Curve, Panel, stacked
from linkwright.plot.diagrams.picture import COLOURS, INK, new_figure
from linkwright.plot.diagrams.source import InputAxis
from linkwright.registry import offered
from linkwright.study.compare import Comparison
from linkwright.study.overlay import Overlay
from linkwright.words import say
from linkwright.words.sentence import Sentence

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HODOGRAPH = "hodograph"
#: What a motion is called and measured in, for an output that turns and for one that slides.
_MOTION = {
    "travel": {"angle": ("angle", "θ", "angle"), "displacement": ("displacement", "s", "length")},
    "velocity": {
        "angle": ("angular_velocity", "ω", "angular_velocity"),
        "displacement": ("velocity", "v", "velocity"),
    },
    "acceleration": {
        "angle": ("angular_acceleration", "α", "angular_acceleration"),
        "displacement": ("acceleration", "a", "acceleration"),
    },
}


@result_diagram("comparison", Comparison, options=("of",))
def draw_comparison(result: Comparison, request: Request) -> Figure:
    """Curves of all alternatives over the input that has passed since the cycle's begin, a colour for each.

    ``of``: travel, velocity, acceleration, pivot_reaction, input_torque; all that there are by default.
    """
    axis = _axis(result)
    panels = [panel for overlay in _chosen(result, request.of) for panel in _panels(result, overlay, request)]
    figure, axes, legend = stacked(panels, axis, request)
    label_input(axes[-1], axis, request.say)
    passed = say("compare.curve.input", request.language)
    axes[-1].set_xlabel(axis.unit.label(f"{passed} {'φ' if axis.dimension == 'angle' else 's'}"))
    framed(figure, " – ".join(result.labels), request)
    figure.align_ylabels(axes)
    legend.put(figure)
    return figure


@result_diagram("pivot_hodograph", Comparison, usual=False)
def draw_pivot_hodograph(result: Comparison, request: Request) -> Figure:
    """Hodographs of the reaction at the output's pivot, all alternatives from one origin, in the frame's axes."""
    overlay = next((each for each in result.curves if each.name == HODOGRAPH), None)
    if overlay is None:
        raise RequestError(Sentence("picture.no_pivot_reactions"))
    unit = unit_of("force", [values for line in overlay.lines.values() for values in line])
    figure = new_figure(request.size or (6.4, 5.4))
    axes, legend = figure.subplots(), Legend()
    for number, (label, (x, y)) in enumerate(overlay.lines.items()):
        (line,) = axes.plot(x * unit.factor, y * unit.factor, color=COLOURS[number % len(COLOURS)],
                            linestyle=_dash(number))  # fmt: skip
        legend.add(label, line)
    axes.set_xlabel(unit.label("Fx"))
    axes.set_ylabel(unit.label("Fy"))
    equal(axes)
    axes.plot([0], [0], "+", color=INK, markersize=9, zorder=4)
    axes.margins(0.1)
    framed(figure, request.say("kind.pivot_hodograph"), request)
    legend.put(figure)
    return figure


def _chosen(result: Comparison, names: Sequence[str]) -> list[Overlay]:
    """The curves that are asked for."""
    known = {each.name: each for each in result.curves if each.name != HODOGRAPH}
    for name in names:
        if name not in known:
            raise RequestError(Sentence("picture.no_curve", name=name, hint=offered(name, known)))
    return [known[name] for name in names or known]


def _axis(result: Comparison) -> InputAxis:
    """The input passed; raises LinkwrightError where one input turns and another slides."""
    turning = {next(iter(each.motion.positions.rotary.values())) for each in result.alternatives}
    if len(turning) > 1:
        raise RequestError(Sentence("picture.turn_and_slide"))
    lines = [x for x, _ in result.curves[0].lines.values()]
    return InputAxis(
        "", "angle" if turning.pop() else "length", max(lines, key=lambda x: float(np.nanmax(x)))
    )


def _panels(result: Comparison, overlay: Overlay, request: Request) -> list[Panel]:
    """One panel for a quantity; two where some outputs turn and others slide."""
    colours = {label: (COLOURS[n % len(COLOURS)], _dash(n)) for n, label in enumerate(result.labels)}
    kinds = _MOTION.get(overlay.name)
    if kinds is None:
        return [_panel(overlay, say(f"compare.curve.{overlay.name}", request.language), overlay.dimension,
                       result.labels, colours)]  # fmt: skip
    found = []
    for kind, (word, symbol, dimension) in kinds.items():
        labels = [
            each.label for each in result.alternatives if (each.output.kind == "angle") == (kind == "angle")
        ]
        if labels:
            found.append(_panel(overlay, f"{request.say(word)} {symbol}", dimension, labels, colours))
    return found


def _panel(
    overlay: Overlay, title: str, dimension: str, labels: Sequence[str], colours: dict[str, tuple[str, str]]
) -> Panel:
    curves = []
    for label in labels:
        x, values = overlay.lines[label]
        colour, dash = colours[label]
        curves.append(Curve(label, values, "", colour, dash, x))
    return Panel(title, dimension, tuple(curves))


def _dash(number: int) -> str:
    return DASHES[number // len(COLOURS) % len(DASHES)]
