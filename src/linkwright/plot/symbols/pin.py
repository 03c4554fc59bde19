"""A pin, and the dot of a plain point."""

from __future__ import annotations

from linkwright.plot.svg.element import circle
from linkwright.plot.symbols.base import PIN, SYMBOLS, Shape, Vec, ring


@SYMBOLS.register("pin")
def pin(*, at: Vec = (0.0, 0.0), radius: float = PIN) -> Shape:
    """A small open circle."""
    return Shape((circle(at, radius, "lw-pin"),), (ring(at, radius),))


@SYMBOLS.register("point")
def point(*, at: Vec = (0.0, 0.0), radius: float = 0.55 * PIN) -> Shape:
    """A dot: a named point that is no joint."""
    return Shape((circle(at, radius, "lw-point"),), (ring(at, radius, 8),))
