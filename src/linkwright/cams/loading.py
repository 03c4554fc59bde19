"""Contact force, torque, Hertzian pressure and springs of a cam at constant speed, and its follower's vibration."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from linkwright.cams.curves import Contact
from linkwright.cams.follower import Follower, LiftQuantity
from linkwright.core.arrays import Floats
from linkwright.curves.curve import Curve, Extreme
from linkwright.fields.base import Quantity, file_key
from linkwright.laws.program import MotionProgram, Program
from linkwright.laws.residual import residual
from linkwright.parts.vibration.linear import largest_between


@dataclass(frozen=True)
class CamSpring:
    """Presses the follower on the cam: ``stiffness`` (N/m or N·m/rad), ``preload`` (N or N·m) at zero lift."""

    stiffness: float | None = file_key(
        LiftQuantity("stiffness", "torsional_stiffness", minimum=0.0, doc="chosen by default"), None
    )
    preload: float | None = file_key(
        LiftQuantity("force", "torque", minimum=0.0, doc="at zero lift; chosen by default"), None
    )


@dataclass(frozen=True)
class CamMaterial:
    """Young's moduli (Pa) and Poisson's ratios of cam and follower."""

    modulus: float = file_key(Quantity("pressure", above=0.0, required=True, doc="Young's modulus of the cam"), 210e9)
    poisson: float = file_key(Quantity("dimensionless", minimum=0.0, doc="Poisson's ratio, 0.3"), 0.3)
    follower_modulus: float | None = file_key(
        Quantity("pressure", above=0.0, doc="of the follower (default: the same)"), None
    )
    follower_poisson: float | None = file_key(Quantity("dimensionless", minimum=0.0, doc="of the follower"), None)

    @property
    def contact_modulus(self) -> float:
        """E* with 1/E* = (1 - ν₁²)/E₁ + (1 - ν₂²)/E₂, Pa."""
        other = self.modulus if self.follower_modulus is None else self.follower_modulus
        ratio = self.poisson if self.follower_poisson is None else self.follower_poisson
        return 1.0 / ((1 - self.poisson**2) / self.modulus + (1 - ratio**2) / other)


@dataclass(frozen=True)
class CamLoading:
    """``speed`` ω of the cam (rad/s), ``mass`` (kg or kg·m²) of the follower, a constant ``load`` towards the cam."""

    speed: float = 0.0
    mass: float = 0.0
    load: float = 0.0
    spring: CamSpring = CamSpring()

    def demand(self, program: Program, phi: Floats) -> Floats:
        """Force (moment) towards the cam that inertia and load leave to the spring, (n,)."""
        return np.asarray(-self.mass * self.speed**2 * program.curves(phi)[2] - self.load)

    def effort(self, program: Program, phi: Floats) -> Floats:
        """What the cam must exert along the follower's coordinate, N or N·m: m ω² s'' + load + F₀ + k s."""
        s = program.curves(phi)[0]
        pressed = (self.spring.preload or 0.0) + (self.spring.stiffness or 0.0) * s
        return np.asarray(pressed - self.demand(program, phi))

    def with_spring(self, program: Program, phi: Floats, minimum: float) -> CamLoading:
        """The loading with a spring that leaves an effort of ``minimum``: what is not set is chosen.

        Without stiffness and preload those with the minimum mean force, a linear program of two unknowns.
        """
        need = self.demand(program, phi) + minimum
        s = program.curves(phi)[0]
        k, preload = self.spring.stiffness, self.spring.preload
        if k is None and preload is None:
            k = _best_stiffness(s, need)
        if preload is None:
            assert k is not None
            preload = max(0.0, float((need - k * s).max()))
        if k is None:
            lifted = s > 1e-9 * max(float(np.ptp(s)), 1e-12)
            k = max(0.0, float(((need[lifted] - preload) / s[lifted]).max(initial=0.0)))
        return replace(self, spring=CamSpring(k, preload))._between_places(self.spring, program, minimum)

    def _between_places(self, asked: CamSpring, program: Program, minimum: float) -> CamLoading:
        """The loading with what was chosen of its spring made larger by what misses between the places of a look."""
        found, half = self, 0.5 * program.lifts[1]
        for _ in range(8):
            lowest, spring = found.minimum_effort(program), found.spring
            missing = minimum - lowest.value
            height = float(program.curves(np.array([lowest.place]))[0][0])
            high = height > (half if asked.preload is None else 0.0)
            if missing <= 0.0:
                break
            if asked.stiffness is None and high:
                spring = replace(spring, stiffness=(spring.stiffness or 0.0) + missing / height)
            elif asked.preload is None:
                spring = replace(spring, preload=(spring.preload or 0.0) + missing)
            else:
                break
            found = replace(found, spring=spring)
        return found

    def minimum_effort(self, program: Program) -> Extreme:
        """The smallest effort over the turn, N or N·m, with its place, found between all places."""
        inner = program.breaks[(program.breaks > 0) & (program.breaks < program.period)]
        effort = Curve.of(lambda phi: self.effort(program, phi), 0.0, program.period, pieces=24, knots=inner)
        return effort.extreme("min")


def _best_stiffness(s: Floats, need: Floats) -> float:
    """The stiffness that minimizes the mean of F₀ + k s, while F₀ + k s >= need everywhere."""
    from scipy.optimize import linprog

    height = float(s.max())
    if not np.ptp(s):
        return 0.0
    size = max(float(np.abs(need).max()), 1e-12)
    found = linprog(
        [1.0, float(s.mean()) / height],
        A_ub=-np.column_stack([np.ones(len(s)), s / height]),
        b_ub=-need / size,
        bounds=[(0, None), (0, None)],
        method="highs",
    )
    return float(found.x[1]) * size / height


def leverage(follower: Follower, contact: Contact) -> Floats:
    """Normal velocity of the follower at the contact per unit of its coordinate's rate, (n,): 1 or m per rad."""
    arm: Floats = np.ones(len(contact.curvature))
    if follower.oscillating:
        arm = np.abs(contact.along) if follower.kind == "flat" else np.full(len(arm), follower.arm or 0.0)
        if follower.kind == "flat":
            return np.asarray(arm)
    return np.asarray(arm * np.cos(contact.pressure_angle))


def contact_pressure(
    force: Floats, contact: Contact, follower: Follower, width: float, material: CamMaterial
) -> Floats:
    """Hertz's pressure (Pa) of the line contact: √(F E*/(π b R)), 1/R of profile and roller; 0 without force."""
    curvature = contact.curvature + (1.0 / follower.roller_radius if follower.kind == "roller" else 0.0)
    inside = np.maximum(force, 0.0) * material.contact_modulus * np.maximum(curvature, 0.0) / (math.pi * width)
    return np.asarray(np.sqrt(inside))


#: Steps of the turn at least, doubled so often at most where a natural period has fewer than PER_PERIOD of them.
_PLACES, _FINEST, PER_PERIOD = 1440, 4, 64
#: Gauss points of a step and their shares.
_AT, _SHARE = (
    0.5 * (each + shift) for each, shift in zip(np.polynomial.legendre.leggauss(5), (1.0, 0.0), strict=True)
)
#: det(I - e^(AT)), the square of the distance to a harmonic in turns, below which nothing tells it from one.
_RESONANCE = 1e-20


def residual_amplitude(program: MotionProgram, frequency: float, speeds: Floats) -> Floats:
    """Amplitude (n, k) left after each of the k moving segments at speeds (n,) rad/s of a cam, without damping.

    z̈ + ω² z = -s̈ from rest; ``frequency`` ω in rad/s (Norton, Cam Design and Manufacturing Handbook, ch. 11).
    """
    columns = []
    for segment, (law, scale) in zip(program.segments, program.moved_by, strict=True):
        if law is not None:
            ratio = segment.over / speeds * frequency / (2 * math.pi)
            columns.append(abs(scale) * residual(law, ratio))
    return np.stack(columns, axis=1)


def steady_deviation(program: Program, frequency: float, damping_ratio: float, speeds: Floats) -> Floats:
    """Largest |z| (n,) over the turn in steady motion, z̈ + 2ζω ż + ω² z = -s̈, exact for any program.

    Infinite where, without damping, a harmonic of the cam meets the natural frequency; 0 at rest.
    """
    found = np.zeros(len(speeds))
    turning = speeds > 0
    ratio = frequency / np.where(turning, speeds, 1.0)
    finer = np.clip(np.ceil(np.log2(PER_PERIOD * ratio / _PLACES)), 0, _FINEST).astype(int)
    for level in np.unique(finer[turning]).tolist():
        here = turning & (finer == level)
        found[here] = _steady(program, ratio[here], damping_ratio, _PLACES << level)
    return found


def _steady(program: Program, ratio: Floats, damping_ratio: float, count: int) -> Floats:
    """Largest |z| (n,) where the natural frequency is ``ratio`` (n,) times the speed, by ``count`` steps."""
    edges = np.append(np.unique(np.append(program.places(count), program.breaks)), program.period)
    edges = np.unique(edges[edges <= program.period])
    h = np.diff(edges)
    state = np.zeros((len(ratio), 2, 2))
    state[:, 0, 1], state[:, 1, 0], state[:, 1, 1] = 1.0, -(ratio**2), -2 * damping_ratio * ratio
    pull = -np.asarray(program.curves((edges[:-1, None] + h[:, None] * _AT).ravel())[2]).reshape(len(h), -1)
    lengths, which = np.unique(np.round(h, 12), return_inverse=True)
    steps = [_step(state, length) for length in lengths.tolist()]

    def over_a_turn(now: Floats) -> Floats:
        passed = [now]
        for force, kind in zip(pull, which.tolist(), strict=True):
            own, driven = steps[kind]
            now = np.einsum("nij,nj->ni", own, now) + driven @ force
            passed.append(now)
        return np.array(passed)

    left = over_a_turn(np.zeros((len(ratio), 2)))[-1]
    system_matrix = np.eye(2) - _exponential(state, program.period)
    resonant = np.linalg.det(system_matrix) < _RESONANCE
    system_matrix[resonant] = np.eye(2)
    start = np.linalg.solve(system_matrix, left[:, :, None])[:, :, 0]
    start[resonant] = 0.0
    passed = over_a_turn(start)
    found = np.array([abs(largest_between(edges, passed[:, k, 0], passed[:, k, 1])[1]) for k in range(len(ratio))])
    grows = resonant & (np.abs(left[:, 0]) + np.abs(left[:, 1]) / ratio > 1e-9 * found)
    return np.where(grows, math.inf, found)


def _step(state: Floats, length: float) -> tuple[Floats, Floats]:
    """What a step makes of the state, (n, 2, 2), and of the acceleration at its Gauss points, (n, 2, points)."""
    driven = [_exponential(state, length * (1 - at))[:, :, 1] * length * w for at, w in zip(_AT, _SHARE, strict=True)]
    return _exponential(state, length), np.stack(driven, axis=2)


def _exponential(state: Floats, length: float) -> Floats:
    from scipy.linalg import expm

    return np.asarray(expm(state * length))
