"""A damper that turns."""

from __future__ import annotations

import math

import numpy as np

from linkwright.plot.svg.element import Floats, path
from linkwright.plot.symbols.base import SYMBOLS, Shape, Vec


@SYMBOLS.register("torsion_damper")
def torsion_damper(*, at: Vec = (0.0, 0.0), radius: float = 16.0) -> Shape:
    """A dashpot bent about a pin: the pot, closed at one end, and the vane in it on its arm."""
    inner, outer, middle = radius - 5.0, radius + 5.0, -0.5 * math.pi
    start, end, vane = middle - 0.8, middle + 0.7, middle + 0.15

    def arc(r: float, first: float, last: float) -> Floats:
        angle = np.linspace(first, last, 15)
        return np.stack([at[0] + r * np.cos(angle), at[1] + r * np.sin(angle)], axis=1)

    def ray(angle: float, first: float, last: float) -> Floats:
        r = np.array([first, last])
        return np.stack([at[0] + r * math.cos(angle), at[1] + r * math.sin(angle)], axis=1)

    strokes = (
        np.concatenate([arc(outer, end, start), arc(inner, start, end)]),
        ray(vane, inner + 1.5, outer - 1.5),
        np.concatenate([arc(radius, vane, end + 0.55), ray(end + 0.55, radius, 6.0)]),
        np.concatenate([arc(radius, start, start - 0.4), ray(start - 0.4, radius, 6.0)]),
    )
    return Shape(tuple(path(stroke, "lw-spring") for stroke in strokes), strokes)
