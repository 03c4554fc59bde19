"""Names beside what they mean: of several places each takes the one where it meets least."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.sheets.picture import (
    TEXT,
    Anchor,
    Circle,
    Line,
    Picture,
    Runs,
    Text,
    Words,
    as_runs,
    bounds_of,
)

#: Distance of samples along lines, mm; what a sample of a thick line, of a thin one, and a text cost.
_EVERY, _THICK, _THIN, _TEXT = 0.7, 4.0, 1.0, 1000.0
#: Clear space around a text, mm; what each further place of a name costs.
_CLEAR, _LATER = 0.7, 0.4

#: A place with the direction in which a text leads away from it.
Spot = tuple[Floats, complex]
#: A text with the spots where it may be, and the place that its leader leads to.
Name = tuple[Runs, list[Spot], Floats | None]


class Names:
    """Writes texts on a picture that is drawn already, one after the other."""

    def __init__(self, picture: Picture, letters: float = TEXT) -> None:
        self.picture, self.letters = picture, letters
        samples = [_samples(item) for item in picture.items if isinstance(item, Line | Circle)]
        self.samples = np.concatenate([*samples, np.empty((0, 3))])
        self.boxes = [bounds_of([text]) for text in picture.texts]

    def write(self, words: Words, spots: Sequence[Spot], *, leader: ArrayLike | None = None) -> None:
        """A text at the spot where it meets least; ``leader``: the place that a thin line leads to from there."""
        found = [_text(words, spot, self.letters) for spot in spots]
        costs = [self._cost(text) + _LATER * k for k, text in enumerate(found)]
        best = int(np.argmin(costs))
        text = found[best]
        self.picture.items.append(text)
        self.boxes.append(bounds_of([text]))
        if leader is not None:
            line = np.array([spots[best][0], np.asarray(leader)])
            self.picture.line(line)
            self.samples = np.concatenate([self.samples, _samples(Line(line))])

    def _cost(self, text: Text) -> float:
        inner = bounds_of([text])
        box = inner.inset(-_CLEAR)
        x, y, weight = self.samples.T
        inside = (x > box.left) & (x < box.right) & (y > box.bottom) & (y < box.top)
        return float(weight[inside].sum()) + _TEXT * sum(box.meets(other) for other in self.boxes)


def around(
    at: ArrayLike, away: complex, gaps: Sequence[float], turns: Sequence[float] = (0.0,)
) -> list[Spot]:
    """Spots about a place: at distances (mm) in a direction turned by angles (degrees)."""
    place = np.asarray(at, dtype=float)
    unit = away / abs(away)
    found: list[Spot] = []
    for gap in gaps:
        for turn in turns:
            way = unit * complex(math.cos(math.radians(turn)), math.sin(math.radians(turn)))
            found.append((place + gap * np.array([way.real, way.imag]), way))
    return found


def _text(words: Words, spot: Spot, height: float) -> Text:
    """A text whose near side is at a spot."""
    at, away = spot
    unit = away / abs(away)
    anchor: Anchor = "start" if unit.real > 0.35 else "end" if unit.real < -0.35 else "middle"
    drop = 0.5 * height * (1.0 - unit.imag)
    return Text(at - (0.0, drop), as_runs(words), height, anchor)


def _samples(item: Line | Circle) -> Floats:
    """Places along an item with their weight, (n, 3)."""
    if isinstance(item, Circle):
        count = max(8, math.ceil(2 * math.pi * item.radius / _EVERY))
        angle = np.linspace(0.0, 2 * math.pi, count, endpoint=False)
        places = item.at + item.radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    else:
        corners = np.vstack([item.points, item.points[:1]]) if item.closed else item.points
        lengths = np.hypot(*np.diff(corners, axis=0).T)
        way = np.append(0.0, np.cumsum(lengths))
        inner = np.linspace(0.0, way[-1], max(2, math.ceil(way[-1] / _EVERY) + 1))
        places = np.stack([np.interp(inner, way, corners[:, k]) for k in (0, 1)], axis=1)
    weight = _THICK if item.pen in ("thick", "frame") else _THIN
    return np.column_stack([places, np.full(len(places), weight)])
