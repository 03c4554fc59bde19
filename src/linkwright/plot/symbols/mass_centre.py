"""The mass centre: a circle with two filled quarters."""

from __future__ import annotations

from linkwright.plot.svg.element import circle, element, number
from linkwright.plot.symbols.base import SYMBOLS, Shape, Vec, ring


@SYMBOLS.register("mass_centre")
def mass_centre(*, at: Vec = (0.0, 0.0), radius: float = 6.0) -> Shape:
    """The symbol for the centre of mass."""
    x, y, r = at[0], at[1], radius

    def quarter(dx: float, dy: float) -> str:
        return f"M{number(x)} {number(y)}h{number(dx)}A{number(r)} {number(r)} 0 0 1 {number(x)} {number(y + dy)}Z"

    filled = element("path", {"class": "lw-mass", "d": quarter(r, r) + quarter(-r, -r)})
    return Shape((circle(at, r, "lw-mass-ring"), filled), (ring(at, r),))
