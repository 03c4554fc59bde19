"""Limit positions, where an output reverses; quick-return ratio, and the crank angle between them."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from math import pi
from typing import ClassVar

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Metric, MetricValue, Number
from linkwright.applied_loads.signals import Limit
from linkwright.core.outputs import Output
from linkwright.cycle.summaries import Summary, SummaryValue
from linkwright.formula.trace import Scalar, floor, maximum
from linkwright.words import _

#: Digits of rad or m behind which values are the same.
DIGITS = 11


@METRICS.register("limit_position")
class LimitPosition(Metric):
    """Every position in which an output reverses: its angle or displacement there, and the input.

    For each output those with the largest values first; without a subject the first of all is meant.
    """

    label = _("limit position")
    meaning = _("Angle or displacement at which an output reverses, and the input there.")

    dimension = "angle"
    source = "IFToMM terminology: the output's velocity is zero"
    own_values = True

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and any(analysis.limits(output) for output in analysis.outputs)

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        """The outermost ones of a closed cycle."""
        for output, kind, passed_over in outermost_limits(analysis):
            value = Summary(output.name, kind)
            yield Number(f"{output} {kind}", (value,), dimension=output.dimension, passed_over=passed_over)

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for output in analysis.outputs:
            for limit in sorted(analysis.limits(output), key=_from_the_largest):
                yield self.value(
                    analysis, f"{output} {limit.kind}", limit.value, dimension=output.dimension, at=limit.input
                )


def _from_the_largest(limit: Limit) -> tuple[bool, float]:
    """Puts largest values first, the outermost one before the others, then smallest ones in the same way."""
    value = round(limit.value, DIGITS)
    return (False, -value) if limit.kind == "max" else (True, value)


def outermost_limits(analysis: Analysis) -> Iterator[tuple[Output, str, tuple[Output, ...]]]:
    """Outputs with limits in a closed cycle and the kinds of these, ``max`` first, which is the same in all designs;
    with them the outputs before that reverse nowhere."""
    never: list[Output] = []
    for output in analysis.outputs if analysis.complete else ():
        kinds = {limit.kind for limit in analysis.limits(output)}
        if not kinds:
            never.append(output)
        yield from ((output, kind, tuple(never)) for kind in ("max", "min") if kind in kinds)


@METRICS.register("quick_return_ratio")
class QuickReturnRatio(Metric):
    """K = time of the slow stroke / time of the fast one = (π + θ)/(π - θ) ≥ 1 at uniform crank speed."""

    label = _("quick-return ratio")
    meaning = _("Time of the slow stroke over time of the fast stroke at uniform input speed.")

    rank = 1
    dimension = "dimensionless"
    source = "IFToMM terminology, time ratio; Norton, Design of Machinery, ch. 3"
    angle: ClassVar[bool] = False

    def suits(self, analysis: Analysis) -> bool:
        steady = analysis.complete and bool(np.ptp(analysis.input_rate) <= 1e-9 * abs(analysis.input_rate[0]))
        return super().suits(analysis) and steady and bool(_returning(analysis))

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        cycle = float(analysis.input_rate[0]) * (analysis.motion.positions.period or 0.0)
        formula, begin = partial(_angle if self.angle else _ratio, abs(cycle)), partial(_begin, cycle)
        for output in _returning(analysis):
            parts = tuple(Summary(output.name, kind) for kind in ("argmax", "argmin"))
            yield Number(str(output), parts, formula, at=begin)


@METRICS.register("crank_angle_between_limits")
class CrankAngleBetweenLimits(QuickReturnRatio):
    """Acute angle θ between the crank's directions in the limit positions: π (K - 1)/(K + 1)."""

    label = _("crank angle between limits")
    meaning = _("Acute angle between the crank's directions in the two limit positions.")

    dimension = "angle"
    angle = True


def _returning(analysis: Analysis) -> tuple[Output, ...]:
    """The outputs with two outermost positions in a closed cycle."""
    if analysis.motion.positions.period is None:
        return ()
    ends = {output: [each.kind for each in analysis.outermost(output)] for output in analysis.outputs}
    return tuple(output for output, kinds in ends.items() if sorted(kinds) == ["max", "min"])


def _slow(cycle: float, first: Scalar, last: Scalar) -> Scalar:
    """Share of the slow stroke in the way of the input through the cycle."""
    share = (last - first) / cycle
    share = share - floor(share)
    return maximum(share, 1.0 - share)


def _ratio(cycle: float, first: Scalar, last: Scalar) -> Scalar:
    slow = _slow(cycle, first, last)
    return slow / (1.0 - slow)


def _angle(cycle: float, first: Scalar, last: Scalar) -> Scalar:
    return pi * (2.0 * _slow(cycle, first, last) - 1.0)


def _begin(cycle: float, first: SummaryValue, last: SummaryValue) -> float:
    """Where the slow stroke begins."""
    return first.input if ((last.input - first.input) / cycle) % 1.0 >= 0.5 else last.input
