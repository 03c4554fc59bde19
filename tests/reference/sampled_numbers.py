"""Metrics of a machine from its solved positions alone, each by its definition."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from math import nan, pi
from typing import Any

import numpy as np
from tests.reference import sampled_cycle as cycle
from tests.reference.sampled_cycle import Array, Bounded

import linkwright as lw

#: Relative accuracy of the areas of hulls.
HULL = 1e-6
#: Shares of the largest effort and power below which a mean is zero, as the numbers have it.
NOTHING = 1e-9
FLUCTUATION = 0.02


class SampledMachine:
    """A machine at many positions of its cycle, which it passes wholly."""

    def __init__(self, mechanism: lw.Mechanism, positions: int) -> None:
        self.mechanism = mechanism
        self.motion = lw.solve_motion(mechanism, steps=positions)
        self.forces = lw.solve_forces(self.motion)
        self.closed = len(self.motion.time) == positions
        self.step = float(abs(self.motion.time[1] - self.motion.time[0]))
        self.duration = self.step * (positions if self.closed else len(self.motion.time) - 1)
        self.groups = {"+".join(each["links"]): each for each in lw.structure(mechanism).data()["groups"]}

    def number(self, row: Any) -> Bounded | None:
        """The number of a row of ``lw.metrics``; None where it is not judged."""
        rule = NUMBERS.get(row.metric)
        if rule is None:
            return None
        try:
            return rule(self, row.subject)
        except Unjudged:
            return None

    @cached_property
    def columns(self) -> dict[str, Array]:
        """All columns by their names without units."""
        return {name.rpartition(" [")[0]: values for name, values in self.forces.columns().items()}

    def output(self, name: str, derivative: int = 0) -> Array:
        """The angle of a link or the displacement of a guide, or one of its derivatives."""
        words = ("displacement", "velocity", "acceleration")
        if name not in self.mechanism.links:
            return self.columns[f"{name}.{words[derivative]}"]
        words = ("angle", "angular_velocity", "angular_acceleration")
        return self.columns[f"{name}.{words[derivative]}"]

    @cached_property
    def input_rate(self) -> Array:
        """Rate of the first driver."""
        driver = next(iter(self.mechanism.drivers.values()))
        if driver.joint in self.mechanism.guides:
            return self.motion.joint(driver.joint).velocity
        ahead, behind = (self.turning(each) for each in (driver.link, driver.relative_to))
        return np.asarray(ahead - behind)

    def turning(self, link: str) -> Array:
        return np.zeros(self.motion.steps) if link == "frame" else self.motion.link(link).angular_velocity

    def by_time(self, values: Array) -> Array:
        """The derivative by time over a closed cycle, central differences of the fourth order."""
        g, at = cycle.extended(values, True), np.arange(len(values)) + cycle.REACH
        return np.asarray((g[at - 2] - 8 * g[at - 1] + 8 * g[at + 1] - g[at + 2]) / (12 * self.step))

    def vector(self, values: Array) -> Array:
        return np.hypot(*values.T)

    def reaction(self, subject: str) -> Array:
        joint, _, link = subject.partition(" on ")
        link = link or self.second_link(joint)
        return self.vector(self.forces.reaction(joint, on=link))

    def second_link(self, joint: str) -> str:
        return str(self.mechanism.joints[joint].joined[1])

    def steady(self) -> float:
        """The speed of the one driver; else the number is not judged."""
        rate = self.input_rate
        if len(self.mechanism.drivers) != 1 or not self.closed or np.ptp(rate) > 1e-7 * np.abs(rate).max():
            raise Unjudged
        return float(rate.mean())

    def pin(self, joint: Mapping[str, Any]) -> Array:
        return self.motion.point(joint["joint"]).position

    def way(self, joint: Mapping[str, Any]) -> Array:
        return self.forces.guide_direction(joint["joint"])


class Unjudged(Exception):
    """A number that samples do not give."""


Rule = Callable[[SampledMachine, str], Bounded]


def _extent(m: SampledMachine, subject: str) -> Bounded:
    return cycle.extent(m.output(subject), m.closed)


def _limit(m: SampledMachine, subject: str) -> Bounded:
    """Only the outermost limit of a kind, the first in the table, is judged."""
    name, _, kind = subject.rpartition(" ")
    values = m.output(name)
    if not m.closed and int(np.argmax(values if kind == "max" else -values)) in (0, len(values) - 1):
        raise Unjudged  # the end of an open course is no limit position
    return (cycle.maximum if kind == "max" else cycle.minimum)(values, m.closed)


def _slow_share(m: SampledMachine, subject: str) -> Bounded:
    m.steady()
    ends = [cycle.place_of_maximum(sign * m.output(subject)) for sign in (1, -1)]
    share = (ends[1].value - ends[0].value) % 1.0
    return Bounded(max(share, 1.0 - share), ends[0].slack + ends[1].slack)


def _quick_return(m: SampledMachine, subject: str) -> Bounded:
    share, slack = _slow_share(m, subject)
    return Bounded(share / (1 - share), slack / (1 - share) ** 2)


def _crank_angle(m: SampledMachine, subject: str) -> Bounded:
    share, slack = _slow_share(m, subject)
    return Bounded(pi * (2 * share - 1), 2 * pi * slack)


def _ratio(m: SampledMachine, subject: str) -> Bounded:
    """Its size: of two as large as each other either sign will do."""
    return cycle.peak(m.output(subject, 1) / m.input_rate, m.closed)


def _advantage(m: SampledMachine, subject: str) -> Bounded:
    value, slack = _ratio(m, subject)
    return Bounded(1 / value, slack / value**2) if value > 1e-9 else Bounded(nan, 0)


def _acceleration(m: SampledMachine, subject: str) -> Bounded:
    if "." in subject:
        return cycle.maximum(m.vector(m.motion.point(subject).acceleration), m.closed)
    return cycle.peak(m.output(subject, 2), m.closed)


def _jerk(m: SampledMachine, subject: str) -> Bounded:
    if any(each.kind == "cam" for each in m.mechanism.joints.values()) or not m.closed:
        raise Unjudged  # differences across the bends of cams
    if "." in subject:
        parts = m.motion.point(subject).acceleration.T
        jerk = np.hypot(*(m.by_time(each) for each in parts))
    else:
        jerk = m.by_time(m.output(subject, 2))
    value, slack = cycle.peak(jerk, True)
    noise = 1e-13 * float((m.input_rate**2).max()) / m.step
    return Bounded(value, slack + noise + 1e-8 * value)


def _sine(m: SampledMachine, subject: str) -> Array:
    """Sine of the transmission angle of a dyad from its pins and guides."""
    group = m.groups.get(subject, {"signature": ""})
    joints = [*group.get("outer_joints", ()), *group.get("inner_joints", ())]
    pins = [each for each in joints if each["kind"] == "revolute"]
    guides = [each for each in joints if each["kind"] == "prismatic"]
    if len(joints) != 3 or len(pins) + len(guides) != 3:
        raise Unjudged
    if group["signature"] == "RRR":
        inner = m.pin(joints[2])
        ways = [m.pin(each) - inner for each in joints[:2]]
    elif group["signature"] in ("RRP", "RPR", "PRR"):
        way = m.way(guides[0])
        ways = [m.pin(pins[0]) - m.pin(pins[1]), np.stack([-way[:, 1], way[:, 0]], axis=1)]
    else:
        ways = [m.way(each) for each in guides]
    (a, b), (c, d) = (each.T for each in ways)
    sizes = np.hypot(a, b) * np.hypot(c, d)
    if sizes.min() < 1e-6 * sizes.max():
        raise Unjudged
    return np.asarray(np.abs(a * d - b * c) / sizes)


def _singularity(m: SampledMachine, subject: str) -> Bounded:
    return cycle.minimum(_sine(m, subject), m.closed)


def _transmission(m: SampledMachine, subject: str) -> Bounded:
    value, slack = _singularity(m, subject)
    if value > 1 - 1e-3:
        raise Unjudged  # the arc sine is steep there
    return Bounded(float(np.arcsin(value)), slack / np.sqrt(1 - value**2))


def _pressure(m: SampledMachine, subject: str) -> Bounded:
    value, slack = _transmission(m, subject)
    return Bounded(pi / 2 - value, slack)


def _pv(m: SampledMachine, subject: str) -> Bounded:
    joint, _, link = subject.partition(" on ")
    first, second = m.mechanism.joints[joint].joined[0], link or m.second_link(joint)
    radius = m.mechanism.joints[joint].pin_radius
    force = m.vector(m.forces.reaction(joint, on=second))
    return cycle.peak(force * (m.turning(second) - m.turning(first)) * radius, m.closed)


def _mean_power(m: SampledMachine, subject: str) -> Bounded:
    return cycle.mean(m.forces.power, m.closed)


def _efficiency(m: SampledMachine, subject: str) -> Bounded:
    lost, work = (cycle.mean(each, m.closed) for each in (m.forces.friction_power, m.forces.power))
    share = abs(lost.value / work.value)
    return Bounded(1 - share, (lost.slack + share * work.slack) / abs(work.value))


def _energy(m: SampledMachine, subject: str) -> Bounded:
    m.steady()
    turned = 2 * pi * round(abs(m.steady()) * m.duration / (2 * pi))
    value, slack = cycle.excess(m.forces.input_torque)
    return Bounded(value * turned, slack * turned)


def _flywheel(m: SampledMachine, subject: str) -> Bounded:
    speed = m.steady()
    energy, own = _energy(m, subject), cycle.mean(_inertia(m), True)
    found = Bounded(
        energy.value / (FLUCTUATION * speed**2) - own.value,
        energy.slack / (FLUCTUATION * speed**2) + own.slack + 1e-12 * own.value,
    )
    return found if found.value > 0 else Bounded(0.0, max(0.0, found.value + found.slack))


def _inertia(m: SampledMachine) -> Array:
    """Twice the kinetic energy over the square of the speed."""
    energy = np.zeros(m.motion.steps)
    for name, link in m.mechanism.links.items():
        motion = m.motion.link(name)
        energy = energy + link.inertia * motion.angular_velocity**2
        if link.mass:
            energy = energy + link.mass * (motion.centre.velocity**2).sum(axis=1)
    return np.asarray(energy / m.input_rate**2)


def _curve_length(m: SampledMachine, subject: str) -> Bounded:
    value, slack = cycle.mean(m.vector(m.motion.point(subject).velocity), True)
    return Bounded(value * m.duration, slack * m.duration)


def _curve_area(m: SampledMachine, subject: str) -> Bounded:
    point = m.motion.point(subject)
    (x, y), (u, v) = (point.position - point.position.mean(axis=0)).T, point.velocity.T
    value, slack = cycle.mean(0.5 * (x * v - y * u), True)
    length = cycle.mean(m.vector(point.velocity), True).value * m.duration
    return Bounded(value * m.duration, slack * m.duration + 1e-12 * length**2)


def _swept_area(m: SampledMachine, subject: str) -> Bounded:
    links = {"frame": m.mechanism.frame, **m.mechanism.links}
    names = [f"{link}.{point}" for link, each in links.items() for point in each.points]
    places = [m.motion.point(name).position for name in names]
    area, coarser = (cycle.hull_area(np.concatenate([each[::n] for each in places])) for n in (1, 2))
    bend = max(cycle.unevenness(np.diff(one)).max(initial=0.0) for each in places for one in each.T)
    around = 2.0 * float(np.ptp(np.concatenate(places), axis=0).sum())
    return Bounded(area, HULL * area + area - coarser + around * bend)


NUMBERS: Mapping[str, Rule] = {
    "stroke": _extent,
    "swing_angle": _extent,
    "limit_position": _limit,
    "quick_return_ratio": _quick_return,
    "crank_angle_between_limits": _crank_angle,
    "velocity_ratio": _ratio,
    "mechanical_advantage": _advantage,
    "peak_acceleration": _acceleration,
    "peak_jerk": _jerk,
    "singularity": _singularity,
    "transmission_angle": _transmission,
    "pressure_angle": _pressure,
    "peak_reaction": lambda m, subject: cycle.maximum(m.reaction(subject), m.closed),
    "rms_reaction": lambda m, subject: cycle.rms(m.reaction(subject), m.closed),
    "bearing_pv": _pv,
    "peak_shaking_force": lambda m, _: cycle.maximum(m.vector(m.forces.shaking_force), m.closed),
    "peak_shaking_moment": lambda m, _: cycle.peak(m.forces.shaking_moment, m.closed),
    "peak_input_torque": lambda m, subject: cycle.peak(m.forces.driver_effort(subject), m.closed),
    "rms_input_torque": lambda m, subject: cycle.rms(m.forces.driver_effort(subject), m.closed),
    "peak_power": lambda m, _: cycle.maximum(m.forces.power, m.closed),
    "mean_power": _mean_power,
    "efficiency": _efficiency,
    "energy_fluctuation": _energy,
    "flywheel": _flywheel,
    "coupler_curve_length": _curve_length,
    "coupler_curve_area": _curve_area,
    "swept_area": _swept_area,
}
