"""Pages to scale: one millimetre of a picture's plane is one millimetre of paper."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from linkwright.kinematics.cycle import Floats
from linkwright.plot.diagrams.labels import text_width
from linkwright.plot.diagrams.picture import INK
from linkwright.plot.diagrams.units import round_up

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

INCH = 25.4
#: Space around a picture, and above it for its title, mm.
EDGE, HEAD = 9.0, 9.0
#: Least width of a page, and height of a line of text, mm.
LEAST, LINE = 150.0, 4.4


@dataclass(frozen=True)
class Cell:
    """A picture of the page: its places (n, 2) in paper mm, its title, texts with colours below it."""

    cloud: Floats
    title: str
    notes: tuple[tuple[str, str], ...] = ()

    @property
    def low(self) -> Floats:
        """Lower left corner, mm in the picture's plane."""
        return np.asarray(self.cloud.min(axis=0) - EDGE)

    @property
    def size(self) -> Floats:
        """Width and height on the paper, mm."""
        return np.asarray(np.maximum(np.ptp(self.cloud, axis=0) + 2 * EDGE, (42.0, 20.0)))


def scale_for(largest: float, millimetres: float) -> float:
    """A round scale (unit per mm) with which a length becomes at most so many millimetres."""
    return round_up(largest / millimetres) if largest > 0 else 1.0


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
    axes.set_ylim(middle[1] - tall / 2, middle[1] + tall / 2)
    axes.set_axis_off()
    figure.text((corner[0] + 4) / paper[0], (corner[1] + 2) / paper[1], cell.title, fontsize=8.5, color=INK,
                va="bottom", parse_math=True)  # fmt: skip
    for number, (text, colour) in enumerate(cell.notes):
        y = (corner[1] - tall - LINE * (number + 1)) / paper[1]
        figure.text(
            (corner[0] + 4) / paper[0], y, text, fontsize=7.8, color=colour, va="bottom", parse_math=True
        )
    return axes


def symbol(letter: str, name: str = "", above: str = "") -> str:
    """A letter with its indices, set as mathematics where the name's characters allow it."""
    if not name:
        return f"${letter}$"
    if not name.isascii() or not all(c.isalnum() or c in "()" for c in name):
        plain = name.replace("$", r"\$")
        return f"{letter}{f' {above}' if above else ''}({plain})"
    upper = f"^{{{above}}}" if above else ""
    return rf"${letter}{upper}_{{\mathrm{{{name}}}}}$"


def headed(figure: Figure, heading: str) -> None:
    """The page's title."""
    wide, tall = (float(each) * INCH for each in figure.get_size_inches())
    figure.text(4 / wide, 1 - 3 / tall, heading, fontsize=11, va="top", color=INK)


def colour_key(figure: Figure, entries: list[tuple[str, str]], height: float) -> None:
    """Words in the colours that they explain, in one line at a height (mm) of the page."""
    wide, tall = (float(each) * INCH for each in figure.get_size_inches())
    place = 4.0
    for text, colour in entries:
        figure.text(place / wide, height / tall, f"■ {text}", fontsize=8, color=colour, va="bottom")
        place += 8.0 + text_width(text, 8.0)


def arrow(
    axes: Axes, start: Floats, end: Floats, colour: str, *, dash: Any = "-", width: float = 1.3
) -> None:
    """An arrow between two places of a picture; nothing where it would be shorter than a tenth of a millimetre."""
    if float(np.hypot(*(end - start))) < 0.1:
        return
    head = min(9.0, 1.5 + 1.6 * float(np.hypot(*(end - start))))
    axes.annotate("", tuple(end), tuple(start), annotation_clip=False, zorder=3,
                  arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": width, "linestyle": dash,
                              "mutation_scale": head, "shrinkA": 0, "shrinkB": 0, "joinstyle": "miter"})  # fmt: skip
