"""A plain loop of SciPy from one singular position to the next, as a reference for those that do more."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import solve_ivp

from linkwright.core.arrays import Floats
from linkwright.dynamics.change_points import Bridged
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.right_side import RightSide, state_slopes
from linkwright.dynamics.singular import SingularPositions, Stretch
from linkwright.mechanism.mechanism import Mechanism


@dataclass
class Course:
    """Stretches with their states (2 n + 1, steps), the kinetic energies (steps,) there, and times."""

    stretches: list[Stretch] = field(default_factory=list)
    states: list[Floats] = field(default_factory=list)
    times: list[Floats] = field(default_factory=list)
    kinetic: list[Floats] = field(default_factory=list)

    @property
    def drift(self) -> float:
        """Energy that is gained or lost, as share of the largest one."""
        kinetic = np.concatenate(self.kinetic)
        work = np.concatenate([each[-1] for each in self.states])
        return float(np.abs(kinetic - kinetic[0] - work).max() / np.abs(kinetic).max())

    @property
    def coordinates(self) -> list[list[str]]:
        """The coordinates of each stretch."""
        return [each.description.names for each in self.stretches]


def integrated(mechanism: Mechanism, q: list[float], w: list[float], end: float, tolerance: float = 1e-12) -> Course:
    """The motion until a time, s, from coordinates and rates."""
    positions = SingularPositions(EquationOfMotion(mechanism, flipping=True))
    stretch, now, rates = positions.first(np.array(q), np.array(w))
    n, t, course = len(q), 0.0, Course()
    y = np.array([*now, *rates, 0.0])
    while True:
        course.stretches.append(stretch)
        slopes, full = sides(stretch, n)
        assert np.isfinite(slopes(t, y)).all(), y

        def margin(t: float, y: Floats, stretch: Stretch = stretch, full: RightSide | Bridged = full) -> float:
            full.x[: 2 * n] = y[: 2 * n]
            full.call()
            groups = len(stretch.description.equation.groups)
            return stretch.margin(full.out[len(full.out) - groups :], full)

        margin.terminal, margin.direction = True, -1  # type: ignore[attr-defined]
        found = solve_ivp(
            slopes, (t, end), y, method="DOP853", rtol=tolerance, atol=tolerance, events=margin, max_step=0.05
        )
        assert found.status >= 0, found.message
        course.states.append(found.y)
        course.times.append(found.t)
        kinetic = []
        for each in found.y.T:
            full.x[: 2 * n] = each[: 2 * n]
            full.call()
            kinetic.append(full.out[n + 1])
        course.kinetic.append(np.array(kinetic))
        t, y = found.t[-1], found.y[:, -1]
        if found.status == 0:
            return course
        stretch, now, rates = positions.next(stretch, y[:n], y[n : 2 * n])
        y = np.array([*now, *rates, y[-1]])


def sides(stretch: Stretch, n: int) -> tuple[Callable[[float, Floats], Floats], RightSide | Bridged]:
    """The right-hand side of a stretch, and one with kinetic energy and qualities as well."""
    description = stretch.description
    equation = description.equation
    names = [*(f"qdd:{name}" for name in equation.free), "power"]
    more = [*names, "kinetic", *(f"closure:{group}" for group in equation.groups)]
    first = [f"{kind}:{name}" for kind in ("q", "qd") for name in equation.free]
    slim, full = (
        stretch.side(
            RightSide(equation.program(each), equation.numbers, tables=equation.tables, first=[*first, "time"])
        )
        for each in (names, more)
    )
    return state_slopes(slim, n), full
