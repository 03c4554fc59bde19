"""How many layers a machine needs, and the smallest gap in one of them; by the room of layers."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Better, Metric, MetricValue
from linkwright.core.attached import attached
from linkwright.words import _


@METRICS.register("layers")
class LayerCount(Metric):
    """The fewest layers above the frame's in which nothing collides over the cycle; infinite where there are none."""

    label = _("fewest layers")
    meaning = _("The fewest layers above that of the frame in which nothing collides over the cycle.")

    dimension = "dimensionless"
    source = "smallest gaps over the cycle; integer programming"
    better: ClassVar[Better | None] = "lower"
    on_request = True

    @attached
    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        """One value; raises LinkwrightError where shapes cannot be made."""
        raise NotImplementedError


@METRICS.register("min_gap")
class MinGap(Metric):
    """The smallest gap over the cycle between what lies in one layer, m, in the layers that the file fixes, else in
    the fewest; 0 or less where there are no layers without a collision."""

    label = _("smallest gap")
    meaning = _("The smallest gap over the cycle between what lies in one layer, in the fewest layers.")

    dimension = "length"
    source = "distances of outlines, exact between positions"
    better: ClassVar[Better | None] = "higher"
    on_request = True

    @attached
    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        """One value, of the two that come nearest; raises LinkwrightError where shapes cannot be made."""
        raise NotImplementedError
