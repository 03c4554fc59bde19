"""Parts of design numbers that are the smallest transmission angle while an output goes one way.

``transmission_angle B on jaw.angle falling``, ``rising``: from its largest to its smallest value, and back.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import islice, pairwise
from math import pi
from typing import TYPE_CHECKING

from linkwright.metrics.summary import Summary

if TYPE_CHECKING:
    from linkwright.kinematics.cycle import Floats
    from linkwright.kinematics.motion import Motion
    from linkwright.kinetostatics.forces import Forces
    from linkwright.metrics.analysis import Analysis, Extreme

#: Kinds of these parts, by the limits with which their strokes begin.
KINDS = {"max": "falling", "min": "rising"}
WAYS = frozenset(KINDS.values())
#: No transmission angle is larger.
LARGEST = pi / 2


def signal_of(part: Summary) -> str:
    """The signal whose smallest value is sought."""
    return part.output.rpartition(" on ")[0]


def output_of(part: Summary) -> str:
    """The output that goes one way."""
    return part.output.rpartition(" on ")[2]


def of_machine(parts: Sequence[Summary], analysis: Analysis) -> list[Extreme]:
    """Such parts of one machine, each the smallest of all its strokes that way."""
    each_wanted = [_wanted(part, analysis) for part in parts]
    of = "motion" if analysis.forces is None else "forces"
    found = iter(analysis.extremes_between("min", [one for wanted in each_wanted for one in wanted], of))
    return [
        min((each for each in islice(found, len(wanted)) if each is not None), key=lambda each: each.value)
        for wanted in each_wanted
    ]


def _wanted(
    part: Summary, analysis: Analysis
) -> list[tuple[Callable[[Motion | Forces], Floats], tuple[float, float]]]:
    """The signal with the beginning and the end, s, of every stroke that way."""
    output = analysis.output(output_of(part))
    assert output is not None
    limits, period = analysis.limits(output), analysis.motion.positions.period or 0.0
    signal = analysis.signal(signal_of(part))
    return [
        (signal, (first.time, last.time + (0.0 if last.time > first.time else period)))
        for first, last in pairwise([*limits, limits[0]])
        if KINDS[first.kind] == part.kind
    ]
