"""Small vibrations about a position at rest: natural frequencies, modes, damping ratios, stability."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from linkwright.core.arrays import Floats

Stability = Literal["stable", "unstable", "neutral", "one_sided", "held", "stopped"]
#: Share of the largest stiffness, or asymmetry of it, that is rounding.
ROUNDING = 1e-9


@dataclass(frozen=True)
class SmallVibrations:
    """Modes about a position at rest, M x'' + C x' + K x = 0, stiffest last.

    ``squares`` (modes,): ω², 1/s²; negative of a mode that moves away, complex of one that flutters. ``shapes``
    (freedoms, modes): inputs in a mode, the largest one 1 (a rad counts as much as a metre). ``damping_ratios``
    (modes,): ζ = xᵀCx/(2 ω xᵀMx), exact for one freedom and for damping that does not couple the modes, NaN of modes
    that do not vibrate. ``eigenvalues`` (2 · freedoms,): exact ones of the damped motion exp(s·t), 1/s.

    Source: Meirovitch, Fundamentals of Vibrations, chapters 6 and 7.
    """

    squares: Floats
    shapes: Floats
    damping_ratios: Floats
    eigenvalues: Floats

    @property
    def frequencies(self) -> Floats:
        """Natural frequencies (modes,), Hz; NaN of modes that do not vibrate."""
        with np.errstate(invalid="ignore"):
            real = np.where(np.abs(np.imag(self.squares)) > 0.0, np.nan, np.real(self.squares))
            return np.asarray(np.sqrt(np.where(real > 0.0, real, np.nan)) / (2.0 * np.pi))

    @property
    def growth_rates(self) -> Floats:
        """How fast modes without damping move away, (modes,) 1/s: x grows as exp(rate·t); 0 of those that do not."""
        return np.asarray(np.abs(np.real(np.sqrt(-np.asarray(self.squares, dtype=complex)))))


def small_vibrations(inertia: Floats, stiffness: Floats, damping: Floats) -> SmallVibrations | None:
    """Modes from matrices (freedoms, freedoms); None where some motion has no inertia."""
    import scipy.linalg

    n = len(inertia)
    mass = 0.5 * (inertia + inertia.T)
    unit = np.sqrt(np.abs(np.diag(mass)))
    if not (unit > 0.0).all() or np.linalg.eigvalsh(mass / np.outer(unit, unit)).min() < ROUNDING:
        return None
    if is_symmetric(stiffness):
        squares, shapes = scipy.linalg.eigh(0.5 * (stiffness + stiffness.T), mass)
    else:
        squares, shapes = scipy.linalg.eig(stiffness, mass)
        order = np.argsort(np.real(squares))
        squares, shapes = squares[order], shapes[:, order]
        if np.abs(np.imag(squares)).max() <= ROUNDING * np.abs(squares).max():
            squares, shapes = np.real(squares), np.real(shapes)
    largest = np.abs(shapes).argmax(axis=0)
    shapes = shapes / shapes[largest, np.arange(n)]
    with np.errstate(invalid="ignore", divide="ignore"):
        lost = np.real(np.einsum("im,ij,jm->m", shapes, damping, shapes))
        moved = np.real(np.einsum("im,ij,jm->m", shapes, mass, shapes))
        rate = np.sqrt(np.where(np.isreal(squares) & (np.real(squares) > 0.0), np.real(squares), np.nan))
        ratios = lost / (2.0 * rate * moved)
    state = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(mass, np.hstack([stiffness, damping]))]])
    return SmallVibrations(squares, shapes, ratios, np.linalg.eigvals(state))


def is_symmetric(stiffness: Floats) -> bool:
    """Whether forces have a potential: the stiffness is symmetric but for rounding."""
    return bool(np.abs(stiffness - stiffness.T).max() <= ROUNDING * np.abs(stiffness).max())


def stability(stiffness: Floats, vibrations: SmallVibrations | None) -> Stability:
    """What a stiffness, in units in which 1 is large, says of a position at rest.

    With a potential: stable where K is positive definite (Lagrange–Dirichlet), neutral where it is but for some
    directions in which it is zero; else stable where all modes vibrate.
    """
    if is_symmetric(stiffness) or vibrations is None:
        values = np.linalg.eigvalsh(0.5 * (stiffness + stiffness.T))
        if values.min() > ROUNDING:
            return "stable"
        return "neutral" if values.min() >= -ROUNDING else "unstable"
    squares = vibrations.squares
    if np.iscomplexobj(squares) and np.abs(np.imag(squares)).max() > 0.0:
        return "unstable"
    smallest, largest = np.real(squares).min(), np.abs(squares).max()
    if abs(smallest) <= ROUNDING * largest:
        return "neutral"
    return "stable" if smallest > 0.0 else "unstable"
