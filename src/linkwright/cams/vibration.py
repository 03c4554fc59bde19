"""The follower as one mass on a spring that the cam moves: what it does beside what it should."""

from __future__ import annotations

import math

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.laws.program import MotionProgram, Program
from linkwright.laws.residual import residual

#: Places of the turn for its harmonics.
_PLACES = 4096


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
    """Largest |z| (n,) over the turn in steady motion, z̈ + 2ζω ż + ω² z = -s̈, by the harmonics of s''.

    Infinite where, without damping, a harmonic of the cam meets the natural frequency.
    """
    phi = program.period * np.arange(_PLACES) / _PLACES
    parts = np.fft.rfft(program.curves(phi)[2])
    order = np.arange(len(parts)) * 2 * math.pi / program.period
    found = np.zeros(len(speeds))
    for i, speed in enumerate(speeds.tolist()):
        w = order * speed
        stiffness = frequency**2 - w**2 + 2j * damping_ratio * frequency * w
        resonant = np.abs(stiffness) < 1e-12 * frequency**2
        driven = np.abs(parts) > 1e-12 * np.abs(parts).max()
        if (resonant & driven).any():
            found[i] = math.inf
            continue
        z = np.fft.irfft(-parts * speed**2 / np.where(resonant, 1.0, stiffness), _PLACES)
        found[i] = float(np.abs(z).max())
    return found
