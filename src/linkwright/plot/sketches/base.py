"""What sketches have in common: paper on which symbols and labels are put, and the registry of kinds."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.errors import require_language
from linkwright.parts.base import Problem
from linkwright.pictures.drawing import Drawing, bounds, document
from linkwright.pictures.labels import Label, Obstacles, place, written
from linkwright.pictures.picture import Line, SvgNode, Vec
from linkwright.pictures.svg.element import element, group
from linkwright.pictures.symbols.base import SYMBOLS, Shape, placed, points, vec
from linkwright.registry import Registry

#: Size of the letters of a sketch; room that a drawing takes, across and down.
LETTERS, WIDE, HIGH = 14.0, 560.0, 380.0
Sketch = Callable[[Problem, str], Drawing]
SKETCHES: Registry[Sketch] = Registry("sketch", "linkwright.plot.sketches")
_Drawn = TypeVar("_Drawn", bound=Callable[..., Drawing])


def sketched(*kinds: str) -> Callable[[_Drawn], _Drawn]:
    """Decorator that registers a function of problem and language as the sketch of kinds of calculations."""

    def registered(draw: _Drawn) -> _Drawn:
        for kind in kinds:
            SKETCHES.register(kind)(draw)
        return draw

    return registered


def sketch(problem: Problem, language: str = "en") -> Drawing | None:
    """The sketch of a calculation, None where its kind has none; raises LinkwrightError where it cannot be drawn."""
    require_language(language)
    kind = problem.kind
    return SKETCHES[kind](problem, language) if kind in SKETCHES else None


class Paper:
    """Symbols and labels in the units of the paper, y down; labels are put where nothing is drawn."""

    def __init__(self) -> None:
        self.content: list[SvgNode] = []
        self.ink: list[Floats] = []
        self.labels: list[Label] = []

    def put(self, name: str, **values: object) -> None:
        """A symbol of kinematic drawings."""
        self.add(SYMBOLS[name](**values))

    def add(self, shape: Shape, style: str = "") -> None:
        """A shape; ``style``: the class of a group around it, such as ``lw-dashed``."""
        self.content += [group(shape.elements, style)] if style else shape.elements
        self.ink += shape.ink

    def line(self, places: ArrayLike, style: str = "lw-ground", *, closed: bool = False) -> None:
        """A polyline or a polygon."""
        rows = points(places)
        self.content.append(Line(rows, style, closed=closed))
        self.ink.append(np.vstack([rows, rows[:1]]) if closed else rows)

    def circle(self, at: Vec, radius: float, style: str = "lw-ground") -> None:
        """A circle."""
        self.content.append(element("circle", {"class": style, "cx": at[0], "cy": at[1], "r": radius}))
        angle = np.linspace(0.0, 2 * math.pi, 25)
        self.ink.append(np.stack([at[0] + radius * np.cos(angle), at[1] + radius * np.sin(angle)], axis=1))

    def arrow(
        self, start: Vec | Floats, end: Vec | Floats, style: str = "lw-force", *, dashed: bool = False
    ) -> None:
        """An arrow; ``dashed``: of what is not known yet."""
        shape = SYMBOLS["arrow"](start=vec(np.asarray(start)), end=vec(np.asarray(end)), style=style)
        self.add(shape, "lw-dashed" if dashed else "")

    def name(self, text: str, *at: Vec | Floats, style: str = "lw-name", clearance: float = 6.0) -> None:
        """A label near the first of some places that has room."""
        anchors = tuple(vec(np.asarray(each)) for each in at)
        self.labels.append(Label(text, anchors, style, LETTERS, clearance, leader=False))

    def dimension(self, start: Vec, end: Vec, text: str, offset: float = 0.0) -> None:
        """A dimension line with its number, ``offset`` to the right of the way from start to end."""
        shape = SYMBOLS["dimension_line"](start=start, end=end, offset=offset or 0.01)
        self.add(shape)
        length = math.dist(start, end)
        if length >= 1.0:
            along = ((end[0] - start[0]) / length, (end[1] - start[1]) / length)
            line = placed([(0.0, offset), (length, offset)], start, along)
            ends = (vec(line[0]), vec(line[1]))
            middle = vec(line.mean(axis=0))
            self.labels.append(
                Label(text, (middle,), "lw-value", 0.9 * LETTERS, 4.0, leader=False, along=ends)
            )

    def chain(self, places: Sequence[tuple[Vec, float]], say: Callable[[float], str], offset: float) -> None:
        """A chain of dimensions between places (on the paper, and as numbers) that follow each other."""
        for (first, one), (last, other) in pairwise(places):
            self.dimension(first, last, say(abs(other - one)), offset)

    def drawing(self, title: str) -> Drawing:
        """The finished sketch."""
        chosen = place(self.labels, Obstacles.of(self.ink))
        texts = [each for label, one in zip(self.labels, chosen, strict=True) for each in written(label, one)]
        boxes = [np.array([each.box[:2], each.box[2:]]) for each in chosen]
        return Drawing(document([*self.content, *texts], bounds([*self.ink, *boxes]), title, None))


def scale_of(places: Iterable[ArrayLike], wide: float = WIDE, high: float = HIGH) -> float:
    """Pixels per metre with which places (n, 2) fill the room; 1 where all are one place."""
    span = np.ptp(np.vstack([points(each) for each in places]), axis=0)
    factors = [room / size for room, size in zip((wide, high), span, strict=True) if size > 0]
    return min(factors, default=1.0)


def roller_support(paper: Paper, at: Vec, toward: Vec = (0.0, 1.0), size: float = 18.0) -> None:
    """A triangle on rollers, which holds across the ground alone; the ground lies in the direction ``toward``."""
    half, radius = 0.62 * size, 3.4
    paper.line(placed([(0, 0), (size, -half), (size, half)], at, toward), "lw-support", closed=True)
    for y in (-0.55 * half, 0.55 * half):
        paper.circle(vec(placed([(size + radius, y)], at, toward)[0]), radius, "lw-pin")
    paper.put("wall", at=vec(placed([(size + 2 * radius, 0)], at, toward)[0]), toward=toward, size=0.9 * size)
