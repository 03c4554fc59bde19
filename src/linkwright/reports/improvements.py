"""The one link length that would improve a design number most, from exact derivatives."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.analysis.base import METRICS, MetricValue
from linkwright.analysis.table import MetricsTable
from linkwright.errors import LinkwrightError
from linkwright.kinematics.motion import Motion
from linkwright.mechanism.mechanism import Mechanism
from linkwright.plotting.diagrams.source import main_output

#: Numbers whose recommended limits say how a machine passes on forces: the first that is exceeded is examined.
JUDGED = ("transmission_angle", "pressure_angle", "singularity")
#: What a driver must supply.
EFFORT = "peak_input_torque"
#: Percent per percent: a smaller change is none, a larger one is beyond what a first order can tell.
MIN_PERCENT, MOST = 0.02, 50.0
#: Links of machines of which the derivatives of forces cost no more than the rest of a report.
FEW = 8
#: To this share the value that has derivatives is the one in the table, not that of another subject.
SAME = 1e-6


@dataclass(frozen=True)
class Improvement:
    """A link length that, one percent ``longer`` or shorter, brings the design number ``row`` to about ``better``;
    the travel of ``output`` then changes by ``side_effect`` percent."""

    row: MetricValue
    dimension: str
    longer: bool
    better: float
    output: str
    side_effect: float


def broken(row: MetricValue) -> bool:
    """Whether a value is beyond its recommended limit."""
    if row.limit is None:
        return False
    return row.value < row.limit if METRICS[row.metric].better == "higher" else row.value > row.limit


def improvements(motion: Motion, metrics: MetricsTable) -> list[Improvement]:
    """For the first number of force transmission that does not keep its limit, and for the peak of what an only
    driver supplies; none where there are no derivatives, or where they help little."""
    mechanism, output = motion.mechanism, main_output(motion)
    rows = [row for row in (_transmission(metrics), _effort(metrics, len(mechanism.links))) if row is not None]
    lengths = [name for name in mechanism.dimensions() if name.endswith(".length") or ".lengths." in name]
    if not rows or not lengths or output.is_point:
        return []
    travel = f"{output.name} range"
    slopes = _slopes(mechanism, [row.metric for row in rows], travel, lengths)
    found = (_improved(row, lengths, slopes, str(output), travel) for row in rows if row.metric in slopes)
    return [each for each in found if each is not None]


def _transmission(metrics: MetricsTable) -> MetricValue | None:
    """The worst value of the first number that does not keep its limit."""
    for name in JUDGED:
        rows = [row for row in metrics if row.metric == name and broken(row)]
        if rows:
            sign = 1.0 if METRICS[name].better == "higher" else -1.0
            return min(rows, key=lambda row: sign * row.value)
    return None


def _effort(metrics: MetricsTable, links: int) -> MetricValue | None:
    rows = [row for row in metrics if row.metric == EFFORT]
    return rows[0] if len(rows) == 1 and links <= FEW else None


#: Value of a number, and percent by which it changes per percent of each length.
Slopes = dict[str, tuple[float, Sequence[float]]]


def _slopes(mechanism: Mechanism, names: Sequence[str], travel: str, lengths: Sequence[str]) -> Slopes:
    """Of all numbers that have derivatives; together where that goes, for they share a program."""
    from linkwright.designs.sensitivity import sensitivity

    found: Slopes = {}
    for asked in _tries([*names, travel]):
        try:
            result = sensitivity(mechanism, of=asked, by=lengths)
            found |= {name: (result.value(name), result.relative(name).tolist()) for name in asked}
        except LinkwrightError:
            continue
        if len(asked) > 1:
            break
    return found


def _tries(names: Sequence[str]) -> Iterator[Sequence[str]]:
    """All names together, then each alone."""
    yield names
    yield from ([name] for name in names)


def _improved(
    row: MetricValue, lengths: Sequence[str], slopes: Slopes, output: str, travel: str
) -> Improvement | None:
    """The length with most influence; None where none helps, or what it does to the travel is not known."""
    value, changes = slopes[row.metric]
    if not abs(value - row.value) <= SAME * abs(row.value) or not np.isfinite(changes).any():
        return None
    best = int(np.nanargmax(np.abs(changes)))
    slope, side = changes[best], slopes[travel][1][best] if travel in slopes else math.nan
    if not MIN_PERCENT <= abs(slope) <= MOST or not math.isfinite(side):
        return None
    sign = 1.0 if METRICS[row.metric].better == "higher" else -1.0
    longer = sign * slope * row.value > 0.0
    better = row.value + sign * 0.01 * abs(slope * row.value)
    return Improvement(row, lengths[best], longer, better, output, side if longer else -side)
