"""Shaking force and moment on the frame."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Better, Metric, Number
from linkwright.cycle.summaries import Summary
from linkwright.formula.trace import Scalar, sqrt
from linkwright.kinematics.names import HARMONIC
from linkwright.kinetostatics.load_site import turns_steadily
from linkwright.words import _


class Shaking(Metric):
    """What the inertia of the moving links puts on the frame."""

    source = "Norton, Design of Machinery, ch. 11: minus the sum of m a_G, and its moment"
    better: ClassVar[Better | None] = "lower"
    needs_forces = True
    rank = 5
    summary: ClassVar[Summary]

    def suits(self, analysis: Analysis) -> bool:
        links = analysis.motion.mechanism.links.values()
        return super().suits(analysis) and any(link.mass or link.inertia for link in links)

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        yield Number("frame", (self.summary,))


@METRICS.register("peak_shaking_force")
class PeakShakingForce(Shaking):
    """Largest resultant of the inertia forces on the frame, N."""

    label = _("peak shaking force")
    meaning = _("Largest resultant of the inertia forces of the moving links on the frame.")

    dimension = "force"
    summary = Summary("shaking_force", "max")


@METRICS.register("peak_shaking_moment")
class PeakShakingMoment(Shaking):
    """Largest moment of the inertia forces about the frame's origin, N·m."""

    label = _("peak shaking moment")
    meaning = _("Largest moment of the inertia forces about the frame's origin.")

    dimension = "torque"
    summary = Summary("shaking_moment", "peak")


class ShakingHarmonic(Shaking):
    """What goes round once and twice in a turn of the input, as balancing takes it away."""

    source = "Norton, Design of Machinery, ch. 13: primary and secondary forces; Dresig, Holzweißig, ch. 2"
    on_request = True
    orders: ClassVar[tuple[int, ...]] = (1, 2)

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and analysis.closed and turns_steadily(analysis.motion.mechanism)


@METRICS.register("shaking_force_harmonic")
class ShakingForceHarmonic(ShakingHarmonic):
    """Largest force of one order of the shaking force, N: the longer half axis of the ellipse that it goes round."""

    label = _("shaking force harmonic")
    meaning = _("Largest primary (1×) and secondary (2×) inertia force on the frame.")

    dimension = "force"

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for order in self.orders:
            outputs = (f"{wave} shaking_force.{axis} {order}" for axis in "xy" for wave in HARMONIC)
            yield Number(f"{order}×", tuple(Summary(each, "mean") for each in outputs), _longer_half_axis)


@METRICS.register("shaking_moment_harmonic")
class ShakingMomentHarmonic(ShakingHarmonic):
    """Amplitude of one order of the shaking moment, N·m."""

    label = _("shaking moment harmonic")
    meaning = _("Amplitude of the primary (1×) and secondary (2×) shaking moment.")

    dimension = "torque"

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for order in self.orders:
            waves = (Summary(f"{wave} shaking_moment {order}", "mean") for wave in HARMONIC)
            yield Number(f"{order}×", tuple(waves), lambda a, b: 2.0 * sqrt(a * a + b * b))


def _longer_half_axis(a: Scalar, b: Scalar, c: Scalar, d: Scalar) -> Scalar:
    """Of x = 2 (a cos φ + b sin φ), y = 2 (c cos φ + d sin φ): the sum of what turns either way."""
    with_it = sqrt((a + d) * (a + d) + (c - b) * (c - b))
    against = sqrt((a - d) * (a - d) + (c + b) * (c + b))
    return with_it + against
