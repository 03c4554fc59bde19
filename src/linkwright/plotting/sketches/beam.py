"""Beams: supports, forces, couples, line loads, hinges and the dimensions between them."""

from __future__ import annotations

import numpy as np

from linkwright.core.quantity import shown
from linkwright.parts.beams.beam import Beam, BeamLoad, BeamSupport
from linkwright.pictures.drawing import Drawing
from linkwright.pictures.sketch import Sketch
from linkwright.plotting.sketches.base import WIDE, roller_support, sketched
from linkwright.words import _

#: Half the height of the beam, longest arrow of a force, highest line load, places of both rows of dimensions.
HALF, ARROW, LOAD, ROWS = 4.0, 62.0, 40.0, (78.0, 106.0)


@sketched("beam")
def draw_beam(beam: Beam, language: str) -> Drawing:
    """The beam from the left to the right, loads above, dimensions below."""
    paper, scale = Sketch(), WIDE / beam.length
    paper.line([(0, -HALF), (WIDE, -HALF), (WIDE, HALF), (0, HALF)], "lw-block", closed=True)
    for name, support in beam.supports.items():
        _support(paper, name, support, support.at * scale)
    for x in beam.hinges:
        paper.put("pin", at=(x * scale, 0.0))
    lines = [abs(q) for load in beam.loads.values() for q in load.line or ()]
    for name, load in beam.loads.items():
        _load(paper, name, load, beam, scale, max(lines, default=1.0) or 1.0)
    if beam.own_weight:
        paper.arrow((0.62 * WIDE, HALF), (0.62 * WIDE, 34.0), "lw-load")
        paper.name(_("own weight").translate(language), (0.62 * WIDE, 34.0), style="lw-load-name")
    _dimensions(paper, beam, scale)
    return paper.drawing(beam.name)


def _support(paper: Sketch, name: str, support: BeamSupport, x: float) -> None:
    below = (x, HALF)
    match support.kind:
        case "fixed":
            side = -1.0 if x < 0.5 * WIDE else 1.0
            end = x in (0.0, WIDE) or abs(x - WIDE) < 0.5
            toward, at = ((side, 0.0), (x, 0.0)) if end else ((0.0, 1.0), below)
            paper.put("wall", at=at, toward=toward, size=24.0)
        case "pinned":
            paper.put("fixed_pivot", at=below, toward=(0.0, 1.0))
        case "roller":
            roller_support(paper, below)
        case "guided":
            paper.put("slider", at=(x, 0.0), along=(0.0, 1.0), length=34.0, height=14.0)
            paper.put(
                "ground_guide",
                at=(x, 0.0),
                along=(0.0, 1.0),
                start=-30.0,
                end=30.0,
                side=1 if x < 0.5 * WIDE else -1,
                height=14.0,
            )
        case "spring":
            if support.stiffness or not support.torsional_stiffness:
                paper.put("spring", start=below, end=(x, HALF + 44.0))
                paper.put("wall", at=(x, HALF + 44.0), toward=(0.0, 1.0))
            if support.torsional_stiffness:
                paper.put("torsion_spring", at=(x, 0.0))
    paper.name(name, (x, HALF + 12.0), (x, -HALF), clearance=16.0)


def _load(paper: Sketch, name: str, load: BeamLoad, beam: Beam, scale: float, largest: float) -> None:
    x = (load.at or 0.0) * scale
    if load.force is not None:
        ends = ((x, -HALF - ARROW), (x, -HALF)) if load.force < 0 else ((x, -HALF), (x, -HALF - ARROW))
        paper.arrow(*ends, "lw-load")
        paper.name(f"{name} = {shown(abs(load.force), 'force')}", (x, -HALF - ARROW), style="lw-load-name")
    elif load.couple is not None:
        paper.put("moment", at=(x, 0.0), turning=1 if load.couple > 0 else -1, radius=20.0, style="lw-load")
        text = f"{name} = {shown(abs(load.couple), 'torque')}"
        paper.name(text, (x, -22.0), style="lw-load-name", clearance=8.0)
    elif load.line is not None:
        _line_load(paper, name, load, beam, scale, largest)


def _line_load(paper: Sketch, name: str, load: BeamLoad, beam: Beam, scale: float, largest: float) -> None:
    """Arrows under the line of a load; upward ones point away from the beam."""
    assert load.line is not None
    a, b = load.start, beam.length if load.end is None else load.end
    first, last = load.line[0], load.line[-1]
    count = max(3, round((b - a) * scale / 24.0) + 1)
    share = np.linspace(0.0, 1.0, count)
    x, q = scale * (a + share * (b - a)), first + share * (last - first)
    top = -HALF - 2.0 - LOAD * np.abs(q) / largest
    paper.line(np.stack([x, top], axis=1), "lw-load-thin")
    for x_k, q_k, top_k in zip(x.tolist(), q.tolist(), top.tolist(), strict=True):
        if abs(top_k + HALF + 2.0) > 8.0:
            start, end = (top_k, -HALF) if q_k < 0 else (-HALF, top_k)
            paper.arrow((x_k, start), (x_k, end), "lw-load")
    sizes = [shown(abs(each), "line_load") for each in (first, last)]
    text = f"{name} = {sizes[0]}" if first == last else f"{name} = {sizes[0]} … {sizes[1]}"
    middle = (float(x.mean()), float(top.min()))
    paper.name(text, middle, (float(x[0]), float(top[0])), style="lw-load-name")


def _dimensions(paper: Sketch, beam: Beam, scale: float) -> None:
    """Distances between everything that is at a place, and the full length below them."""
    places = {0.0, beam.length, *beam.hinges, *(each.at for each in beam.supports.values())}
    places |= {each.start for each in beam.steps}
    for load in beam.loads.values():
        places |= {load.start, beam.length if load.end is None else load.end} if load.line else {load.at or 0.0}
    ordered = sorted(places)
    distinct = [x for i, x in enumerate(ordered) if i == 0 or x - ordered[i - 1] > 1e-9 * beam.length]
    paper.chain([((x * scale, ROWS[0]), x) for x in distinct], _length, 0.0)
    if len(distinct) > 2:
        paper.dimension((0.0, ROWS[1]), (WIDE, ROWS[1]), _length(beam.length))
    for x in distinct:
        paper.line([(x * scale, 34.0), (x * scale, ROWS[0] + 5.0)], "lw-dimension")


def _length(value: float) -> str:
    return shown(value, "length", 5)
