"""Loads of a `linkwright` Mechanism as loads of the reference, made from their plain data only."""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, pi
from typing import Any

import numpy as np
from numpy.typing import NDArray
from tests.reference.adapter import driver_values, guide_direction, link_points, reference_motion
from tests.reference.agreement import slide_coordinate
from tests.reference.formulas import (
    damper,
    force_in_link,
    force_in_space,
    gravity,
    push_along_guide,
    spring,
    torque,
    torsion_damper,
    torsion_spring,
)
from tests.reference.laws import taylor
from tests.reference.multibody import Array, Forces, Load, Motion, Vec


def reference_loads(mechanism: Any, motion: Motion, time: Array) -> list[Load]:
    """Gravity and all loads; raises NotImplementedError for what the reference has no formula for."""
    loads: list[Load] = [gravity(mechanism.gravity)] if any(mechanism.gravity) else []
    for load in mechanism.loads.values():
        if load.kind not in KINDS:
            raise NotImplementedError(f"loads of kind {load.kind}")
        loads.append(KINDS[load.kind](mechanism, load, Course(mechanism, motion, time)))
    return loads


class Course:
    """The motion as magnitudes and phases see it: time, input, outputs with their rates."""

    def __init__(self, mechanism: Any, motion: Motion, time: Array) -> None:
        self.mechanism = mechanism
        self.motion = motion
        self.time = time
        u, ud, _ = driver_values(mechanism, time)
        self.input, self.rate = (u[:, 0], ud[:, 0]) if u.shape[1] else (0 * time, 0 * time)

    def output(self, output: Any) -> tuple[Array, Array]:
        if output.kind == "angle":
            return self.motion.angle(output.owner)[:2]
        if output.kind == "displacement":
            return slide_coordinate(self.mechanism, self.motion, self.mechanism.joints[output.owner])[:2]
        link, point = output.owner.rsplit(".", 1)
        place, rate, _ = self.motion.point(link, link_points(self.mechanism, link)[point])
        axis = "xy".index(output.kind)
        return place[:, axis], rate[:, axis]

    def magnitude(self, load: Any) -> Array:
        """Size (n,) of the load: number, expression or ramp, zero outside its phase."""
        inside, progress = self.phase(load.magnitude.phase)
        given = load.magnitude.size
        match type(given).__name__:
            case "Ramp":
                size = given.start + progress * (given.end - given.start)
            case "Constant":
                size = np.full(len(self.time), given.value)
            case "Formula":
                size = self._expression(given.expression)
            case "Table":
                size = self._table(given)
            case _:
                size = np.ones(len(self.time))
        return np.where(inside, size, 0.0)

    def _table(self, table: Any) -> Array:
        if table.over == "time":
            across = self.time
        elif table.over == "input":
            across = self.input
        else:
            across = self.output(table.over)[0]
        if table.across == "angle":
            across = table.x[0] + (across - table.x[0]) % (2 * pi)
        size: Array = np.interp(across, table.x, table.y)
        return size

    def _expression(self, expression: Any) -> Array:
        values: dict[str, Any] = {**self.mechanism.parameters, "input": self.input}
        values |= {name: self.motion.angle(name)[0] for name in self.mechanism.links}
        return taylor(expression.text, values, self.time).f

    def phase(self, phase: Any) -> tuple[NDArray[np.bool_], Array]:
        """Where the phase is on, and how much of its input has passed (0 to 1)."""
        if type(phase).__name__ == "Always":
            return np.ones(len(self.time), dtype=bool), np.full(len(self.time), np.nan)
        if hasattr(phase, "direction"):
            rate = self.output(phase.output)[1] * (1.0 if phase.direction == "increasing" else -1.0)
            still = 1e-9 * np.nanmax(np.abs(self.motion.qd))
            return rate > still, np.full(len(self.time), np.nan)
        if not hasattr(phase, "output") and not self._turning():
            return (self.input >= phase.start) & (self.input <= phase.end), np.full(len(self.time), np.nan)
        if hasattr(phase, "output"):
            limits = self._limits(phase.output)
            (begin, first), (end, last) = limits[phase.start], limits[phase.end]
            way = float(np.sign(self.rate[0]))
        else:
            begin, end, way = phase.start, phase.end, float(np.sign(phase.end - phase.start))
        progress = ((self.input - begin) * way % (2 * pi)) / ((end - begin) * way % (2 * pi))
        if getattr(phase, "part", None) is None:
            return progress <= 1.0, progress
        passed = (self.output(phase.output)[0] - first) / (last - first)
        return (progress <= 1.0) & _within(phase.part, passed), np.full(len(self.time), np.nan)

    def _turning(self) -> bool:
        driver = next(iter(self.mechanism.drivers.values()))
        return bool(self.mechanism.joints[driver.joint].kind == "revolute")

    def _limits(self, output: Any) -> dict[str, tuple[float, float]]:
        """Input and value of an output's largest and smallest value over one turn of a constant-speed driver."""
        law = next(iter(self.mechanism.drivers.values())).law
        time = np.linspace(0.0, 2 * pi / abs(law.speed), 361)
        turn = Course(self.mechanism, reference_motion(self.mechanism, time), time)
        values = turn.output(output)[0][:-1]
        found = {}
        for word, k in (("max", int(np.argmax(values))), ("min", int(np.argmin(values)))):
            t = self._standstill(output, turn, k)
            found[word] = law.start + law.speed * t, self._near(output, turn, k, t)[0]
        return found

    def _standstill(self, output: Any, turn: Course, k: int) -> float:
        """Time near time[k] at which the output stands still, by bisection of its rate."""
        step = turn.time[1] - turn.time[0]
        low, high = turn.time[k] - step, turn.time[k] + step
        for _ in range(60):
            middle = (low + high) / 2
            rates = [self._near(output, turn, k, t)[1] for t in (low, middle)]
            low, high = (low, middle) if rates[0] * rates[1] <= 0 else (middle, high)
        return float((low + high) / 2)

    def _near(self, output: Any, turn: Course, k: int, t: float) -> tuple[float, float]:
        """The output and its rate at a time near time[k]."""
        u, ud, udd = driver_values(self.mechanism, np.array([turn.time[k], t]))
        there = turn.motion.system.motion(turn.motion.q[k], u[0], u[1:], ud[1:], udd[1:])
        value, rate = Course(self.mechanism, there, np.array([t])).output(output)
        return float(value[0]), float(rate[0])


def _within(part: Any, passed: Array) -> NDArray[np.bool_]:
    """Where a stroke of which shares are ``passed`` is in a part given by shares."""
    if not all(amount.share for amount in part.amounts):
        raise NotImplementedError("parts of a stroke in its own unit")
    first, last = part.amounts[0].value, part.amounts[-1].value
    before, after = {"free": (first, 1 - last), "first": (0.0, first), "last": (1 - last, 1.0)}[part.word]
    inside: NDArray[np.bool_] = (passed >= before) & (passed <= after)
    return inside


def friction_loads(mechanism: Any, motion: Motion, found: Forces) -> dict[str, Load]:
    """Couples against relative rotation, forces against sliding, from the reactions in `found`."""
    loads: dict[str, Load] = {}
    for name, joint in mechanism.joints.items():
        coefficient = getattr(joint, "friction", 0.0)
        if not coefficient:
            continue
        if joint.kind == "revolute":
            a, b = joint.links
            pressing = np.hypot(*found.on(name, b)[0].T)
            turning = motion.angle(b)[1] - motion.angle(a)[1]
            loads[name] = torque(b, -np.sign(turning) * coefficient * joint.pin_radius * pressing, a)
            continue
        u = motion.direction(joint.guide, guide_direction(mechanism, joint))
        force = found.on(name, joint.block)[0]
        pressing = np.abs(u[:, 0] * force[:, 1] - u[:, 1] * force[:, 0])
        sliding: Array = slide_coordinate(mechanism, motion, joint)[1]
        block = joint.block, link_points(mechanism, joint.block)[joint.at]
        guide = joint.guide, guide_direction(mechanism, joint)
        loads[name] = push_along_guide(guide, block, -np.sign(sliding) * coefficient * pressing)
    return loads


def _force(mechanism: Any, load: Any, course: Course) -> Load:
    at, size = link_points(mechanism, load.on)[load.at], course.magnitude(load)
    if load.components is not None:
        return force_in_space(load.on, at, np.outer(size, load.components))
    if load.direction is not None:
        return force_in_space(load.on, at, np.outer(size, (np.cos(load.direction), np.sin(load.direction))))
    angle = _angle_in_link(mechanism, load)
    return force_in_link(load.on, at, np.outer(size, (np.cos(angle), np.sin(angle))), load.on)


def _angle_in_link(mechanism: Any, load: Any) -> float:
    if load.in_link is not None:
        return float(load.in_link)
    points = link_points(mechanism, load.on)
    (ax, ay), (bx, by) = (points[p] for p in load.normal_to or load.along)
    return atan2(by - ay, bx - ax) + (pi / 2 if load.normal_to else 0.0)


def _torque(mechanism: Any, load: Any, course: Course) -> Load:
    return torque(load.on, course.magnitude(load), load.against)


def _ends(mechanism: Any, load: Any) -> list[tuple[str, Vec]]:
    return [(end.link, link_points(mechanism, end.link)[end.point]) for end in load.between]


def _spring(mechanism: Any, load: Any, course: Course) -> Load:
    a, b = _ends(mechanism, load)
    return spring(a, b, load.stiffness, load.free_length, load.preload)


def _damper(mechanism: Any, load: Any, course: Course) -> Load:
    a, b = _ends(mechanism, load)
    return damper(a, b, load.damping)


def _torsion_spring(mechanism: Any, load: Any, course: Course) -> Load:
    a, b = load.links
    return torsion_spring(a, b, load.stiffness, load.free_angle, load.preload)


def _torsion_damper(mechanism: Any, load: Any, course: Course) -> Load:
    a, b = load.links
    return torsion_damper(a, b, load.damping)


def _pressure(mechanism: Any, load: Any, course: Course) -> Load:
    joint = mechanism.joints[load.joint]
    area = load.area if load.area is not None else pi * load.bore**2 / 4
    size = course.magnitude(load) * area * (-1.0 if load.pushes == "backward" else 1.0)
    block = joint.block, link_points(mechanism, joint.block)[joint.at]
    return push_along_guide((joint.guide, guide_direction(mechanism, joint)), block, size)


KINDS: dict[str, Callable[[Any, Any, Course], Load]] = {
    "force": _force,
    "torque": _torque,
    "spring": _spring,
    "damper": _damper,
    "torsion_spring": _torsion_spring,
    "torsion_damper": _torsion_damper,
    "pressure": _pressure,
}
