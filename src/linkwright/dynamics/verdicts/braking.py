"""Time and angle in which a machine comes to rest when it is switched off and braked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import ClassVar

import numpy as np

from linkwright.actuators.base import Actuator
from linkwright.actuators.brake import Brake
from linkwright.core.arguments import integer, real, require
from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.core.table import Block, Numbers, Row
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.run import run
from linkwright.dynamics.verdicts.drive import Drive
from linkwright.dynamics.verdicts.quasi_static import QuasiStatic
from linkwright.errors import LinkwrightError, RequestError
from linkwright.mechanism.mechanism import Mechanism
from linkwright.units import si_unit
from linkwright.words import Message, Translate, _

#: How long a machine is watched until it rests, s.
LONGEST = 60.0
#: Positions over the cycle for the means of the formula.
_STEPS = 72

LABELS: Mapping[str, Message] = {
    "speed": _("speed from which it is braked"),
    "longest": _("longest braking time"),
    "farthest": _("largest braking angle"),
    "farthest_length": _("largest braking distance"),
    "shortest": _("shortest braking time"),
    "nearest": _("smallest braking angle"),
    "nearest_length": _("smallest braking distance"),
    "formula_time": _("by the formula: time J·ω/T"),
    "formula_way": _("by the formula: angle J·ω²/(2 T)"),
    "inertia": _("  mean moment of inertia J"),
    "mass": _("  mean mass m"),
    "torque": _("  mean braking torque T, loads and friction included"),
    "force": _("  mean braking force F, loads and friction included"),
    "energy": _("kinetic energy that is taken up, at most"),
}


@dataclass(frozen=True)
class Braking(Numbers):
    """A machine switched off at its speed, and braked until it rests, from several positions of its cycle.

    ``begin`` (n,): coordinates of the driver, rad or m, where it is switched off; ``time`` (n,): until it rests, s;
    ``way`` (n,): what the driver moves meanwhile, rad or m, positive; ``energy`` (n,): kinetic energy at the
    beginning, J. ``inertia`` kg·m² (kg) and ``torque`` N·m (N): means over the cycle for the formula.
    """

    labels: ClassVar[Mapping[str, Message]] = LABELS
    mechanism: Mechanism = field(repr=False)
    driver: str
    rotary: bool
    speed: float
    begin: Floats
    time: Floats
    way: Floats
    energy: Floats = field(repr=False)
    inertia: float
    torque: float

    @property
    def longest(self) -> float:
        """The longest time until it rests, s."""
        return float(self.time.max())

    @property
    def farthest(self) -> float:
        """The largest angle, rad, or distance, m, that the driver moves meanwhile."""
        return float(self.way.max())

    @property
    def formula_time(self) -> float:
        """t = J ω/T with the means over the cycle, s; infinite where nothing brakes on the average."""
        return self.inertia * self.speed / self.torque if self.torque > 0.0 else np.inf

    @property
    def formula_way(self) -> float:
        """φ = J ω²/(2 T), rad or m."""
        return 0.5 * self.speed * self.formula_time

    @property
    def title(self) -> str:
        """Name of the machine."""
        return self.mechanism.name

    def blocks(self, translate: Translate) -> list[Block]:
        """Exact times and angles, and those of the formula."""
        end = "" if self.rotary else "_length"
        late, far = int(self.time.argmax()), int(self.way.argmax())
        early, near = int(self.time.argmin()), int(self.way.argmin())
        way = "angle" if self.rotary else "length"
        exact = [
            Row("speed", self.speed, "angular_velocity" if self.rotary else "velocity"),
            self._placed("longest", self.time, late, "time"),
            self._placed(f"farthest{end}", self.way, far, way),
            self._placed("shortest", self.time, early, "time"),
            self._placed(f"nearest{end}", self.way, near, way),
            Row("energy", float(self.energy.max()), "energy"),
        ]
        formula = [
            Row("formula_time", self.formula_time, "time"),
            Row("formula_way", self.formula_way, way),
            Row("inertia", self.inertia, "inertia") if self.rotary else Row("mass", self.inertia, "mass"),
            Row("torque", self.torque, "torque") if self.rotary else Row("force", self.torque, "force"),
        ]
        return [Block("braking", "", exact), Block("formula", "", formula if self.torque > 0.0 else [])]

    def _placed(self, key: str, values: Floats, place: int, dimension: str) -> Row:
        where, kind = float(self.begin[place]), "angle" if self.rotary else "length"
        note = _("switched off at {where}", where=shown(where, kind))
        return Row(key, float(values[place]), dimension, note=note, more={f"from [{si_unit(kind)}]": where})

    def columns(self) -> dict[str, Floats]:
        """Times and angles by the position where it is switched off, SI."""
        unit = "rad" if self.rotary else "m"
        return {f"begin [{unit}]": self.begin, "time [s]": self.time, f"way [{unit}]": self.way}


def braking(
    mechanism: Mechanism,
    *,
    torque: float | None = None,
    speed: float | None = None,
    positions: int = 8,
    at_most: float = LONGEST,
) -> Braking:
    """Time and angle in which a machine comes to rest that is switched off at its speed and braked.

    Motors and cylinders are off, their rotors go on turning; brakes act at once, whatever their times.

    Args:
        mechanism: with one driver; its ``actuators`` of kind ``brake`` brake it, and loads and friction.
        torque: of one more brake on the driver, N·m (N for one that slides).
        speed: of the driver at the beginning, rad/s or m/s (default: that of the driver's law).
        positions: how many positions of its cycle it is switched off at.
        at_most: how long it is watched, s.

    Returns:
        Times and angles by position, and what the formula for constant torque gives with means over the cycle.

    Raises:
        LinkwrightError: no speed, nothing that brakes, a machine that does not come to rest.

    Source: principle of work and energy; t = J ω/T and φ = J ω²/(2 T) of constant torque.

    Example:
        >>> import linkwright as lw
        >>> found = lw.braking(lw.load("gallery:jaw_crusher_fourbar"), torque=2000.0, positions=2)
        >>> found.longest < found.speed * found.inertia / 1000.0
        True
    """
    require(mechanism, Mechanism)
    drive = Drive(mechanism)
    begin_speed = _speed(drive, speed)
    braked = _braked(drive, torque)
    count = integer("positions", positions, 1, 1000)
    starts = _starts(drive, count)
    sense = 1.0 if (drive.mechanism.drivers[drive.name].law.constant_speed or 1.0) >= 0.0 else -1.0
    rows = [_one(braked, drive, float(place), sense * begin_speed, at_most) for place in starts]
    time, way, energy = np.array(rows).T
    inertia, resisting = _means(braked, drive, sense * begin_speed)
    return Braking(
        mechanism=mechanism,
        driver=drive.name,
        rotary=drive.rotary,
        speed=begin_speed,
        begin=starts,
        time=time,
        way=way,
        energy=energy,
        inertia=inertia,
        torque=resisting,
    )


def _speed(drive: Drive, speed: float | None) -> float:
    found = drive.speed if speed is None else abs(real("speed", speed))
    if not found:
        raise RequestError(
            _(
                "nothing says how fast {name!r} moves when it is switched off; give speed: {unit}",
                code="verdicts.no_speed",
                name=drive.source.name,
                unit="20 rad/s" if drive.rotary else "0.2 m/s",
            )
        )
    return found


def _braked(drive: Drive, torque: float | None) -> Mechanism:
    """The machine switched off, with its brakes and one more."""
    actuators = {name: _off(each) for name, each in drive.source.actuators.items()}
    if torque is not None:
        driver = drive.source.drivers[drive.name]
        size = abs(real("torque", torque))
        name = next(name for name in ("brake", "brake_2", "brake_3") if name not in actuators)
        actuators[name] = (
            Brake(name=name, on=driver.link, against=driver.relative_to, torque=size)
            if drive.rotary
            else Brake(name=name, along=driver.joint, force=size)
        )
    rubs = any(joint.friction_arm for joint in drive.source.joints.values())
    if not rubs and not any(each.brakes for each in actuators.values()) and not drive.source.loads:
        raise RequestError(
            _(
                "nothing brakes {name!r}: it has no brake, no friction and no load; add an actuator of kind: brake, "
                "or give torque: …",
                code="verdicts.no_brake",
                name=drive.source.name,
            )
        )
    return replace(drive.source, actuators=actuators, run=None)


def _off(actuator: Actuator) -> Actuator:
    """A brake at work, anything else switched off."""
    return replace(actuator, begin=None, until=None if actuator.brakes else 0.0)


def _starts(drive: Drive, count: int) -> Floats:
    """Coordinates of the driver at equal steps of its cycle, those that are reached."""
    times = drive.cycle(count)
    course, _reached = drive.course(times)
    return np.asarray(course.places[drive.name][:count])


def _one(machine: Mechanism, drive: Drive, place: float, speed: float, at_most: float) -> tuple[float, float, float]:
    """Time, way and energy of one braking."""
    found = run(machine, until="rest", at={drive.name: place}, speed={drive.name: speed}, at_most=at_most)
    end, rate = found.end_state[drive.name]
    if found.note is not None or rate != 0.0:
        where = shown(place, "angle" if drive.rotary else "length")
        raise LinkwrightError(
            _(
                "{name!r} does not come to rest within {time:g} s when it is switched off at {where}: its brakes and "
                "friction are too small, or its loads move it on; increase the torque of the brake",
                code="verdicts.does_not_stop",
                name=machine.name,
                time=at_most,
                where=where,
            )
        )
    energy = float(found.equation.evaluate(["kinetic"], _state(drive.name, place, speed), 1)[0, 0])
    return found.end, abs(end - place), energy


def _state(name: str, place: float | Floats, speed: float) -> dict[str, Floats | float]:
    return {f"q:{name}": place, f"qd:{name}": speed}


def _means(machine: Mechanism, drive: Drive, speed: float) -> tuple[float, float]:
    """Mean moment of inertia and mean braking torque over the cycle, the latter where it creeps on."""
    course, _reached = drive.course(drive.cycle(_STEPS))
    name, count = drive.name, course.count
    inertia = EquationOfMotion(machine).evaluate(
        [f"M:{name}:{name}"], _state(name, course.places[name], speed), count
    )
    senses = {each: np.full(count, np.sign(speed)) for each in course.places}
    efforts = QuasiStatic(machine).starting(course, senses).effort[name]
    return float(inertia.mean()), float(np.sign(speed) * np.nanmean(efforts))
