"""The smallest motor of a catalogue, with its gear, that starts a machine, runs it and survives."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from linkwright.actuators.motor import Motor
from linkwright.core.arguments import integer, real, require
from linkwright.core.progress import Progress, current_progress
from linkwright.core.quantity import shown
from linkwright.core.table import PERCENT, Amount, Cell, Table, Tabular
from linkwright.dynamics.verdicts.catalogue import Catalogue, ListedGear, ListedMotor, read_catalogue
from linkwright.dynamics.verdicts.drive import Drive, Torques, mean_over
from linkwright.dynamics.verdicts.drive_margin import drive_margin
from linkwright.dynamics.verdicts.motor_duty import (
    ROUNDING,
    MotorDuty,
    law_duty,
    limits,
    motor_duty,
    rpm,
    transmission,
)
from linkwright.errors import LinkwrightError, RequestError
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _

#: Positions over the cycle.
STEPS = 180
#: Share of its largest speed at which a controlled motor without gears in the catalogue is meant to run.
RESERVE = 0.9
#: How far from the driver's speed a motor may run its machine, as share.
SPEED_TOLERANCE = 0.1
#: Torque per speed difference of a controller, as share of the motor's peak torque over its largest speed.
STIFFNESS = 50.0


@dataclass(frozen=True)
class Candidate:
    """A motor with a gear in the machine: the ``margin`` of starting, its ``duty`` where that was found, ``refused``:
    the reason where it does not do, None for one that does; ``tried``: False where a smaller one was found before."""

    motor: Motor
    gear: str
    margin: float
    duty: MotorDuty | None
    refused: Message | None
    tried: bool = True

    @property
    def suffices(self) -> bool:
        """Whether it starts, runs and survives."""
        return self.tried and self.refused is None


@dataclass(frozen=True)
class MotorChoice(Tabular):
    """The motors of a catalogue in a machine, the smallest first, each with its reason where it does not do."""

    source: Mechanism = field(repr=False)
    catalogue: Catalogue = field(repr=False)
    candidates: tuple[Candidate, ...]

    @property
    def best(self) -> Candidate | None:
        """The smallest one that does; None where none does."""
        return next((each for each in self.candidates if each.suffices), None)

    @property
    def mechanism(self) -> Mechanism:
        """The machine with the chosen motor among its actuators.

        Raises LinkwrightError where none suffices.
        """
        if self.best is None:
            raise LinkwrightError(self.sentence)
        return with_motor(self.source, self.best.motor)

    @property
    def sentence(self) -> Message:
        """What is chosen, or that nothing is."""
        best = self.best
        if best is None:
            return _(
                "no motor of {catalogue} does for {name!r}; the table gives the reason of each: add larger motors or "
                "other gears",
                code="verdicts.none_suffices",
                catalogue=self.catalogue.name,
                name=self.source.name,
            )
        return _(
            "{motor}, ratio {ratio:.4g}: the smallest motor of {catalogue} that starts {name!r}, runs it and lasts",
            motor=best.motor.name,
            name=self.source.name,
            ratio=abs(best.motor.ratio or 1.0),
            catalogue=self.catalogue.name,
        )

    def tables(self, language: str = "en", *args: Any, **options: Any) -> tuple[Table, ...]:
        """A row for every candidate."""
        head = (
            _("motor"),
            _("gear"),
            _("ratio"),
            _("starting margin"),
            _("run-up"),
            _("RMS / continuous"),
            _("peak"),
            _("energy per cycle"),
            _("verdict"),
        )
        rows = [self._row(each) for each in self.candidates]
        notes = [self.sentence.translate(language)]
        return (Table(head, rows, "<<>>>>>><", title=self.source.name, notes=notes),)

    def _row(self, each: Candidate) -> list[Cell]:
        duty = each.duty
        heat = None if duty is None or duty.rating.continuous is None else duty.rms / duty.rating.continuous
        verdict = each.refused or (_("does") if each.tried else _("larger than needed"))
        return [
            each.motor.name,
            each.gear,
            Amount(abs(each.motor.ratio or 1.0), digits=4),
            Amount(each.margin, digits=3),
            None if duty is None or duty.run_up is None else Amount(duty.run_up, "time", 3),
            None if heat is None else Amount(heat, digits=3, scale=PERCENT),
            None if duty is None else Amount(duty.peak, "torque", 4),
            None if duty is None else Amount(duty.energy, "energy", 4),
            verdict,
        ]

    def data(self) -> Mapping[str, Any]:
        """The candidates as plain data, SI."""
        best = self.best
        return {
            "name": self.source.name,
            "best": None if best is None else best.motor.name,
            "gear": None if best is None else best.gear,
            "candidates": [_data(each) for each in self.candidates],
            "remarks": [self.sentence],
        }


def _data(each: Candidate) -> dict[str, Any]:
    duty = each.duty
    return {
        "motor": each.motor.name,
        "gear": each.gear,
        "ratio": each.motor.ratio,
        "starting_margin": each.margin,
        "run_up": None if duty is None else duty.run_up,
        "rms_torque": None if duty is None else duty.rms,
        "peak_torque": None if duty is None else duty.peak,
        "energy": None if duty is None else duty.energy,
        "suffices": each.suffices,
        "tried": each.tried,
        "reason": each.refused,
    }


def with_motor(mechanism: Mechanism, motor: Motor) -> Mechanism:
    """A machine with a motor in the place of those that it has."""
    others = {name: each for name, each in mechanism.actuators.items() if not isinstance(each, Motor)}
    if motor.name in mechanism.loads or motor.name in others:
        motor = replace(motor, name=f"{motor.name}_motor")
    return replace(mechanism, actuators={**others, motor.name: motor})


def choose_motor(
    mechanism: Mechanism,
    catalogue: str | Path | Catalogue | None = None,
    *,
    driver: str | None = None,
    margin: float = 1.0,
    longest_run_up: float | None = None,
    speed_tolerance: float = SPEED_TOLERANCE,
    every: bool = False,
    steps: int = STEPS,
    progress: Progress | None = None,
) -> MotorChoice:
    """The smallest motor of a catalogue that starts a machine from every position, runs it and survives.

    Each motor is tried with each gear (without gears: with the ratio of its rated speed to the driver's): it must
    start with the ``margin``, not turn faster than its largest speed, run up, and stay within its continuous torque
    by its RMS torque, and within its peak torque. Motors that are controlled follow the driver's law; the others run
    as their curve gives it, until they are steady. Motors that the machine has are left out, brakes and flywheels
    stay.

    Args:
        mechanism: what is driven, with loads, at the speed of its driver.
        catalogue: file (YAML or CSV, see ``read_catalogue``) or its content; the example where left out.
        driver: the driver on which the motor acts; the first one unless named.
        margin: required ratio of available to needed torque at rest.
        longest_run_up: largest run-up time, s.
        speed_tolerance: how far from the driver's speed the machine may run, as share.
        every: whether larger motors are tried too after one that does.
        steps: positions over the cycle.

    Returns:
        All candidates with their numbers and reasons; ``best``, and the ``mechanism`` with it.

    Raises:
        LinkwrightError: a machine that jams, that has no speed, or loads that drive it; a catalogue with findings.

    Example:
        >>> import linkwright as lw
        >>> choice = lw.choose_motor(lw.load("gallery:jaw_crusher_fourbar"), steps=72)
        >>> choice.best.motor.name
        'A-7.5'
    """
    require(mechanism, Mechanism)
    listed = catalogue if isinstance(catalogue, Catalogue) else read_catalogue(catalogue)
    course = progress or current_progress()
    bare = replace(
        mechanism, actuators={key: each for key, each in mechanism.actuators.items() if not isinstance(each, Motor)}
    )
    asked = _Asked(real("margin", margin), longest_run_up, real("speed_tolerance", speed_tolerance))
    task = _Task(bare, driver, asked, integer("steps", steps, 8, 100_000))
    found: list[Candidate] = []
    pairs = list(_pairs(listed, task))
    for done, (motor, gear) in enumerate(pairs):
        if course is not None:
            course(done, len(pairs))
        smaller = any(each.suffices for each in found)
        found.append(task.judged(motor, gear, tried=every or not smaller))
    return MotorChoice(mechanism, listed, tuple(found))


def _pairs(listed: Catalogue, task: _Task) -> Iterator[tuple[ListedMotor, ListedGear]]:
    """Motors, the smallest first, each with each gear."""
    for motor in listed.by_size():
        fastest = motor.rating.rated_speed or RESERVE * (motor.rating.largest_speed or task.speed)
        yield from ((motor, gear) for gear in (listed.gears.values() or [ListedGear("", fastest / task.speed)]))


@dataclass(frozen=True)
class _Asked:
    """What a motor must reach: see :func:`choose_motor`."""

    margin: float
    longest_run_up: float | None
    speed_tolerance: float


class _Task:
    """A machine that all candidates are tried in; its load is found once."""

    def __init__(self, mechanism: Mechanism, driver: str | None, asked: _Asked, steps: int) -> None:
        self.mechanism, self.asked, self.steps = mechanism, asked, steps
        load = drive_margin(replace(mechanism, actuators={}), driver=driver, steps=steps)
        if load.stretches:
            raise LinkwrightError(load.findings[0])
        self.drive = Drive(mechanism, driver)
        self.driver = mechanism.drivers[self.drive.name]
        if not self.drive.rotary:
            raise RequestError(
                _(
                    "a motor of a catalogue turns, and the driver {driver!r} slides; drive a link that turns",
                    code="verdicts.motor_of_slide",
                    driver=self.drive.name,
                )
            )
        self.needed = float(load.peak.needed[0])
        if not self.drive.prescribed or not self.speed:
            raise RequestError(
                _(
                    "nothing says how fast {name!r} runs; give its driver a speed or another law",
                    code="verdicts.no_nominal_speed",
                    name=mechanism.name,
                )
            )

    @cached_property
    def _torques(self) -> Torques:
        return self.drive.running(self.drive.cycle(self.steps, closed=True))

    @property
    def speed(self) -> float:
        """Largest speed of the driver, rad/s."""
        return float(np.abs(self._torques.rate).max())

    def judged(self, listed: ListedMotor, gear: ListedGear, *, tried: bool) -> Candidate:
        """One motor with one gear."""
        motor = self.placed(listed, gear)
        i, eta = transmission(motor), motor.efficiency or 1.0
        at_rest = float(motor.at_limit().torque_at(np.zeros(1), 0.0)[0])
        margin = i * eta * at_rest / self.needed if self.needed > 0.0 else np.inf
        reason = self._too_fast(motor, listed, i) or self._no_start(margin, i * eta * at_rest)
        if reason is not None or not tried:
            return Candidate(motor, gear.name, margin, None, reason, tried or reason is not None)
        try:
            duty = self._duty(motor, listed)
        except LinkwrightError as error:
            return Candidate(motor, gear.name, margin, None, _("{reason}", reason=error))
        reason = self._other_speed(duty, i) or next(iter(duty.findings), None) or self._too_slow(duty)
        return Candidate(motor, gear.name, margin, duty, reason)

    def placed(self, listed: ListedMotor, gear: ListedGear) -> Motor:
        """The motor on the driver's link, by the gear."""
        motor = listed.motor.at_speed(gear.ratio * self.speed, STIFFNESS)
        return replace(
            motor,
            on=self.driver.link,
            against=self.driver.relative_to,
            ratio=gear.ratio,
            efficiency=gear.efficiency if gear.efficiency < 1.0 else None,
            inertia=(listed.motor.inertia or 0.0) + gear.inertia or None,
        )

    def _too_fast(self, motor: Motor, listed: ListedMotor, i: float) -> Message | None:
        most = listed.rating.largest_speed
        slack = ROUNDING
        if not motor.controlled and most is None:
            most, slack = _idle(motor, i * self.speed), self.asked.speed_tolerance
        if most is None or i * self.speed <= most * (1.0 + slack):
            return None
        return _("must turn at {speed}, its limit is {limit}", speed=rpm(i * self.speed), limit=rpm(most))

    def _no_start(self, margin: float, available: float) -> Message | None:
        if margin >= self.asked.margin:
            return None
        return _(
            "does not start: {available} of {needed} on the link",
            available=shown(available, "torque", 4),
            needed=shown(self.asked.margin * self.needed, "torque", 4),
        )

    def _other_speed(self, duty: MotorDuty, i: float) -> Message | None:
        """That the machine runs at another speed than its driver's."""
        wanted = self.drive.speed
        found = duty.mean_speed / i
        if duty.by == "law" or wanted is None or abs(found / wanted - 1.0) <= self.asked.speed_tolerance:
            return None
        return _("runs the machine at {speed} instead of {wanted}", speed=rpm(found), wanted=rpm(wanted))

    def _too_slow(self, duty: MotorDuty) -> Message | None:
        most = self.asked.longest_run_up
        if most is None or duty.run_up is None or duty.run_up <= most:
            return None
        return _("runs up in {time}", time=shown(duty.run_up, "time", 3))

    def _duty(self, motor: Motor, listed: ListedMotor) -> MotorDuty:
        machine = with_motor(self.mechanism, motor)
        if not motor.controlled:
            weak = self._stalls(motor)
            if weak is not None:
                raise LinkwrightError(weak)
            found = motor_duty(machine, motor.name, by="run", steps=self.steps)
            return replace(found, rating=listed.rating, limit=limits(motor, found.speed, listed.rating))
        duty = law_duty(machine, motor, self._torques, listed.rating)
        if self.drive.speed is not None and not duty.findings:
            up = motor_duty(machine, motor.name, by="run", steps=self.steps)
            duty = replace(duty, run_up=up.run_up, run_up_rms=up.run_up_rms)
        return duty

    def _stalls(self, motor: Motor) -> Message | None:
        """That its largest torque at any speed is below the mean that is needed."""
        i, eta = transmission(motor), motor.efficiency or 1.0
        most = i * eta * float(motor.torque_at(np.linspace(0.0, i * self.speed, 201)).max())
        mean = mean_over(self._torques.time, self._torques.left)
        if most >= mean:
            return None
        return _(
            "stalls: at most {available} of {needed} on the average",
            available=shown(most, "torque", 4),
            needed=shown(mean, "torque", 4),
        )


def _idle(motor: Motor, speed: float) -> float:
    """The speed without load of a motor, rad/s: where its torque ceases below a speed, else infinite."""
    speeds = np.linspace(0.0, speed, 1001)
    drives = np.flatnonzero(motor.torque_at(speeds) > 0.0)
    if not drives.size or drives[-1] == len(speeds) - 1:
        return np.inf if drives.size else 0.0
    return float(speeds[drives[-1] + 1])
