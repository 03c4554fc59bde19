"""Andrews' squeezer: the printed state at 0.03 s and what of our links it speaks of.

Source: Mazzia and Magherini, Test Set for Initial Value Problem Solvers, release 2.4, 2008, problem Andrews'
squeezing mechanism, after Hairer and Wanner, Solving Ordinary Differential Equations II, section VII.7.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from tests.reference.multibody import Array

END = 0.03
#: beta, theta, gamma, phi, delta, Omega, epsilon; rad, rad/s, rad/s².
START = (
    -0.0617138900142764496358948458001,
    0.0,
    0.455279819163070380255912382449,
    0.222668390165885884674473185609,
    0.487364979543842550225598953530,
    -0.222668390165885884674473185609,
    1.23054744454982119249735015568,
)
ANGLES = (
    15.81077119629904,
    -15.75637105984298,
    0.04082224013073101,
    -0.5347301163226948,
    0.5244099658805304,
    0.5347301163226948,
    1.048080741042263,
)
RATES = (
    1139.920302151208,
    -1424.379294994111,
    11.03291221937134,
    19.29337464421385,
    0.5735699284790808,
    -19.29337464421385,
    0.3231791658026955,
)
ACCELERATIONS = (
    -24631.76316945196,
    51850.37701610329,
    324102.5686413781,
    566749.3645176213,
    16743.62929479361,
    -566749.3645176222,
    9826.520791458422,
)
#: Angular acceleration of the crank at the start, rad/s², and the mass matrix's element of beta there, kg·m².
FIRST_ACCELERATION = 14222.4439199541
#: Forces (x, y) at E, N: on K3, on K4, on K6: the six multipliers.
FORCES = {
    "K3": (199.1753333731910, -29.75531228015052),
    "K4": (23.06654119098399, 31.45271365475927),
    "K6": (22.64249232082739, 11.61740700019673),
}


def seven(links: Mapping[str, float], order: int) -> Array:
    """The seven coordinates of the test set, or their first or second rates, from those of the links K1, K2, …"""
    b, t, g, d, e = (links[name] for name in ("K1", "K2", "K3", "K5", "K7"))
    right = np.pi / 2 if order == 0 else 0.0
    found = (b, t - b - 2 * right, g + right, links["K4"] - d + right, d, links["K6"] - e - right, e + right)
    return np.array(found)


def off(links: Mapping[str, float], order: int) -> float:
    """Largest relative difference from the printed numbers; angles up to full turns."""
    printed = np.array((ANGLES, RATES, ACCELERATIONS)[order])
    gap = seven(links, order) - printed
    if order == 0:
        gap = np.angle(np.exp(1j * gap))
    return float(np.abs(gap / printed).max())
