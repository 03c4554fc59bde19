"""Springs and the damper."""

from __future__ import annotations

import math

import numpy as np

from linkwright.plot.svg.element import Floats, path
from linkwright.plot.symbols.base import SYMBOLS, Shape, Vec, placed


def zigzag(start: Vec, end: Vec, *, coils: int = 6, height: float = 7.0) -> Floats:
    """Corners of a spring between two points."""
    length, along = _way(start, end)
    lead = min(0.18 * length, 16.0)
    x = np.linspace(lead, length - lead, 2 * coils + 1)
    y = np.where(np.arange(len(x)) % 2 == 0, height, -height)
    y[0] = y[-1] = 0.0
    inner = np.stack([x, y], axis=1)
    return placed(np.vstack([[(0.0, 0.0)], inner, [(length, 0.0)]]), start, along)


@SYMBOLS.register("spring")
def spring(*, start: Vec = (0.0, 0.0), end: Vec = (60.0, 0.0)) -> Shape:
    """A coil spring between two points."""
    line = zigzag(start, end)
    return Shape((path(line, "lw-spring"),), (line,))


@SYMBOLS.register("torsion_spring")
def torsion_spring(*, at: Vec = (0.0, 0.0), radius: float = 14.0) -> Shape:
    """A spiral about a pin."""
    t = np.linspace(0.0, 1.0, 60)
    angle, r = 4.5 * math.pi * t, 6.0 + (radius - 6.0) * t
    line = np.stack([at[0] + r * np.cos(angle), at[1] + r * np.sin(angle)], axis=1)
    return Shape((path(line, "lw-spring"),), (line,))


@SYMBOLS.register("damper")
def damper(*, start: Vec = (0.0, 0.0), end: Vec = (60.0, 0.0), height: float = 8.0) -> Shape:
    """A dashpot between two points."""
    length, along = _way(start, end)
    body = min(26.0, 0.5 * length)
    a, b, c = (length - body) / 2, (length + body) / 2, length / 2 + 0.15 * body
    lines = (
        [(0, 0), (a, 0)], [(b, -height), (a, -height), (a, height), (b, height)],
        [(c, -0.7 * height), (c, 0.7 * height)], [(c, 0), (length, 0)],
    )  # fmt: skip
    strokes = [placed(line, start, along) for line in lines]
    return Shape(tuple(path(stroke, "lw-spring") for stroke in strokes), tuple(strokes))


def _way(start: Vec, end: Vec) -> tuple[float, Vec]:
    dx, dy = end[0] - start[0], end[1] - start[1]
    length = math.hypot(dx, dy)
    return length, (dx / length, dy / length) if length else (1.0, 0.0)
