"""Pages of sketches to scale, one millimetre of a sketch a millimetre of paper, with titles, scales and keys."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Protocol

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import significant
from linkwright.kinematics.motion import Motion
from linkwright.pictures.drawing import Drawing, Sketch
from linkwright.pictures.labels import Label
from linkwright.pictures.picture import Runs, Words, indexed, joined, name_runs, round_up
from linkwright.pictures.svg import element, fold
from linkwright.pictures.symbols.base import vec
from linkwright.plotting.drawing.machine import View
from linkwright.plotting.drawing.scene import laid_out, point_labels
from linkwright.words import Translate, _

#: Printed width of a unit of the paper, mm.
MILLIMETRE = 0.25
#: Minimum width of a page and of a cell, space between cells, length of the line that shows a scale: units.
MIN_WIDTH, NARROWEST, SPACING, BAR = 600.0, 168.0, 36.0, 80.0
#: Sizes of letters and heights of lines: of the heading, of titles, of texts below.
HEADING, TITLE, SIZE, LINE = 15.0, 12.0, 11.0, 17.6
#: A picture flatter than FLAT mm is drawn up to WIDE mm long, an upright one up to HIGH mm, so that its page
#: has room beneath it; one that stays below THIN mm has its arrows side by side at SIDE mm.
FLAT, WIDE, HIGH, THIN, SIDE = 12.0, 190.0, 110.0, 3.0, 3.0
#: Longest extent of a polygon, mm; vectors that are shorter on the paper have no name of their own, mm; where along
#: one its name may stand.
EXTENT, SHORT, SHARES = 58.0, 1.5, (0.5, 0.35, 0.65, 0.2, 0.8)
#: Shorter arrows are not drawn, mm; longest extent of a position, mm, without and with its symbols.
MIN_ARROW, POSITION, WITH_SYMBOLS = 0.1, 75.0, 95.0
#: A text in a style.
Written = tuple[Words, str]
#: Lines of texts below a page, each with its place in the line.
Below = Sequence[Sequence[tuple[Written, float]]]


class Placed(Protocol):
    """The content of a cell of a page, below the lines of its title."""

    @property
    def title(self) -> tuple[Words, ...]:
        """The lines of its title."""

    @property
    def width(self) -> float:
        """Its width with the space next to it, units."""

    def put(self, page: Sketch, left: float, top: float, head: int) -> float:
        """Puts it on the page below ``head`` lines of titles; where it ends below."""


@dataclass(frozen=True)
class Cell:
    """A sketch of the page with its title, texts below it, and the length that a line of BAR represents."""

    sketch: Sketch
    title: tuple[Words, ...]
    bar: str = ""
    notes: tuple[Written, ...] = ()

    @property
    def width(self) -> float:
        """Its width, units."""
        left, _unused, right, _unused2 = self.sketch.box
        return max(right - left, NARROWEST) + SPACING

    def put(self, page: Sketch, left: float, top: float, head: int) -> float:
        """Puts it on the page below ``head`` lines of its title; where it ends below."""
        y = top + LINE * (head - len(self.title))
        for line in self.title:
            y += LINE
            page.text((left, y), line, size=TITLE)
        x0, y0, x1, y1 = self.sketch.box
        page.put_sketch(self.sketch, (left + 0.5 * (self.width - SPACING - (x1 - x0)) - x0, y + 20.0 - y0))
        y += 20.0 + (y1 - y0)
        if self.bar:
            y += 24.0
            for tick in ([(0, 0), (BAR, 0)], [(0, -3.6), (0, 3.6)], [(BAR, -3.6), (BAR, 3.6)]):
                page.line(np.add(tick, (left, y)))
            page.text((left + BAR + 6.0, y + 4.0), self.bar, size=SIZE)
        for runs, style in self.notes:
            y += LINE
            page.text((left, y + 5.0), runs, style, SIZE)
        return y + 14.0


def page(cells: Sequence[Placed], columns: int, below: Below, heading: str, title: str, css: str = "") -> Drawing:
    """Cells in rows under a heading, and lines of texts below, each with its place in the line."""
    paper = Sketch()
    if css:
        paper.content.append(element("style", None, css))
    rows = [cells[i : i + columns] for i in range(0, len(cells), columns)]
    y = 0.0
    for line in fold(heading, page_width(cells, columns), HEADING) if heading else ():
        y += 20.0
        paper.text((0.0, y), line, size=HEADING)
    y += 6.0 if heading else 0.0
    for row in rows:
        head, left, ends = max(len(cell.title) for cell in row), 0.0, []
        for cell in row:
            ends.append(cell.put(paper, left, y + 2.0, head))
            left += cell.width
        y = max(ends)
    for texts in below:
        y += LINE
        for (words, style), x in texts:
            paper.text((x, y), words, style, SIZE)
    return paper.drawing(title, millimetre=MILLIMETRE)


def page_width(cells: Sequence[Placed], columns: int) -> float:
    """The width of a page of cells, units."""
    rows = (cells[i : i + columns] for i in range(0, len(cells), columns))
    return max(MIN_WIDTH, *(sum(cell.width for cell in row) for row in rows))


def key(entries: Sequence[tuple[str, str]]) -> list[tuple[Written, float]]:
    """Words behind squares in the colours of styles, in one line."""
    found: list[tuple[Written, float]] = []
    x = 0.0
    for text, style in entries:
        square = 1.4 * SIZE
        found += [(("■", f"{style}-head"), x), ((text, "lw-legend"), x + square)]
        x += square + Sketch().text((0.0, 0.0), text, size=SIZE) + 24.0
    return found


def units(places: Floats) -> Floats:
    """Places in paper mm, y up, as units of the paper."""
    return np.asarray(places) * (1.0 / MILLIMETRE, -1.0 / MILLIMETRE)


def scale_title(name: str, letter: str, scale: str) -> Runs:
    """What is drawn, and its scale."""
    return joined(f"{name}: " if name else "", indexed("μ", letter), f" = {scale}")


def position_cell(motion: Motion, translate: Translate) -> Cell:
    """The machine at a motion's first position, with the names of its points."""
    clouds = [motion.point_of(key).position[:1] for key in motion.point_names()]
    clouds.append(np.array(list(motion.mechanism.frame.points.values())).reshape(-1, 2))
    scale = scale_for(float(np.ptp(np.concatenate(clouds), axis=0).max()), POSITION)
    while True:
        sketch = Sketch()
        scene = laid_out(motion, 0, inputs=False, view=View(1.0 / (scale * MILLIMETRE)))
        sketch.draw(scene.at(0), scene.ink(0))
        left, top, right, bottom = sketch.box
        if max(right - left, bottom - top) * MILLIMETRE <= WITH_SYMBOLS:
            break
        scale = round_up(1.05 * scale)
    sketch.labels += point_labels(scene.machine, 0)
    sketch.write_names()
    title = scale_title(translate(_("position")), "l", f"{significant(scale * 1e3)} mm/mm")
    return Cell(sketch, (title,), f"{significant(scale * BAR * MILLIMETRE * 1e3)} mm")


def scale_for(largest: float, millimetres: float) -> float:
    """A round scale (unit per mm) with which a length becomes at most so many millimetres."""
    return round_up(largest / millimetres) if largest > 0 else 1.0


def scale_of_picture(places: Floats, millimetres: float) -> float:
    """A round scale with which places (n, 2) are so many millimetres long, or more where they would be too flat."""
    across, up = (float(each) for each in np.ptp(places, axis=0))
    thin, long, most = (across, up, HIGH) if up > across else (up, across, WIDE)
    if long <= 0 or not thin * most / long >= THIN / 2:
        return scale_for(long, millimetres)
    return scale_for(long, min(most, max(millimetres, FLAT * long / thin)))


def side_by_side(pairs: list[tuple[Floats, Floats]]) -> list[tuple[Floats, Floats]]:
    """Arrows in paper mm; those of a picture without height each on a line of its own, in their order."""
    places = np.array([place for pair in pairs for place in pair])
    spread = places - places.mean(axis=0)
    across = np.linalg.svd(spread)[2][1]
    if len(pairs) < 2 or float(np.ptp(spread @ across)) >= THIN:
        return pairs
    across = across if across[1] + 1e-9 * across[0] > 0 else -across
    drawn = [float(np.hypot(*(end - start))) > MIN_ARROW for start, end in pairs]
    shifts = [(0.5 * (sum(drawn) - 1) - sum(drawn[:number])) * SIDE * across for number in range(len(pairs))]
    return [(start + shift, end + shift) for (start, end), shift in zip(pairs, shifts, strict=True)]


@dataclass(frozen=True)
class Vector:
    """A vector of a polygon, (2,) SI: its letter and index, and the class of its arrow."""

    letter: str
    value: Floats
    style: str
    index: str = ""


def corners(vectors: Sequence[Floats]) -> Floats:
    """Corners of vectors end to end, (vectors + 1, 2), from zero."""
    return np.concatenate([np.zeros((1, 2)), np.cumsum(np.reshape(vectors, (-1, 2)), axis=0)])


def end_to_end(vectors: Sequence[Floats], scale: float) -> list[tuple[Floats, Floats]]:
    """Starts and ends of vectors in paper mm."""
    return side_by_side(list(pairwise(corners(vectors) / scale)))


def vector_cell(
    title: tuple[Words, ...],
    vectors: Sequence[Vector],
    letter: str,
    text: Callable[[float], str],
    *,
    resultant: Vector | None = None,
) -> Cell:
    """Vectors end to end with their sizes, and their sum from start to end where it is given as the ``whole``;
    ``letter``: what they are, ``text`` a value with its unit."""
    rows = [each.value for each in vectors]
    scale = scale_of_picture(corners(rows), EXTENT)
    pairs = side_by_side(
        [*pairwise(corners(rows) / scale), *([] if resultant is None else [(np.zeros(2), resultant.value / scale)])]
    )
    shown = [*vectors, *([] if resultant is None else [resultant])]
    sketch = Sketch()
    for each, (start, end) in zip(shown, pairs, strict=True):
        sketch.arrow(units(start), units(end), each.style)
        if np.hypot(*(end - start)) > SHORT:
            spots = tuple(vec(units(start + share * (end - start))) for share in SHARES)
            sketch.labels.append(
                Label(each.letter, spots, f"{each.style}-name", 12.0, 4.0, leader=False, index=each.index)
            )
    sketch.write_names()
    sizes = [float(np.hypot(*each.value)) for each in shown]
    names = [indexed(v.letter, v.index) if v.index else name_runs(v.letter) for v in shown]
    notes = tuple(
        (joined(name, f" = {text(size)}"), f"{each.style}-name")
        for each, name, size in zip(shown, names, sizes, strict=True)
        if size > 0.0
    )
    bar = text(BAR * MILLIMETRE * scale)
    return Cell(sketch, (*title, scale_title("", letter, f"{text(scale)}/mm")), bar, notes)
