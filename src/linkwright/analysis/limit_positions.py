"""Limit positions: where an output reverses."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Metric, MetricValue, Number
from linkwright.applied_loads.signals import Limit
from linkwright.core.outputs import Output
from linkwright.cycle.summaries import Summary
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
