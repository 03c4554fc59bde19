"""Symbols of GB/T 4460 and ISO 3952 on a cam's sheet, in millimetres of paper."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.sheets.picture import Picture

#: Radius of a pin; height and half width of its legs; half length of guides and their distance; hatching.
_PIN, _LEGS, _HALF, _GUIDE, _ROOM, _PITCH, _DEEP = 1.5, 6.0, 3.2, 6.0, 1.6, 1.8, 2.0


def frame_pin(picture: Picture, at: ArrayLike, toward: tuple[float, float]) -> None:
    """A pin on the frame: a circle on two legs that stand on a hatched line in the direction ``toward``."""
    place, down = np.asarray(at, dtype=float), np.asarray(toward)
    across = np.array([-down[1], down[0]])
    left, right = (place + _LEGS * down + side * _HALF * across for side in (-1.0, 1.0))
    picture.line([left, place, right], "thin")
    ground = (place + _LEGS * down - 1.5 * _HALF * across, place + _LEGS * down + 1.5 * _HALF * across)
    hatched(picture, *ground, down)
    picture.circle(place, _PIN, "thin", fill="paper")


def guide(picture: Picture, at: ArrayLike, along: ArrayLike) -> None:
    """Two hatched strokes between which a rod slides."""
    place, way = np.asarray(at, dtype=float), np.asarray(along, dtype=float)
    across = np.array([-way[1], way[0]])
    for side in (-1.0, 1.0):
        middle = place + side * _ROOM * across
        hatched(picture, middle - _GUIDE * way, middle + _GUIDE * way, side * across)


def hatched(picture: Picture, start: Floats, end: Floats, side: Floats) -> None:
    """A thick line with strokes of 45° on one side."""
    length = float(np.hypot(*(end - start)))
    way = (end - start) / length
    picture.line([start, end], "thick")
    count = max(2, round(length / _PITCH))
    for k in range(count):
        foot = start + (k + 0.75) * length / count * way
        picture.line([foot, foot + _DEEP * (side - 0.75 * way)], "thin")
