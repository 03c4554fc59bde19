"""The fold at the end of an input's range: where the Jacobian of all joints and drivers becomes singular."""

from __future__ import annotations

import math

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.kinematics.constraint_equations import ConstraintEquations
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.rank_of_motion import coordinates

#: Largest equation (lengths over the size, rad) that a found fold may leave, and Newton steps to get there.
CLOSED = 1e-12
STEPS = 25
#: What rounding leaves of the equations.
ROUNDED = 2e-15


def fold(motion: Motion, driver: str) -> tuple[float, float] | None:
    """The driver's coordinate (rad or m) at the fold nearest to the last position of a motion; None if not found.

    With it the error that is left, which is larger where two folds almost meet.

    Newton's method on the joints, the other drivers' coordinates, J v = 0 and |v| = 1, in the coordinates x of
    all links and the direction v in which they can still move while all drivers stand still (Govaerts, Numerical
    Methods for Bifurcations of Dynamical Equilibria, ch. 4). Its derivatives are exact.
    """
    positions = motion.positions
    if not motion.ok[-1]:
        return None
    start = coordinates(motion, -1)
    search = _Fold(ConstraintEquations(motion.mechanism), driver, start)
    found = search.solve(start)
    if found is None:
        return None
    x, unsure = found
    value = float(search.coordinate(driver, x))
    if positions.rotary[driver]:
        near, unit = float(positions.coordinates[driver][0][-1]), 1.0
        value += 2 * math.pi * round((near - value) / (2 * math.pi))
    else:
        unit = search.system.size
    return value * unit, (unsure + ROUNDED * (1.0 + abs(value))) * unit


class _Fold:
    def __init__(self, system: ConstraintEquations, driver: str, start: Floats) -> None:
        self.system = system
        self.drivers = list(system.mechanism.drivers)
        self.held = {name: self.coordinate(name, start) for name in self.drivers if name != driver}

    def coordinate(self, driver: str, x: Floats) -> float:
        """A driver's coordinate; lengths over the size."""
        return self.system.driver_row(driver, x).value

    def solve(self, start: Floats) -> tuple[Floats, float] | None:
        """Coordinates of all links at the fold, and what rounding leaves of them."""
        x = start
        v = np.linalg.svd(self._jacobian(x))[2][-1]
        normal = v.copy()
        for _ in range(STEPS):
            gap = np.concatenate([self._position(x), self._jacobian(x) @ v, [normal @ v - 1.0]])
            step = np.linalg.lstsq(self._derivative(x, v, normal), gap, rcond=None)[0]
            x, v = x - step[: len(x)], v - step[len(x) :]
            if not np.isfinite(x).all() or np.abs(x - start).max() > 0.5:
                return None
            if np.abs(step).max() < 1e-13:
                break
        left = max(np.abs(self._position(x)).max(), np.abs(self._jacobian(x) @ v).max())
        if left > CLOSED:
            return None
        smallest = float(np.linalg.svd(self._derivative(x, v, normal), compute_uv=False)[-1])
        return x, float(np.abs(step).max()) + ROUNDED / smallest

    def _position(self, x: Floats) -> Floats:
        held = [self.system.driver_row(name, x).value - q for name, q in self.held.items()]
        return np.concatenate([self.system.residual(x), held])

    def _jacobian(self, x: Floats) -> Floats:
        return self.system.matrix([*self.system.rows(x), *(self.system.driver_row(n, x) for n in self.drivers)])

    def _held_jacobian(self, x: Floats) -> Floats:
        rows = [*self.system.rows(x), *(self.system.driver_row(name, x) for name in self.held)]
        return self.system.matrix(rows)

    def _derivative(self, x: Floats, v: Floats, normal: Floats) -> Floats:
        top = self._held_jacobian(x)
        return np.block(
            [
                [top, np.zeros_like(top)],
                [self.system.second(x, v), self._jacobian(x)],
                [np.zeros((1, len(x))), normal[None, :]],
            ]
        )
