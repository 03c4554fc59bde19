"""Bearing load times sliding speed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import ClassVar

import numpy as np

from linkwright.joints.revolute import RevoluteJoint
from linkwright.kinematics.cycle import Floats
from linkwright.kinetostatics.forces import Forces
from linkwright.metrics.analysis import Analysis
from linkwright.metrics.base import METRICS, Better, Metric, MetricValue, Remark
from linkwright.metrics.quantities import shown
from linkwright.metrics.reactions import size


@METRICS.register("bearing_pv")
class BearingPv(Metric):
    """Largest F·r·|ω| of every pin with a pin_radius r: F its force, ω the relative speed of its two links, W.

    The pressure-velocity value p·v is this over the projected area 2·r·b of a bearing of width b; friction heat is
    μ times it.
    """

    name = "bearing_pv"
    rank = 4
    dimension = "power"
    source = "Shigley, Mechanical Engineering Design, sec. 12-15: p = F/(2 r b), v = r ω"
    better: ClassVar[Better | None] = "lower"
    needs_forces = True

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and bool(_bearings(analysis))

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for joint in _bearings(analysis):
            assert joint.pin_radius is not None
            for link in joint.links[1:]:
                signal = _heat(joint, link, joint.links[0])
                found = analysis.extreme(signal, "max", of="forces")
                if found is None:
                    continue
                mean = shown(analysis.mean_of(signal), "power")
                remarks = (
                    Remark("bearing_pv.mean", {"mean": mean, "radius": shown(joint.pin_radius, "length")}),
                )
                subject = joint.name if len(joint.links) == 2 else f"{joint.name} on {link}"
                yield self.value(
                    analysis, subject, found.value, remarks=remarks, at=found.input, exact=found.exact
                )


def _bearings(analysis: Analysis) -> list[RevoluteJoint]:
    joints = analysis.motion.mechanism.joints.values()
    return [joint for joint in joints if isinstance(joint, RevoluteJoint) and joint.pin_radius]


def _heat(joint: RevoluteJoint, link: str, other: str) -> Callable[[Forces], Floats]:
    radius = joint.pin_radius or 0.0

    def signal(forces: Forces) -> Floats:
        motion = forces.motion
        speed = motion.link(link).angular_velocity - motion.link(other).angular_velocity
        return np.asarray(size(joint.name, link)(forces) * radius * np.abs(speed))

    return signal
