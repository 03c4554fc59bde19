"""A sketch in the making: symbols, lines and texts on paper, and names that keep clear of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.pictures.drawing import Box, Drawing, bounds, document
from linkwright.pictures.labels import Label, Obstacles, place, written
from linkwright.pictures.picture import Anchor, Circle, Line, SvgNode, Text, Vec, Words, as_runs, name_runs
from linkwright.pictures.svg.element import group, number
from linkwright.pictures.symbols.base import SYMBOLS, Shape, placed, points, vec

#: Size of the letters of a sketch.
LETTERS = 14.0


class Sketch:
    """Symbols, lines and names in the units of the paper, y down; names are put where nothing is drawn.

    ``extent``: the corners of texts, which have room on the paper but keep no name away; ``notes``: sentences on what
    was asked for and is invisible.
    """

    def __init__(self) -> None:
        self.content: list[SvgNode] = []
        self.ink: list[Floats] = []
        self.extent: list[Floats] = []
        self.labels: list[Label] = []
        self.notes: list[str] = []

    def put(self, name: str, **values: object) -> None:
        """A symbol of kinematic drawings."""
        self.add(SYMBOLS[name](**values))

    def add(self, shape: Shape, style: str = "") -> None:
        """A shape; ``style``: the class of a group around it, such as ``lw-dashed``."""
        self.draw([group(shape.elements, style)] if style else shape.elements, shape.ink)

    def draw(self, content: Iterable[SvgNode], ink: Iterable[Floats] = ()) -> None:
        """Whatever SVG holds, with the lines along which it has ink."""
        self.content += content
        self.ink += ink

    def put_sketch(self, other: Sketch, at: Vec, **attributes: str) -> None:
        """Another sketch, its origin at a place; its box has room on the paper."""
        shift = f"translate({number(at[0])} {number(at[1])})"
        self.content.append(group(other.content, None, transform=shift, **attributes))
        self.extent.append(np.reshape(other.box, (2, 2)) + at)

    def line(self, places: ArrayLike, style: str = "lw-ground", *, closed: bool = False) -> None:
        """A polyline or a polygon."""
        line = Line(points(places), style, closed)
        self.draw([line], [line.outline])

    def circle(self, at: Vec, radius: float, style: str = "lw-ground") -> None:
        """A circle."""
        circle = Circle(at, radius, style)
        self.draw([circle], [circle.outline])

    def text(
        self, at: Vec, words: Words, style: str = "lw-legend", size: float = LETTERS, anchor: Anchor = "start"
    ) -> float:
        """A line of text where it is wanted; its width."""
        text = Text(at, as_runs(words), style, size, anchor)
        self.content.append(text)
        self.extent.append(text.placed(np.zeros(2), scale=(1.0, -1.0)).cloud * (1.0, -1.0))
        return text.width

    def write_below(self, lines: Iterable[str]) -> None:
        """Lines of text below all that is drawn."""
        left, _top, _right, bottom = self.box
        for row, line in enumerate(lines, 1):
            self.text((left, bottom + 4.0 + 20.0 * row), name_runs(line), size=13.0)

    def arrow(self, start: Vec | Floats, end: Vec | Floats, style: str = "lw-force", *, dashed: bool = False) -> None:
        """An arrow; ``dashed``: of what is not known yet."""
        shape = SYMBOLS["arrow"](start=vec(np.asarray(start)), end=vec(np.asarray(end)), style=style)
        self.add(shape, "lw-dashed" if dashed else "")

    def name(self, text: str, *at: Vec | Floats, style: str = "lw-name", clearance: float = 6.0) -> None:
        """A label near the first of some places that has room."""
        anchors = tuple(vec(np.asarray(each)) for each in at)
        self.labels.append(Label(text, anchors, style, LETTERS, clearance, leader=False))

    def dimension(self, start: Vec, end: Vec, text: str, offset: float = 0.0) -> None:
        """A dimension line with its number, ``offset`` to the right of the way from start to end."""
        self.put("dimension_line", start=start, end=end, offset=offset or 0.01)
        length = math.dist(start, end)
        if length >= 1.0:
            along = ((end[0] - start[0]) / length, (end[1] - start[1]) / length)
            line = placed([(0.0, offset), (length, offset)], start, along)
            ends = (vec(line[0]), vec(line[1]))
            middle = vec(line.mean(axis=0))
            self.labels.append(Label(text, (middle,), "lw-value", 0.9 * LETTERS, 4.0, leader=False, along=ends))

    def chain(self, places: Sequence[tuple[Vec, float]], say: Callable[[float], str], offset: float) -> None:
        """A chain of dimensions between places (on the paper, and as numbers) that follow each other."""
        for (first, one), (last, other) in pairwise(places):
            self.dimension(first, last, say(abs(other - one)), offset)

    def write_names(self) -> None:
        """Puts the names that are waiting where they keep clear of all ink."""
        for label, chosen in zip(self.labels, place(self.labels, Obstacles.of(self.ink)), strict=True):
            self.content += written(label, chosen)
            self.extent.append(np.reshape(chosen.box, (2, 2)))
        self.labels = []

    @property
    def box(self) -> Box:
        """Left, top, right and bottom of all that is drawn."""
        return bounds([*self.ink, *self.extent])

    def drawing(self, title: str, size: float | None = None, *, millimetre: float | None = None) -> Drawing:
        """The finished drawing; ``size``: longer side in pixels; ``millimetre``: printed width of a unit, mm."""
        self.write_names()
        svg = document(self.content, self.box, title, size, millimetre=millimetre)
        return Drawing(svg, tuple(self.notes))
