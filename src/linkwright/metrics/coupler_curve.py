"""Coupler curves: length, area, double points, cusps."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from linkwright.kinematics.cycle import Floats
from linkwright.metrics.analysis import Analysis
from linkwright.metrics.base import METRICS, Metric, MetricValue, Remark
from linkwright.metrics.outputs import free_points
from linkwright.metrics.plane import cross, crossings
from linkwright.metrics.quantities import shown

#: A path stops in a cusp where its speed falls below this share of its mean speed.
STANDING = 1e-6
#: Double points nearer than this share of the curve's length to one another in place and time are one.
SAME = 1e-9
Spot = tuple[float, float]


@dataclass(frozen=True)
class CouplerCurve:
    """Closed path of a point: ``length`` m, ``area`` m² (counter-clockwise positive, loops with their sign),
    ``double_points`` and ``cusps`` as (x, y) in m with the inputs there."""

    point: str
    length: float
    area: float
    double_points: tuple[tuple[Spot, Spot], ...]
    cusps: tuple[tuple[Spot, float], ...]


def coupler_curve(analysis: Analysis, point: str) -> CouplerCurve:
    """The curve of a point over a closed cycle of which all positions are reached."""
    motion = analysis.motion
    track = motion.point(point)
    period = motion.positions.period or 0.0
    speed = np.hypot(*track.velocity.T)
    area = 0.5 * float(np.mean(cross(track.position, track.velocity))) * period
    sense = np.sign(motion.time[-1] - motion.time[0])
    length = float(np.mean(speed)) * period
    doubles = tuple(_doubles(analysis, point, track.position, length)) if length > 0 else ()
    return CouplerCurve(point, length, float(area * sense), doubles, tuple(_cusps(analysis, point, speed)))


def _doubles(analysis: Analysis, point: str, path: Floats, length: float) -> Iterator[tuple[Spot, Spot]]:
    """Crossings of the polygon, sharpened to those of the curve by Newton steps in both times."""
    time, period = analysis.motion.time, analysis.motion.positions.period or 0.0
    step = time[1] - time[0]
    found: list[tuple[float, float]] = []
    for a, b in crossings(path):
        t = np.array([time[0] + a * step, time[0] + b * step])
        for _ in range(8 if analysis.resolver.possible else 0):
            track = analysis.resolver.motion(t).point(point)
            gap, (va, vb) = track.position[1] - track.position[0], track.velocity
            turn = cross(va, vb)
            if turn == 0:
                break
            t = t + np.array([cross(gap, vb) / turn, cross(gap, va) / turn])
        apart = abs(t[1] - t[0]) % period
        if min(apart, period - apart) < 1e-3 * abs(step):
            continue
        place = analysis.resolver.motion(t).point(point).position if analysis.resolver.possible else None
        if place is None or np.hypot(*(place[1] - place[0])) > SAME * length:
            continue
        if any(np.hypot(place[0][0] - x, place[0][1] - y) < 1e-6 * length for x, y in found):
            continue
        found.append((float(place[0][0]), float(place[0][1])))
        inputs = analysis.resolver.input_at(float(t[0])), analysis.resolver.input_at(float(t[1]))
        yield found[-1], inputs


def _cusps(analysis: Analysis, point: str, speed: Floats) -> Iterator[tuple[Spot, float]]:
    """Local minima of the speed where it vanishes."""
    if not analysis.resolver.possible:
        return
    mean, step = float(np.mean(speed)), float(abs(analysis.motion.time[1] - analysis.motion.time[0]))
    for i in np.flatnonzero((speed <= np.roll(speed, 1)) & (speed < np.roll(speed, -1)) & (speed < 0.3 * mean)):
        t = float(analysis.motion.time[i])
        low = analysis.extreme_between(lambda m: np.hypot(*m.point(point).velocity.T), "min", t - step, t + step)
        if low is not None and low.value <= STANDING * mean:
            x, y = analysis.resolver.motion(np.array([low.time])).point(point).position[0]
            yield (float(x), float(y)), low.input


class CurveMetric(Metric):
    """A number of the closed path of a free point."""

    source = "Dijksman, Motion Geometry of Mechanisms; Wunderlich, Ebene Kinematik"

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and analysis.whole and bool(free_points(analysis.motion.mechanism))

    def curves(self, analysis: Analysis) -> Iterator[CouplerCurve]:
        """The curves of all free points."""
        for point in free_points(analysis.motion.mechanism):
            yield coupler_curve(analysis, point)


@METRICS.register("coupler_curve_length")
class CouplerCurveLength(CurveMetric):
    """Length of the closed path of every free point, m."""

    name = "coupler_curve_length"
    dimension = "length"

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for curve in self.curves(analysis):
            yield self.value(analysis, curve.point, curve.length)


@METRICS.register("coupler_curve_area")
class CouplerCurveArea(CurveMetric):
    """Area within the closed path of every free point, m²; loops count with the sense in which they are run."""

    name = "coupler_curve_area"
    dimension = "area"

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for curve in self.curves(analysis):
            yield self.value(analysis, curve.point, curve.area)


@METRICS.register("double_point")
class DoublePoint(CurveMetric):
    """Number of places where the path of a free point crosses itself, with their coordinates."""

    name = "double_point"
    dimension = "count"

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for curve in self.curves(analysis):
            remarks = tuple(_remark("double_point.at", spot) for spot, _ in curve.double_points)
            place = curve.double_points[0][0] if curve.double_points else None
            yield self.value(analysis, curve.point, len(curve.double_points), remarks=remarks, place=place)


@METRICS.register("cusp")
class Cusp(CurveMetric):
    """Number of cusps of the path of a free point: places where it stands still and turns back."""

    name = "cusp"
    dimension = "count"

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for curve in self.curves(analysis):
            remarks = tuple(_remark("cusp.at", spot) for spot, _ in curve.cusps)
            place, at = curve.cusps[0] if curve.cusps else (None, None)
            yield self.value(analysis, curve.point, len(curve.cusps), remarks=remarks, place=place, at=at)


def _remark(key: str, spot: Spot) -> Remark:
    return Remark(key, {"x": shown(spot[0], "length"), "y": shown(spot[1], "length")})
