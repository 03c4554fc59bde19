"""What a synthesis found: target, candidates and their curves; deviations; a coupler curve."""

from __future__ import annotations

from typing import Any

import numpy as np

from linkwright.analysis.coupler_curve import CouplerCurve
from linkwright.core.arrays import Complexes, Floats
from linkwright.errors import speaker
from linkwright.pictures.diagram import COLOURS, FAINT, INK, Axes, Figure, new_figure
from linkwright.plotting.diagrams.axes import Legend, make_plane, unit_of
from linkwright.plotting.diagrams.base import Request, framed, result_diagram
from linkwright.plotting.diagrams.names import draw_support
from linkwright.synthesis.result import Candidate, Synthesis, title_text
from linkwright.words import _, pgettext, say

SHOWN = 4
#: What the output of a task's curve is, where it is not that of a function.
OUTPUTS = {"slider_crank": "place", "toggle": "ratio", "dwell": "angle"}
#: Curves of the plane, by their names.
CURVES = {"circle_points": _("circle points"), "centre_points": pgettext("synthesize", "centre points")}
#: What a function gives, by its kind: the factor to the unit of its axis, and the label of that.
AXES = {
    "angle": (float(np.degrees(1.0)), _("output (°)")),
    "place": (1e3, _("place of the slider (mm)")),
    "ratio": (1.0, _("force ratio P/F")),
}


@result_diagram("synthesis", _("synthesis"), Synthesis)
def draw_synthesis(result: Synthesis, request: Request) -> Figure:
    """The best candidates in their first pose with the curves they draw, the target, and Burmester's curves.

    Functions are drawn next to them over the input.
    """
    function = any(each.curve is not None and each.curve.ndim == 2 for each in result.candidates)
    figure = new_figure(request.size or ((11, 5.2) if function else (7.5, 6)))
    axes, legend = figure.subplots(1, 2 if function else 1, squeeze=False)[0], Legend()
    _plane(axes[0], result, request.language, legend)
    if function:
        _function(axes[1], result, request.language)
    return framed(figure, title_text(result, speaker(request.language)), request, legend)


def _plane(axes: Axes, result: Synthesis, language: str, legend: Legend) -> None:
    for name, curve in result.curves.items():
        colour = FAINT if "centre" in name else "#d9a13b"
        (dots,) = axes.plot(*_places(curve), ".", ms=2.5, color=colour)
        legend.add(say(CURVES[name], language), dots)
    for number, each in enumerate(result.candidates[:SHOWN]):
        colour = COLOURS[number % len(COLOURS)]
        label = _("candidate {number}", number=number + 1).translate(language)
        if each.curve is not None and each.curve.ndim == 1:
            (line,) = axes.plot(*_places(each.curve), color=colour, lw=1)
            legend.add(label, line)
        if result.task != "free_curve" or not number:
            legend.add(label, _links(axes, each, colour))
    target = result.target
    if target is not None and np.iscomplexobj(target):
        places = _places(target if target.ndim == 1 else target[0])
        mark = "--" if result.task == "free_curve" else "o"
        (marks,) = axes.plot(*places, mark, ms=4, mfc="none", color=INK)
        legend.add(_("target").translate(language), marks)
        if target.ndim == 2:
            axes.quiver(*places, target[1].real, target[1].imag, color=INK, width=0.003)
    make_plane(axes, 0.08)


def _places(numbers: Complexes) -> tuple[Floats, Floats]:
    """Places x and y, mm."""
    return 1e3 * numbers.real, 1e3 * numbers.imag


def _function(axes: Axes, result: Synthesis, language: str) -> None:
    """Functions of the candidates over the input, and the pairs; angles in degrees, places in mm."""
    kind = OUTPUTS.get(result.task, "place" if result.error_name == "length" else "angle")
    factor, label = AXES[kind]
    factors = np.array([[np.degrees(1.0)], [factor]])
    for number, each in enumerate(result.candidates[:SHOWN]):
        if each.curve is not None and each.curve.ndim == 2:
            axes.plot(*(factors * each.curve), color=COLOURS[number % len(COLOURS)])
    target = result.target
    if target is not None and not np.iscomplexobj(target):
        axes.plot(*(factors * target), "o", ms=4, mfc="none", color=INK)
    axes.set(xlabel=_("input (°)").translate(language), ylabel=label.translate(language))


def _links(axes: Axes, each: Candidate, colour: str) -> Any:
    """The links of a candidate and its pins, those of the frame on supports; one of its lines."""
    points, line = each.linkage.points, None
    for names in each.linkage.links.values():
        if len(names) > 1:
            ring = [*names, names[0]] if len(names) > 2 else list(names)
            x, y = _places(np.array([points[name] for name in ring]))
            (line,) = axes.plot(x, y, "-o", ms=4.2, mfc="white", color=colour, lw=1.8, zorder=2.5)
            if len(names) > 2:
                axes.fill(x, y, color=colour, alpha=0.1, linewidth=0)
    for name in each.linkage.frame:
        draw_support(axes, np.ravel(_places(np.array([points[name]]))))
    return line


#: Share of an angle (rad) or of a length (m) below which deviations are rounding.
ROUNDING = 1e-11
#: Error names whose deviations are angles.
ANGLES = ("angle", "rest")


def has_deviations(result: Synthesis) -> bool:
    """Whether the first candidate deviates anywhere."""
    off = result.best.deviations if len(result) else np.empty(0)
    return bool(off.size and np.abs(off).max() > ROUNDING * max(result.extent, 1e-3))


@result_diagram(
    "structural_error", _("deviation at every demanded position"), Synthesis, usual=False, when=has_deviations
)
def draw_structural_error(result: Synthesis, request: Request) -> Figure:
    """The error curve: over the input of a function, else over the number of the position."""
    figure = new_figure(request.size or (7.2, 3.2))
    axes = figure.subplots()
    off, angles = result.best.deviations, result.error_name in ANGLES
    factor = np.degrees(1.0) if angles else 1e3
    x, label = _abscissa(result, request.language)
    axes.axhline(0.0, color=FAINT, linewidth=0.8)
    axes.vlines(x, 0.0, factor * off, color=COLOURS[0], linewidth=1.0)
    order = np.argsort(x)
    axes.plot(x[order], factor * off[order], "o-", color=COLOURS[0], ms=4, linewidth=0.8)
    if result.error_name not in ("angle", "length"):
        axes.locator_params(axis="x", integer=True)
    axes.set(xlabel=label, ylabel=request.say(_("deviation (°)") if angles else _("deviation (mm)")))
    axes.margins(x=0.05, y=0.15)
    return framed(figure, title_text(result, speaker(request.language)), request)


def _abscissa(result: Synthesis, language: str) -> tuple[Floats, str]:
    """Where the deviations are drawn, and the label of that axis."""
    target = result.target
    if target is not None and not np.iscomplexobj(target):
        return np.degrees(target[0]), _("input (°)").translate(language)
    return np.arange(1.0, len(result.best.deviations) + 1), _("position").translate(language)


@result_diagram("coupler_curve", _("coupler curve"), CouplerCurve)
def draw_coupler_curve(result: CouplerCurve, request: Request) -> Figure:
    """The path, both axes to one scale; double points ringed, cusps as diamonds; length and area in the title."""
    unit, legend = unit_of("length"), Legend()
    figure = new_figure(request.size or (6.2, 5.2))
    axes = figure.subplots()
    x, y = (np.concatenate([result.path, result.path[:1]]) * unit.factor).T
    axes.plot(x, y, color=COLOURS[0])
    doubles = [spot for spot, _unused in result.double_points]
    cusps = [spot for spot, _unused in result.cusps]
    if request.marks:
        for name, spots, sign in ((_("double point"), doubles, "o"), (_("cusp"), cusps, "D")):
            if spots:
                (dots,) = axes.plot(
                    *(np.array(spots).T * unit.factor),
                    sign,
                    color=COLOURS[1],
                    markersize=7,
                    fillstyle="none",
                    markeredgewidth=1.4,
                )
                legend.add(request.say(name), dots)
    make_plane(axes, 0.1)
    length, area = unit.text(result.length, 6), unit_of("area").text(result.area, 6)
    return framed(
        figure,
        request.say(
            _("coupler curve of {point}, length {length}, area {area}", point=result.point, length=length, area=area)
        ),
        request,
        legend,
    )
