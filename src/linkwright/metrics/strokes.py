"""Parts of design numbers that are the smallest transmission angle while an output goes one way.

``transmission_angle B on jaw.angle falling``, ``rising``: from its largest to its smallest value, and back.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

from linkwright.metrics.summary import Summary

if TYPE_CHECKING:
    from linkwright.metrics.analysis import Analysis, Extreme

#: Kinds of these parts, by the limits with which their strokes begin.
KINDS = {"max": "falling", "min": "rising"}
WAYS = frozenset(KINDS.values())


def signal_of(part: Summary) -> str:
    """The signal whose smallest value is sought."""
    return part.output.rpartition(" on ")[0]


def output_of(part: Summary) -> str:
    """The output that goes one way."""
    return part.output.rpartition(" on ")[2]


def of_machine(parts: Sequence[Summary], analysis: Analysis) -> list[Extreme]:
    """Such parts of one machine, each the smallest of all its strokes that way: of the stroke in which it lies the
    smallest of the cycle."""
    found: dict[tuple[Summary, int], Extreme | None] = {}
    period, sought = analysis.motion.positions.period or 0.0, []
    for part in parts:
        lowest = analysis.part(f"{signal_of(part)} min")
        for k, (start, end) in enumerate(_strokes(part, analysis, period)):
            found[part, k] = lowest
            if not lowest.exact or not any(start <= lowest.time + lap <= end for lap in (0.0, period)):
                sought.append(((part, k), (analysis.signal(signal_of(part)), (start, end))))
    of = "motion" if analysis.forces is None else "forces"
    smallest = analysis.extremes_between("min", [wanted for _, wanted in sought], of)
    found |= zip((key for key, _ in sought), smallest, strict=True)
    return [
        min((one for (each, _), one in found.items() if each == part and one), key=lambda one: one.value)
        for part in parts
    ]


def _strokes(part: Summary, analysis: Analysis, period: float) -> list[tuple[float, float]]:
    """The beginning and the end, s, of every stroke that way."""
    output = analysis.output(output_of(part))
    assert output is not None
    limits = analysis.limits(output)
    return [
        (first.time, last.time + (0.0 if last.time > first.time else period))
        for first, last in pairwise([*limits, limits[0]])
        if KINDS[first.kind] == part.kind
    ]
