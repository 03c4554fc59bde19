"""Steady running of a machine: motor and its power, flywheel, and the speed that results."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import ClassVar

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.singularity import Singularity
from linkwright.analysis.true_speed import steady_cycle
from linkwright.core.arguments import real, require
from linkwright.core.arrays import Floats
from linkwright.core.attached import PlotMixin
from linkwright.core.quantity import shown
from linkwright.core.table import PERCENT, Block, Numbers, Row
from linkwright.cycle.summaries import Summary
from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinetostatics.forces import Forces
from linkwright.machine.equivalent import Equivalent, steady_rate
from linkwright.machine.flywheel import ZERO_TOLERANCE, flywheel_inertia, on_faster_shaft, speed_fluctuation
from linkwright.machine.speed import SpeedCurve
from linkwright.machine.torque_curve import EnergyFluctuation
from linkwright.words import Message, Translate, _

#: What the numbers are, by the keys of their rows.
LABELS = {
    "speed": _("mean speed"),
    "mean_torque": _("mean torque"),
    "mean_power": _("mean power"),
    "motor_power": _("power of the motor, with efficiency and margin"),
    "motor_power_without_flywheel": _("power of the motor without a flywheel, at constant speed"),
    "energy_lowest": _("  lowest energy, slowest running (approximately)"),
    "energy_highest": _("  highest energy, fastest running (approximately)"),
    "inertia_smallest": _("smallest equivalent moment of inertia"),
    "inertia_largest": _("largest equivalent moment of inertia"),
    "required_fluctuation": _("required coefficient of speed fluctuation"),
    "exact_flywheel": _("flywheel for just the required coefficient, exact"),
    "shaft_flywheel": _("  the same on the flywheel's shaft"),
    "energy_fluctuation": _("energy fluctuation"),
    "flywheel": _("flywheel by the formula"),
    "slowest": _("  slowest"),
    "fastest": _("  fastest"),
}


def placed(key: str, value: float, dimension: str, at: float, label: str = "") -> Row:
    """A number with the input's angle where it is."""
    return Row(key, value, dimension, label, shown(at, "angle"), more={"at [rad]": at})


def share(key: str, value: float, label: str = "") -> Row:
    """A coefficient of speed fluctuation."""
    return Row(key, value, label=label, scale=PERCENT, digits=5)


def speeds(curve: SpeedCurve, at: Callable[[float], float], translate: Translate, before: str = "") -> list[Row]:
    """How even a speed is, and its extremes; ``before`` their keys."""
    slow, fast = curve.slowest, curve.fastest
    reached = share(f"{before}reached_fluctuation", curve.fluctuation, _("  coefficient really reached with it"))
    ends = (("slowest", slow), ("fastest", fast))
    return [
        reached,
        *(
            placed(f"{before}{key}", value, "angular_velocity", at(place), LABELS[key])
            for key, (place, value) in ends
        ),
    ]


@dataclass(frozen=True)
class SteadyRunning(PlotMixin, Numbers):
    """A machine over one cycle of steady running with a flywheel.

    ``required`` δ; ``flywheel`` J, kg·m² on the crank, by J = ΔE/(δ ω²) - mean J_e (the machine's own inertia is
    counted: its mean); ``exact_flywheel`` the J with which the true speed fluctuates by just δ; ``shaft_flywheel``
    the exact one on a shaft ``ratio`` times as fast; ``speed`` over the cycle with the approximate flywheel, so
    ``speed.fluctuation`` is what the formula really reaches; ``exact_speed`` with the exact one; ``own`` δ by the
    formula without a flywheel.
    """

    labels: ClassVar[Mapping[str, Message]] = LABELS
    digits: ClassVar[int] = 7
    equivalent: Equivalent = field(repr=False)
    energy: EnergyFluctuation = field(repr=False)
    motor: Motor
    required: float
    ratio: float
    flywheel: float
    exact_flywheel: float
    speed: SpeedCurve = field(repr=False)
    exact_speed: SpeedCurve = field(repr=False)

    @property
    def mean_torque(self) -> float:
        """Mean torque that the machine needs, N·m; negative where its loads drive it."""
        return self.motor.mean_torque

    @property
    def shaft_flywheel(self) -> float:
        """The exact flywheel on the faster shaft, kg·m²."""
        return on_faster_shaft(self.exact_flywheel, self.ratio)

    @property
    def own(self) -> float:
        """Speed fluctuation by the formula without any flywheel."""
        return speed_fluctuation(self.energy.value, self.equivalent.speed, self.equivalent.mean_inertia)

    @property
    def title(self) -> str:
        """Name of the machine."""
        return self.equivalent.forces.mechanism.name

    def blocks(self, translate: Translate) -> list[Block]:
        """The numbers: motor, energy and inertia, flywheel by the formula, exact flywheel; without a motor where the
        loads drive the machine."""
        reduced, energy, at = self.equivalent, self.energy, self.equivalent.input_at
        smallest, largest = reduced.inertia_extremes
        motor = [
            Row("speed", reduced.speed, "angular_velocity"),
            Row("mean_torque", self.mean_torque, "torque"),
            Row("mean_power", self.motor.mean_power, "power"),
            Row("motor_power", self.motor.power, "power"),
            Row("motor_power_without_flywheel", self.power_without_flywheel, "power"),
        ]
        ends = [
            placed("energy_lowest", float(np.min(energy.energy)), "energy", at(energy.low)),
            placed("energy_highest", float(np.max(energy.energy)), "energy", at(energy.high)),
        ]
        inertia = [
            placed("inertia_smallest", smallest.value, "inertia", at(smallest.place)),
            placed("inertia_largest", largest.value, "inertia", at(largest.place)),
            share("required_fluctuation", self.required),
        ]
        exact = [Row("exact_flywheel", self.exact_flywheel, "inertia")]
        if self.ratio != 1.0:
            exact.append(Row("shaft_flywheel", self.shaft_flywheel, "inertia"))
        return [
            Block("motor", "", motor if self.driven is None else motor[:3]),
            Block(
                "energy",
                "",
                [Row("energy_fluctuation", energy.value, "energy"), *(ends if energy.value else []), *inertia],
            ),
            Block("formula", "", [Row("flywheel", self.flywheel, "inertia"), *speeds(self.speed, at, translate)]),
            Block("exact", "", [*exact, *speeds(self.exact_speed, at, translate, "exact_")]),
        ]

    def columns(self) -> dict[str, Floats]:
        """Curves over the cycle, SI: torque, inertia, excess energy, speed with both flywheels."""
        reduced, energy = self.equivalent, self.energy
        return {
            "input [rad]": reduced.start + reduced.direction * energy.angle,
            "equivalent_torque [N·m]": reduced.load(energy.angle),
            "equivalent_inertia [kg·m²]": reduced.inertia_at(energy.angle),
            "excess_energy [J]": energy.energy,
            "speed_with_flywheel [rad/s]": self.speed.at(energy.angle),
            "speed_with_exact_flywheel [rad/s]": self.exact_speed.at(energy.angle),
        }

    def notes(self, language: str = "en") -> list[str]:
        """The remarks, that no flywheel is needed, and warnings of singular positions."""
        near = Singularity().evaluate(self.equivalent.forces.motion)
        found = [each.translate(language) for each in self.remarks]
        found += (
            []
            if self.exact_flywheel
            else [
                _("No flywheel is needed: the machine's own inertia keeps the speed even enough.").translate(language)
            ]
        )
        return found + [f"! {remark.text(language)}" for value in near for remark in value.warnings]

    @property
    def driven(self) -> Message | None:
        """That the loads drive the machine, as an engine's gas does, and a constant torque resists them."""
        name = self.equivalent.forces.mechanism.name
        return (
            _(
                "the loads drive {name!r}, as the gas does an engine: a constant torque against them "
                "takes up their work; of a machine that should need a drive, check the direction of "
                "the loads",
                name=name,
            )
            if self.mean_torque < 0.0
            else None
        )

    @property
    def remarks(self) -> list[Message]:
        """Remarks about the numbers: that the loads drive the machine, or what its motor depends on."""
        return [each for each in (self.driven, self.evened) if each is not None]

    @property
    def evened(self) -> Message | None:
        """That the motor of the mean power suffices only with a flywheel, or with the inertia of the machine."""
        if self.driven is not None or self.power_without_flywheel <= self.motor.power * (1.0 + ZERO_TOLERANCE):
            return None
        powers = (self.motor.power, self.power_without_flywheel)
        most, peak = (shown(each, "power") for each in powers)
        if not self.exact_flywheel:
            return _(
                "The motor of {power} is sized by the mean power: the machine's own inertia carries "
                "the peaks. To hold the speed constant it must have {peak}.",
                code="running.evened_by_itself",
                power=most,
                peak=peak,
            )
        inertia = shown(self.exact_flywheel, "inertia")
        return _(
            "The motor of {power} is sized by the mean power: it suffices only with the flywheel "
            "of {inertia}. Without a flywheel, at constant speed, it must have {peak}.",
            code="running.needs_flywheel",
            power=most,
            peak=peak,
            inertia=inertia,
        )

    @property
    def power_without_flywheel(self) -> float:
        """What the motor must have to turn the input at constant speed: margin · largest power / efficiency, W."""
        analysis = Analysis.of(self.equivalent.forces)
        kind = "max" if self.equivalent.direction > 0 else "min"
        most = analysis.part(Summary("input_torque", kind)).value
        largest = replace(self.motor, mean_power=self.equivalent.direction * most * self.equivalent.speed)
        return largest.power


def steady_running(
    forces: Forces, *, fluctuation: float, ratio: float = 1.0, efficiency: float = 1.0, margin: float = 1.0
) -> SteadyRunning:
    """Motor, flywheel and true speed of a machine driven by a constant torque, or, as an engine, held by one.

    Args:
        forces: over a closed cycle of one turning driver of constant speed.
        fluctuation: required coefficient of speed fluctuation δ.
        ratio: speed of the flywheel's shaft over the crank's.
        efficiency, margin: see :func:`~linkwright.machine.running.motor`.

    The energy fluctuation is that of the driver torque at constant speed, inertia of the links included.
    Raises LinkwrightError for δ ≤ 0, a mean torque of zero, or a cycle that is not closed.
    """
    require(forces, Forces)
    on_faster_shaft(1.0, real("ratio", ratio))
    reduced, cycle = steady_cycle(forces)
    flywheel_inertia(1.0, reduced.speed, fluctuation)
    mean = reduced.load.mean
    _require_load(mean, forces)
    energy = reduced.energy
    formula = flywheel_inertia(energy.value, reduced.speed, fluctuation, present=reduced.mean_inertia)
    exact = cycle.flywheel(fluctuation, formula)
    return SteadyRunning(
        equivalent=reduced,
        energy=energy,
        motor=motor(mean, reduced.speed, efficiency=efficiency, margin=margin),
        required=fluctuation,
        ratio=ratio,
        flywheel=formula,
        exact_flywheel=exact,
        speed=cycle.curve(formula, motor_torque=mean),
        exact_speed=cycle.curve(exact, motor_torque=mean),
    )


def require_steady(forces: Forces) -> None:
    """Raises LinkwrightError, as :func:`steady_running`, for a machine that runs unevenly or takes no work."""
    rate = steady_rate(forces.motion)
    _require_load(float(np.sign(rate) * Analysis.of(forces).part(Summary("input_torque", "mean")).value), forces)


def _require_load(mean: float, forces: Forces) -> None:
    largest = float(np.abs(forces.input_torque).max())
    if abs(mean) <= ZERO_TOLERANCE * largest or largest == 0:
        raise LinkwrightError(
            _(
                "the mean torque of {name!r} over its cycle is zero: no work is done, so there is no "
                "motor to choose and no flywheel to lay out; give the machine a load that does work "
                "over a cycle (loads: …)",
                code="running.no_work",
                name=forces.mechanism.name,
            )
        )


@dataclass(frozen=True)
class Motor:
    """``mean_torque`` N·m on the input and ``mean_power`` W there; ``power`` W that the motor must have."""

    mean_torque: float
    mean_power: float
    efficiency: float
    margin: float

    @property
    def power(self) -> float:
        """margin · mean power / efficiency, W."""
        return self.margin * self.mean_power / self.efficiency


def motor(mean_torque: float, speed: float, *, efficiency: float = 1.0, margin: float = 1.0) -> Motor:
    """Motor for a mean torque (N·m) at a speed (rad/s) of the input.

    ``efficiency`` of everything between motor and input, above 0 and up to 1; ``margin`` ≥ 1 on the power.
    Raises LinkwrightError for values out of range.
    """
    if not 0 < real("efficiency", efficiency) <= 1:
        raise RequestError(
            _(
                "the efficiency is {efficiency:g}; give a value above 0 and up to 1",
                code="running.bad_efficiency",
                efficiency=efficiency,
            )
        )
    if not real("margin", margin) >= 1:
        raise RequestError(
            _(
                "the margin on the motor's power is {margin:g}; give 1 or more",
                code="running.bad_margin",
                margin=margin,
            )
        )
    return Motor(mean_torque, mean_torque * speed, efficiency, margin)
