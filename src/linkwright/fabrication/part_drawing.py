"""A plate drawn with its main dimensions: places and diameters of its holes, length and width."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator

import numpy as np

from linkwright.core.arrays import Complexes, Floats
from linkwright.core.quantity import number
from linkwright.errors import require_language, speaker
from linkwright.fabrication.cut_lines import CutLines, cut_lines
from linkwright.fabrication.holes import level_turn
from linkwright.fabrication.part import Part
from linkwright.fabrication.parts_list import called, hole_name
from linkwright.pictures.drawing import Drawing, Sketch
from linkwright.pictures.picture import Vec
from linkwright.pictures.svg import element, path_data
from linkwright.words import _

#: Length and height of an outline on the paper at most, width of the paper, and distance of dimension lines.
ACROSS, UP, WIDE, FIRST = 300.0, 230.0, 440.0, 28.0
#: How far an arc may be from its chords on the paper, and how far centre lines stick out of a hole.
SMOOTH, CROSS = 0.05, 5.0
#: Places nearer to each other than this share of a plate's length have one dimension.
ALIKE = 1e-6


class _Paper:
    """A plate on the paper, turned so that its farthest holes lie level."""

    def __init__(self, part: Part) -> None:
        self.part = part
        self.turn = level_turn([each for each in part.holes if each.pin] or part.holes)
        lines = cut_lines(part).moved(-self.turn, 0j)
        low, high = lines.box
        self.scale = min(ACROSS / (high - low).real, UP / (high - low).imag)
        self.origin, self.lines = low, lines
        self.width, self.height = self.scale * (high - low).real, self.scale * (high - low).imag

    def places(self, places: Complexes) -> Floats:
        """Places of the turned plate on the paper, (k, 2), the lower left corner of its box at (0, 0), y down."""
        moved = self.scale * (places - self.origin)
        return np.stack([moved.real, -moved.imag], axis=1)

    def place(self, place: complex) -> Vec:
        """One place of the turned plate."""
        x, y = self.places(np.array([place]))[0]
        return float(x), float(y)

    def text(self, paper: float) -> str:
        """A length of the paper as a number in mm."""
        return number(paper / self.scale, "length", 5)


def draw_part(part: Part, language: str = "en") -> Drawing:
    """The outline of a plate with the distances between its holes, their diameters, its length and width; mm."""
    require_language(language)
    paper, sketch, translate = _Paper(part), Sketch(), speaker(language)
    _outline(sketch, paper)
    _holes(sketch, paper)
    _overall(sketch, paper)
    title = called([part], translate)
    thickness = _("{name}, t = {thickness} mm", name=title, thickness=number(part.length, "length"))
    sketch.write_names()
    sketch.write_below([translate(thickness)])
    left, top, right, _bottom = sketch.box
    missing = 0.5 * max(WIDE - (right - left), 0.0)
    sketch.extent.append(np.array([(left - missing, top), (right + missing, top)]))  # letters of one size in all
    return sketch.drawing(title)


def _outline(sketch: Sketch, paper: _Paper) -> None:
    """The plate with its slots and holes."""
    rings = list(_rings(paper.lines, paper))
    data = "".join(path_data(ring, closed=True) for ring in rings)
    sketch.draw([element("path", {"class": "lw-gear", "fill-rule": "evenodd", "d": data})], map(_closed, rings))


def _rings(lines: CutLines, paper: _Paper) -> Iterator[Floats]:
    tolerance = SMOOTH / paper.scale
    for loop in (*lines.outer, *lines.inner):
        yield paper.places(loop.points(tolerance))
    for centre, radius in lines.holes:
        turns = np.linspace(0.0, 2.0 * math.pi, 60, endpoint=False)
        yield paper.places(centre + radius * np.exp(1j * turns))


def _closed(ring: Floats) -> Floats:
    return np.vstack([ring, ring[:1]])


def _holes(sketch: Sketch, paper: _Paper) -> None:
    """Centre lines, names with diameters, and chains of dimensions across and up."""
    way = cmath.exp(-1j * paper.turn)
    at = {hole: paper.place(way * hole.centre) for hole in paper.part.holes}
    for hole, (x, y) in at.items():
        reach = paper.scale * hole.radius + CROSS
        sketch.line([(x - reach, y), (x + reach, y)], "lw-pitch")
        sketch.line([(x, y - reach), (x, y + reach)], "lw-pitch")
        label = f"{hole_name(hole)} Ø {number(2.0 * hole.radius, 'length', 5)}".strip()
        near = reach + 6.0
        sketch.name(label, (x, y - near), (x + near, y - near), (x - near, y - near), (x, y + near), style="lw-value")
    across = _distinct([x for x, _y in at.values()], ALIKE * ACROSS)
    chain = [((x, 0.0), x) for x in across]
    sketch.chain(chain, paper.text, FIRST)
    up = _distinct([-y for _x, y in at.values()], ALIKE * ACROSS)
    sketch.chain([((paper.width, -y), y) for y in up], paper.text, FIRST)


def _distinct(values: list[float], near: float) -> list[float]:
    found: list[float] = []
    for each in sorted(values):
        if not found or each - found[-1] > near:
            found.append(each)
    return found


def _overall(sketch: Sketch, paper: _Paper) -> None:
    """Length above the plate, width to its left."""
    top = -paper.height
    sketch.dimension((0.0, top), (paper.width, top), paper.text(paper.width), -FIRST)
    sketch.dimension((0.0, 0.0), (0.0, top), paper.text(paper.height), -FIRST)
