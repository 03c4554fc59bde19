"""Deviations of the first candidate of a synthesis at the demanded positions."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.errors import speaker
from linkwright.pictures.diagram import COLOURS, FAINT, Figure, new_figure
from linkwright.plot.diagrams.base import Request, framed, result_diagram
from linkwright.synthesis.result import Synthesis, title_said
from linkwright.words import say

#: Share of an angle (rad) or of a length (m) below which deviations are rounding.
ROUNDING = 1e-11
#: Error names whose deviations are angles.
ANGLES = ("angle", "rest")


def has_deviations(result: Synthesis) -> bool:
    """Whether the first candidate deviates anywhere."""
    off = result.best.deviations if len(result) else np.empty(0)
    return bool(off.size and np.abs(off).max() > ROUNDING * max(result.extent, 1e-3))


@result_diagram("structural_error", Synthesis, usual=False, when=has_deviations)
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
    axes.set_xlabel(label)
    key = "angle" if angles else "length"
    axes.set_ylabel(say(f"synthesis_steps.axis.deviation_{key}", request.language))
    axes.margins(x=0.05, y=0.15)
    framed(figure, title_said(result, speaker(request.language)), request)
    return figure


def _abscissa(result: Synthesis, language: str) -> tuple[Floats, str]:
    """Where the deviations are drawn, and the label of that axis."""
    target = result.target
    if target is not None and not np.iscomplexobj(target):
        return np.degrees(target[0]), say("synthesize.axis.input", language)
    return np.arange(1.0, len(result.best.deviations) + 1), say("synthesis_steps.axis.position", language)
