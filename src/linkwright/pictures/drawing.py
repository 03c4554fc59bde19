"""Drawings: SVG text that can be saved and shown, and a sketch in the making, whose names keep clear of its lines."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arguments import real
from linkwright.core.arrays import Floats
from linkwright.errors import RequestError
from linkwright.filesystem import refuse_target
from linkwright.pictures.labels import Label, Obstacles, place, written
from linkwright.pictures.picture import Anchor, Circle, Line, SvgNode, Text, Vec, Words, as_runs, name_runs
from linkwright.pictures.svg import FAMILY_LIST, Element, element, group, number, png, save_picture
from linkwright.pictures.symbols.base import LINE, SYMBOLS, Shape, placed, points, vec
from linkwright.words import _

INK, GROUND, BLUE, RED, GREEN, ORANGE, PURPLE, TEAL = (
    "#1c2733",
    "#5b6672",
    "#1565c0",
    "#c62828",
    "#2e7d32",
    "#d9730d",
    "#7b1fa2",
    "#00838f",
)
COLOURS = (INK, GROUND, BLUE, RED, GREEN, ORANGE, PURPLE, TEAL)


def arrow_rules(name: str, colour: str, width: float = 2.0, dash: str = "") -> str:
    """The rules of an arrow's line, head and name."""
    dashes = f";stroke-dasharray:{dash}" if dash else ""
    return (
        f".lw-{name}-line{{fill:none;stroke:{colour};stroke-width:{width}{dashes}}}"
        f".lw-{name}-head{{fill:{colour};stroke:none}}.lw-{name}-name{{fill:{colour};font-style:italic}}"
    )


CSS = "".join(
    (
        ".lw-paper{fill:#fff}",
        f".lw-bar,.lw-spring{{fill:none;stroke:{INK};stroke-linecap:round;stroke-linejoin:round}}",
        f".lw-bar{{stroke-width:{LINE}}}.lw-spring{{stroke-width:1.5}}",
        f".lw-plate{{fill:#c3d5e8;fill-opacity:.6;stroke:{INK};stroke-width:2;stroke-linejoin:round}}",
        f".lw-bar-coloured,.lw-plate-coloured{{stroke-width:{LINE};stroke-linecap:round;stroke-linejoin:round}}",
        ".lw-plate-coloured{fill-opacity:.25}",
        f".lw-block{{fill:#f3f6f9;stroke:{INK};stroke-width:2;stroke-linejoin:round}}",
        f".lw-pin,.lw-mass-ring{{fill:#fff;stroke:{INK};stroke-width:1.8}}",
        f".lw-point,.lw-weld,.lw-mass{{fill:{INK}}}",
        f".lw-support,.lw-rim{{fill:#fff;stroke:{INK};stroke-width:1.6;stroke-linejoin:round}}",
        f".lw-ground{{fill:none;stroke:{INK};stroke-width:1.8;stroke-linecap:round}}",
        f".lw-base{{fill:#eceff2;fill-opacity:.6;stroke:{GROUND};stroke-width:1.2;stroke-linejoin:round}}",
        f".lw-hatch{{fill:none;stroke:{GROUND};stroke-width:1}}",
        f".lw-strand{{fill:none;stroke:{INK};stroke-width:1.6}}",
        f".lw-pitch{{fill:none;stroke:{GROUND};stroke-width:.9;stroke-dasharray:9 2.5 1.5 2.5}}",
        f".lw-gear{{fill:#eef3f8;stroke:{INK};stroke-width:1.4;stroke-linejoin:round}}",
        f".lw-dimension{{fill:none;stroke:{GROUND};stroke-width:1}}.lw-dimension-head{{fill:{GROUND}}}",
        ".lw-trace{fill:none;stroke:#1565c0;stroke-width:1.3;stroke-opacity:.8;stroke-linejoin:round}",
        ".lw-trace-1{stroke:#2e7d32}.lw-trace-2{stroke:#d9730d}.lw-trace-3{stroke:#7b1fa2}",
        ".lw-dot{fill:#1565c0}",
        ".lw-leader{fill:none;stroke:#9aa4ae;stroke-width:.8}",
        arrow_rules("input", ORANGE),
        arrow_rules("force", RED),
        arrow_rules("load", PURPLE, 2.4),
        f".lw-load-ring{{fill:#fff;stroke:{PURPLE};stroke-width:1.6}}",
        f".lw-load-thin{{fill:none;stroke:{PURPLE};stroke-width:1.6}}",
        ".lw-load-dashed{stroke-dasharray:6 4}",
        arrow_rules("driver", TEAL, 2.4),
        arrow_rules("weight", GREEN),
        arrow_rules("inertia", BLUE),
        arrow_rules("velocity", BLUE),
        arrow_rules("acceleration", GREEN),
        f"text{{font-family:{FAMILY_LIST}}}",
        f".lw-name{{fill:{INK};font-style:italic}}.lw-link{{fill:#52606d}}.lw-value{{fill:{GROUND}}}",
        f".lw-legend{{fill:{INK}}}.lw-axis{{fill:none;stroke:{GROUND};stroke-width:1}}",
        f".lw-flow{{fill:#fff;stroke:{INK};stroke-width:1.5;stroke-linejoin:round}}.lw-flow-call{{font-weight:bold}}",
        f".lw-flow-line{{fill:none;stroke:{INK};stroke-width:1.3}}.lw-flow-head{{fill:{INK}}}",
        ".lw-short path{stroke-dasharray:3 2.2}.lw-rule{fill:none;stroke:#9aa4ae;stroke-width:.9}",
        ".lw-faded{opacity:.28}",
        ".lw-dashed{opacity:.62}.lw-dashed path,.lw-dashed circle{stroke-dasharray:5 3.5;fill-opacity:.25}",
    )
)


MARGIN = 12.0
#: Smallest and largest longer side of a drawing, pixels.
SIZES = (8, 32_000)
#: Pixels of SVG in a millimetre.
PIXELS = 96.0 / 25.4


@dataclass(frozen=True)
class Drawing:
    """A kinematic drawing; notebooks show it, ``svg`` is its text, ``save`` writes it.

    ``notes``: sentences on what was asked for and is invisible, such as forces that are all zero.
    """

    svg: str
    notes: tuple[str, ...] = ()

    def save(
        self, path: str | Path, *, fonts: Sequence[str | Path] = (), width: int | None = None, force: bool = False
    ) -> Path:
        """Write it as .svg, .png (``width`` pixels across) or .pdf, atomically.

        PNG and PDF need ``linkwright[plot]``; ``fonts``: font files used in addition to the system's.
        Raises LinkwrightError for another suffix, a missing package or font, a folder that cannot be written, and for
        a file that is there already unless ``force``.
        """
        refuse_target(path, force=force)
        options: dict[str, object] = {}
        if Path(path).suffix.lower() != ".svg" and fonts:
            options["fonts"] = tuple(fonts)
        if Path(path).suffix.lower() == ".png" and width is not None:
            options["width"] = width
        return save_picture(self.svg, path, force=force, **options)

    def png(self, *, width: int | None = None, fonts: Sequence[str | Path] = ()) -> bytes:
        """The picture as PNG."""
        return png(self.svg, width=width, fonts=fonts)

    def _repr_svg_(self) -> str:
        return self.svg

    def __repr__(self) -> str:
        return f"Drawing({len(self.svg)} characters of SVG)"


Box = tuple[float, float, float, float]


def bounds(clouds: Iterable[Floats]) -> Box:
    """Left, top, right, bottom of everything drawn."""
    everything = np.concatenate([*clouds, np.zeros((0, 2))])
    everything = everything[np.isfinite(everything).all(axis=1)]
    if not len(everything):
        return (0.0, 0.0, 1.0, 1.0)
    (left, top), (right, bottom) = everything.min(axis=0), everything.max(axis=0)
    return float(left), float(top), float(right), float(bottom)


def _paper(left: float, top: float, width: float, height: float) -> Element:
    """The white ground, a little larger than the picture so that its last row of pixels is white as well."""
    box = {"x": left - 2.0, "y": top - 2.0, "width": width + 4.0, "height": height + 4.0}
    return element("rect", {"class": "lw-paper", **box})


def document(
    content: Sequence[SvgNode], box: Box, title: str, size: float | None, *, millimetre: float | None = None
) -> str:
    """A complete SVG document over a box; ``size`` is its longer side in pixels, ``millimetre`` instead the printed
    width of a unit, mm."""
    if size is not None and not SIZES[0] <= real("size", size) <= SIZES[1]:
        raise RequestError(
            _(
                "a drawing cannot be {size:.12g} pixels large; give {minimum} to {maximum}",
                code="picture.bad_size",
                size=size,
                minimum=SIZES[0],
                maximum=SIZES[1],
            )
        )
    left, top = box[0] - MARGIN, box[1] - MARGIN
    width, height = box[2] - left + MARGIN, box[3] - top + MARGIN
    factor = 1.0 if size is None else size / max(width, height)
    if millimetre is not None:
        factor = millimetre * PIXELS
    root = element(
        "svg",
        {
            "xmlns": "http://www.w3.org/2000/svg",
            "viewBox": " ".join(number(each) for each in (left, top, width, height)),
            "width": factor * width,
            "height": factor * height,
            "role": "img",
        },
        element("title", None, title),
        element("style", None, CSS),
        _paper(left, top, width, height),
        *content,
    )
    return str(root)


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

    def chain(self, places: Sequence[tuple[Vec, float]], translate: Callable[[float], str], offset: float) -> None:
        """A chain of dimensions between places (on the paper, and as numbers) that follow each other."""
        for (first, one), (last, other) in pairwise(places):
            self.dimension(first, last, translate(abs(other - one)), offset)

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
