"""Linear vibration M ẍ + C ẋ + K x = F: modes, damping, frequency response, response in time."""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Complexes, Floats
from linkwright.core.dataclass import dataclass


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
        kept = values[values.imag >= -1e-9 * np.abs(values).max()]
        return np.asarray(kept[np.argsort(np.abs(kept))])

    @cached_property
    def damping_ratios(self) -> Floats:
        """ζ of every mode from the nearest pole, (n,); 0 for a mode without frequency."""
        found = np.zeros(len(self.mass))
        for i, frequency in enumerate(self.modes[0]):
            if frequency > 0.0 and self.damping.any():
                pole = self.poles[np.abs(np.abs(self.poles) - frequency).argmin()]
                found[i] = -pole.real / abs(pole)
        return np.where(np.abs(found) < 1e-12, 0.0, found)

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

    def in_time(self, time: Floats, force: Floats, start: Floats, rate: Floats) -> Floats:
        """Displacements (t, n) at even times (t,) under forces (t, n) that are linear between them: exact."""
        from scipy.linalg import expm

        n, h = len(self.mass), float(time[1] - time[0])
        inputs = np.vstack([np.zeros((n, n)), np.linalg.inv(self.mass)])
        whole = np.zeros((4 * n, 4 * n))
        whole[: 2 * n, : 2 * n], whole[: 2 * n, 2 * n : 3 * n] = self.state, inputs
        whole[2 * n : 3 * n, 3 * n :] = np.eye(n)
        step = expm(whole * h)[: 2 * n]
        now, found = np.concatenate([start, rate]), np.empty((len(time), n))
        found[0] = start
        for i in range(1, len(time)):
            slope = (force[i] - force[i - 1]) / h
            now = step @ np.concatenate([now, force[i - 1], slope])
            found[i] = now[:n]
        return found


def tuned(mass: float, stiffness: float, absorber: float) -> tuple[float, float]:
    """Stiffness (N/m) and damping (N·s/m) of the best damped absorber of a mass without damping of its own.

    f = 1/(1 + μ), ζ = √(3μ/(8(1 + μ)³)), c = 2 ζ m_a √(k/m) (Den Hartog, Mechanical Vibrations, ch. 3.3); the two
    fixed points are then of the height √(1 + 2/μ) of the static deflection.
    """
    ratio, frequency = absorber / mass, math.sqrt(stiffness / mass)
    own = frequency / (1.0 + ratio)
    return absorber * own**2, 2.0 * absorber * frequency * math.sqrt(3.0 * ratio / (8.0 * (1.0 + ratio) ** 3))
