"""Equivalent moment of inertia and equivalent torque on the input link."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.core.arrays import Floats
from linkwright.core.outputs import row_names
from linkwright.curves.curve import Curve, Extreme, Integral, at_nodes
from linkwright.errors import LinkwrightError
from linkwright.kinematics.cycle import MOST, not_back
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.forces import Forces
from linkwright.machine.torque_curve import TURN, EnergyFluctuation, TorqueCurve, of_energy
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _


def equivalent_inertia(motion: Motion) -> Floats:
    """J_e = Σ (m v² + J ω²)/ω₁², (n,) kg·m²: the inertia on the first driver's link of equal kinetic energy.

    v of the mass centres, ω of all moving links, ω₁ the driver's rate. For a sliding driver an equivalent mass, kg.
    NaN where the driver is at rest.
    """
    return _inertia_and_slope(motion)[0]


def inertia_slope(motion: Motion) -> Floats:
    """dJ_e/dφ, (n,) kg·m²/rad, exact: 2 (Σ (m v·a + J ω α) - J_e ω₁ ε₁)/ω₁³."""
    return _inertia_and_slope(motion)[1]


def equivalent_torque(forces: Forces) -> Floats:
    """M_e, (n,) N·m: the driver's effort against all loads, gravity and friction, inertia left out.

    M_e = T - (J_e ε + ½ dJ_e/dφ ω²); positive along the driver's coordinate. Loads that depend on the speed, and
    friction, are those at the speed that was solved.
    """
    return _torque(forces, *_inertia_and_slope(forces.motion))


def _inertia_and_slope(motion: Motion) -> tuple[Floats, Floats]:
    energy, power = np.zeros(motion.steps), np.zeros(motion.steps)
    centres = _rates_of_centres(motion.mechanism)
    motion.evaluate_together(chain.from_iterable(centres.values()))
    for name, link in motion.mechanism.links.items():
        if link.mass:
            vx, vy, ax, ay = motion.rows.fetch(centres[name], motion.evaluate)
            energy += link.mass * (vx * vx + vy * vy)
            power += link.mass * (vx * ax + vy * ay)
        if link.inertia:
            turning = motion.link(name)
            energy += link.inertia * turning.angular_velocity**2
            power += link.inertia * turning.angular_velocity * turning.angular_acceleration
    rate, second = _rates(motion)
    with np.errstate(all="ignore"):
        inertia = energy / rate**2
        return np.asarray(inertia), np.asarray(2.0 * (power - inertia * rate * second) / rate**3)


def _rates_of_centres(mechanism: Mechanism) -> dict[str, tuple[str, ...]]:
    """Velocity and acceleration of every mass centre among a program's outputs, by link."""
    return {
        name: (*row_names("velocity", f"{name}.@centre"), *row_names("acceleration", f"{name}.@centre"))
        for name, link in mechanism.links.items()
        if link.mass
    }


def _torque(forces: Forces, inertia: Floats, slope: Floats) -> Floats:
    if forces.static:
        return forces.input_torque
    rate, second = _rates(forces.motion)
    return np.asarray(forces.input_torque - inertia * second - 0.5 * slope * rate**2)


@dataclass(frozen=True)
class Equivalent:
    """A machine reduced to its input, over one closed cycle in the direction in which it runs.

    ``speed`` rad/s > 0, the mean one; ``inertia_at`` and ``load``, N·m, at any angle turned; ``angle``, ``inertia``,
    ``slope`` and ``torque`` at the positions of the ``forces``.
    """

    forces: Forces = field(repr=False)
    speed: float
    period: float
    start: float
    direction: float
    inertia_at: Curve = field(repr=False)
    load: TorqueCurve = field(repr=False)

    @property
    def angle(self) -> Floats:
        """Turned by the input from the cycle's begin, always growing, (n,) rad."""
        time = self.forces.motion.time
        return np.asarray(self.speed * (time - time[0]))

    @property
    def inertia(self) -> Floats:
        """J_e, (n,) kg·m²."""
        return self._reduced[0]

    @property
    def slope(self) -> Floats:
        """dJ_e/dangle, (n,) kg·m²/rad."""
        return self.direction * self._reduced[1]

    @property
    def torque(self) -> Floats:
        """What resists, (n,) N·m, positive where the machine needs driving."""
        return self.direction * _torque(self.forces, *self._reduced)

    @cached_property
    def _reduced(self) -> tuple[Floats, Floats]:
        return _inertia_and_slope(self.forces.motion)

    @cached_property
    def inertia_extremes(self) -> tuple[Extreme, Extreme]:
        """Smallest and largest J_e, kg·m², between the positions too, with the angle turned there; a sum of squares
        is not below zero by more than rounding."""
        low, high = self.inertia_at.extremes()
        return replace(low, value=max(low.value, 0.0)), high

    @property
    def mean_inertia(self) -> float:
        """Mean of J_e over the angle, kg·m²."""
        return self.inertia_at.mean

    @cached_property
    def work(self) -> Integral:
        """Work of a constant torque, the mean one, less that of the loads, J, over the angle turned."""
        load = self.load.pieces
        return Curve(load.edges, self.load.mean - load.values).integral()

    @cached_property
    def energy(self) -> EnergyFluctuation:
        """Fluctuation of ∫ (mean - T) dφ, T the torque at constant speed: that of the loads, and ½ dJ_e/dφ ω²."""
        kinetic = 0.5 * self.speed**2 * at_nodes(self.inertia_at, self.work.edges)
        found = of_energy(Curve(self.work.edges, self.work.values - kinetic), balance=self.work.total)
        return found.without_rounding(abs(self.load.mean) * self.load.period)

    def input_at(self, angle: float) -> float:
        """The input's coordinate, rad, at an angle turned."""
        return self.start + self.direction * angle


def equivalent(forces: Forces) -> Equivalent:
    """Reduces a machine to its input link.

    Raises LinkwrightError where the cycle is not closed, the input does not turn at constant speed, or there are
    several drivers: a flywheel on the input then has no meaning.
    """
    motion = forces.motion
    rate = steady_rate(motion)
    direction = float(np.sign(rate))
    period = abs(rate) * (motion.positions.period or 0.0)
    cycle = Analysis.of(forces).cycle
    if cycle is None:
        raise LinkwrightError(
            _(
                "the positions of {name!r} pass a change point or follow no law in time, so the "
                "machine cannot be evaluated between them; solve its cycle without change points "
                "first",
                code="running.not_between",
                name=motion.mechanism.name,
            )
        )

    def reduced(solved: Forces) -> Floats:
        inertia, slope = _inertia_and_slope(solved.motion)
        return np.stack([inertia, direction * _torque(solved, inertia, slope)])

    found = cycle.curve(reduced, "forces", 2)
    edges, (inertia, torque) = found.edges, found.values
    edges = abs(rate) * (edges - cycle.course.begin)
    return Equivalent(
        forces=forces,
        speed=abs(rate),
        period=period,
        start=float(motion.input[0]),
        direction=direction,
        inertia_at=Curve(edges, inertia),
        load=TorqueCurve.from_pieces(Curve(edges, torque)),
    )


def steady_rate(motion: Motion) -> float:
    """The input's constant speed, rad/s; raises as :func:`equivalent`."""
    name = motion.mechanism.name
    if len(motion.mechanism.drivers) != 1 or not next(iter(motion.positions.rotary.values())):
        raise LinkwrightError(
            _(
                "a flywheel and the speed over the cycle need one turning driver; {name!r} has "
                "another kind or number",
                code="running.one_driver",
                name=name,
            )
        )
    rate = _rates(motion)[0]
    if rate[0] == 0 or np.ptp(rate) > 1e-9 * abs(rate[0]):
        raise LinkwrightError(
            _(
                "the driver of {name!r} does not turn at constant speed; give it speed: … instead of a law, and no "
                "cycle that rocks",
                code="running.not_constant",
                name=name,
            )
        )
    turned = abs(rate[0]) * (motion.positions.period or 0.0)
    if not motion.positions.closed or not turned or abs(turned / TURN - round(turned / TURN)) > 1e-9:
        raise LinkwrightError(_not_full_turns(motion.mechanism))
    if not motion.complete:
        raise LinkwrightError(
            _(
                "{name!r} does not reach all positions of its cycle, so it cannot run steadily",
                code="running.not_all_reached",
                name=name,
            )
        )
    return float(rate[0])


def _not_full_turns(mechanism: Mechanism) -> Message:
    if mechanism.higher and not_back(mechanism):
        return _(
            "the wheels or racks of {name!r} do not come back to where they began within {most} "
            "turns, so no cycle of it repeats; give teeth or radii in a ratio of smaller "
            "numbers",
            code="running.never_back",
            name=mechanism.name,
            most=MOST,
        )
    return _(
        "the cycle of {name!r} is not a number of full turns of its driver; leave cycle out, or give turns",
        code="running.not_whole_turns",
        name=mechanism.name,
    )


def _rates(motion: Motion) -> tuple[Floats, Floats]:
    """Rate and second derivative of the first driver's coordinate, (n,) each."""
    _unused, rate, second = next(iter(motion.positions.coordinates.values()))
    return rate, second
