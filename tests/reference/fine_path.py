"""The motion followed in steps so small that it cannot leave its assembly: the truth about branches.

On the whole-mechanism reference code: tangent predictor, Newton's method on all coordinates, and a step is taken
only if it is short, the sign of the Jacobian's determinant stays and the correction is a small part of it; else it
is halved.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from tests.reference.adapter import driver_values, reference_system, starting_position
from tests.reference.multibody import Array, Multibody

#: Largest and smallest step of a driver, rad or m; largest change of a coordinate; largest correction, as its share.
STEP, LEAST, LARGEST, SHARE = 2e-2, 1e-11, 0.05, 0.1
#: Places between two positions at which the drivers' laws are visited.
PARTS = 4


class FinePath:
    """Follows a mechanism from its drawing along its drivers' laws; ``reached`` positions before a singular one."""

    def __init__(self, mechanism: Any, time: Array, parts: int = PARTS) -> None:
        self.system: Multibody = reference_system(mechanism)
        u = driver_values(mechanism, time[:1])[0][0]
        q, here = starting_position(mechanism, self.system, u)
        first = self._corrected(q, here)
        assert first is not None
        self.q = first
        self.sign = self._sign(self.q)
        self.positions: list[Array] = []
        self.longest = STEP
        self.stop: Array | None = None
        between = np.concatenate([np.linspace(a, b, parts + 1)[1:] for a, b in pairwise(time)])
        places = driver_values(mechanism, np.concatenate([time[:1], between]))[0]
        for k, there in enumerate(places):
            if not self._leg(here, there):
                break
            if k % parts == 0:
                self.positions.append(self.q)
            here = there

    @property
    def reached(self) -> int:
        return len(self.positions)

    def direction(self, link: str) -> Array:
        """Unit vector of a link's x axis, (reached, 2)."""
        angle = np.array(self.positions)[:, self.system.index[link], 2]
        return np.stack([np.cos(angle), np.sin(angle)], axis=-1)

    def _leg(self, begin: Array, end: Array) -> bool:
        way = end - begin
        length = float(np.abs(way).max(initial=0.0))
        done = 0.0
        while done < 1.0 - 1e-15 and length > 0.0:
            step = min(self.longest / length, 1.0 - done)
            while not self._step(begin + done * way, way * step):
                step /= 2.0
                self.longest = step * length
                if self.longest < LEAST:
                    self.stop = begin + done * way
                    return False
            self.longest = min(2.0 * self.longest, STEP)
            done += step
        return True

    def _step(self, u: Array, change: Array) -> bool:
        guess = self.q.copy()
        moved = self.system.solve(self.system.jacobian(self.q)[:, 3:], self.system.selection @ change)
        guess[1:] += moved.reshape(-1, 3)
        if np.abs(moved).max() > LARGEST * (1.0 + np.abs(self.q).max()):
            return False
        new = self._corrected(guess, u + change)
        if new is None or self._sign(new) != self.sign:
            return False
        if np.abs(new - guess).max() > SHARE * np.abs(moved).max() + 1e-10:
            return False
        self.q = new
        return True

    def _corrected(self, q: Array, u: Array) -> Array | None:
        """The root near q; None where Newton's method does not converge."""
        for _ in range(8):
            step = self.system.solve(self.system.jacobian(q)[:, 3:], -self.system.residual(q, u))
            q = q.copy()
            q[1:] += step.reshape(-1, 3)
            if np.abs(step).max() < 1e-12 * (1.0 + np.abs(q).max()):
                return q
        return None

    def _sign(self, q: Array) -> float:
        jacobian = self.system.jacobian(q)[:, 3:]
        return float(np.linalg.slogdet(jacobian)[0]) if jacobian.shape[0] == jacobian.shape[1] else 1.0
