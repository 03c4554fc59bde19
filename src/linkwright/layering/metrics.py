"""The numbers of layers and of the smallest gap in one, as metrics of a machine."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf, isfinite

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import Metric, MetricValue, Remark
from linkwright.layering.arrangement import Layers
from linkwright.layering.layers_of import layers
from linkwright.words import _


def layer_count(metric: Metric, analysis: Analysis) -> Iterator[MetricValue]:
    """The fewest layers of a machine; raises LinkwrightError where shapes cannot be made."""
    found = layers(analysis.motion.mechanism)
    count = inf if found.conflicts else found.count
    yield metric.value(analysis, found.mechanism.name, count, remarks=_remarks(found))


def smallest_gap(metric: Metric, analysis: Analysis) -> Iterator[MetricValue]:
    """The smallest gap in one layer; none where nothing shares one. Raises LinkwrightError where shapes cannot be
    made."""
    found = layers(analysis.motion.mechanism)
    if (nearest := found.nearest) is None:
        return
    one, other, gap = nearest
    at = gap.input if isfinite(gap.input) else None
    place = (gap.place.real, gap.place.imag)
    yield metric.value(analysis, f"{one}–{other}", gap.size, at=at, place=place, remarks=_remarks(found))


def _remarks(found: Layers) -> tuple[Remark, ...]:
    if not found.conflicts:
        return ()
    reason = found.conflicts[0].sentence
    return (Remark("layers.none", _("no layers without a collision: {reason}", reason=reason), warning=True),)
