"""Instant centres of all pairs of links, and centrodes."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Metric, MetricValue, Remark
from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.kinematics.motion import Motion
from linkwright.words import _

#: A relative angular velocity below this share of the largest one of all links has its centre at infinity.
PARALLEL = 1e-12


def instant_centre(motion: Motion, a: str, b: str = "frame") -> Floats:
    """P_ab, the point of equal velocity of two links, (n, 2) m in frame axes; NaN where it is at infinity.

    From the velocities: v_A(0) + ω_A × P = v_B(0) + ω_B × P. Kennedy's theorem (P_ab, P_bc, P_ac on one line)
    follows from it.
    """
    va, wa = _at_origin(motion, a)
    vb, wb = _at_origin(motion, b)
    v, w = va - vb, wa - wb
    rates = [motion.link(name).angular_velocity for name in motion.mechanism.links]
    scale = np.nanmax(np.abs(rates), initial=0.0)
    with np.errstate(all="ignore"):
        w = np.where(np.abs(w) <= PARALLEL * scale, np.nan, w)
        return np.stack([-v[:, 1] / w, v[:, 0] / w], axis=1)


def centrode(motion: Motion, link: str, on: str = "frame") -> Floats:
    """Locus of P_(link, frame), (n, 2) m: the fixed centrode on the frame, the moving one on ``link`` (its axes)."""
    pole = instant_centre(motion, link)
    if on == "frame":
        return pole
    key = f"{on}.{next(iter(motion.mechanism.link(on).points))}"
    x0, y0 = next(iter(motion.mechanism.link(on).points.values()))
    d, e = pole - motion.point(key).position, motion.link(on).direction
    along, across = (d * e).sum(axis=1), e[:, 0] * d[:, 1] - e[:, 1] * d[:, 0]
    return np.stack([along + x0, across + y0], axis=1)


def _at_origin(motion: Motion, link: str) -> tuple[Floats, Floats]:
    """Velocity of the link's plane at the frame's origin, (n, 2), and its angular velocity, (n,)."""
    if link == "frame":
        return np.zeros((motion.steps, 2)), np.zeros(motion.steps)
    point = motion.point(f"{link}.{next(iter(motion.mechanism.link(link).points))}")
    w = motion.link(link).angular_velocity
    x, y = point.position.T
    return point.velocity + np.stack([w * y, -w * x], axis=1), w


@METRICS.register("instant_centre")
class InstantCentre(Metric):
    """Distance of every instant centre P_ij from the frame's origin at the first position, m; with its place."""

    label = _("instant centre, distance from the origin")
    meaning = _("Point at which two links have the same velocity, at the first position.")

    on_request = True
    dimension = "length"
    source = "Norton, Design of Machinery, sec. 6.3; Kennedy's theorem"

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        motion = analysis.motion
        if not motion.ok.any():
            return
        first = int(np.flatnonzero(motion.ok)[0])
        for a, b in combinations(("frame", *motion.mechanism.links), 2):
            x, y = (float(c) for c in instant_centre(motion, b, a)[first])
            finite = np.isfinite(x)
            remark = (
                Remark("instant_centre.at", _("at ({x}, {y})", x=shown(x, "length"), y=shown(y, "length")))
                if finite
                else Remark("instant_centre.infinite", _("at infinity: the two links do not turn against each other"))
            )
            yield self.value(
                analysis,
                f"{a}, {b}",
                np.hypot(x, y) if finite else np.inf,
                at=float(motion.input[first]),
                remarks=(remark,),
                place=(x, y) if finite else None,
            )
