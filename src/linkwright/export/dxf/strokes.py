"""Polygons and circles of symbols, from their drawing on paper."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.plot.svg.element import Element
from linkwright.plot.symbols.base import points

_NUMBER = r"(-?\d*\.?\d+)"
_MOVE = re.compile(rf"([ML]){_NUMBER} {_NUMBER}")


@dataclass(frozen=True)
class Stroke:
    """A polyline (k, 2) on the paper, or a circle where it has a ``radius`` (its centre is the only point)."""

    points: Floats
    closed: bool = False
    radius: float | None = None


def strokes(element: Element) -> Iterator[Stroke]:
    """What an element of a symbol draws; elements with curves other than circles are left out."""
    given = dict(element.attributes)
    if element.tag == "circle":
        yield Stroke(points([(float(given["cx"]), float(given["cy"]))]), radius=float(given["r"]))
    elif element.tag == "path" and re.fullmatch(r"[ML\d\s.,Z-]*", given["d"]):
        for part in filter(None, re.split(r"(?=M)", given["d"])):
            rows = [(float(x), float(y)) for _, x, y in _MOVE.findall(part)]
            if rows:
                yield Stroke(points(rows), closed=part.endswith("Z"))
    for inner in element.content:
        if isinstance(inner, Element):
            yield from strokes(inner)


def unbroken(track: Floats) -> Iterator[Floats]:
    """The pieces of a path between positions that were not reached."""
    good = np.asarray(np.isfinite(track).all(axis=1))
    for piece in np.split(np.arange(len(track)), np.flatnonzero(np.diff(good.astype(int))) + 1):
        if len(piece) > 1 and good[piece[0]]:
            yield track[piece]
