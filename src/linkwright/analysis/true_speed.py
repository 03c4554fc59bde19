"""Summaries of the true speed over the cycle, and their values for one machine."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from linkwright.analysis.analysis import Analysis, finds
from linkwright.cycle.summaries import Summary, SummaryValue
from linkwright.kinetostatics.forces import Forces
from linkwright.machine.equivalent import Equivalent, equivalent
from linkwright.machine.flywheel import flywheel_inertia
from linkwright.machine.speed import SteadyCycle

#: The outputs that the true speed follows from.
EFFORT, INERTIA = "input_torque", "equivalent_inertia"


@dataclass(frozen=True)
class TrueSpeedSummary(Summary):
    """``fastest``, ``slowest`` (rad/s) or ``fluctuation`` of the true speed with the inertia that the machine has;
    with a coefficient ``required`` also with the flywheel that the formula gives for it, or the ``size`` of the
    flywheel with which the true speed fluctuates by just that."""

    of_cycle: ClassVar[bool] = False
    required: float | None = None

    @property
    def name(self) -> str:
        """Its name among others: ``true speed fluctuation with 0.02``."""
        return super().name if self.required is None else f"{super().name} with {self.required!r}"


@finds(TrueSpeedSummary)
def of_machine(part: TrueSpeedSummary, analysis: Analysis) -> SummaryValue:
    """Such a part of one machine; raises LinkwrightError where it would stop, or does not run steadily."""
    assert analysis.forces is not None
    reduced, cycle = steady_cycle(analysis.forces)
    size, fluctuation, nan = 0.0, part.required, float("nan")
    if fluctuation is not None:
        energy, own = reduced.energy.value, reduced.mean_inertia
        size = flywheel_inertia(energy, reduced.speed, fluctuation, present=own)
        if part.kind == "size":
            return SummaryValue(cycle.flywheel(fluctuation, size), nan, nan, True)
    if part.kind == "fluctuation":
        return SummaryValue(cycle.fluctuation(size), nan, nan, True)
    place, value = getattr(cycle.curve(size, motor_torque=reduced.load.mean), part.kind)
    return SummaryValue(value, nan, reduced.input_at(place), True)


def steady_cycle(forces: Forces) -> tuple[Equivalent, SteadyCycle]:
    """The machine reduced to its input, and its cycles of steady running, found once; raises as ``equivalent``."""
    cached = Analysis.of(forces).cached
    if ("running", "") not in cached:
        reduced = equivalent(forces)
        cached["running", ""] = reduced, SteadyCycle(reduced.work, reduced.inertia_at, reduced.speed)
    found: tuple[Equivalent, SteadyCycle] = cached["running", ""]
    return found
