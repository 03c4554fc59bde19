"""Static balance: what holds a machine still over its cycle, as a hand holds a lid or a lamp."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from linkwright.analysis.base import METRICS
from linkwright.analysis.effort import EffortMetric
from linkwright.words import Message, _


class HoldingMetric(EffortMetric):
    """Effort of every driver that holds the machine still, at zero speed and without friction of joints, by one
    ``kind`` of summary over the cycle."""

    source = "statics: effort of the driver from the joint forces at zero speed"
    on_request = True
    output: ClassVar[str] = "holding_effort"


@METRICS.register("holding_torque")
class HoldingTorque(HoldingMetric):
    """Largest size of the effort that holds the machine still: zero of one that is balanced everywhere."""

    label = _("holding torque")
    labels: ClassVar[Mapping[str, Message]] = {"force": _("holding force")}
    meaning = _("Largest torque (force) that holds the machine still in a position; zero where it is balanced.")

    kind = "peak"


@METRICS.register("rms_holding_torque")
class RmsHoldingTorque(HoldingMetric):
    """Root mean square over the cycle of the effort that holds the machine still: how well it is balanced."""

    label = _("RMS holding torque")
    labels: ClassVar[Mapping[str, Message]] = {"force": _("RMS holding force")}
    meaning = _("Root mean square over the cycle of what holds the machine still: how well it is balanced.")

    kind = "rms"
