"""Pages to scale, one millimetre of a picture's plane a millimetre of paper, and the names on them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.pictures.diagram import INK, Axes, Figure
from linkwright.pictures.svg.text import split_index
from linkwright.plot.diagrams.axes import round_up

INCH = 25.4
#: Space around a picture, and above it for its title, mm.
EDGE, HEAD = 9.0, 12.0
#: Least width of a page, and height of a line of text, mm.
LEAST, LINE = 150.0, 4.4
#: Length of the line that shows a picture's scale, and the space for it, mm.
BAR, BAR_SPACE = 20.0, 7.0
#: A picture flatter than FLAT mm is drawn up to WIDE mm long, one that stands upright up to HIGH mm, so that its page
#: has room beneath it; one that stays below THIN mm has its arrows side by side, SIDE mm apart.
FLAT, WIDE, HIGH, THIN, SIDE = 12.0, 190.0, 110.0, 3.0, 3.0
#: Shorter arrows are not drawn, mm.
LEAST_ARROW = 0.1
#: Distance of a name from its place, and between the points that stand for a line, mm.
GAP, STEP = 1.3, 1.2
Box = tuple[float, float, float, float]
LOW = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_SIDES = tuple(np.array([np.cos(a), np.sin(a)]) for a in np.radians([45, 0, 90, 135, -45, 180, -90, -135]))


@dataclass(frozen=True)
class Cell:
    """A picture of the page: its places (n, 2) in paper mm, its title, texts with colours below it.

    ``bar``: what a line of BAR mm stands for; drawn with the picture.
    """

    cloud: Floats
    title: str
    notes: tuple[tuple[str, str], ...] = ()
    bar: str = ""

    @property
    def low(self) -> Floats:
        """Lower left corner, mm in the picture's plane."""
        return np.asarray(self.cloud.min(axis=0) - EDGE)

    @property
    def size(self) -> Floats:
        """Width and height on the paper, mm."""
        content = np.ptp(self.cloud, axis=0) + np.array([2 * EDGE, 2 * EDGE + self.below])
        return np.asarray(np.maximum(content, (42.0, 20.0 + self.below)))

    @property
    def below(self) -> float:
        """Space for the scale, mm."""
        return BAR_SPACE if self.bar else 0.0


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
    seen = [float(np.hypot(*(end - start))) > LEAST_ARROW for start, end in pairs]
    shifts = [(0.5 * (sum(seen) - 1) - sum(seen[:number])) * SIDE * across for number in range(len(pairs))]
    return [(start + shift, end + shift) for (start, end), shift in zip(pairs, shifts, strict=True)]


def page(
    cells: list[Cell], columns: int, *, foot: float = 0.0, head: float = 10.0
) -> tuple[Figure, list[Axes]]:
    """A figure with its pictures in rows; ``head`` and ``foot``: space for the title and for text below, mm."""
    from matplotlib.figure import Figure as New

    rows = [cells[i : i + columns] for i in range(0, len(cells), columns)]
    heights = [max(float(cell.size[1]) + LINE * len(cell.notes) for cell in row) + HEAD for row in rows]
    width = max(sum(float(cell.size[0]) for cell in row) for row in rows)
    width, height = max(width, LEAST), sum(heights) + foot + head
    figure = New(figsize=(width / INCH, height / INCH))
    found: list[Axes] = []
    top = height - head
    for row, tall in zip(rows, heights, strict=True):
        left = 0.0
        for cell in row:
            found.append(_picture(figure, cell, (left, top - HEAD), (width, height)))
            left += float(cell.size[0])
        top -= tall
    return figure, found


def _picture(figure: Figure, cell: Cell, corner: tuple[float, float], paper: tuple[float, float]) -> Axes:
    """Axes without lines whose upper left corner lies at a place of the paper, mm from the lower left."""
    wide, tall = (float(each) for each in cell.size)
    box = (corner[0] / paper[0], (corner[1] - tall) / paper[1], wide / paper[0], tall / paper[1])
    axes = figure.add_axes(box)
    middle = 0.5 * (cell.cloud.min(axis=0) + cell.cloud.max(axis=0))
    axes.set_xlim(middle[0] - wide / 2, middle[0] + wide / 2)
    axes.set_ylim(middle[1] - (tall + cell.below) / 2, middle[1] + (tall - cell.below) / 2)
    axes.set_axis_off()
    figure.text((corner[0] + 4) / paper[0], (corner[1] + 2) / paper[1], cell.title, fontsize=8.5, color=INK,
                va="bottom", parse_math=True)  # fmt: skip
    if cell.bar:
        _draw_bar(axes, cell.bar)
    for number, (text, colour) in enumerate(cell.notes):
        y = (corner[1] - tall - LINE * (number + 1)) / paper[1]
        figure.text(
            (corner[0] + 4) / paper[0], y, text, fontsize=7.8, color=colour, va="bottom", parse_math=True
        )
    return axes


def _draw_bar(axes: Axes, value: str) -> None:
    """A line of BAR mm in the lower left corner of a picture, with what it stands for."""
    x, y = axes.get_xlim()[0] + 4.0, axes.get_ylim()[0] + 3.0
    axes.plot([x, x + BAR], [y, y], color=INK, linewidth=0.9)
    for end in (x, x + BAR):
        axes.plot([end, end], [y - 0.9, y + 0.9], color=INK, linewidth=0.9)
    axes.annotate(value, (x + BAR + 1.5, y), va="center", fontsize=7.5, color=INK, annotation_clip=False)


def symbol(letter: str, name: str = "", above: str = "") -> str:
    """A letter with its indices, set as mathematics where the name's characters allow it."""
    if not name:
        return f"${letter}$"
    if not name.isascii() or not all(c.isalnum() or c in "(),′'" for c in name.replace("′", "")):
        plain = name.replace("$", r"\$")
        return f"{letter}{f' {above}' if above else ''}({plain})"
    upper = f"^{{{above}}}" if above else ""
    return rf"${letter}{upper}_{{\mathrm{{{name}}}}}$"


def headed(figure: Figure, heading: str) -> None:
    """The page's title."""
    wide, tall = (float(each) * INCH for each in figure.get_size_inches())
    figure.text(4 / wide, 1 - 3 / tall, heading, fontsize=11, va="top", color=INK)


def colour_key(figure: Figure, entries: list[tuple[str, str]], height: float, mark: str = "■ ") -> None:
    """Words in the colours that they explain, in one line at a height (mm) of the page."""
    wide, tall = (float(each) * INCH for each in figure.get_size_inches())
    place = 4.0
    for text, colour in entries:
        figure.text(place / wide, height / tall, f"{mark}{text}", fontsize=8, color=colour, va="bottom")
        place += 8.0 + text_width(text, 8.0)


def arrow(
    axes: Axes, start: Floats, end: Floats, colour: str, *, dash: Any = "-", width: float = 1.3
) -> None:
    """An arrow between two places of a picture; nothing where it would be shorter than a tenth of a millimetre."""
    if float(np.hypot(*(end - start))) < LEAST_ARROW:
        return
    head = min(9.0, 1.5 + 1.6 * float(np.hypot(*(end - start))))
    axes.annotate("", tuple(end), tuple(start), annotation_clip=False, zorder=3,
                  arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": width, "linestyle": dash,
                              "mutation_scale": head, "shrinkA": 0, "shrinkB": 0, "joinstyle": "miter"})  # fmt: skip


class Labels:
    """What is drawn in a picture so far, in paper mm."""

    def __init__(self, axes: Axes) -> None:
        self.axes = axes
        self._boxes: list[Box] = []
        self._ink: list[Floats] = []

    def line(self, start: Floats, end: Floats) -> None:
        """A line that names should not cover."""
        count = 2 + int(np.hypot(*(end - start)) / STEP)
        self._ink.append(start + np.linspace(0.0, 1.0, count)[:, None] * (end - start))

    def put(
        self,
        text: str,
        places: Iterable[Floats],
        *,
        away: Floats | None = None,
        colour: str = INK,
        size: float = 8.0,
        written: str | None = None,
    ) -> None:
        """Writes a name beside the best of some places; ``away``: a direction that is liked.

        ``written``: the same as mathematics, where it has indices.
        """
        ink = np.concatenate([*self._ink, np.zeros((0, 2))])
        best: tuple[float, Box, Floats] | None = None
        for rank, place in enumerate(places):
            for number, side in enumerate(_SIDES):
                box = _box(text, place, side, size)
                liked = 0.0 if away is None else -float(side @ away) / (float(np.hypot(*away)) or 1.0)
                cost = (
                    20.0 * self._covered(box) + _inside(box, ink) + 0.6 * rank + 0.05 * number + 0.8 * liked
                )
                if best is None or cost < best[0]:
                    best = (cost, box, side)
        if best is None:
            return
        _, box, _ = best
        self._boxes.append(box)
        self.axes.annotate(
            written or text,
            (0.5 * (box[0] + box[2]), 0.5 * (box[1] + box[3])),
            ha="center",
            va="center",
            fontsize=size,
            color=colour,
            annotation_clip=False,
            zorder=5,
            parse_math=written is not None,
        )

    def _covered(self, box: Box) -> int:
        left, low, right, high = box
        return sum(left < b[2] and right > b[0] and low < b[3] and high > b[1] for b in self._boxes)


def text_width(text: str, size: float) -> float:
    """Width of a text on the paper, about, mm."""
    return size * sum(0.36 if ord(c) > 0x2E7F else 0.21 for c in text)


def _box(text: str, place: Floats, side: Floats, size: float) -> Box:
    wide, tall = text_width(text, size), 0.36 * size
    x, y = place + GAP * side + side * (wide / 2, tall / 2)
    return x - wide / 2, y - tall / 2, x + wide / 2, y + tall / 2


def _inside(box: Box, ink: Floats) -> int:
    left, low, right, high = box
    x, y = ink.T
    return int(((x > left) & (x < right) & (y > low) & (y < high)).sum())


def with_index(name: str) -> str:
    """A point's name with its number as an index: ``O₁``."""
    stem, index = split_index(name.rpartition(".")[2] if name.count(".") == 1 else name)
    owner = f"{name.rpartition('.')[0]}." if name.count(".") == 1 else ""
    return f"{owner}{stem}{index.translate(LOW)}"
