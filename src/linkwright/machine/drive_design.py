"""What ``machine`` finds of torque curves and of a flywheel's shape, as rows of numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import ClassVar

from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.core.table import Block, Numbers, Row
from linkwright.errors import LinkwrightError
from linkwright.kinetostatics.run import solve_forces
from linkwright.machine import running
from linkwright.machine.drive_options import DriveOptions
from linkwright.machine.flywheel import FLUCTUATION, flywheel_inertia, on_faster_shaft, speed_fluctuation
from linkwright.machine.running import motor, placed, share, speeds
from linkwright.machine.speed import true_speed
from linkwright.machine.torque_curve import EnergyFluctuation, TorqueCurve, energy_fluctuation, fluctuation_from_areas
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, Translate, _, pgettext

#: A mean torque below this share of the largest one is zero.
NOTHING = 1e-9

#: What the numbers are, by the keys of their rows.
LABELS = {
    **running.LABELS,
    "inertia": _("moment of inertia that is there"),
    "formula_fluctuation": _("coefficient of speed fluctuation by the formula"),
    "acceleration_smallest": _("largest retardation"),
    "acceleration_largest": pgettext("machine", "largest acceleration"),
    "disk_diameter": _("disk, diameter"),
    "rim_diameter": _("rim, outer diameter"),
    "width": _("  width"),
    "thickness": _("  thickness"),
    "mass": _("  mass"),
    "rim_speed": _("  speed of the circumference (cast iron: up to about 30 m/s)"),
}


@dataclass(frozen=True)
class DriveDesign(Numbers):
    """What is found of torque curves, or of a machine (``running``) with the dimensions of its flywheel."""

    labels: ClassVar[Mapping[str, Message]] = LABELS
    digits: ClassVar[int] = 7
    name: str
    found: Callable[[Translate], list[Block]]
    machine: running.SteadyRunning | None = None

    @property
    def title(self) -> str:
        return self.name

    def blocks(self, translate: Translate) -> list[Block]:
        return [each for each in self.found(translate) if each.rows]

    def columns(self) -> dict[str, Floats]:
        return {} if self.machine is None else self.machine.columns()

    def notes(self, language: str = "en") -> list[str]:
        return [] if self.machine is None else self.machine.notes(language)


def of_areas(energy: EnergyFluctuation, options: DriveOptions, translate: Translate) -> list[Block]:
    """Rows of areas between torque curve and mean line."""
    first = [
        Row("energy_fluctuation", energy.value, "energy"),
        _after("energy_lowest", float(energy.energy.min()), int(energy.low), translate),
        _after("energy_highest", float(energy.energy.max()), int(energy.high), translate),
    ]
    flywheel, rows = _by_formula(energy.value, options)
    total = options.present + flywheel
    if total and options.speed:
        rows.append(share("formula_fluctuation", speed_fluctuation(energy.value, options.speed, total)))
    return _blocks(first, rows, dimensions(flywheel, options.speed or 0.0, options))


def of_curves(
    driver: TorqueCurve, load: TorqueCurve | None, options: DriveOptions, translate: Translate
) -> list[Block]:
    """Rows of a driving torque against a load; raises LinkwrightError for a mean torque of zero."""
    mean = driver.mean
    (_unused, lowest), (_unused2, highest) = driver.extremes()
    if abs(mean) <= NOTHING * max(abs(lowest), abs(highest)) or mean < 0:
        shown_mean = shown(mean, "torque") if mean < -NOTHING * abs(lowest) else "0 N·m"
        raise LinkwrightError(
            _(
                "the mean of --torque over the cycle is {mean}, so it does no work that a motor or a "
                "flywheel could be laid out for; give the driving torque, which is positive on the "
                "average",
                code="machine.no_mean_torque",
                mean=shown_mean,
            )
        )
    resisting = TorqueCurve.constant(mean, period=driver.period) if load is None else load
    energy = energy_fluctuation(driver, resisting).without_rounding(mean * driver.period)
    first = [Row("mean_torque", mean, "torque")]
    if options.speed:
        found = motor(mean, options.speed, efficiency=options.efficiency, margin=options.margin)
        first.append(Row("mean_power", found.mean_power, "power"))
        if found.power != found.mean_power:
            first.append(Row("motor_power", found.power, "power"))
        if load is not None and highest - lowest <= NOTHING * highest:
            alone = motor(load.extremes()[1][1], options.speed, efficiency=options.efficiency, margin=options.margin)
            first.append(Row("motor_power_without_flywheel", alone.power, "power"))
    second = [
        Row("energy_fluctuation", energy.value, "energy"),
        placed("energy_lowest", float(energy.energy.min()), "energy", energy.low),
        placed("energy_highest", float(energy.energy.max()), "energy", energy.high),
    ]
    flywheel, third = _by_formula(energy.value, options)
    total = options.present + flywheel
    if total and options.speed:
        third.append(share("formula_fluctuation", speed_fluctuation(energy.value, options.speed, total)))
        third += speeds(true_speed(resisting, total, options.speed, driver=driver), lambda angle: angle, translate)
        third += _accelerations(driver.minus(resisting), total)
    return _blocks(first, second, third, dimensions(flywheel, options.speed or 0.0, options))


def _blocks(*parts: list[Row]) -> list[Block]:
    return [Block("", "", rows) for rows in parts]


def _after(key: str, energy: float, area: int, translate: Translate) -> Row:
    """An energy with the number of the area behind which it is."""
    place = translate(_("after area {number}", number=area)) if area else translate(_("at the beginning"))
    return Row(key, energy, "energy", note=place, more={"after_area": area})


def _by_formula(energy: float, options: DriveOptions) -> tuple[float, list[Row]]:
    """Flywheel that is needed in addition to the present inertia, 0 where none is asked for."""
    rows = [Row("inertia", options.present, "inertia")] if options.present else []
    if options.fluctuation is None or not options.speed:
        return 0.0, rows
    needed = flywheel_inertia(energy, options.speed, options.fluctuation, present=options.present)
    rows += [share("required_fluctuation", options.fluctuation), Row("flywheel", needed, "inertia")]
    return needed, rows + _on_shaft(needed, options)


def _accelerations(excess: TorqueCurve, inertia: float) -> list[Row]:
    (slow, minimum), (fast, most) = excess.extremes()
    return [
        placed("acceleration_smallest", minimum / inertia, "angular_acceleration", slow),
        placed("acceleration_largest", most / inertia, "angular_acceleration", fast),
    ]


def _on_shaft(flywheel: float, options: DriveOptions) -> list[Row]:
    if options.ratio == 1.0:
        return []
    return [Row("shaft_flywheel", on_faster_shaft(flywheel, options.ratio), "inertia")]


def dimensions(flywheel: float, speed: float, options: DriveOptions) -> list[Row]:
    """Dimensions of the flywheel on its shaft; none where no shape or no flywheel is asked for."""
    if options.size is None or not flywheel > 0:
        return []
    size = options.size(on_faster_shaft(flywheel, options.ratio))
    rows = [Row(f"{size.shape}_diameter", size.diameter, "length"), Row("width", size.width, "length")]
    if size.shape == "rim":
        rows.append(Row("thickness", size.thickness, "length"))
    rim_speed = size.rim_speed(speed * abs(options.ratio))
    return [*rows, Row("mass", size.mass, "mass"), Row("rim_speed", rim_speed, "velocity")]


def of_mechanism(mechanism: Mechanism, options: DriveOptions, steps: int) -> DriveDesign:
    """Motor and flywheel of a machine for steady running."""
    found = running.steady_running(
        solve_forces(mechanism, steps=steps),
        fluctuation=FLUCTUATION if options.fluctuation is None else options.fluctuation,
        ratio=options.ratio,
        efficiency=options.efficiency,
        margin=options.margin,
    )
    sized = Block("dimensions", "", dimensions(found.exact_flywheel, found.equivalent.speed, options))
    return DriveDesign(mechanism.name, lambda translate: [*found.blocks(translate), sized], found)


def of_diagram(options: DriveOptions, translate: Translate) -> DriveDesign:
    """Motor and flywheel of a torque diagram, by its areas or by expressions."""
    if options.areas is not None:
        areas, scales = options.areas
        torque, angle = scales or (1.0, 1.0)
        energy = fluctuation_from_areas(areas, torque_scale=torque, angle_scale=angle)
        title = translate(_("Torque diagram of {count} areas", count=len(areas)))
        return DriveDesign(title, partial(of_areas, energy, options))
    assert options.torque is not None
    text, driver = options.torque
    against, load = options.load or (translate(_("its mean")), None)
    title = translate(_("T = {torque}, against {load}", torque=text, load=against))
    return DriveDesign(title, partial(of_curves, driver, load, options))
