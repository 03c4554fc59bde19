"""Coupler curves: length, area, double points, cusps."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field
from functools import partial
from operator import mul

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.plane import cross, crossings
from linkwright.core.plotted import Plotted
from linkwright.errors import LinkwrightError
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.forces import Forces
from linkwright.metrics.analysis import Analysis
from linkwright.metrics.base import METRICS, Metric, MetricValue, Number, Remark
from linkwright.metrics.outputs import coupler_points
from linkwright.metrics.quantities import shown

#: A path stops in a cusp where its speed falls below this share of its mean speed.
STANDING = 1e-6
#: A crossing meets within this share of the curve's length; two nearer than APART are one.
SAME, APART = 1e-9, 1e-6
#: Times closer than this many steps belong to a cusp or a fold, not to a crossing.
NEIGHBOURS = 1e-3
NEWTON = 8
#: Sine of the angle between two branches below which they run along each other, as on a way to and fro.
ALONG = 1e-6
Spot = tuple[float, float]


@dataclass(frozen=True)
class CouplerCurve(Plotted):
    """Closed path of a point: ``length`` m, ``area`` m² (counter-clockwise positive, loops with their sign),
    ``double_points`` and ``cusps`` as (x, y) in m with the inputs there; ``path`` (n, 2) m, its positions once. A
    path that is run several times over a cycle, as by a planet over the turns of its train, counts once."""

    point: str
    length: float
    area: float
    double_points: tuple[tuple[Spot, Spot], ...]
    cusps: tuple[tuple[Spot, float], ...]
    path: Floats = field(repr=False, compare=False)


def coupler_curve(result: Motion | Forces | Analysis, point: str) -> CouplerCurve:
    """The curve of a point over a closed cycle.

    Raises LinkwrightError where the cycle does not close or not all of its positions are reached.
    """
    analysis = Analysis.of(result)
    if ("curve", point) not in analysis.kept:
        analysis.kept["curve", point] = _curve(analysis, point)
    found: CouplerCurve = analysis.kept["curve", point]
    return found


def _curve(analysis: Analysis, point: str) -> CouplerCurve:
    motion = analysis.motion
    if not analysis.whole:
        raise LinkwrightError("metrics.path_open", point=point, name=motion.mechanism.name)
    lap, number = _lap(analysis, point), slice(0, len(motion.time[analysis.once]) // _rounds(analysis, point))
    path, speed = motion.point(point).position[number], np.hypot(*motion.point(point).velocity[number].T)
    length, area = (each(point, lap).measured(analysis)[0] for each in (_length, _area))
    doubles = tuple(_doubles(analysis, point, path, length, abs(lap))) if length > 0 else ()
    return CouplerCurve(point, length, area, doubles, tuple(_cusps(analysis, point, speed)), path)


def _length(point: str, lap: float) -> Number:
    """Length of a curve that is run once in the time ``lap``, s, negative where the positions run back in time."""
    return Number(point, (f"{point}.velocity mean",), partial(mul, abs(lap)))


def _area(point: str, lap: float) -> Number:
    """Area within such a curve."""
    return Number(point, (f"areal_velocity {point} mean",), partial(mul, lap))


def _lap(analysis: Analysis, point: str) -> float:
    """Time, s, in which a point runs its curve once; negative where the positions run back in time."""
    motion = analysis.motion
    sense = float(np.sign(motion.time[-1] - motion.time[0]))
    return sense * (motion.positions.period or 0.0) / _rounds(analysis, point)


def _rounds(analysis: Analysis, point: str) -> int:
    """How many times a cycle runs the same curve, as far as its positions divide into so many."""
    if ("rounds", point) not in analysis.kept:
        path = analysis.motion.point(point).position[analysis.once]
        analysis.kept["rounds", point] = _repeated(analysis, point, path)
    found: int = analysis.kept["rounds", point]
    return found


def _repeated(analysis: Analysis, point: str, path: Floats) -> int:
    count, size = len(path), float(np.ptp(path, axis=0).max())
    for rounds in range(count // 3, 1, -1) if size else ():
        shift, rest = divmod(count, rounds)
        if rest or np.abs(path[shift] - path[0]).max() > SAME * size:
            continue
        if np.abs(path - np.roll(path, shift, axis=0)).max() > SAME * size:
            continue
        begin, following = analysis.motion.time[:2]
        between = begin + (following - begin) * (np.array([0.0, shift]) + 0.37)
        if (
            analysis.resolver.possible
            and np.ptp(analysis.resolver.motion(between).point(point).position, axis=0).max() <= SAME * size
        ):
            return rounds
    return 1


def _doubles(
    analysis: Analysis, point: str, path: Floats, length: float, period: float
) -> Iterator[tuple[Spot, Spot]]:
    """Crossings of the polygon, sharpened to those of the curve by Newton steps in both times."""
    places = np.array(crossings(path))
    if not len(places) or not analysis.resolver.possible:
        return
    begin, step = analysis.motion.time[0], analysis.motion.time[1] - analysis.motion.time[0]
    times = begin + places * step
    for _ in range(NEWTON):
        position, velocity = _pairs(analysis, point, times)
        gap, turn = position[:, 1] - position[:, 0], cross(velocity[:, 0], velocity[:, 1])
        with np.errstate(all="ignore"):
            change = (
                np.stack([cross(gap, velocity[:, 1]), cross(gap, velocity[:, 0])], axis=1) / turn[:, None]
            )
        times = times + np.where(np.isfinite(change), np.clip(change, -abs(step), abs(step)), 0.0)
    position, velocity = _pairs(analysis, point, times)
    speeds = np.hypot(*np.moveaxis(velocity, -1, 0)).prod(axis=1)
    across = np.abs(cross(velocity[:, 0], velocity[:, 1])) > ALONG * speeds
    apart = np.abs(times[:, 1] - times[:, 0]) % period
    met = np.hypot(*(position[:, 1] - position[:, 0]).T) <= SAME * length
    found: list[Spot] = []
    for i in np.flatnonzero(met & across & (np.minimum(apart, period - apart) > NEIGHBOURS * abs(step))):
        x, y = (float(c) for c in position[i, 0])
        if all(np.hypot(x - a, y - b) > APART * length for a, b in found):
            found.append((x, y))
            first, second = (analysis.resolver.input_at(float(t)) for t in times[i])
            yield (x, y), (first, second)


def _pairs(analysis: Analysis, point: str, times: Floats) -> tuple[Floats, Floats]:
    """Position and velocity of a point at pairs of times, (pairs, 2, 2) each."""
    track = analysis.resolver.motion(times.ravel()).point(point)
    return track.position.reshape(-1, 2, 2), track.velocity.reshape(-1, 2, 2)


def _cusps(analysis: Analysis, point: str, speed: Floats) -> Iterator[tuple[Spot, float]]:
    """Local minima of the speed where it vanishes; fewer than three positions show none."""
    if not analysis.resolver.possible or len(speed) < 3:
        return
    mean, step = float(np.mean(speed)), float(abs(analysis.motion.time[1] - analysis.motion.time[0]))
    for i in np.flatnonzero(
        (speed <= np.roll(speed, 1)) & (speed < np.roll(speed, -1)) & (speed < 0.3 * mean)
    ):
        t = float(analysis.motion.time[i])
        (low,) = analysis.extremes_between(
            "min", [(lambda m: np.hypot(*m.point(point).velocity.T), (t - step, t + step))]
        )
        if low is not None and low.value <= STANDING * mean:
            x, y = analysis.resolver.motion(np.array([low.time])).point(point).position[0]
            yield (float(x), float(y)), low.input


class CurveMetric(Metric):
    """A number of the closed path of a coupler point."""

    source = "Dijksman, Motion Geometry of Mechanisms; Wunderlich, Ebene Kinematik"

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and analysis.whole and bool(coupler_points(analysis.motion.mechanism))

    def curves(self, analysis: Analysis) -> Iterator[CouplerCurve]:
        """The curves of all coupler points."""
        for point in coupler_points(analysis.motion.mechanism):
            yield coupler_curve(analysis, point)


@METRICS.register("coupler_curve_length")
class CouplerCurveLength(CurveMetric):
    """Length of the closed path of every coupler point, m."""

    dimension = "length"

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for point in coupler_points(analysis.motion.mechanism):
            yield _length(point, _lap(analysis, point))


@METRICS.register("coupler_curve_area")
class CouplerCurveArea(CurveMetric):
    """Area within the closed path of every coupler point, m²; loops count with the sense in which they are run."""

    dimension = "area"

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for point in coupler_points(analysis.motion.mechanism):
            yield _area(point, _lap(analysis, point))


@METRICS.register("double_point")
class DoublePoint(CurveMetric):
    """Number of places where the path of a coupler point crosses itself, with their coordinates."""

    dimension = "count"

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for curve in self.curves(analysis):
            remarks = tuple(_remark("double_point.at", spot) for spot, _ in curve.double_points)
            place = curve.double_points[0][0] if curve.double_points else None
            yield self.value(analysis, curve.point, len(curve.double_points), remarks=remarks, place=place)


@METRICS.register("cusp")
class Cusp(CurveMetric):
    """Number of cusps of the path of a coupler point: places where it stands still and turns back."""

    dimension = "count"

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for curve in self.curves(analysis):
            remarks = tuple(_remark("cusp.at", spot) for spot, _ in curve.cusps)
            place, at = curve.cusps[0] if curve.cusps else (None, None)
            yield self.value(analysis, curve.point, len(curve.cusps), remarks=remarks, place=place, at=at)


def _remark(key: str, spot: Spot) -> Remark:
    return Remark(key, {"x": shown(spot[0], "length"), "y": shown(spot[1], "length")})
