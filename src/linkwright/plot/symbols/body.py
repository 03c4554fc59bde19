"""Bodies of links: a bar, or a filled plate of three and more points."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from linkwright.plot.svg.element import Floats, path
from linkwright.plot.symbols.base import SYMBOLS, Shape, points


@SYMBOLS.register("bar")
def bar(*, through: ArrayLike = ((0.0, 0.0), (60.0, 0.0))) -> Shape:
    """A thick line through points."""
    line = points(through)
    return Shape((path(line, "lw-bar"),), (line,))


@SYMBOLS.register("plate")
def plate(*, corners: ArrayLike = ((0.0, 0.0), (60.0, 0.0), (30.0, -40.0))) -> Shape:
    """A ternary or higher link: the filled hull of its points."""
    hull = convex_hull(points(corners))
    return Shape((path(hull, "lw-plate", closed=True),), (np.vstack([hull, hull[:1]]),))


def convex_hull(cloud: Floats) -> Floats:
    """Corners of the convex hull, in order round it."""
    rows = sorted({(float(x), float(y)) for x, y in cloud})

    def half(ordered: list[tuple[float, float]]) -> list[tuple[float, float]]:
        chain: list[tuple[float, float]] = []
        for p in ordered:
            while len(chain) > 1 and _turn(chain[-2], chain[-1], p) <= 0:
                chain.pop()
            chain.append(p)
        return chain[:-1]

    return points(half(rows) + half(rows[::-1])) if len(rows) > 2 else points(rows)


def _turn(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
