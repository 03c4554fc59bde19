"""One branch of a reference system, followed in small steps of its own and kept by the determinant's sign.

The whole mechanism's constraint Jacobian is square; between regular positions of one branch its determinant
keeps its sign, and the path is as smooth as its laws. A step from t to t + h is taken only if Newton's method,
started from the second-order Taylor value, ends near it, the determinant's sign is kept, and the two ends
satisfy the fourth-order Hermite rule q1 - q0 = h/2 (v0 + v1) - h²/12 (a1 - a0). Where the steps become
smaller than any regular path needs, the branch ends: its smallest singular value tells whether in a fold.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from tests.reference.multibody import Array, Multibody, Unreachable

Law = Callable[[float], tuple[Array, Array, Array]]

CORRECTION = 0.05  # of a step's length: largest distance from the Taylor value
HERMITE = 2e-3  # of a step's length: largest gap of the Hermite rule
LONGEST = 0.08  # rad, or share of the mechanism's reach, that one step may move a coordinate
FARTHEST = 1e4  # of the mechanism's size: a block that runs away on its guide is at its limit
FLOOR = 1e-9  # of the whole time: below it the branch is given up


@dataclass
class Branch:
    """Positions q at the asked times, as many as could be reached; `end` is the last time reached."""

    q: list[Array]
    end: float
    nearness: float  # smallest singular value there, as a share of the largest over the branch
    steps: int = 0

    def ends_in_a_fold(self) -> bool:
        return self.nearness < 3e-3


@dataclass
class _State:
    t: float
    q: Array
    v: Array
    a: Array
    sign: float
    nearness: float


class Follower:
    """Follows a system along `law`; `care` divides the allowed errors and lengths of a step."""

    def __init__(self, system: Multibody, law: Law, care: float = 1.0) -> None:
        self.system = system
        self.law = law
        self.care = care
        self.scale = np.ones(3)

    def follow(self, q: Array, t0: float, times: Sequence[float], whole: float) -> Branch:
        """The branch through q at t0, at the `times` one after the other; `whole` is the scale of time."""
        size = max(float(np.abs(q[:, :2]).max()), 1e-3)
        self.scale = np.array([size, size, 1.0])
        here = self._state(t0, self.system.assemble(q, self.law(t0)[0]))
        found, h, regular, steps = [], whole / 50, here.nearness, 0
        for goal in times:
            way = 1.0 if goal >= here.t else -1.0
            while abs(goal - here.t) > 1e-14 * whole:
                step = min(h, abs(goal - here.t))
                there = self._step(here, way * step if step < abs(goal - here.t) else goal - here.t)
                steps += 1
                if there is None:
                    h = step / 2
                    if h < FLOOR * whole:
                        return Branch(found, here.t, here.nearness / regular, steps)
                    continue
                if self._size(there.q) > FARTHEST:
                    return Branch(found, here.t, 0.0, steps)
                here, h = there, max(h, step * 1.6) if step == h else h
                regular = max(regular, here.nearness)
            found.append(here.q)
        return Branch(found, here.t, here.nearness / regular, steps)

    def _state(self, t: float, q: Array) -> _State:
        _, ud, udd = self.law(t)
        jac = self.system.jacobian(q)[:, 3:]
        right = self.system.selection
        v, a = np.zeros_like(q), np.zeros_like(q)
        v[1:] = np.linalg.solve(jac, right @ ud).reshape(-1, 3)
        a[1:] = np.linalg.solve(jac, right @ udd - self.system.quadratic(q, v)).reshape(-1, 3)
        scaled = jac * np.tile(self.scale, len(q) - 1)
        nearness = float(np.linalg.svd(scaled, compute_uv=False)[-1])
        return _State(t, q, v, a, float(np.linalg.slogdet(jac)[0]), nearness)

    def _step(self, here: _State, h: float) -> _State | None:
        try:
            guess = here.q + h * here.v + h * h / 2 * here.a
            t = here.t + h
            q = self._newton(guess, self.law(t)[0])
            if q is None:
                return None
            length, far = self._size(q - here.q), max(1.0, self._size(here.q))
            longest, rounding = LONGEST / self.care * far, 1e-11 * far
            if length > longest or self._size(q - guess) > CORRECTION / self.care * length + rounding:
                return None
            there = self._state(t, q)
        except (Unreachable, np.linalg.LinAlgError):
            return None
        if there.sign != here.sign:
            return None
        rule = h / 2 * (here.v + there.v) - h * h / 12 * (there.a - here.a)
        gap = self._size(q - here.q - rule)
        return there if gap <= HERMITE / self.care * length + rounding else None

    def _newton(self, guess: Array, u: Array) -> Array | None:
        q, before, far = guess.copy(), np.inf, max(1.0, self._size(guess))
        for _ in range(8):
            step = np.linalg.solve(self.system.jacobian(q)[:, 3:], -self.system.residual(q, u))
            q[1:] += step.reshape(-1, 3)
            length = self._size(step.reshape(-1, 3))
            if length < 1e-13 * far:
                return q
            if length > 0.5 * before:
                return q if length < 1e-11 * far else None
            before = length
        return None

    def _size(self, change: Array) -> float:
        return float(np.abs(change / self.scale).max())
