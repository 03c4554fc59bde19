"""Transmission angle and pressure angle: smallest over the cycle, and over each stroke."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from math import pi, radians
from typing import ClassVar

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Better, Metric, Number, Remark
from linkwright.analysis.outputs import output_link
from linkwright.core.outputs import Output
from linkwright.core.quantity import shown
from linkwright.cycle.summaries import STROKES, StrokeSummary, Summary
from linkwright.elements import Group
from linkwright.formula.trace import Scalar
from linkwright.kinetostatics.closure import dyads
from linkwright.words import _

LIMIT = radians(40)
SOURCE = "VDI 2123; Volmer, Getriebetechnik; TU Chemnitz, Getriebelexika: not below about 40°"


def low(value: float) -> tuple[Remark, ...]:
    """A warning where a transmission angle is below the recommended one."""
    if not value < LIMIT:
        return ()
    sentence = _(
        "the transmission angle falls to {value}, below the recommended {limit}",
        value=shown(value, "angle"),
        limit=shown(LIMIT, "angle"),
    )
    return (Remark("transmission_angle.low", sentence, warning=True),)


def smallest(group: Group) -> Summary:
    """The smallest transmission angle of a dyad over the cycle."""
    return Summary(f"transmission_angle {group.name}", "min")


@METRICS.register("transmission_angle")
class TransmissionAngle(Metric):
    """Smallest transmission angle of every dyad, 0 to π/2; defined in ``kinetostatics/closure.py``."""

    label = _("smallest transmission angle")
    meaning = _(
        "Acute angle between coupler and output link (rod and normal of the guide): the "
        "nearer to 90°, the better the force is passed on."
    )

    rank = 2
    dimension = "angle"
    source = SOURCE
    better: ClassVar[Better | None] = "higher"
    limit = LIMIT

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and bool(dyads(analysis.motion.structure))

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for group in dyads(analysis.motion.structure):
            yield Number(group.name, (smallest(group),))

    def remarks(self, value: float, at: float, analysis: Analysis) -> tuple[Remark, ...]:
        return low(value)


@METRICS.register("transmission_angle_of_stroke")
class TransmissionAngleOfStroke(TransmissionAngle):
    """Smallest transmission angle of a dyad on the strokes of its output from its largest value on, and back."""

    label = _("smallest transmission angle of the stroke")
    meaning = _("Smallest transmission angle while the output moves from one limit position to the next.")

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and analysis.complete and bool(_driven_dyads(analysis))

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for group, output in _driven_dyads(analysis):
            for first, last in pairwise([*analysis.limits(output)[:2], analysis.limits(output)[0]]):
                part = StrokeSummary(f"transmission_angle {group.name}", "min", output.name, STROKES[first.kind])
                yield Number(f"{group.name}: {output} {first.kind}→{last.kind}", (part,))


def _driven_dyads(analysis: Analysis) -> list[tuple[Group, Output]]:
    """Dyads with the output that they drive, where it has limit positions."""
    motion = analysis.motion
    return [
        (group, output)
        for group in dyads(motion.structure)
        for output in analysis.outputs
        if output_link(motion.mechanism, output) in group.links and len(analysis.limits(output)) >= 2
    ]


def _complement(angle: Scalar) -> Scalar:
    return 0.5 * pi - angle


@METRICS.register("pressure_angle")
class PressureAngle(Metric):
    """Largest angle between the force on the driven point of a dyad and that point's velocity: α = π/2 - μ."""

    label = _("largest pressure angle")
    meaning = _("Angle between the force on the driven point and its velocity: 90° minus the transmission angle.")

    rank = 2
    dimension = "angle"
    source = "Volmer, Getriebetechnik: α = 90° - μ, not above about 50°"
    better: ClassVar[Better | None] = "lower"
    limit = 0.5 * pi - LIMIT

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and bool(dyads(analysis.motion.structure))

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for group in dyads(analysis.motion.structure):
            yield Number(group.name, (smallest(group),), _complement)

    def remarks(self, value: float, at: float, analysis: Analysis) -> tuple[Remark, ...]:
        if not value > self.limit:
            return ()
        sentence = _(
            "the pressure angle rises to {value}, above the recommended {limit}",
            value=shown(value, "angle"),
            limit=shown(self.limit, "angle"),
        )
        return (Remark("pressure_angle.high", sentence, warning=True),)
