"""Rectangular cross sections: the width at which stress, an eye or a strut holds. Closed forms, SI units."""

from __future__ import annotations

import math

import numpy as np

from linkwright.core.arrays import Floats

#: Halvings of the interval in which the width of a bored section lies.
HALVINGS = 40


def gross_width(normal: Floats, moment: Floats, thickness: float, stress: float) -> Floats:
    """The width w with N/(t w) + 6 M/(t w²) = σ, of sizes of N and M."""
    return np.asarray((normal + np.sqrt(normal**2 + 24.0 * moment * thickness * stress)) / (2.0 * thickness * stress))


def net_width(normal: Floats, moment: Floats, bore: Floats | float, thickness: float, stress: float) -> Floats:
    """The width w with N/(t (w − d)) + 6 M w/(t (w³ − d³)) = σ, a hole d in the middle."""
    low = np.zeros(np.broadcast(normal, moment, bore).shape)
    high = gross_width(normal, moment, thickness, stress) + low
    for _unused in range(HALVINGS):
        middle = 0.5 * (low + high)
        wide = net_stress(normal, moment, bore, middle + bore, thickness) < stress
        low, high = np.where(wide, low, middle), np.where(wide, middle, high)
    return np.asarray(high + bore)


def net_stress(normal: Floats, moment: Floats, bore: Floats | float, width: Floats, thickness: float) -> Floats:
    """N/(t (w − d)) + 6 M w/(t (w³ − d³)), of sizes of N and M."""
    with np.errstate(divide="ignore", invalid="ignore"):
        pull = normal / (thickness * (width - bore))
        bend = 6.0 * moment * width / (thickness * (width**3 - np.asarray(bore) ** 3))
        return np.asarray(np.where(normal > 0.0, pull, 0.0) + np.where(moment > 0.0, bend, 0.0))


def eye_width(force: float, bore: float, thickness: float, stress: float) -> float:
    """The width of a round eye with a hole d that a force pulls in any direction: F/(t σ) + 7 d/3.

    EN 1993-1-8, table 3.9, type A: a ≥ F/(2 t σ) + 2 d/3 from the edge of the hole to that of the plate, and sideways
    F/(2 t σ) + d/3; in a round eye both are (w − d)/2.
    """
    return force / (thickness * stress) + 7.0 * bore / 3.0


def limit_slenderness(strength: float, modulus: float) -> float:
    """The slenderness from which Euler's formula holds: π √(2 E/Re)."""
    return math.pi * math.sqrt(2.0 * modulus / strength)


def buckling_stress(slenderness: float, strength: float, modulus: float) -> float:
    """Stress, Pa, at which a strut buckles: π² E/λ² (Euler), below the limit Re (1 − Re λ²/(4 π² E)) (Johnson).

    Shigley, Mechanical Engineering Design, sections 4-12 and 4-13.
    """
    if slenderness >= limit_slenderness(strength, modulus):
        return math.pi**2 * modulus / slenderness**2
    return strength * (1.0 - strength * slenderness**2 / (4.0 * math.pi**2 * modulus))


def slenderness(length: float, smaller_side: float) -> float:
    """λ = L/i of a strut with pins at its ends, i = a/√12 of the smaller side a."""
    return math.sqrt(12.0) * length / smaller_side
