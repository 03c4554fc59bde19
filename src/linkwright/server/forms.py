"""Entries of links by where their points are drawn: a length, lengths and an angle, coordinates."""

from __future__ import annotations

import cmath
from collections.abc import Mapping

from linkwright.core.data import Plain
from linkwright.core.expressions import amount
from linkwright.errors import LinkwrightError, QuantityError
from linkwright.server.agreement import Condition, nearest
from linkwright.server.draft import Draft, coordinates, length
from linkwright.server.sizes import angle, in_axes
from linkwright.words import _

_NO_TRIANGLE = _("sides of {sides} make no triangle", code="studio.no_triangle")


def link_entry(draft: Draft, at: Mapping[str, complex], sides: list[str | None] | None = None) -> Plain:
    """The sizes of a link between places; of a plate, typed sides go round it in the order of its points."""
    points, local = list(at), in_axes(at, at)
    sides = sides or [None] * len(points)
    first = sides[0] or length(abs(local[points[1]]), draft.step)
    if len(points) == 2:
        return {"points": points, "length": first}
    if len(points) == 3 and any(sides):
        return _triangle(draft, local, sides)
    step = draft.step
    if any(sides[1:]):
        local, step = _with_sides(local, sides), 0.01 * step
    also = {point: coordinates(local[point], step) for point in points[2:]}
    return {"points": points[:2], "length": first, "also": also}


def _triangle(draft: Draft, local: Mapping[str, complex], sides: list[str | None]) -> Plain:
    """Two lengths from the first point and the angle between them, by the third side where that was typed."""
    _corner, second, third = local.values()
    drawn = (abs(second), abs(third - second), abs(third))
    a, b, c = (side or length(size, draft.step) for side, size in zip(sides, drawn, strict=True))
    turn = angle(cmath.phase(third))
    if sides[1]:
        sign = "-" if third.imag < 0 else ""
        turn = f"{sign}acos((({a})^2 + ({c})^2 - ({b})^2)/(2*({a})*({c})))"
        try:
            amount(turn, "angle")
        except QuantityError:
            raise LinkwrightError(_NO_TRIANGLE.format(sides=(a, b, c))) from None
    return {"points": list(local), "lengths": [a, c], "angle": turn}


def _with_sides(local: Mapping[str, complex], sides: list[str | None]) -> dict[str, complex]:
    """Corners of a plate nearest to those drawn whose typed sides are as long as typed."""
    corners, wanted = list(local), list[Condition]()
    for start, end, side in zip(corners, [*corners[1:], corners[0]], sides, strict=True):
        if side or start == corners[0]:
            size = amount(side, "length") if side else abs(local[end] - local[start])
            wanted.append(_apart(start, end, size))
    found = nearest(wanted, local, corners[1:])
    if found is None:
        raise LinkwrightError(_NO_TRIANGLE.format(sides=tuple(side for side in sides if side)))
    return in_axes(corners, {**local, **found})


def _apart(start: str, end: str, size: float) -> Condition:
    return Condition("", (start, end), lambda at: [abs(at[end] - at[start]) - size])
