"""Joint reactions: peak and root mean square."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import ClassVar

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Better, Metric, Number
from linkwright.core.arrays import Floats
from linkwright.cycle.summaries import Summary
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
