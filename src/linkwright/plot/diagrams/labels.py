"""Names beside places of a page to scale, each where it covers least."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from linkwright.kinematics.cycle import Floats
from linkwright.plot.diagrams.picture import INK

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Distance of a name from its place, and between the points that stand for a line, mm.
GAP, STEP = 1.3, 1.2
Box = tuple[float, float, float, float]
_SIDES = tuple(np.array([np.cos(a), np.sin(a)]) for a in np.radians([45, 0, 90, 135, -45, 180, -90, -135]))


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
    ) -> None:
        """Writes a name beside the best of some places; ``away``: a direction that is liked."""
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
        self.axes.annotate(text, (0.5 * (box[0] + box[2]), 0.5 * (box[1] + box[3])), ha="center", va="center",
                           fontsize=size, color=colour, annotation_clip=False, zorder=5)  # fmt: skip

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
