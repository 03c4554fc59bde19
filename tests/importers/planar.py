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
Residual = Callable[[Mapping[str, np.ndarray], float], Sequence[float] | np.ndarray]
#: The body that does not move.
FRAME = "frame"


@dataclass
class Planar:
    """Bodies and constraints; each constraint gives residuals of the poses of some bodies, and the time."""

    bodies: list[str] = field(default_factory=list)
    constraints: list[tuple[tuple[str, ...], Residual]] = field(default_factory=list)

    def body(self, *names: str) -> None:
        """Adds moving bodies."""
        self.bodies += [name for name in names if name not in self.bodies and name != FRAME]

    def demand(self, residual: Residual, *bodies: str) -> None:
        """What must be zero, by the poses of these bodies."""
        self.body(*bodies)
        self.constraints.append((bodies, residual))

    def pin(self, a: str, b: str, place: Place, other: Place | None = None) -> None:
        """A point of body a, at ``place`` at the start, and one of body b (``other``: where it lies) are one."""
        self.demand(lambda q, _t: moved(q[a], place) - moved(q[b], other or place), a, b)

    def slide(self, guide: str, block: str, at: Place, direction: float, through: Place | None = None) -> None:
        """The point ``at`` of the block stays on the guide's line (through a place, in a direction at the start)."""
        normal = np.array([-math.sin(direction), math.cos(direction)])

        def off(q: Mapping[str, np.ndarray], _t: float) -> list[float]:
            away = moved(q[block], at) - moved(q[guide], through or at)
            return [float(turned(q[guide][2], normal) @ away)]

        self.demand(off, guide, block)

    def parallel(self, a: str, b: str) -> None:
        """Two bodies do not turn against each other."""
        self.turn(a, b, lambda _t: 0.0)

    def turn(self, a: str, b: str, law: Law) -> None:
        """Body a turns against body b by a function of the time, 0 at the start."""
        self.demand(lambda q, t: [float(q[a][2] - q[b][2]) - law(t)], a, b)

    def coupled(self, a: str, b: str, carrier: str, ratio: float) -> None:
        """b turns ``ratio`` times as fast as a, both against the carrier."""
        self.demand(
            lambda q, _t: [float(q[b][2] - q[carrier][2]) - ratio * float(q[a][2] - q[carrier][2])], a, b, carrier
        )

    def move(self, guide: str, block: str, at: Place, direction: float, law: Law) -> None:
        """The block's point moves along the guide's direction by a function of the time, 0 at the start."""
        along = np.array([math.cos(direction), math.sin(direction)])

        def gone(q: Mapping[str, np.ndarray], t: float) -> list[float]:
            away = moved(q[block], at) - moved(q[guide], at)
            return [float(turned(q[guide][2], along) @ away) - law(t)]

        self.demand(gone, guide, block)

    def distance(self, a: str, one: Place, b: str, other: Place, law: Law) -> None:
        """The distance of a point of body a from one of body b is a function of the time."""
        self.demand(lambda q, t: [float(np.hypot(*(moved(q[a], one) - moved(q[b], other)))) - law(t)], a, b)

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
        return np.concatenate([np.atleast_1d(np.asarray(each(poses, time))) for _bodies, each in self.constraints])

    def _slopes(self, state: np.ndarray, time: float) -> np.ndarray:
        """Slopes of all residuals along the poses of the bodies that each depends on, by central differences."""
        poses, rows = self._poses(state), list[np.ndarray]()
        for bodies, each in self.constraints:
            part = np.zeros((np.size(each(poses, time)), state.size))
            for name in set(bodies) - {FRAME}:
                for axis in range(3):
                    shift = np.zeros(3)
                    shift[axis] = 1e-6
                    ahead = np.asarray(each(poses | {name: poses[name] + shift}, time))
                    behind = np.asarray(each(poses | {name: poses[name] - shift}, time))
                    part[:, 3 * self.bodies.index(name) + axis] = (ahead - behind) / 2e-6
            rows.append(part)
        return np.concatenate(rows)

    def _closed(self, state: np.ndarray, time: float) -> np.ndarray:
        state, inverse, before = state.copy(), None, np.inf
        for _attempt in range(60):
            wrong = self._residual(state, time)
            size = np.abs(wrong).max(initial=0.0)
            if inverse is None or size > 0.1 * before:  # the slopes of an earlier iteration do as long as they help
                inverse = np.linalg.pinv(self._slopes(state, time), rcond=1e-10)
            before, change = size, -inverse @ wrong
            state += change
            if np.abs(change).max(initial=0.0) < 1e-13:
                break
        if np.abs(self._residual(state, time)).max(initial=0.0) > 1e-10:
            raise ArithmeticError(f"the machine does not close at t = {time}")
        return state


def moved(pose: np.ndarray, place: Place) -> np.ndarray:
    """Where a point of a body is."""
    return pose[:2] + turned(pose[2], place)


def turned(angle: float, vector: Place | np.ndarray) -> np.ndarray:
    """A vector turned counter-clockwise."""
    cos, sin = math.cos(angle), math.sin(angle)
    return np.array([cos * vector[0] - sin * vector[1], sin * vector[0] + cos * vector[1]])
