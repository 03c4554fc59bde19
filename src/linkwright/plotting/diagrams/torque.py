"""Effort, power, energy and speed of the input over the cycle."""

from __future__ import annotations

from functools import partial

import numpy as np

from linkwright.analysis.analysis import Analysis, Kind
from linkwright.analysis.true_speed import steady_cycle
from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output
from linkwright.core.quantity import significant
from linkwright.cycle.summary import SummaryValue
from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinetostatics.forces import Forces
from linkwright.machine.energy import EnergyFluctuation
from linkwright.machine.equivalent import Equivalent, equivalent
from linkwright.machine.running import SteadyRunning
from linkwright.machine.speed import SpeedCurve
from linkwright.pictures.diagram import COLOURS
from linkwright.plotting.diagrams.axes import InputAxis, unit_of
from linkwright.plotting.diagrams.base import DIAGRAMS, Request
from linkwright.plotting.diagrams.marks import Curve
from linkwright.plotting.diagrams.outputs import main_output
from linkwright.plotting.diagrams.panels import Level, OverInput, Panel, with_mean
from linkwright.plotting.diagrams.source import Extremes, PlotInput
from linkwright.words import _


@DIAGRAMS.register("torque")
class Torque(OverInput):
    """Driver effort from the joint forces: torque of a turning driver, force of a sliding one; one panel a driver."""

    title = _("what the driver must supply")
    options = ("static",)

    def output(self, source: PlotInput, request: Request) -> Output | None:
        return main_output(source.motion)

    def panels(self, source: PlotInput, request: Request) -> list[Panel]:
        motion, forces, say = source.motion, source.forces, request.say
        if not motion.mechanism.drivers:
            raise RequestError(
                _(
                    '"{name}" has no driver, so it has no input torque',
                    code="picture.no_torque",
                    name=motion.mechanism.name,
                )
            )
        found = []
        several = len(motion.mechanism.drivers) > 1
        for name in motion.mechanism.drivers:
            turning = motion.positions.rotary[name]
            effort = forces.driver_effort(name)
            exact = source.extremes(partial(Forces.driver_effort, name=name), "forces")
            dimension = "torque" if turning else "force"
            word = say(_("input torque") if turning else _("driving force"))
            title = f"{word} {'T' if turning else 'F'}{f' {name}' if several else ''}"
            curve = Curve("", source.closed(effort), "both", extremes=exact)
            mean = Analysis.of(forces).mean_of(partial(Forces.driver_effort, name=name))
            found.append(with_mean(title, dimension, curve, mean, request, f"{name}: " if several else ""))
        return found


@DIAGRAMS.register("power")
class Power(OverInput):
    """Power that all drivers supply together, from the powers of all forces."""

    title = _("power of the driver")
    options = ("static",)

    def output(self, source: PlotInput, request: Request) -> Output | None:
        return main_output(source.motion)

    def panels(self, source: PlotInput, request: Request) -> list[Panel]:
        power = source.forces.power
        curve = Curve("", source.closed(power), "both", extremes=source.extremes(_total, "forces"))
        mean = Analysis.of(source.forces).mean_of(_total)
        return [with_mean(request.say(_("power")) + " P", "power", curve, mean, request)]


def _total(forces: Forces) -> Floats:
    return forces.power


@DIAGRAMS.register("energy")
class Energy(OverInput):
    """Torque at constant speed with its mean and the areas between, and the energy E(φ) that the areas leave.

    ΔE = max E - min E is what a flywheel has to take up. Angles are those turned from the cycle's begin.
    """

    title = _("energy over the cycle")
    options = ("static",)

    def axis(self, source: PlotInput) -> InputAxis:
        reduced, found = _reduced(source)
        return InputAxis("angle", reduced.start + reduced.direction * found.angle)

    def panels(self, source: PlotInput, request: Request) -> list[Panel]:
        say = request.say
        reduced, found = _reduced(source)
        place = reduced.start + reduced.direction * np.append(reduced.angle, reduced.period)
        steady = reduced.torque + 0.5 * reduced.slope * reduced.speed**2
        torque = reduced.direction * np.append(steady, steady[0])
        mean = reduced.direction * reduced.load.mean
        title = say(_("input torque")) + " T"
        curve = Curve("", torque, "both", x=place, extremes=_of_torque(reduced))
        change = say(_("energy fluctuation ΔE = {value}", value=unit_of("energy", [found.energy]).text(found.value)))
        return [
            with_mean(title, "torque", curve, mean, request, fill=True),
            Panel(say(_("energy")) + " E", "energy", (Curve(change, found.energy, "both"),)),
        ]


def _of_torque(reduced: Equivalent) -> Extremes | None:
    """Extremes of the driver's torque at constant speed."""
    forces = reduced.forces
    if forces.static:
        return None
    return lambda kind: Analysis.of(forces).extreme(lambda each: each.input_torque, kind, of="forces")


def _reduced(source: PlotInput) -> tuple[Equivalent, EnergyFluctuation]:
    if source.result_running is not None:
        return source.result_running.equivalent, source.result_running.energy
    reduced = source.once("energy", lambda: equivalent(source.forces))
    return reduced, reduced.energy


@DIAGRAMS.register("speed")
class Speed(OverInput):
    """ω(φ) of steady running under a constant motor torque: with the flywheel for a required δ, and without any."""

    title = _("speed over the cycle")
    options = ("fluctuation", "static")

    def axis(self, source: PlotInput) -> InputAxis:
        if source.result_running is None:
            return source.axis
        reduced = source.result_running.equivalent
        return InputAxis("angle", reduced.start + reduced.direction * np.array([0.0, reduced.period]))

    def panels(self, source: PlotInput, request: Request) -> list[Panel]:
        running = source.once(f"running {request.fluctuation}", lambda: source.running(request.fluctuation))
        say, mean = request.say, running.equivalent.speed
        title = say(_("speed of the input")) + " ω"
        level = Level(say(_("mean {value}", value=f"{significant(mean)} rad/s")), mean)
        first = _curve(running, running.exact_speed, running.exact_flywheel, say(_("with flywheel")), COLOURS[0])
        found = [Panel(title, "angular_velocity", (first,), (level,))]
        alone = _alone(running) if running.exact_flywheel > 0 else None
        if alone is not None:
            bare = _curve(running, alone, 0.0, say(_("without flywheel")), COLOURS[4])
            found.append(Panel(title, "angular_velocity", (bare,), (level,)))
        return found


def _curve(running: SteadyRunning, speed: SpeedCurve, flywheel: float, name: str, colour: str) -> Curve:
    inertia = f", J = {significant(flywheel)} kg·m²" if flywheel else ""
    label = f"{name}{inertia}: δ = {significant(speed.fluctuation, 3)}"
    reduced = running.equivalent

    def exact(kind: Kind) -> SummaryValue:
        angle, value = speed.fastest if kind == "max" else speed.slowest
        return SummaryValue(value, angle / reduced.speed, reduced.input_at(angle), True)

    x = reduced.start + reduced.direction * speed.angle
    return Curve(label, speed.speed, "both", colour, x=x, extremes=exact)


def _alone(running: SteadyRunning) -> SpeedCurve | None:
    """The speed without a flywheel; None where the machine would stop within its cycle."""
    try:
        return steady_cycle(running.equivalent.forces)[1].curve(motor_torque=running.mean_torque)
    except LinkwrightError:
        return None
