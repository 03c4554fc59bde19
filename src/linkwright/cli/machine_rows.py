"""What ``machine`` finds, as rows of numbers."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from linkwright.cli.machine_options import Wanted
from linkwright.core.dataclass import dataclass
from linkwright.core.quantity import number, shown, shown_unit
from linkwright.errors import LinkwrightError
from linkwright.machine.energy import EnergyFluctuation, energy_fluctuation
from linkwright.machine.flywheel import flywheel_inertia, on_faster_shaft, speed_fluctuation
from linkwright.machine.motor import motor
from linkwright.machine.speed import SpeedCurve, true_speed
from linkwright.machine.torque_curve import TorqueCurve
from linkwright.units import si_unit
from linkwright.words import Say

if TYPE_CHECKING:
    from linkwright.machine.running import SteadyRunning

#: Digits that the table shows.
DIGITS = 7
#: A mean torque below this share of the largest one is zero.
NOTHING = 1e-9


@dataclass(frozen=True)
class Row:
    """One number: ``key`` in the catalogue ``machine``, SI ``value``; ``at``: the input's angle, rad, or the number
    of an area (``after``)."""

    key: str
    value: float
    dimension: str
    at: float | None = None
    after: int | None = None

    def cells(self, say: Say) -> list[str]:
        """Label, value, unit, place."""
        place = "" if self.at is None else shown(self.at, "angle")
        if self.after is not None:
            place = say("machine.after_area", number=self.after) if self.after else say("machine.at_begin")
        label = say(f"machine.{self.key}")
        if self.dimension == "fluctuation":
            return [label, f"{100 * self.value:.5g}", "%", place]
        return [label, number(self.value, self.dimension, DIGITS), shown_unit(self.dimension), place]

    def data(self) -> dict[str, Any]:
        """Plain data, SI."""
        unit = "" if self.dimension == "fluctuation" else si_unit(self.dimension)
        found: dict[str, Any] = {"value": self.value, "unit": unit}
        if self.at is not None:
            found["at [rad]"] = self.at
        return found if self.after is None else {**found, "after_area": self.after}


def of_running(running: SteadyRunning, wanted: Wanted) -> list[list[Row]]:
    """Rows of a mechanism: motor, energy and inertia, flywheel by the formula, exact flywheel, its dimensions."""
    reduced, energy, motor_found = running.equivalent, running.energy, running.motor
    (least, most), at = reduced.inertia_extremes, reduced.input_at
    first = [
        Row("speed", reduced.speed, "angular_velocity"),
        Row("mean_torque", running.mean_torque, "torque"),
        Row("mean_power", motor_found.mean_power, "power"),
    ]
    if running.driven is None:
        first.append(Row("motor_power", motor_found.power, "power"))
        first.append(Row("motor_power_without_flywheel", running.power_without_flywheel, "power"))
    second = [
        Row("energy_fluctuation", energy.value, "energy"),
        *(
            []
            if not energy.value
            else [
                Row("energy_lowest", float(np.min(energy.energy)), "energy", at(energy.low)),
                Row("energy_highest", float(np.max(energy.energy)), "energy", at(energy.high)),
            ]
        ),
        Row("inertia_smallest", least.value, "inertia", at(least.place)),
        Row("inertia_largest", most.value, "inertia", at(most.place)),
        Row("required_fluctuation", running.required, "fluctuation"),
    ]
    third = [Row("flywheel", running.flywheel, "inertia"), *_speeds(running.speed, at)]
    fourth = [Row("exact_flywheel", running.exact_flywheel, "inertia")]
    fourth += _on_shaft(running.exact_flywheel, wanted)
    fourth += _speeds(running.exact_speed, at)
    return [first, second, third, fourth, _dimensions(running.exact_flywheel, reduced.speed, wanted)]


def of_areas(energy: EnergyFluctuation, wanted: Wanted) -> list[list[Row]]:
    """Rows of areas between torque curve and mean line."""
    first = [
        Row("energy_fluctuation", energy.value, "energy"),
        Row("energy_lowest", float(energy.energy.min()), "energy", after=int(energy.low)),
        Row("energy_highest", float(energy.energy.max()), "energy", after=int(energy.high)),
    ]
    flywheel, rows = _by_formula(energy.value, wanted)
    total = wanted.inertia + flywheel
    if total and wanted.speed:
        rows.append(
            Row("formula_fluctuation", speed_fluctuation(energy.value, wanted.speed, total), "fluctuation")
        )
    return [first, rows, _dimensions(flywheel, wanted.speed or 0.0, wanted)]


def of_curves(driver: TorqueCurve, load: TorqueCurve | None, wanted: Wanted, say: Say) -> list[list[Row]]:
    """Rows of a driving torque against a load; raises LinkwrightError for a mean torque of zero."""
    mean = driver.mean
    (_, lowest), (_, highest) = driver.extremes()
    if abs(mean) <= NOTHING * max(abs(lowest), abs(highest)) or mean < 0:
        shown_mean = shown(mean, "torque") if mean < -NOTHING * abs(lowest) else "0 N·m"
        raise LinkwrightError("machine.no_mean_torque", mean=shown_mean)
    resisting = TorqueCurve.constant(mean, period=driver.period) if load is None else load
    energy = energy_fluctuation(driver, resisting).without_rounding(mean * driver.period)
    first = [Row("mean_torque", mean, "torque")]
    if wanted.speed:
        found = motor(mean, wanted.speed, efficiency=wanted.efficiency, margin=wanted.margin)
        first.append(Row("mean_power", found.mean_power, "power"))
        if found.power != found.mean_power:
            first.append(Row("motor_power", found.power, "power"))
        if load is not None and highest - lowest <= NOTHING * highest:
            alone = motor(
                load.extremes()[1][1], wanted.speed, efficiency=wanted.efficiency, margin=wanted.margin
            )
            first.append(Row("motor_power_without_flywheel", alone.power, "power"))
    second = [
        Row("energy_fluctuation", energy.value, "energy"),
        Row("energy_lowest", float(energy.energy.min()), "energy", energy.low),
        Row("energy_highest", float(energy.energy.max()), "energy", energy.high),
    ]
    flywheel, third = _by_formula(energy.value, wanted)
    total = wanted.inertia + flywheel
    if total and wanted.speed:
        third.append(
            Row("formula_fluctuation", speed_fluctuation(energy.value, wanted.speed, total), "fluctuation")
        )
        third += _speeds(true_speed(resisting, total, wanted.speed, driver=driver), lambda angle: angle)
        third += _accelerations(driver.minus(resisting), total)
    return [first, second, third, _dimensions(flywheel, wanted.speed or 0.0, wanted)]


def _by_formula(energy: float, wanted: Wanted) -> tuple[float, list[Row]]:
    """Flywheel that is needed beside what is there, 0 where none is asked for."""
    rows = [Row("inertia", wanted.inertia, "inertia")] if wanted.inertia else []
    if wanted.fluctuation is None or not wanted.speed:
        return 0.0, rows
    needed = flywheel_inertia(energy, wanted.speed, wanted.fluctuation, present=wanted.inertia)
    rows += [
        Row("required_fluctuation", wanted.fluctuation, "fluctuation"),
        Row("flywheel", needed, "inertia"),
    ]
    return needed, rows + _on_shaft(needed, wanted)


def _speeds(curve: SpeedCurve, at: Callable[[float], float]) -> list[Row]:
    return [
        Row("reached_fluctuation", curve.fluctuation, "fluctuation"),
        Row("slowest", curve.slowest[1], "angular_velocity", at(curve.slowest[0])),
        Row("fastest", curve.fastest[1], "angular_velocity", at(curve.fastest[0])),
    ]


def _accelerations(excess: TorqueCurve, inertia: float) -> list[Row]:
    (slow, least), (fast, most) = excess.extremes()
    return [
        Row("acceleration_smallest", least / inertia, "angular_acceleration", slow),
        Row("acceleration_largest", most / inertia, "angular_acceleration", fast),
    ]


def _on_shaft(flywheel: float, wanted: Wanted) -> list[Row]:
    if wanted.ratio == 1.0:
        return []
    return [Row("shaft_flywheel", on_faster_shaft(flywheel, wanted.ratio), "inertia")]


def _dimensions(flywheel: float, speed: float, wanted: Wanted) -> list[Row]:
    """Dimensions of the flywheel on its shaft; none where no shape or no flywheel is asked for."""
    if wanted.size is None or not flywheel > 0:
        return []
    size = wanted.size(on_faster_shaft(flywheel, wanted.ratio))
    rows = [Row(f"{size.shape}_diameter", size.diameter, "length"), Row("width", size.width, "length")]
    if size.shape == "rim":
        rows.append(Row("thickness", size.thickness, "length"))
    rim_speed = size.rim_speed(speed * abs(wanted.ratio))
    return [*rows, Row("mass", size.mass, "mass"), Row("rim_speed", rim_speed, "velocity")]
