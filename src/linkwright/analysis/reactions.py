"""Joint reactions: peak and root mean square; bearing load times sliding speed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from math import isnan
from typing import ClassVar

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Better, Metric, MetricValue, Number, Remark
from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.cycle.summaries import Summary
from linkwright.joints.lower_pair import TurningJoint
from linkwright.kinetostatics.forces import Forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _


def sides(mechanism: Mechanism) -> Iterator[tuple[str, str, str]]:
    """Name to show, joint and link for every reaction; each link's share where a pin holds three or more."""
    for name, joint in mechanism.joints.items():
        several = len(joint.joined) > 2
        for link in joint.joined if several else joint.joined[1:]:
            yield (f"{name} on {link}" if several else name), name, link


def size(joint: str, link: str) -> Callable[[Forces], Floats]:
    """Size of a reaction, (n,) N."""

    def signal(forces: Forces) -> Floats:
        force = forces.reaction(joint, on=link)
        return np.hypot(force[:, 0], force[:, 1])

    return signal


@METRICS.register("peak_reaction")
class PeakReaction(Metric):
    """Largest size of every joint's reaction, N."""

    label = _("peak reaction")
    meaning = _("Largest force that a joint transmits.")

    rank = 4
    dimension = "force"
    source = "kinetostatics: reactions by Assur group"
    better: ClassVar[Better | None] = "lower"
    needs_forces = True
    kind: ClassVar[str] = "max"

    def suits(self, analysis: Analysis) -> bool:
        return analysis.loaded

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for subject, joint, link in sides(analysis.motion.mechanism):
            yield Number(subject, (Summary(f"reaction {joint} on {link}", self.kind),))


@METRICS.register("rms_reaction")
class RmsReaction(PeakReaction):
    """Root mean square over time of the size of every joint's reaction, N."""

    label = _("RMS reaction")
    meaning = _("Root mean square over time of the force that a joint transmits.")

    kind = "rms"


@METRICS.register("bearing_pv")
class BearingPv(Metric):
    """Largest F·r·|ω| of every pin with a pin_radius r: F its force, ω the relative speed of its two links, W.

    The pressure-velocity value p·v is this over the projected area 2·r·b of a bearing of width b; friction heat is
    μ times it.
    """

    label = _("bearing force times sliding speed")
    meaning = _(
        "Pin force times pin radius times relative angular velocity; divided by the "
        "projected area of the bearing it is its p·v value."
    )

    rank = 4
    dimension = "power"
    source = "Shigley, Mechanical Engineering Design, sec. 12-15: p = F/(2 r b), v = r ω"
    better: ClassVar[Better | None] = "lower"
    needs_forces = True

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and any(_bearings(analysis))

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for joint, link in _bearings(analysis):
            subject = joint.name if len(joint.links) == 2 else f"{joint.name} on {link}"
            yield Number(subject, (Summary(f"heat {joint.name} on {link}", "peak"),))

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for found, (joint, link) in zip(super().values(analysis), _bearings(analysis), strict=False):
            heat = analysis.signal(f"heat {joint.name} on {link}")
            mean = analysis.mean_of(lambda forces, heat=heat: np.abs(heat(forces)))
            radius = shown(joint.pin_radius or 0.0, "length")
            sentence = _(
                "with a pin radius of {radius}; mean over the cycle {mean}", radius=radius, mean=shown(mean, "power")
            )
            known = () if isnan(mean) else (Remark("bearing_pv.mean", sentence),)
            yield replace(found, remarks=(*known, *found.remarks))


def _bearings(analysis: Analysis) -> Iterator[tuple[TurningJoint, str]]:
    """Every pin with a radius, with each link that it holds besides its first one."""
    for joint in analysis.motion.mechanism.pins.values():
        if joint.pin_radius:
            yield from ((joint, link) for link in joint.links[1:])
