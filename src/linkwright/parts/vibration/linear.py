"""Linear vibration M ẍ + C ẋ + K x = F: modes, damping, frequency response, response in time."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Complexes, Floats


@dataclass(frozen=True)
class Linear:
    """Matrices (n, n) of a linear system in SI units; M positive definite (Thomson, Theory of Vibration, ch. 6)."""

    mass: Floats
    damping: Floats
    stiffness: Floats

    @cached_property
    def modes(self) -> tuple[Floats, Floats]:
        """Undamped natural frequencies (n,) rad/s, rising, and modes (n, n) in columns with φᵀ M φ = 1."""
        from scipy.linalg import eigh

        squares, shapes = eigh(self.stiffness, self.mass)
        tidy = np.where(np.abs(squares) < 1e-13 * np.abs(squares).max(), 0.0, squares)
        return np.sqrt(np.maximum(tidy, 0.0)), shapes

    @cached_property
    def poles(self) -> Complexes:
        """Eigenvalues of the damped system with positive imaginary part or on the real axis, by size."""
        values = np.linalg.eigvals(self.state)
        upper = values[values.imag >= -1e-9 * np.abs(values).max()]
        return np.asarray(upper[np.argsort(np.abs(upper))])

    @cached_property
    def damping_ratios(self) -> Floats:
        """ζ of every mode, (n,), above 1 where it does not swing; 0 for a mode without frequency.

        Of dampers that do not couple the modes φᵀCφ/(2ω); of others each mode's own pole or pair of real poles, the
        one of nearest size.
        """
        frequency, shapes = self.modes
        own = shapes.T @ self.damping @ shapes
        moving = frequency > 0.0
        found = np.zeros(len(frequency))
        if not moving.any() or not self.damping.any():
            return found
        if np.abs(own - np.diag(np.diag(own))).max() <= 1e-9 * np.abs(own).max():
            found[moving] = np.diag(own)[moving] / (2 * frequency[moving])
        else:
            found[moving] = self._nearest_ratios(frequency[moving])
        return np.where(np.abs(found) < 1e-12, 0.0, found)

    def _nearest_ratios(self, frequency: Floats) -> Floats:
        """Damping ratios of the poles that lie nearest to natural frequencies (k,), each taken once."""
        from scipy.optimize import linear_sum_assignment

        largest = np.abs(self.poles).max()
        swinging = self.poles[self.poles.imag > 1e-9 * largest]
        real = np.sort(-self.poles.real[(self.poles.imag <= 1e-9 * largest) & (np.abs(self.poles) > 1e-9 * largest)])
        real = real[len(real) % 2 :]
        slow, fast = real[: len(real) // 2], real[len(real) // 2 :][::-1]
        sizes = np.concatenate([np.abs(swinging), np.sqrt(slow * fast)])
        ratios = np.concatenate([-swinging.real / np.abs(swinging), (slow + fast) / (2 * np.sqrt(slow * fast))])
        modes, places = linear_sum_assignment(np.abs(np.log(sizes[None, :] / frequency[:, None])))
        found = np.zeros(len(frequency))
        found[modes] = ratios[places]
        return found

    @property
    def state(self) -> Floats:
        """Matrix of (x, ẋ), (2n, 2n)."""
        n = len(self.mass)
        inverse = np.linalg.inv(self.mass)
        return np.block([[np.zeros((n, n)), np.eye(n)], [-inverse @ self.stiffness, -inverse @ self.damping]])

    def response(self, frequency: ArrayLike, force: Complexes | Floats) -> Complexes:
        """Complex amplitudes (f, n) at angular frequencies (f,) under F e^(iωt), ``force`` (n,) or (f, n)."""
        w = np.atleast_1d(np.asarray(frequency, dtype=float))[:, None, None]
        dynamic = self.stiffness - w**2 * self.mass + 1j * w * self.damping
        right = np.broadcast_to(np.asarray(force, dtype=complex), (len(w), len(self.mass)))
        return np.asarray(np.linalg.solve(dynamic, right[..., None])[..., 0])

    def in_time(
        self, time: Floats, force: Floats, start: Floats, rate: Floats, blows: Mapping[int, Floats] | None = None
    ) -> tuple[Floats, Floats]:
        """Displacements and rates (t, n) at times (t,) under forces (t, n) that are linear between them: exact.

        A time listed twice is a jump of the force; ``blows``: impulses (n,) by the index of their time.
        """
        n = len(self.mass)
        inverse = np.linalg.inv(self.mass)
        now, found = np.concatenate([start, rate]), np.empty((len(time), 2 * n))
        steps: dict[float, Floats] = {}
        for i in range(len(time)):
            h = float(time[i] - time[i - 1]) if i else 0.0
            if h > 0.0:
                slope = (force[i] - force[i - 1]) / h
                now = self._step(h, steps) @ np.concatenate([now, force[i - 1], slope])
            if blows and i in blows:
                now = now + np.concatenate([np.zeros(n), inverse @ blows[i]])
            found[i] = now
        return found[:, :n], found[:, n:]

    def _step(self, h: float, known: dict[float, Floats]) -> Floats:
        """What a step of length h makes of state, force and its slope, (2n, 4n)."""
        from scipy.linalg import expm

        key = float(f"{h:.11g}")
        if key not in known:
            n = len(self.mass)
            augmented = np.zeros((4 * n, 4 * n))
            augmented[: 2 * n, : 2 * n] = self.state
            augmented[n : 2 * n, 2 * n : 3 * n] = np.linalg.inv(self.mass)
            augmented[2 * n : 3 * n, 3 * n :] = np.eye(n)
            known[key] = expm(augmented * h)[: 2 * n]
        return known[key]


def largest_between(time: Floats, value: Floats, rate: Floats) -> tuple[float, float]:
    """Place and value of largest size of a curve of values and rates (t,), between its places by cubics."""
    h = np.diff(time)
    increasing = h > 0
    h, low = h[increasing], value[:-1][increasing]
    first, last = rate[:-1][increasing] * h, rate[1:][increasing] * h
    rise = value[1:][increasing] - low
    square, cube = 3 * rise - 2 * first - last, first + last - 2 * rise
    with np.errstate(all="ignore"):
        root = np.sqrt(square**2 - 3 * cube * first)
        half = -(square + np.copysign(root, square))
        inner = np.stack([half / (3 * cube), first / half])
    share = np.clip(np.nan_to_num(inner, nan=0.0, posinf=0.0, neginf=0.0), 0.0, 1.0)
    share = np.concatenate([share, [np.zeros_like(h), np.ones_like(h)]])
    found = low + share * (first + share * (square + share * cube))
    i, k = np.unravel_index(int(np.abs(found).argmax()), found.shape)
    return float(time[:-1][increasing][k] + share[i, k] * h[k]), float(found[i, k])


def tuned(mass: float, stiffness: float, absorber: float) -> tuple[float, float]:
    """Stiffness (N/m) and damping (N·s/m) of the best damped absorber of a mass without damping of its own.

    f = 1/(1 + μ), ζ = √(3μ/(8(1 + μ)³)), c = 2 ζ m_a √(k/m) (Den Hartog, Mechanical Vibrations, ch. 3.3); the two
    fixed points are then of the height √(1 + 2/μ) of the static deflection.
    """
    ratio, frequency = absorber / mass, math.sqrt(stiffness / mass)
    own = frequency / (1.0 + ratio)
    return absorber * own**2, 2.0 * absorber * frequency * math.sqrt(3.0 * ratio / (8.0 * (1.0 + ratio) ** 3))
