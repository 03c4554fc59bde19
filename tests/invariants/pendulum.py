"""A crank with its mass off the axis that a motor turns over, and its speeds by elliptic integrals."""

from math import pi

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipkm1

#: A crank with its mass off the axis, against a constant torque: with the motor's torque on it a pendulum turns over.
PENDULUM = """
format: 1
name: heavy crank
frame: {{points: {{O: [0 m, 0 m]}}}}
links: {{crank: {{points: [O, A], length: 0.4 m, mass: 3 kg, inertia: 0.9 kg·m²}}}}
driver: {{turn: crank, about: O, speed: {speed} rpm}}
gravity: [0, -9.81 m/s²]
loads: {{work: {{kind: torque, on: crank, magnitude: {torque} N·m}}}}
"""


def pendulum_speeds(inertia: float, mean: float, mass: float = 3.0) -> tuple[float, float]:
    """Slowest and fastest: ½ J ω² = E - m g r (1 + sin φ); a turn takes 4 √(J/2E) K(2 m g r/E)."""
    lift = 2 * mass * 9.81 * 0.2
    total = inertia + mass * 0.2**2

    def late(power: float) -> float:
        above = np.exp(power)
        energy = lift * (1 + above)
        turn = 4 * np.sqrt(total / (2 * energy)) * ellipkm1(above / (1 + above))
        return float(turn) - 2 * pi / mean

    above = np.exp(brentq(late, -200.0, 20.0, xtol=1e-14, rtol=1e-15))
    return np.sqrt(2 * lift * above / total), np.sqrt(2 * lift * (1 + above) / total)
