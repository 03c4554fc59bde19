"""The follower as one mass on a spring that the cam moves: its deviation from the lift."""

from __future__ import annotations

import math

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.laws.program import MotionProgram, Program
from linkwright.laws.residual import residual
from linkwright.parts.vibration.linear import largest_between

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
