"""Alternatives over each other: motion of the output, pivot reaction, input torque."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.designs.compare import Comparison
from linkwright.designs.overlay import Overlay
from linkwright.errors import RequestError
from linkwright.pictures.diagram import INK, Figure, new_figure
from linkwright.plot.diagrams.axes import InputAxis, Legend, equal, unit_of
from linkwright.plot.diagrams.base import Request, framed, result_diagram
from linkwright.plot.diagrams.marks import Curve
from linkwright.plot.diagrams.panels import Panel, look, stacked
from linkwright.plot.diagrams.source import Source
from linkwright.registry import offered
from linkwright.words import say

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
    sources = {each.label: Source(each.motion) for each in result.alternatives}
    axis = _axis(sources)
    panels = [
        panel
        for overlay in _chosen(result, request.of)
        for panel in _panels(result, overlay, sources, request)
    ]
    figure, axes = stacked(panels, axis, request, " – ".join(result.labels))
    passed = say("compare.curve.input", request.language)
    axes[-1].set_xlabel(axis.unit.label(f"{passed} {'φ' if axis.dimension == 'angle' else 's'}"))
    return figure


@result_diagram("pivot_hodograph", Comparison, usual=False)
def draw_pivot_hodograph(result: Comparison, request: Request) -> Figure:
    """Hodographs of the reaction at the output's pivot, all alternatives from one origin, in the frame's axes."""
    overlay = next((each for each in result.curves if each.name == HODOGRAPH), None)
    if overlay is None:
        raise RequestError("picture.no_pivot_reactions")
    unit = unit_of("force", [values for line in overlay.lines.values() for values in line])
    figure = new_figure(request.size or (6.4, 5.4))
    axes, legend = figure.subplots(), Legend()
    sources = {each.label: Source(each.motion) for each in result.alternatives}
    for number, (label, components) in enumerate(overlay.lines.items()):
        x, y = map(sources[label].closed, components)
        colour, dash = look(number)
        (line,) = axes.plot(x * unit.factor, y * unit.factor, color=colour, linestyle=dash)
        legend.add(label, line)
    axes.set_xlabel(unit.label("Fx"))
    axes.set_ylabel(unit.label("Fy"))
    equal(axes)
    axes.plot([0], [0], "+", color=INK, markersize=9, zorder=4)
    axes.margins(0.1)
    framed(figure, request.titled(""), request, legend)
    return figure


def _chosen(result: Comparison, names: Sequence[str]) -> list[Overlay]:
    """The curves that are asked for."""
    known = {each.name: each for each in result.curves if each.name != HODOGRAPH}
    for name in names:
        if name not in known:
            raise RequestError("picture.no_curve", name=name, hint=offered(name, known))
    return [known[name] for name in names or known]


def _axis(sources: Mapping[str, Source]) -> InputAxis:
    """The input passed; raises LinkwrightError where one input turns and another slides."""
    turning = {next(iter(each.motion.positions.rotary.values())) for each in sources.values()}
    if len(turning) > 1:
        raise RequestError("picture.turn_and_slide")
    longest = max(map(_passed, sources.values()), key=lambda x: float(np.nanmax(x)))
    return InputAxis("", "angle" if turning.pop() else "length", longest)


def _passed(source: Source) -> Floats:
    """How far the input has gone since the cycle began, up to its end."""
    return np.asarray(np.abs(source.input - source.input[0]))


def _panels(
    result: Comparison, overlay: Overlay, sources: Mapping[str, Source], request: Request
) -> list[Panel]:
    """One panel for a quantity; two where some outputs turn and others slide."""
    looks = {label: look(n) for n, label in enumerate(result.labels)}
    kinds = _MOTION.get(overlay.name)
    if kinds is None:
        title = say(f"compare.curve.{overlay.name}", request.language)
        curves = [_curve(overlay, label, sources[label], looks) for label in result.labels]
        return [Panel(title, overlay.dimension, tuple(curves))]
    found = []
    for kind, (word, symbol, dimension) in kinds.items():
        labels = [
            each.label for each in result.alternatives if (each.output.kind == "angle") == (kind == "angle")
        ]
        if labels:
            turns = dimension == "angle"
            curves = [_curve(overlay, label, sources[label], looks, turns=turns) for label in labels]
            found.append(Panel(f"{request.say(word)} {symbol}", dimension, tuple(curves)))
    return found


def _curve(
    overlay: Overlay, label: str, source: Source, looks: Mapping[str, tuple[str, str]], *, turns: bool = False
) -> Curve:
    """The curve of one alternative up to the end of its cycle; ``turns``: it is an angle."""
    values = source.closed(overlay.lines[label][1], turns=turns)
    return Curve(label, values, "", *looks[label], _passed(source))
