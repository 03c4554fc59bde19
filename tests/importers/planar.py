"""Positions of a planar machine by Newton's method on all bodies at once: independent of the package.

Everything is given where it lies at the start, in frame axes; a body's pose (x, y, angle) is its displacement from
there, so that its points' own coordinates are their places at the start.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

Place = tuple[float, float]
Law = Callable[[float], float]
#: The body that does not move.
FRAME = "frame"


@dataclass
class Planar:
    """Bodies and constraints; each constraint gives residuals of all poses and the time."""

    bodies: list[str] = field(default_factory=list)
    constraints: list[Callable[[Mapping[str, np.ndarray], float], Sequence[float]]] = field(default_factory=list)

    def body(self, *names: str) -> None:
        """Adds moving bodies."""
        self.bodies += [name for name in names if name not in self.bodies and name != FRAME]

    def pin(self, a: str, b: str, place: Place, other: Place | None = None) -> None:
        """A point of body a, at ``place`` at the start, and one of body b (``other``: where it lies) are one."""
        self.body(a, b)
        self.constraints.append(lambda q, _t: moved(q[a], place) - moved(q[b], other or place))

    def slide(self, guide: str, block: str, at: Place, direction: float, through: Place | None = None) -> None:
        """The point ``at`` of the block stays on the guide's line (through a place, in a direction at the start)."""
        self.body(guide, block)
        normal = np.array([-math.sin(direction), math.cos(direction)])

        def off(q: Mapping[str, np.ndarray], _t: float) -> list[float]:
            away = moved(q[block], at) - moved(q[guide], through or at)
            return [float(turned(q[guide][2], normal) @ away)]

        self.constraints.append(off)

    def parallel(self, a: str, b: str) -> None:
        """Two bodies do not turn against each other."""
        self.turn(a, b, lambda _t: 0.0)

    def turn(self, a: str, b: str, law: Law) -> None:
        """Body a turns against body b by a function of the time, 0 at the start."""
        self.body(a, b)
        self.constraints.append(lambda q, t: [float(q[a][2] - q[b][2]) - law(t)])

    def coupled(self, a: str, b: str, carrier: str, ratio: float) -> None:
        """b turns ``ratio`` times as fast as a, both against the carrier."""
        self.body(a, b, carrier)
        self.constraints.append(
            lambda q, _t: [float(q[b][2] - q[carrier][2]) - ratio * float(q[a][2] - q[carrier][2])]
        )

    def move(self, guide: str, block: str, at: Place, direction: float, law: Law) -> None:
        """The block's point moves along the guide's direction by a function of the time, 0 at the start."""
        self.body(guide, block)
        along = np.array([math.cos(direction), math.sin(direction)])

        def gone(q: Mapping[str, np.ndarray], t: float) -> list[float]:
            away = moved(q[block], at) - moved(q[guide], at)
            return [float(turned(q[guide][2], along) @ away) - law(t)]

        self.constraints.append(gone)

    def distance(self, a: str, one: Place, b: str, other: Place, law: Law) -> None:
        """The distance of a point of body a from one of body b is a function of the time."""
        self.body(a, b)
        self.constraints.append(lambda q, t: [float(np.hypot(*(moved(q[a], one) - moved(q[b], other)))) - law(t)])

    def positions(
        self, times: Sequence[float], points: Mapping[str, tuple[str, Place]], steps: int = 8
    ) -> dict[str, np.ndarray]:
        """Places of points (body, place at the start) at times from the start on, rows of (x, y).

        Between two times the machine is led on in ``steps``. Raises ArithmeticError where it does not close.
        """
        found = {name: np.empty((len(times), 2)) for name in points}
        state, before = np.zeros(3 * len(self.bodies)), 0.0
        for row, time in enumerate(times):
            for part in range(1, steps + 1):
                state = self._closed(state, before + (time - before) * part / steps)
            before = time
            poses = self._poses(state)
            for name, (body, place) in points.items():
                found[name][row] = moved(poses[body], place)
        return found

    def _poses(self, state: np.ndarray) -> dict[str, np.ndarray]:
        found = {name: state[3 * k : 3 * k + 3] for k, name in enumerate(self.bodies)}
        return {FRAME: np.zeros(3), **found}

    def _residual(self, state: np.ndarray, time: float) -> np.ndarray:
        poses = self._poses(state)
        return np.concatenate([np.atleast_1d(np.asarray(each(poses, time))) for each in self.constraints])

    def _closed(self, state: np.ndarray, time: float) -> np.ndarray:
        state = state.copy()
        for _attempt in range(60):
            wrong = self._residual(state, time)
            slope = np.empty((wrong.size, state.size))
            for k in range(state.size):
                step = 1e-6
                ahead, behind = state.copy(), state.copy()
                ahead[k] += step
                behind[k] -= step
                slope[:, k] = (self._residual(ahead, time) - self._residual(behind, time)) / (2 * step)
            change = np.linalg.lstsq(slope, -wrong, rcond=1e-10)[0]
            state += change
            if np.abs(change).max(initial=0.0) < 1e-13:
                break
        if np.abs(self._residual(state, time)).max(initial=0.0) > 1e-10:
            raise ArithmeticError(f"the machine does not close at t = {time}")
        return state


def moved(pose: np.ndarray, place: Place) -> np.ndarray:
    """Where a point of a body is."""
    return pose[:2] + turned(pose[2], np.asarray(place, dtype=float))


def turned(angle: float, vector: np.ndarray) -> np.ndarray:
    """A vector turned counter-clockwise."""
    cos, sin = math.cos(angle), math.sin(angle)
    return np.array([cos * vector[0] - sin * vector[1], sin * vector[0] + cos * vector[1]])
