"""Where points could stand of which a text that is no machine yet gives only the lengths of their links."""

from __future__ import annotations

import cmath
import math

from linkwright.server.agreement import conditions, nearest
from linkwright.server.draft import Draft
from linkwright.server.geometry import Values, shape

#: Directions in which points are tried around others, rad.
TURN, FIRST = 2.4, 0.9
#: Length where none is known, m.
USUAL = 0.1


def sketched(draft: Draft) -> dict[str, list[float]]:
    """Places of the points that nothing draws, as far as their links hang on what is drawn, or on a first point at
    the origin: as the lengths have them, where Newton's method finds such places."""
    shown = draft.shown()
    missing = dict.fromkeys(
        point for points in shown["links"].values() for point in points if point not in shown["points"]
    )
    if not missing:
        return {}
    at = {name: complex(*place) for name, place in shown["points"].items()}
    shapes = {name: each for name, node in draft.section("links") or () if (each := shape(Values(draft.root), node))}
    order = list(shown["links"].items())
    if not at:
        at[next(iter(missing))] = 0j
    for _unused in order:
        for link, points in order:
            base = next((point for point in points if point in at), None)
            for point in points if base is not None else ():
                if base is not None and point not in at:
                    local = shapes[link].points if link in shapes else {}
                    size = abs(local[point] - local[base]) if {point, base} <= {*local} else USUAL
                    at[point] = at[base] + cmath.rect(size or USUAL, FIRST + TURN * len(at))
    draft.places |= {name: [at[name].real, at[name].imag] for name in missing if name in at}
    free = [name for name in missing if name in at]
    found = nearest(conditions(draft), at, free) or {}
    return {name: [place.real, place.imag] for name in free if math.isfinite(abs(place := found.get(name, at[name])))}
