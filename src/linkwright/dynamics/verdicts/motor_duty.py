"""What a motor has to do in its machine: torque and speed over the cycle, against its limits."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import ClassVar, Literal

import numpy as np

from linkwright.actuators.motor import Motor, Rating
from linkwright.core.arguments import STEPS, integer, require
from linkwright.core.arrays import Floats
from linkwright.core.attached import PlotMixin
from linkwright.core.quantity import shown
from linkwright.core.table import PERCENT, Block, Numbers, Row
from linkwright.dynamics.result import Run
from linkwright.dynamics.run import run
from linkwright.dynamics.verdicts.drive import Drive, Torques, mean_over
from linkwright.dynamics.zeros import root
from linkwright.errors import LinkwrightError, RequestError
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import no_such
from linkwright.words import Message, Translate, _

TURN = 2.0 * np.pi
#: Share of the mean steady speed at which a machine has run up.
RUN_UP = 0.95
#: How long a run-up is watched, s.
LONGEST = 120.0
#: Share by which limits may be exceeded: rounding.
ROUNDING = 1e-9

LABELS: Mapping[str, Message] = {
    "rms_torque": _("RMS torque of the motor"),
    "continuous_use": _("  share of its continuous torque"),
    "peak_torque": _("peak torque of the motor"),
    "peak_use": _("  share of its peak torque at that speed"),
    "overload": _("  peak over continuous torque"),
    "largest_speed": _("largest speed of the motor"),
    "mean_speed": _("mean speed of the motor"),
    "mean_power": _("mean power at its shaft"),
    "peak_power": _("peak power at its shaft"),
    "energy": _("energy per cycle at its shaft"),
    "run_up": _("run-up time to 95 % of the mean speed"),
    "run_up_rms": _("  RMS torque meanwhile"),
}


@dataclass(frozen=True)
class MotorDuty(PlotMixin, Numbers):
    """Operating points of a motor over one cycle of its machine, on the motor's side of its gear.

    ``time`` s, ``input`` of the driver rad or m, ``speed`` rad/s and ``torque`` N·m of the motor, positive where it
    drives in the sense of the motion: (n,), the first one again at the end. ``by``: ``law`` where the motion is the
    one that the driver prescribes, ``run`` where it is the steady running that the motor's curve gives.
    ``run_up``: time from rest, s, None where it was not run. ``limit`` (n,): the largest torque at each speed.
    """

    labels: ClassVar[Mapping[str, Message]] = LABELS
    mechanism: Mechanism = field(repr=False)
    motor: Motor
    by: Literal["law", "run"]
    time: Floats = field(repr=False)
    input: Floats = field(repr=False)
    speed: Floats = field(repr=False)
    torque: Floats = field(repr=False)
    limit: Floats = field(repr=False)
    rating: Rating
    run_up: float | None = None
    run_up_rms: float | None = None

    def _mean(self, values: Floats) -> float:
        return mean_over(self.time, values)

    @property
    def rms(self) -> float:
        """Root mean square of the torque over time, N·m: what heats the motor."""
        return float(np.sqrt(self._mean(self.torque**2)))

    @property
    def peak(self) -> float:
        """Largest size of the torque, N·m."""
        return float(np.abs(self.torque).max())

    @property
    def mean_speed(self) -> float:
        """Mean speed of the motor over time, rad/s."""
        return self._mean(self.speed)

    @property
    def mean_power(self) -> float:
        """Mean power at the shaft, W; what it gets back counts against it."""
        return self._mean(self.torque * self.speed)

    @property
    def energy(self) -> float:
        """Energy per cycle at the shaft, J."""
        return self.mean_power * float(self.time[-1] - self.time[0])

    @property
    def findings(self) -> tuple[Message, ...]:
        """What it is too small for, in sentences; empty where it suffices."""
        rating, name = self.rating, self.motor.name
        found = []
        fastest = float(np.abs(self.speed).max())
        if rating.largest_speed is not None and fastest > rating.largest_speed * (1.0 + ROUNDING):
            found.append(
                _(
                    "motor {name!r} must turn at {speed}, faster than its largest speed {limit}",
                    code="verdicts.motor_too_fast",
                    name=name,
                    speed=rpm(fastest),
                    limit=rpm(rating.largest_speed),
                )
            )
        over = np.abs(self.torque) - self.limit
        place = int(over.argmax())
        if over[place] > ROUNDING * self.peak:
            found.append(
                _(
                    "motor {name!r} must have {torque} at {speed}, more than the {limit} that it has there",
                    code="verdicts.motor_too_weak",
                    name=name,
                    torque=shown(float(abs(self.torque[place])), "torque", 4),
                    speed=rpm(float(abs(self.speed[place]))),
                    limit=shown(float(self.limit[place]), "torque", 4),
                )
            )
        if rating.continuous is not None and self.rms > rating.continuous * (1.0 + ROUNDING):
            found.append(
                _(
                    "motor {name!r} overheats: its RMS torque {torque} is more than its continuous torque {limit}",
                    code="verdicts.motor_too_hot",
                    name=name,
                    torque=shown(self.rms, "torque", 4),
                    limit=shown(rating.continuous, "torque", 4),
                )
            )
        return tuple(found)

    @property
    def suffices(self) -> bool:
        """Whether it stays within its limits."""
        return not self.findings

    @property
    def title(self) -> str:
        """Name of the machine."""
        return self.mechanism.name

    def blocks(self, translate: Translate) -> list[Block]:
        """Torque against the limits, speed, power and energy, run-up."""
        rating, power = self.rating, self.torque * self.speed
        torque = [Row("rms_torque", self.rms, "torque")]
        if rating.continuous is not None:
            torque.append(Row("continuous_use", self.rms / rating.continuous, scale=PERCENT, digits=4))
        torque.append(Row("peak_torque", self.peak, "torque"))
        if np.isfinite(self.limit).all():
            with np.errstate(all="ignore"):
                use = float(np.nan_to_num(np.abs(self.torque) / self.limit, nan=0.0).max())
            torque.append(Row("peak_use", use, scale=PERCENT, digits=4))
        if rating.continuous is not None:
            torque.append(Row("overload", self.peak / rating.continuous))
        motion = [
            Row("mean_speed", self.mean_speed, "angular_velocity"),
            Row("largest_speed", float(np.abs(self.speed).max()), "angular_velocity"),
            Row("mean_power", self.mean_power, "power"),
            Row("peak_power", float(power.max()), "power"),
            Row("energy", self.energy, "energy"),
        ]
        found = [Block("torque", "", torque), Block("motion", "", motion)]
        if self.run_up is not None and self.run_up_rms is not None:
            rows = [Row("run_up", self.run_up, "time"), Row("run_up_rms", self.run_up_rms, "torque")]
            found.append(Block("run_up", "", rows))
        return found

    def columns(self) -> dict[str, Floats]:
        """The operating points, SI."""
        return {
            "time [s]": self.time,
            "input": self.input,
            "motor_speed [rad/s]": self.speed,
            "motor_torque [N·m]": self.torque,
            "largest_torque [N·m]": self.limit,
        }

    def notes(self, language: str = "en") -> list[str]:
        """What it is too small for."""
        return [each.translate(language) for each in self.findings]


def rpm(speed: float) -> str:
    """A speed as data sheets give it."""
    return f"{speed * 30.0 / np.pi:.4g} rpm"


def _the_motor(mechanism: Mechanism, name: str | None) -> Motor:
    motors = {key: each for key, each in mechanism.actuators.items() if isinstance(each, Motor)}
    if name is not None and name not in motors:
        raise RequestError(no_such(_("motor"), name, motors))
    if name is None and len(motors) != 1:
        raise RequestError(
            _(
                "{name!r} has {count} motors; name the one that is asked for (motor=…)",
                code="verdicts.which_motor",
                name=mechanism.name,
                count=len(motors),
            )
            if motors
            else _(
                "{name!r} has no motor; add one under actuators (kind: induction, dc, servo or curve)",
                code="verdicts.no_motor",
                name=mechanism.name,
            )
        )
    return motors[name or next(iter(motors))]


def motor_duty(
    mechanism: Mechanism, motor: str | None = None, *, by: Literal["law", "run"] | None = None, steps: int = STEPS
) -> MotorDuty:
    """Operating points of a machine's motor over the cycle, RMS and peak torque against its limits, energy per turn.

    Args:
        mechanism: with the ``motor`` among its ``actuators``, on the link (or guide) of a driver.
        motor: its name; the only one unless named.
        by: ``law``: the motion is the one that the driver prescribes, and the motor supplies what that takes (usual
            for a motor that is controlled, such as a servo); ``run``: the motor's curve gives the motion, from rest
            until it is steady (usual for all others).
        steps: positions over the cycle.

    Returns:
        Torque and speed of the motor, and what they exceed.

    Raises:
        LinkwrightError: no such motor, one that does not act on a driver, a machine that does not run steadily.

    Source: T = (T_load + i² J α)/(i η), of power that flows back (T_load + i² J α) η/i; Biagiotti and Melchiorri,
    Trajectory Planning for Automatic Machines and Robots, ch. 7 (load against the motor's limits).
    """
    require(mechanism, Mechanism)
    found = _the_motor(mechanism, motor)
    driver = driver_of(mechanism, found)
    chosen = by or ("law" if found.controlled else "run")
    count = integer("steps", steps, 8, 100_000)
    return _by_law(mechanism, found, driver, count) if chosen == "law" else _by_run(mechanism, found, driver, count)


def driver_of(mechanism: Mechanism, motor: Motor) -> str:
    """The driver on whose link or guide a motor acts."""
    for name, driver in mechanism.drivers.items():
        ends = {driver.link, driver.relative_to}
        if motor.on is not None and driver.law.rotary and {motor.on, motor.against} == ends:
            return name
        if motor.along is not None and motor.along == driver.joint:
            return name
    raise RequestError(
        _(
            "motor {motor!r} of {name!r} acts on no driver; let it act on the link of a driver (on: …), or make its "
            "link the driver",
            code="verdicts.motor_on_no_driver",
            motor=motor.name,
            name=mechanism.name,
        )
    )


def transmission(motor: Motor) -> float:
    """Size of the motor's speed over the driver's rate, dimensionless or rad/m."""
    return abs((motor.ratio or 1.0) / (motor.lead or 1.0))


def _by_law(mechanism: Mechanism, motor: Motor, driver: str, steps: int) -> MotorDuty:
    """The motion is prescribed: what the motor must supply for it."""
    others = {name: each for name, each in mechanism.actuators.items() if name != motor.name}
    drive = Drive(replace(mechanism, actuators=others), driver)
    if not drive.prescribed:
        raise RequestError(
            _(
                "the driver of {name!r} is free, so no law says how it moves; give it a law, or by='run'",
                code="verdicts.free_driver",
                name=mechanism.name,
            )
        )
    torques = drive.running(drive.cycle(steps, closed=True))
    return law_duty(mechanism, motor, torques, motor.rating)


def law_duty(mechanism: Mechanism, motor: Motor, torques: Torques, rating: Rating) -> MotorDuty:
    """The duty of a motor where its machine moves by its law, from the ``torques`` over the cycle without it."""
    i, eta = transmission(motor), motor.efficiency or 1.0
    link = torques.left + i * i * (motor.inertia or 0.0) * torques.second
    torque = np.where(link > 0.0, link / (i * eta), 0.0 if motor.self_locking else link * eta / i)
    speed = i * np.abs(torques.rate)
    most = limits(motor, speed, rating)
    return MotorDuty(mechanism, motor, "law", torques.time, torques.input, speed, torque, most, rating)


def _last_cycle(found: Run, mechanism: Mechanism, driver: str) -> float:
    """The time at which the last cycle of a steady run begins, s."""
    drive = Drive(replace(mechanism, actuators={}), driver)
    turns = max(1, round((drive.period or 0.0) * (drive.speed or 0.0) / TURN))
    end, rate = found.end_state[driver]
    target = end - np.sign(rate) * TURN * turns

    def off(time: float) -> float:
        return float(found.samples([time]).course[driver][0][0] - target)

    return root(off, 0.0, found.end)


def limits(motor: Motor, speed: Floats, rating: Rating) -> Floats:
    """The largest torque at each speed, N·m: of a controlled motor its limit, of another one its peak."""
    if motor.controlled:
        return np.abs(motor.at_limit().torque_at(speed * (1.0 - ROUNDING)))
    return np.full(len(speed), np.inf if rating.peak is None else rating.peak)


def _by_run(mechanism: Mechanism, motor: Motor, driver: str, steps: int) -> MotorDuty:
    """From rest until a turn is as the one before, and the last turn."""
    found = run(mechanism, until="steady", at_most=LONGEST)
    rate = found.end_state[driver][1]
    if found.note is not None or not rate:
        raise LinkwrightError(
            _(
                "{name!r} does not come to run steadily within {time:g} s from rest: its motor is too weak, or its "
                "cycle is not one of full turns; see drive_margin",
                code="verdicts.not_steady",
                name=mechanism.name,
                time=LONGEST,
            )
        )
    begin = _last_cycle(found, mechanism, driver)
    times = np.linspace(begin, found.end, steps + 1)
    i = transmission(motor)
    place, rates, _second = found.samples(times).course[driver]
    sense = np.sign(rate)
    speed = i * sense * rates
    up = np.linspace(0.0, found.end, max(20 * steps, 2))
    early = sense * found.samples(up).course[driver][1]
    reached = up[int(np.argmax(early >= RUN_UP * mean_over(times, sense * rates)))]
    first = np.linspace(0.0, reached, steps + 1)
    heating = motor.torque_at(i * sense * found.samples(first).course[driver][1], first)
    return MotorDuty(
        mechanism=mechanism,
        motor=motor,
        by="run",
        time=times - begin,
        input=place,
        speed=speed,
        torque=motor.torque_at(speed, times),
        limit=limits(motor, speed, motor.rating),
        rating=motor.rating,
        run_up=float(reached),
        run_up_rms=math.sqrt(mean_over(first, heating**2)) if reached else 0.0,
    )
