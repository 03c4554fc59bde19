"""Room that the mechanism needs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, product
from typing import ClassVar

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Better, Metric, MetricValue, Remark
from linkwright.analysis.outputs import output_link
from linkwright.analysis.range_of_motion import turns
from linkwright.analysis.reachable_intervals import SolvedCurves, Ways
from linkwright.analysis.swept_hull import Curves, SweptHull
from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.outputs import row_names
from linkwright.core.plane import area, convex_hull
from linkwright.core.quantity import shown
from linkwright.curves.curve import nodes
from linkwright.curves.polynomials import POINTS
from linkwright.formula.recently_made import Recent
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

#: Ends of ways nearer to each other than this share of the way are the same.
SAME = 1e-9
#: Pieces of a lap: the hull is looked for among their nodes.
HULL_PIECES = 24


class HullArea(Metric):
    """Area of the convex hull of the curves of some points, to 1e-6 of it, however many positions are solved; where
    these follow no law in time, of the positions alone, and not ``exact``."""

    dimension = "area"
    source = "convex hull by Andrew's monotone chain; arcs by Gauss's formula"
    better: ClassVar[Better | None] = "lower"

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        motion = analysis.motion
        if not motion.ok.any():
            return
        found, keys = _curves(analysis), points(motion.mechanism)
        for subject, own in self.swept(motion.mechanism).items():
            chosen = [keys.index(key) for key in own]
            exact = found is not None and not found[1].unresolved.reshape(-1, 2)[chosen].any()
            far = found[1].unbounded.reshape(-1, 2)[chosen].any(axis=0) if found else np.zeros(2, dtype=bool)
            if found is None or far.any():
                places = np.concatenate([motion.vector("position", key)[motion.ok] for key in own])
                corners = convex_hull(places.view(np.complex128)[:, 0])
                size, sides = area(corners), np.ptp(corners.view(float).reshape(-1, 2), axis=0)
            else:
                hull = SweptHull(found[0], chosen)
                size, sides = hull.area, hull.box
            if far.any():
                size, sides, exact = np.inf, np.where(far, np.inf, sides), True
            box = {
                name: shown(side, "length") for name, side in zip(("width", "height"), sides.tolist(), strict=True)
            }
            remarks = (Remark("swept_area.box", _("{width} wide, {height} high").format(**box)),)
            yield self.value(analysis, subject, size, exact=exact, remarks=remarks)


@METRICS.register("swept_area")
class SweptArea(HullArea):
    """Area of the convex hull of the curves of all points of frame and links, m²: a bound of what they sweep."""

    label = _("area needed (convex hull)")
    meaning = _("Area of the convex hull of the curves of all points, an upper bound of the swept area.")

    def swept(self, mechanism: Mechanism) -> dict[str, tuple[str, ...]]:
        return {mechanism.name: points(mechanism)}


@METRICS.register("swept_area_of_link")
class SweptAreaOfLink(HullArea):
    """Area of the convex hull of the curves of every link's points, m²: a bound of what it sweeps."""

    label = _("area needed by a link (convex hull)")
    meaning = _("Area of the convex hull of the curves of a link's points, an upper bound of what it sweeps.")

    on_request = True

    def swept(self, mechanism: Mechanism) -> dict[str, tuple[str, ...]]:
        found = points_of_links(mechanism)
        return {name: found[name] for name in mechanism.links}


def points(mechanism: Mechanism) -> tuple[str, ...]:
    """The canonical names of all points of frame and links."""
    return tuple(dict.fromkeys(chain.from_iterable(points_of_links(mechanism).values())))


def points_of_links(mechanism: Mechanism) -> Mapping[str, tuple[str, ...]]:
    """The canonical names of the points of frame and links, by these."""
    return _points.get(
        mechanism.family,
        None,
        lambda: {
            name: tuple(dict.fromkeys(canonical(mechanism, name, point) for point in link.points))
            for name, link in {"frame": mechanism.frame, **mechanism.links}.items()
        },
    )


#: By the family of a mechanism.
_points: Recent[object, Mapping[str, tuple[str, ...]]] = Recent(64)


def _curves(analysis: Analysis) -> tuple[Curves, SolvedCurves] | None:
    """The curves of all points; None where nothing lies between the positions."""
    cycle, mechanism = analysis.cycle, analysis.motion.mechanism
    keys = points(mechanism)
    if cycle is not None:
        found = cycle.curve(lambda motion: _rows(motion, keys), "motion", 2 * len(keys), HULL_PIECES)
        edges, values = found.edges, np.moveaxis(found.values, 1, 2).reshape(len(keys), 2, -1, POINTS)
        spans = _spans(analysis, cycle, edges, values)
        return Curves(values, *turned(mechanism, edges, analysis.closed), spans), found
    if analysis.ways is None:
        return None
    found = analysis.ways.curve(lambda motion: _rows(motion, keys), "motion", 2 * len(keys), HULL_PIECES)
    edges, values = found.edges, np.moveaxis(found.values, 1, 2).reshape(len(keys), 2, -1, POINTS)
    begins = edges[:-1] == edges[0]
    complete = np.tile([0, len(begins) * POINTS], (len(keys), 1))
    return Curves(values, begins, np.roll(begins, -1), complete), found


def turned(mechanism: Mechanism, edges: Floats, closed: bool) -> tuple[Flags, Flags]:
    """Pieces between edges, s, before which points come from elsewhere, and behind which they go elsewhere, than as
    the piece goes on: at the ends of an open cycle, and where the law of a driver goes over to another formula."""
    laws = [driver.law for driver in mechanism.drivers.values()]
    law_breaks = np.concatenate([law.breaks(edges[0], edges[-1]) for law in laws])
    distance = np.abs(edges[:, None] - law_breaks).min(axis=1, initial=np.inf)
    at_break = distance <= 1e-9 * (edges[-1] - edges[0])
    at_break[[0, -1]] = at_break[[0, -1]].any() or not closed
    return at_break[:-1], at_break[1:]


def _spans(analysis: Analysis, cycle: Ways, edges: Floats, values: Floats) -> Indices:
    """The nodes of every curve from one end of its way to the other, where it is run to and fro: of all points by the
    one driver, or by a link that turns or slides on the frame; one of a point at rest."""
    mechanism, times = analysis.motion.mechanism, nodes(edges).T.ravel()
    complete = (0, len(times)) if len(analysis.resolver.changes) else of_driver(mechanism, edges)
    keys, found = points(mechanism), np.tile(complete, (len(values), 1))
    for output in analysis.outputs:
        way = cycle.at(times, "motion").read(output)
        if output.kind != "angle" or np.ptp(way) < 2.0 * np.pi:
            ends = [(edges[0], float(way[0])), (edges[-1], float(way[-1]))]
            reached = [*ends, *((each.time, each.value) for each in analysis.limits(output))]
            own = points_of_links(mechanism)[output_link(mechanism, output)]
            found[[keys.index(key) for key in own]] = _between(times, _once(reached))
    found[(values == values[:, :, :1, :1]).all(axis=(1, 2, 3))] = 0, 1
    return found


def of_driver(mechanism: Mechanism, edges: Floats) -> tuple[int, int]:
    """The first of the nodes between edges, s, and that behind the last one, that suffice where one driver runs the
    machine to and fro."""
    times, laws = nodes(edges).T.ravel(), [driver.law for driver in mechanism.drivers.values()]
    if len(laws) > 1 or laws[0].constant_speed is not None:
        return 0, len(times)
    return _between(times, _once(turns(laws[0], edges[0], edges[-1])))


def _between(times: Floats, ends: tuple[float, float]) -> tuple[int, int]:
    """The first of the nodes at some times between two, and that behind the last one; one at least."""
    first, last = np.searchsorted(times[:-1], ends[0]), np.searchsorted(times, ends[1])
    return int(first), max(int(last), int(first) + 1)


def _once(reached: Sequence[tuple[float, float]]) -> tuple[float, float]:
    """Times between which what turns back at some times, with these values, goes through its full path, once if that
    can be."""
    values = [value for _, value in reached]
    slack = SAME * (max(values) - min(values))
    low = [time for time, value in reached if value <= min(values) + slack]
    high = [time for time, value in reached if value >= max(values) - slack]
    first, last = min(product(low, high), key=lambda pair: abs(pair[1] - pair[0]))
    return min(first, last), max(first, last)


def _rows(motion: Motion, keys: tuple[str, ...]) -> Floats:
    """The places of points, (2 · points, n) m."""
    names = tuple(chain.from_iterable(row_names("position", key) for key in keys))
    return np.stack(motion.rows.fetch(names, motion.evaluate))
