"""Why a machine that was run did not get going, or stands though its drive is on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from linkwright.core.quantity import shown
from linkwright.drivers.free import Free
from linkwright.dynamics.result import Run
from linkwright.dynamics.verdicts.drive import at_limits, resisting
from linkwright.dynamics.verdicts.quasi_static import Course, QuasiStatic
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _


def stalled(run: Run) -> Message | None:
    """That the drive of a machine with one free coordinate cannot start it from where it was at rest, or cannot move
    it on from where it came to rest, with the torque (force) that is missing; None where it can, or has no drive."""
    mechanism = run.mechanism
    if len(run.coordinates) != 1 or len(mechanism.drivers) != 1 or not _driven(mechanism):
        return None
    name = run.coordinates[0]
    sense = _sense(mechanism, name)
    course = run.samples([0.0, run.end]).course[name]
    (begin, end), rates = (course[0].tolist(), course[1].tolist())
    if rates[0] == 0.0 and sense * (end - begin) <= 0.0:
        return _short(mechanism, name, begin, sense, _STARTS)
    if rates[1] == 0.0 and not (run.events and run.events[-1].kind == "rest"):
        return _short(mechanism, name, end, sense, _STALLS)
    return None


_STARTS = _(
    "{name!r} does not start at {where}: it needs {needed} there, and its drive has {available}, {missing} too "
    "little; choose a drive with more starting torque or another ratio, or begin elsewhere (see machine --start)",
    code="verdicts.run_does_not_start",
)
_STALLS = _(
    "{name!r} stalls at {where}: to move on it needs {needed} there, and its drive has {available} at rest, "
    "{missing} too little; choose a larger drive, another ratio, or a flywheel",
    code="verdicts.run_stalls",
)
_JAMS = _(
    "{name!r} jams at {where}: the friction in its joints grows with the driving effort there, so that no finite "
    "effort moves it (self-locking)",
    code="verdicts.run_jams",
)


def _driven(mechanism: Mechanism) -> bool:
    """Whether anything drives it from the beginning to the end."""
    drives = [each for each in mechanism.actuators.values() if each.drives]
    return bool(drives) and all(each.begin is None and each.until is None for each in drives)


def _sense(mechanism: Mechanism, name: str) -> float:
    law = mechanism.drivers[name].law
    speed = law.nominal if isinstance(law, Free) else law.constant_speed
    return -1.0 if (speed or 0.0) < 0.0 else 1.0


def _short(mechanism: Mechanism, name: str, place: float, sense: float, message: Message) -> Message | None:
    """The sentence with its numbers, where anything is missing at a place."""
    still = {name: np.zeros(1)}
    course = Course({name: np.array([place])}, still, still, {})
    senses = {name: np.array([sense])}
    load = QuasiStatic(replace(mechanism, actuators=resisting(mechanism))).starting(course, senses).effort[name][0]
    net = QuasiStatic(replace(mechanism, actuators=at_limits(mechanism))).starting(course, senses).effort[name][0]
    rotary = mechanism.drivers[name].law.rotary
    dimension, where = "torque" if rotary else "force", shown(place, "angle" if rotary else "length")
    if np.isnan(load):
        return _JAMS.format(name=mechanism.name, where=where)
    missing = float(sense * net)
    if not missing > 0.0:
        return None
    return message.format(
        name=mechanism.name,
        where=where,
        needed=shown(float(sense * load), dimension, 4),
        available=shown(float(sense * load) - missing, dimension, 4),
        missing=shown(missing, dimension, 4),
    )
