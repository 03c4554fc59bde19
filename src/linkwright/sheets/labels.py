"""Names on the pictures of sheets, placed clear of lines and of one another."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.pictures.picture import CAPITAL, TEXT, Picture, Runs, as_runs
from linkwright.pictures.svg.text import split_index
from linkwright.pictures.symbols.base import vec
from linkwright.plot.drawing.labels import Label, Obstacles, place

#: Millimetres of the sheet per unit in which symbols and labels are laid out: a pin of 10 units is 3 mm wide.
UNIT = 0.3
#: To units of symbols, whose y is down.
TO_UNITS = np.array([1.0, -1.0]) / UNIT


@dataclass(frozen=True)
class Name:
    """A text for the best of some places (mm); ``runs`` with its indices; ``clear``: distance from the place, mm.

    ``leader``: whether a line leads to a place that is far off; ``symbol``: set in italics.
    """

    runs: Runs
    places: Sequence[Floats]
    height: float = TEXT
    clear: float = 1.5
    leader: bool = False
    symbol: bool = False


def name_of(
    text: str, places: Sequence[Floats], *, height: float = TEXT, clear: float = 1.5, symbol: bool = True
) -> Name:
    """A name whose trailing number is an index: O1 has the index 1."""
    stem, index = split_index(text)
    return Name(as_runs(((stem, 0), (index, -1))), places, height, clear, symbol=symbol)


def put(picture: Picture, names: Iterable[Name], *, more: Iterable[Floats] = ()) -> None:
    """Writes names on a picture, clear of its lines, its texts and ``more`` polylines (k, 2), mm."""
    wanted = list(names)
    labels = [_label(each) for each in wanted]
    ink = [line * TO_UNITS for line in (*(item.outline for item in picture.items), *more)]
    for name, label, chosen in zip(wanted, labels, place(labels, Obstacles.of(ink)), strict=True):
        left, top, _, bottom = chosen.box
        middle = 0.5 * (top + bottom)
        baseline = middle + 0.5 * label.extent[1] - (0.14 + label.drop) * label.size
        at = np.array([left, baseline]) / TO_UNITS
        if name.leader and chosen.gap > 16.0:
            _lead(picture, chosen.box, chosen.anchor)
        picture.text(at, name.runs, name.height, symbol=name.symbol)


def _lead(picture: Picture, box: tuple[float, float, float, float], anchor: tuple[float, float]) -> None:
    left, top, right, bottom = box
    start = np.clip(anchor, (left, top), (right, bottom))
    picture.line(np.array([start, anchor]) / TO_UNITS)


def _label(name: Name) -> Label:
    stem = "".join(text for text, level in name.runs if level == 0)
    index = max((text for text, level in name.runs if level), key=len, default="")
    places = tuple(vec(np.asarray(at) * TO_UNITS) for at in name.places)
    size = name.height / CAPITAL / UNIT
    return Label(stem, places, size=size, clearance=name.clear / UNIT, index=index)
