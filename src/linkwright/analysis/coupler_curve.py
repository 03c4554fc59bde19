"""Coupler curves: length, area, double points, cusps."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import partial
from operator import mul

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Metric, MetricValue, Number, Remark
from linkwright.analysis.outputs import coupler_points
from linkwright.core.arrays import Floats
from linkwright.core.attached import PlotMixin
from linkwright.core.plane import cross, crossings
from linkwright.core.quantity import shown
from linkwright.core.search import lowest
from linkwright.curves.curve import increasing, nodes
from linkwright.cycle.summaries import Summary
from linkwright.errors import LinkwrightError
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.forces import Forces
from linkwright.words import Message, _

#: A path stops in a cusp where its speed falls below this share of its mean speed.
STANDING = 1e-6
#: A speed below this share of the largest is zero.
AT_REST = 1e-12
#: A crossing meets within this share of the curve's length; two nearer than DISTINCT are one.
SAME, DISTINCT = 1e-9, 1e-6
#: Times closer than this many steps belong to a cusp or a fold, not to a crossing.
NEIGHBOURS = 1e-3
NEWTON = 8
#: Positions of a turn of the first driver in which a curve is looked at, for so many turns at most.
POSITIONS, MOST_TURNS = 360, 3
#: Most times that a cycle may run the same curve, and shares of it at which that is looked at.
ROUNDS = 120
LOOKS = np.array([0.031, 0.117, 0.213, 0.289, 0.377, 0.441, 0.537, 0.618, 0.703, 0.789, 0.871, 0.953])
#: Sine of the angle between two branches below which they run along each other, as on a way to and fro.
ALONG = 1e-6
#: A crossing within this share of the curve's length from a cusp is none.
NEAR_CUSPS = 1e-4
PlanePoint = tuple[float, float]


@dataclass(frozen=True)
class CouplerCurve(PlotMixin):
    """Closed path of a point: ``length`` m, ``area`` m² (counter-clockwise positive, loops with their sign),
    ``double_points`` and ``cusps`` as (x, y) in m with the inputs there; ``path`` (n, 2) m, its positions once, or
    360 a turn where these do not divide into rounds. A path that is run several times over a cycle, as by a planet
    over the turns of its train, counts once."""

    point: str
    length: float
    area: float
    double_points: tuple[tuple[PlanePoint, PlanePoint], ...]
    cusps: tuple[tuple[PlanePoint, float], ...]
    path: Floats = field(repr=False, compare=False)


def coupler_curve(result: Motion | Forces | Analysis, point: str) -> CouplerCurve:
    """The curve of a point over a closed cycle.

    Raises LinkwrightError where the cycle does not close or not all of its positions are reached.
    """
    analysis = Analysis.of(result)
    if ("curve", point) not in analysis.cached:
        analysis.cached["curve", point] = _curve(analysis, point)
    found: CouplerCurve = analysis.cached["curve", point]
    return found


def _curve(analysis: Analysis, point: str) -> CouplerCurve:
    if not analysis.complete:
        raise LinkwrightError(
            _(
                "the path of {point} is not closed: solve a full cycle of {name!r}",
                code="metrics.path_open",
                point=point,
                name=analysis.motion.mechanism.name,
            )
        )
    lap = _lap(analysis, point)
    motion = _once(analysis, lap)
    path = motion.point(point).position
    length, area = (each(point, lap).measured(analysis)[0] for each in (_length, _area))
    cusps = tuple(_cusps(analysis, point, motion, length)) if analysis.resolver.possible else ()
    doubles = tuple(_doubles(analysis, point, path, length, lap)) if length > 0 else ()
    doubles = tuple(each for each in doubles if not _among(each[0], cusps, NEAR_CUSPS * length))
    known, rounds = analysis.motion.point(point).position[analysis.once], _rounds(analysis, point)
    drawn = path if len(known) % rounds else known[: len(known) // rounds]
    return CouplerCurve(point, length, area, doubles, cusps, drawn)


def _once(analysis: Analysis, lap: float) -> Motion:
    """The positions in which a curve is run once in the time ``lap``, s: as many whatever the solved ones."""
    motion = analysis.motion
    if not analysis.resolver.possible:
        return motion
    if ("lap", str(lap)) not in analysis.cached:
        turns = abs(lap) * float(np.abs(analysis.input_rate).max()) / (2.0 * np.pi)
        count = POSITIONS * int(np.clip(np.ceil(turns - SAME), 1, MOST_TURNS))
        times = motion.time[0] + lap * np.arange(count) / count
        analysis.cached["lap", str(lap)] = analysis.resolver.motion(times)
    found: Motion = analysis.cached["lap", str(lap)]
    return found


def _among(spot: PlanePoint, cusps: tuple[tuple[PlanePoint, float], ...], near: float) -> bool:
    """Whether a place is one of the cusps, from which a curve may run back on itself."""
    return any(np.hypot(spot[0] - x, spot[1] - y) <= near for (x, y), _unused in cusps)


def _length(point: str, lap: float) -> Number:
    """Length of a curve that is run once in the time ``lap``, s, negative where the positions run back in time."""
    return Number(point, (Summary(f"{point}.velocity", "mean"),), partial(mul, abs(lap)))


def _area(point: str, lap: float) -> Number:
    """Area within such a curve."""
    return Number(point, (Summary(f"areal_velocity {point}", "mean"),), partial(mul, lap))


def _lap(analysis: Analysis, point: str) -> float:
    """Time, s, in which a point runs its curve once; negative where the positions run back in time."""
    motion = analysis.motion
    sense = float(np.sign(motion.time[-1] - motion.time[0]))
    return sense * (motion.positions.period or 0.0) / _rounds(analysis, point)


def _rounds(analysis: Analysis, point: str) -> int:
    """How many times a cycle runs the same curve."""
    if ("rounds", point) not in analysis.cached:
        analysis.cached["rounds", point] = _repeated(analysis, point) if analysis.resolver.possible else 1
    found: int = analysis.cached["rounds", point]
    return found


def _repeated(analysis: Analysis, point: str) -> int:
    start, period = float(analysis.motion.time[0]), analysis.motion.positions.period or 0.0
    near = SAME * float(np.ptp(analysis.motion.point(point).position, axis=0).max())
    sense = float(np.sign(analysis.motion.time[-1] - start))

    def gaps(share: Floats, shift: Floats) -> Floats:
        """The distance of the point's places at shares of the cycle, and shifts later."""
        both = start + sense * period * (np.array([share, share + shift]) % 1.0)
        place = analysis.resolver.motion(both.ravel()).point(point).position.reshape(2, -1, 2)
        return np.asarray(np.abs(place[1] - place[0]).max(axis=1))

    rounds = np.arange(ROUNDS, 1, -1)
    again = gaps(np.zeros(len(rounds)), 1.0 / rounds) <= near
    for each in rounds[again] if near else ():
        if gaps(LOOKS, np.full(len(LOOKS), 1.0 / each)).max() <= near:
            return int(each)
    return 1


def _doubles(
    analysis: Analysis, point: str, path: Floats, length: float, lap: float
) -> Iterator[tuple[PlanePoint, PlanePoint]]:
    """Crossings of the polygon, sharpened to those of the curve by Newton steps in both times."""
    places = np.array(crossings(path))
    if not len(places) or not analysis.resolver.possible:
        return
    begin, step, period = float(analysis.motion.time[0]), lap / len(path), abs(lap)
    times = begin + places * step
    for _unused in range(NEWTON):
        position, velocity = _pairs(analysis, point, times)
        gap, turn = position[:, 1] - position[:, 0], cross(velocity[:, 0], velocity[:, 1])
        with np.errstate(all="ignore"):
            change = np.stack([cross(gap, velocity[:, 1]), cross(gap, velocity[:, 0])], axis=1) / turn[:, None]
        times = times + np.where(np.isfinite(change), np.clip(change, -abs(step), abs(step)), 0.0)
    position, velocity = _pairs(analysis, point, times)
    speeds = np.hypot(*np.moveaxis(velocity, -1, 0)).prod(axis=1)
    across = np.abs(cross(velocity[:, 0], velocity[:, 1])) > ALONG * speeds
    interval = np.abs(times[:, 1] - times[:, 0]) % period
    met = np.hypot(*(position[:, 1] - position[:, 0]).T) <= SAME * length
    found: list[PlanePoint] = []
    for i in np.flatnonzero(met & across & (np.minimum(interval, period - interval) > NEIGHBOURS * abs(step))):
        x, y = (float(c) for c in position[i, 0])
        if all(np.hypot(x - a, y - b) > DISTINCT * length for a, b in found):
            found.append((x, y))
            first, second = (analysis.resolver.input_at(float(t)) for t in times[i])
            yield (x, y), (first, second)


def _pairs(analysis: Analysis, point: str, times: Floats) -> tuple[Floats, Floats]:
    """Position and velocity of a point at pairs of times, (pairs, 2, 2) each."""
    track = analysis.resolver.motion(times.ravel()).point(point)
    return track.position.reshape(-1, 2, 2), track.velocity.reshape(-1, 2, 2)


def _cusps(analysis: Analysis, point: str, motion: Motion, length: float) -> Iterator[tuple[PlanePoint, float]]:
    """Local minima of the speed where it vanishes; those at the same place are one."""
    time, speed = _speeds(analysis, point, motion)
    mean, interval, found = float(np.mean(speed)), float(np.ptp(time)) / POSITIONS, list[PlanePoint]()
    low = speed <= np.roll(speed, 1)
    for i in np.flatnonzero(low & (speed < np.roll(speed, -1)) & (speed < 0.3 * mean)).tolist():
        before, after = (time[i] - time[i - 1], time[(i + 1) % len(time)] - time[i])
        ends = [float(time[i] + way * min(abs(gap), interval)) for way, gap in ((-1.0, before), (1.0, after))]
        low, high = np.array(ends)[:, None]
        (at,), (slowest,) = lowest(lambda place: _speed(analysis, point, place), low, high)
        if slowest > STANDING * mean:
            continue
        x, y = analysis.resolver.motion(np.array([at])).point(point).position[0].tolist()
        if not any(np.hypot(x - a, y - b) <= DISTINCT * length for a, b in found):
            found.append((x, y))
            yield (x, y), analysis.resolver.input_at(float(at))


def _speeds(analysis: Analysis, point: str, motion: Motion) -> tuple[Floats, Floats]:
    """Times of a motion and of the pieces of the cycle next to them, which are short where the speed changes sharply,
    in order, with a point's speeds there."""
    time = motion.time
    if analysis.cycle is not None:
        inner = nodes(analysis.cycle.curve(lambda each: each.point(point).velocity.T, "motion", 2).edges).T.ravel()
        time = increasing(np.append(time, inner[(inner > time.min()) & (inner < time.max())]))
    speed = _speed(analysis, point, time)
    return time, np.where(speed <= AT_REST * speed.max(), 0.0, speed)


def _speed(analysis: Analysis, point: str, time: Floats) -> Floats:
    """How fast a point is at times (...), s."""
    velocity = analysis.resolver.motion(time.ravel()).point(point).velocity
    return np.asarray(np.hypot(*velocity.T).reshape(time.shape))


class CurveMetric(Metric):
    """A number of the closed path of a coupler point."""

    source = "Dijksman, Motion Geometry of Mechanisms; Wunderlich, Ebene Kinematik"

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and analysis.complete and bool(coupler_points(analysis.motion.mechanism))

    def curves(self, analysis: Analysis) -> Iterator[CouplerCurve]:
        """The curves of all coupler points."""
        for point in coupler_points(analysis.motion.mechanism):
            yield coupler_curve(analysis, point)


@METRICS.register("coupler_curve_length")
class CouplerCurveLength(CurveMetric):
    """Length of the closed path of every coupler point, m."""

    label = _("length of the point's path")
    meaning = _("Length of the closed path of a coupler point.")

    dimension = "length"

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for point in coupler_points(analysis.motion.mechanism):
            yield _length(point, _lap(analysis, point))


@METRICS.register("coupler_curve_area")
class CouplerCurveArea(CurveMetric):
    """Area within the closed path of every coupler point, m²; loops count with the sense in which they are run."""

    label = _("area of the point's path")
    meaning = _("Area within the closed path of a coupler point, counter-clockwise loops positive.")

    dimension = "area"

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for point in coupler_points(analysis.motion.mechanism):
            yield _area(point, _lap(analysis, point))


@METRICS.register("double_point")
class DoublePoint(CurveMetric):
    """Number of places where the path of a coupler point crosses itself, with their coordinates."""

    label = _("double points of the path")
    meaning = _("Places where the path of a coupler point crosses itself.")

    dimension = "count"

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for curve in self.curves(analysis):
            remarks = tuple(
                _remark("double_point.at", _("double point at ({x}, {y})"), spot)
                for spot, _unused in curve.double_points
            )
            place = curve.double_points[0][0] if curve.double_points else None
            yield self.value(analysis, curve.point, len(curve.double_points), remarks=remarks, place=place)


@METRICS.register("cusp")
class Cusp(CurveMetric):
    """Number of cusps of the path of a coupler point: places where it stops and turns back."""

    label = _("cusps of the path")
    meaning = _("Places where the path of a coupler point stops and turns back.")

    dimension = "count"

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for curve in self.curves(analysis):
            remarks = tuple(_remark("cusp.at", _("cusp at ({x}, {y})"), spot) for spot, _unused in curve.cusps)
            place, at = curve.cusps[0] if curve.cusps else (None, None)
            yield self.value(analysis, curve.point, len(curve.cusps), remarks=remarks, place=place, at=at)


def _remark(key: str, message: Message, spot: PlanePoint) -> Remark:
    return Remark(key, message.format(x=shown(spot[0], "length"), y=shown(spot[1], "length")))
