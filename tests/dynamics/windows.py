"""Rows of N windows through their singular positions, against the closed form of the pendulum that they are.

    python -m tests.dynamics.windows [N ...]

All uprights of a row stay parallel: one pendulum with the inertia of all rods. It turns over from its highest place
with 1 m/s of its upper ends, through positions in which all rods lie in a line; its angle is an elliptic function.
Source of the problem: IFToMM Technical Committee for Multibody Dynamics, Library of Computational Benchmark Problems,
N four-bar mechanism.

Exit code: 0 energy kept to 1e-10 and places right to 1e-9 m for 10 s, 1 not.
"""

from __future__ import annotations

import sys
import time

import numpy as np
from scipy.special import ellipj, ellipk
from tests.dynamics.models import windows
from tests.reference.multibody import Array

import linkwright as lw

G, END, SPEED = 9.81, 10.0, -1.0


def angle(n: int, times: Array) -> Array:
    """The uprights' angle at the times: φ/2 = am(Ω t/2 + K, m) from the lowest place, m = 4 W/(J Ω²)."""
    inertia, weight = (n + 1) / 3 + n, ((n + 1) / 2 + n) * G
    lowest = SPEED**2 + 4 * weight / inertia
    m = 4 * weight / inertia / lowest
    amplitude = ellipj(np.sqrt(lowest) / 2 * times + ellipk(m), m)[3]
    return np.asarray(np.pi / 2 - (2 * amplitude - np.pi))


def off(n: int, end: float = END, tolerance: float = 1e-12) -> tuple[lw.Run, float]:
    """A run of N windows, and how far its first upper end is from where it must be, m at most."""
    found = lw.run(lw.loads(windows(n)), speed=SPEED, duration=end, tolerance=tolerance)
    times = np.linspace(0.0, end, 101)
    place, right = found.motion(times=times).point("B0").position, angle(n, times)
    return found, float(np.abs(place - np.column_stack([np.cos(right), np.sin(right)])).max())


def main() -> int:
    worse = False
    for n in [int(each) for each in sys.argv[1:]] or [2, 5, 10, 20, 40]:
        begun = time.perf_counter()
        found, gap = off(n)
        worse |= not (found.energy_residual < 1e-10 and gap < 1e-9)
        wall = time.perf_counter() - begun
        print(f"{n} windows, {END} s: energy {found.energy_residual:.1e}, place {gap:.1e} m, {wall:.1f} s")
    return int(worse)


if __name__ == "__main__":
    sys.exit(main())
