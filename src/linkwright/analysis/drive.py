"""Metrics of a machine with its actuators: margin of starting, run-up time, braking time."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

from linkwright.actuators.motor import Motor
from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Better, Metric, MetricValue
from linkwright.dynamics.verdicts.braking import Braking, braking
from linkwright.dynamics.verdicts.drive_margin import DriveMargin, drive_margin
from linkwright.dynamics.verdicts.motor_duty import MotorDuty, motor_duty
from linkwright.errors import LinkwrightError
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

#: Positions over the cycle.
STEPS = 120


class DriveMetric(Metric):
    """A number of a machine with one driver and its actuators, found in a way of its own."""

    on_request = True
    rank = 9
    own_values: ClassVar[bool] = True

    def suits(self, analysis: Analysis) -> bool:
        mechanism = analysis.motion.mechanism
        return super().suits(analysis) and len(mechanism.drivers) == 1 and self.has(mechanism)

    def obstacle(self, analysis: Analysis) -> str | None:
        found = self._found(analysis)
        return found.sentence if isinstance(found, LinkwrightError) else None

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        found = self._found(analysis)
        if isinstance(found, LinkwrightError):
            raise found
        value, at = self.measured(found)
        yield self.value(analysis, next(iter(analysis.motion.mechanism.drivers)), value, at=at)

    def _found(self, analysis: Analysis) -> Any:
        """What is found of the machine, or why there is none; once for all metrics that ask the same."""
        key = ("drive", self.verdict.__qualname__)
        if key not in analysis.cached:
            analysis.cached[key] = _tried(self.verdict, analysis.motion.mechanism)
        return analysis.cached[key]

    @abstractmethod
    def has(self, mechanism: Mechanism) -> bool:
        """Whether a machine has what the number is about."""

    @abstractmethod
    def verdict(self, mechanism: Mechanism) -> Any:
        """The verdict that the number is part of."""

    @abstractmethod
    def measured(self, found: Any) -> tuple[float, float | None]:
        """Value, SI, and the input where it is."""


def _tried(verdict: Callable[[Mechanism], Any], mechanism: Mechanism) -> Any:
    try:
        return verdict(mechanism)
    except LinkwrightError as error:
        return error


@METRICS.register("starting_margin")
class StartingMargin(DriveMetric):
    """Least ratio over the cycle of the torque that the actuators have at rest to the torque needed to start."""

    label = _("starting margin")
    meaning = _("Least ratio of available to needed torque at rest; below 1 the machine does not start everywhere.")

    dimension = "dimensionless"
    better: ClassVar[Better | None] = "higher"
    limit = 1.0
    source = "statics at the verge of motion, friction against it; see drive_margin"

    def has(self, mechanism: Mechanism) -> bool:
        return any(each.drives for each in mechanism.actuators.values())

    def verdict(self, mechanism: Mechanism) -> DriveMargin:
        return drive_margin(mechanism, steps=STEPS)

    def measured(self, found: DriveMargin) -> tuple[float, float | None]:
        return found.starting_margin, float(found.worst.input[0])


@METRICS.register("run_up_time")
class RunUpTime(DriveMetric):
    """Time from rest to 95 % of the mean steady speed under the machine's motor, s."""

    label = _("run-up time")
    meaning = _("Time from rest to 95 % of the mean speed of steady running under the machine's own motor.")

    dimension = "time"
    better: ClassVar[Better | None] = "lower"
    source = "equation of motion under the curve of the motor; see motor_duty"

    def has(self, mechanism: Mechanism) -> bool:
        return sum(isinstance(each, Motor) for each in mechanism.actuators.values()) == 1

    def verdict(self, mechanism: Mechanism) -> MotorDuty:
        return motor_duty(mechanism, by="run", steps=STEPS)

    def measured(self, found: MotorDuty) -> tuple[float, float | None]:
        assert found.run_up is not None
        return found.run_up, None


class BrakingMetric(DriveMetric):
    """A number of the braking from the driver's speed by the machine's own brakes."""

    better: ClassVar[Better | None] = "lower"
    source = "equation of motion with the motors off; see braking"

    def has(self, mechanism: Mechanism) -> bool:
        return any(each.brakes for each in mechanism.actuators.values())

    def verdict(self, mechanism: Mechanism) -> Braking:
        return braking(mechanism)


@METRICS.register("braking_time")
class BrakingTime(BrakingMetric):
    """Longest time over the cycle until the machine rests that is switched off and braked, s."""

    label = _("braking time")
    meaning = _("Longest time until the machine rests, switched off at its speed and braked by its brakes.")

    dimension = "time"

    def measured(self, found: Braking) -> tuple[float, float | None]:
        return found.longest, float(found.begin[int(found.time.argmax())])


@METRICS.register("braking_angle")
class BrakingAngle(BrakingMetric):
    """Largest angle that the driver turns until the machine rests that is switched off and braked, rad."""

    label = _("braking angle")
    meaning = _("Largest angle that the driver turns until the machine rests, switched off and braked by its brakes.")

    dimension = "angle"

    def has(self, mechanism: Mechanism) -> bool:
        return super().has(mechanism) and next(iter(mechanism.drivers.values())).law.rotary

    def measured(self, found: Braking) -> tuple[float, float | None]:
        return found.farthest, float(found.begin[int(found.way.argmax())])
