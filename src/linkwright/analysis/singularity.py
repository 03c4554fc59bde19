"""Closeness to a singular position."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import ClassVar

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Better, Metric, MetricValue, Number, Remark
from linkwright.core.quantity import shown
from linkwright.cycle.summaries import Summary
from linkwright.elements import Group
from linkwright.kinetostatics.closure import closable
from linkwright.words import _

#: Below this a dyad is nearer than 10° to a dead point.
NEAR = 0.17


@METRICS.register("singularity")
class Singularity(Metric):
    """Smallest determinant of a group's closure equations with unit columns: 0 singular, 1 best; sin μ of a dyad.

    A larger group has its limit lowered to the power of half its equations.
    """

    label = _("distance from a singular position")
    meaning = _("Smallest determinant of a group's closure equations, 1 at best, 0 where the group is singular.")

    dimension = "dimensionless"
    source = "determinant of the closure Jacobian; Gosselin and Angeles, IEEE Trans. Robotics 6(3), 1990"
    better: ClassVar[Better | None] = "higher"
    limit = NEAR

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and bool(closable(analysis.motion.structure))

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for group in closable(analysis.motion.structure):
            yield Number(group.name, (Summary(f"conditioning {group.name}", "min"),))

    @staticmethod
    def throughout(analysis: Analysis) -> Iterator[tuple[Group, float, float]]:
        """The groups that are near a singular position all the time, with their best value and its limit."""
        for group in closable(analysis.motion.structure):
            best = analysis.part(Summary(f"conditioning {group.name}", "max")).value
            limit = NEAR ** len(group.cuts)
            if best < limit:
                yield group, best, limit

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for found, group in zip(super().values(analysis), closable(analysis.motion.structure), strict=False):
            limit = NEAR ** len(group.cuts)
            if found.value >= limit:
                yield replace(found, limit=limit)
                continue
            at = shown(found.at if found.at is not None else float("nan"), analysis.input_dimension)
            remark = Remark(
                "singularity.near",
                _(
                    "group {group} passes close to a singular position at {at}: forces grow very large there",
                    group=group.name,
                    at=at,
                ),
                warning=True,
            )
            yield replace(found, limit=limit, remarks=(remark,))
