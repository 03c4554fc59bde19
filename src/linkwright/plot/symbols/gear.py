"""Gears, racks and cams."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from linkwright.plot.svg.element import circle, path
from linkwright.plot.symbols.base import SYMBOLS, Shape, Vec, placed, points, ring


@SYMBOLS.register("gear")
def gear(*, at: Vec = (0.0, 0.0), radius: float = 40.0, turned: float = 0.0, inside: bool = False) -> Shape:
    """A gear: its pitch circle as a chain line and short teeth across it; ``inside`` for a ring gear."""
    count = max(12, round(2 * math.pi * radius / 9))
    teeth = []
    outer, inner = (3.5, -2.5) if not inside else (-3.5, 2.5)
    for angle in turned + 2 * math.pi * np.arange(count) / count:
        ray = (math.cos(angle), math.sin(angle))
        teeth.append(path(placed([(radius + inner, 0), (radius + outer, 0)], at, ray), "lw-tooth"))
    return Shape((circle(at, radius, "lw-pitch"), *teeth), (ring(at, radius, 36),))


@SYMBOLS.register("rack")
def rack(*, at: Vec = (0.0, 0.0), along: Vec = (1.0, 0.0), start: float = -50.0, end: float = 50.0) -> Shape:
    """A rack: its pitch line and teeth."""
    count = max(4, round((end - start) / 9))
    line = placed([(start, 0), (end, 0)], at, along)
    marks = start + (np.arange(count) + 0.5) * (end - start) / count
    teeth = [path(placed([(x, -3), (x, 3)], at, along), "lw-tooth") for x in marks]
    return Shape((path(line, "lw-pitch"), *teeth), (line,))


@SYMBOLS.register("cam")
def cam(*, profile: ArrayLike = ((20.0, 0.0), (0.0, 20.0), (-20.0, 0.0), (0.0, -34.0))) -> Shape:
    """A cam: its closed profile, filled."""
    outline = points(profile)
    return Shape((path(outline, "lw-plate", closed=True),), (np.vstack([outline, outline[:1]]),))
