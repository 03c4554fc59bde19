"""What a synthesis found: target, candidates and their curves."""

from __future__ import annotations

from typing import Any

import numpy as np

from linkwright.plot.diagrams.base import Request, result_diagram
from linkwright.plot.diagrams.picture import COLOURS, FAINT, INK, Figure, new_figure
from linkwright.synthesis.report import name_said
from linkwright.synthesis.result import Candidate, Synthesis
from linkwright.words import say, speaker

SHOWN = 4


@result_diagram("synthesis", Synthesis)
def draw_synthesis(result: Synthesis, request: Request) -> Figure:
    """The best candidates in their first pose with the curves they draw, the target, and Burmester's curves.

    Functions are drawn beside them over the input.
    """
    function = any(each.curve is not None and each.curve.ndim == 2 for each in result.candidates)
    figure = new_figure(request.size or ((11, 5.2) if function else (7.5, 6)))
    axes = figure.subplots(1, 2 if function else 1, squeeze=False)[0]
    _plane(axes[0], result, request.language)
    if function:
        _function(axes[1], result, request.language)
    task = name_said(result.task, speaker(request.language))
    title = say("synthesize.title", request.language, task=task, count=len(result))
    figure.suptitle(title if request.title is None else request.title)
    return figure


def _plane(axes: Any, result: Synthesis, language: str) -> None:
    for name, curve in result.curves.items():
        label = say(f"synthesize.legend.{name}", language)
        axes.plot(
            curve.real,
            curve.imag,
            ".",
            ms=2.5,
            color=FAINT if "centre" in name else "#d9a13b",
            label=label,
        )
    for number, each in enumerate(result.candidates[:SHOWN]):
        colour = COLOURS[number % len(COLOURS)]
        if each.curve is not None and each.curve.ndim == 1:
            label = say("synthesize.legend.candidate", language, number=number + 1)
            own = label if result.task == "free_curve" and number else "_"
            axes.plot(each.curve.real, each.curve.imag, color=colour, lw=1, label=own)
        if result.task == "free_curve" and number:
            continue
        _links(axes, each, colour, say("synthesize.legend.candidate", language, number=number + 1))
    target = result.target
    if target is not None and np.iscomplexobj(target):
        places = target if target.ndim == 1 else target[0]
        label = say("synthesize.legend.target", language)
        mark = "--" if result.task == "free_curve" else "o"
        axes.plot(places.real, places.imag, mark, ms=4, mfc="none", color=INK, label=label)
        if target.ndim == 2:
            axes.quiver(places.real, places.imag, target[1].real, target[1].imag, color=INK, width=0.003)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel(say("synthesize.axis.x", language))
    axes.set_ylabel(say("synthesize.axis.y", language))
    axes.margins(0.05)
    axes.legend()


def _function(axes: Any, result: Synthesis, language: str) -> None:
    for number, each in enumerate(result.candidates[:SHOWN]):
        if each.curve is not None and each.curve.ndim == 2:
            axes.plot(*each.curve, color=COLOURS[number % len(COLOURS)])
    target = result.target
    if target is not None and not np.iscomplexobj(target):
        axes.plot(*target, "o", ms=4, mfc="none", color=INK)
    axes.set_xlabel(say("synthesize.axis.input", language))
    axes.set_ylabel(say("synthesize.axis.output", language))


def _links(axes: Any, each: Candidate, colour: str, label: str) -> None:
    points = each.linkage.points
    for names in each.linkage.links.values():
        if len(names) > 1:
            ring = [*names, names[0]] if len(names) > 2 else list(names)
            places = np.array([points[name] for name in ring])
            axes.plot(places.real, places.imag, "-o", ms=3.5, color=colour, lw=1.8, label=label)
            label = "_"
    pivots = np.array([points[name] for name in each.linkage.frame])
    axes.plot(pivots.real, pivots.imag, "^", ms=7, color=colour)
