"""Tables as panels of sheets: of their own size."""

from __future__ import annotations

from collections.abc import Sequence

from linkwright.pictures.picture import Box, Picture, Words, as_runs, runs_width
from linkwright.sheets.panel import Drawn, Panel

#: Height of a row in heights of its letters, and space beside a text, mm.
ROW, BESIDE = 1.9, 1.6
#: Rows of a table that is not parted.
LONG = 10


class TablePanel(Panel):
    """A table with a head: texts in cells; widths follow the texts.

    ``parts``: how many stand side by side, of one after the other; by default two where it is long.
    """

    smallest = largest = 0.0

    def __init__(
        self,
        name: str,
        rank: float,
        head: Sequence[Words],
        rows: Sequence[Sequence[Words]],
        caption: Words,
        *,
        parts: int | None = None,
    ) -> None:
        self.name, self.rank = name, rank
        self.parts = parts or (1 if len(rows) <= LONG else 2)
        tall = -(-len(rows) // self.parts)
        filled = [*rows, *([[""] * len(head)] * (tall * self.parts - len(rows)))]
        sides = [filled[k * tall : (k + 1) * tall] for k in range(self.parts)]
        self.rows = [[cell for _ in sides for cell in head]]
        self.rows += [[cell for row in side for cell in row] for side in zip(*sides, strict=True)]
        self.caption = caption

    def drawn(self, size: float, scale: float | None) -> Drawn:
        picture, tall = Picture(), ROW * self.letters
        widths = [
            max(runs_width(as_runs(row[k]), self.letters) for row in self.rows) + 2 * BESIDE
            for k in range(len(self.rows[0]))
        ]
        whole = Box(0.0, -tall * len(self.rows), sum(widths), 0.0)
        for number, row in enumerate(self.rows):
            left, level = 0.0, -tall * number
            for width, text in zip(widths, row, strict=True):
                baseline = level - 0.5 * tall - 0.42 * self.letters
                picture.text((left + 0.5 * width, baseline), text, self.letters, "middle")
                left += width
            if number:
                picture.line([(0.0, level), (whole.right, level)], "thick" if number == 1 else "thin")
        left = 0.0
        for number, width in enumerate(widths[:-1], 1):
            left += width
            between = number * self.parts % len(widths) == 0
            picture.line([(left, 0.0), (left, whole.bottom)], "thick" if between else "thin")
        picture.box(whole, "thick")
        return Drawn(picture, (as_runs(self.caption),))
