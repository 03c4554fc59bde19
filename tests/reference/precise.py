"""One position of a reference system in 50 digits: positions, velocities, accelerations, multipliers.

Written out point by point with mpmath, apart from the arrays of `multibody`, for checks of accuracy.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import mpmath
from tests.reference.multibody import FRAME, Angle, Array, Coincide, Multibody, Vec

DIGITS = 50
Number = Any
Pair = tuple[Number, Number]
Inputs = Sequence[Number] | Array


@dataclass(frozen=True)
class PreciseState:
    """Poses, their rates and second rates by body name: (x, y, phi) in 50 digits; multipliers by row."""

    q: dict[str, list[Number]]
    qd: dict[str, list[Number]]
    qdd: dict[str, list[Number]]
    lam: list[Number]

    def point(self, body: str, local: Vec) -> tuple[Pair, Pair, Pair]:
        """Position, velocity, acceleration of a point of the body."""
        (x, y, phi), (vx, vy, w), (ax, ay, e) = self.q[body], self.qd[body], self.qdd[body]
        rx, ry = _turned(phi, local)
        velocity = vx - w * ry, vy + w * rx
        return (x + rx, y + ry), velocity, (ax - e * ry - w * w * rx, ay + e * rx - w * w * ry)


def precise_state(
    system: Multibody, guess: Array, u: Inputs, ud: Inputs, udd: Inputs, gravity: Vec | None = None
) -> PreciseState:
    """The state at the driver coordinates u, by Newton's method from a position near by.

    With `gravity`, the multipliers of the Newton-Euler equations under the weights alone.
    """
    with mpmath.workdps(DIGITS + 15):
        rows = _Rows(system)
        q = [mpmath.mpf(float(v)) for v in guess[1:].ravel()]
        for _ in range(12):
            jac, value, _ = rows.at(q, [mpmath.mpf(0)] * len(q), u)
            step = mpmath.lu_solve(jac, -value)
            q = [a + b for a, b in zip(q, step, strict=True)]
            if max(abs(s) for s in step) < mpmath.mpf(10) ** -(DIGITS + 5):
                break
        jac, _, _ = rows.at(q, [mpmath.mpf(0)] * len(q), u)
        qd = list(mpmath.lu_solve(jac, rows.driven(ud)))
        _, _, quadratic = rows.at(q, qd, u)
        qdd = list(mpmath.lu_solve(jac, rows.driven(udd) - quadratic))
        state = PreciseState(_by_body(system, q), _by_body(system, qd), _by_body(system, qdd), [])
        if gravity is None:
            return state
        return replace(state, lam=list(_multipliers(system, state, jac, gravity)))


def _by_body(system: Multibody, values: list[Number]) -> dict[str, list[Number]]:
    zero = [mpmath.mpf(0)] * 3
    return {FRAME: zero} | {b.name: values[3 * k : 3 * k + 3] for k, b in enumerate(system.bodies)}


def _turned(phi: Number, v: Vec) -> Pair:
    c, s = mpmath.cos(phi), mpmath.sin(phi)
    return c * v[0] - s * v[1], s * v[0] + c * v[1]


class _Rows:
    """Values, Jacobian and quadratic terms of all rows, in the order of the system's rows."""

    def __init__(self, system: Multibody) -> None:
        self.system = system

    def driven(self, rates: Inputs) -> Number:
        out = mpmath.matrix(self.system.rows, 1)
        for row in range(self.system.rows):
            out[row] = mpmath.fsum(
                float(s) * mpmath.mpf(r) for s, r in zip(self.system.selection[row], rates, strict=True)
            )
        return out

    def at(self, q: list[Number], qd: list[Number], u: Inputs) -> tuple[Number, Number, Number]:
        system = self.system
        jac = mpmath.matrix(system.rows, 3 * len(system.bodies))
        value, quadratic = -self.driven(u), mpmath.matrix(system.rows, 1)
        pose, rate = _by_body(system, q), _by_body(system, qd)
        for c in system.constraints:
            rows = system.constraint_rows(c)
            if isinstance(c, Coincide):
                self._coincide(c, rows, pose, rate, jac, value, quadratic)
            elif isinstance(c, Angle):
                turned = pose[c.b][2] - pose[c.a][2] - c.value + value[rows[0]]
                value[rows[0]] = turned - 2 * mpmath.pi * mpmath.nint(turned / (2 * mpmath.pi))
                self._put(jac, rows[0], c.b, (0, 0, 1))
                self._put(jac, rows[0], c.a, (0, 0, -1))
            else:
                self._line(c, rows[0], pose, rate, jac, value, quadratic)
        return jac, value, quadratic

    def _put(self, jac: Number, row: int, body: str, entries: tuple[Number, Number, Number]) -> None:
        k = self.system.index[body] - 1
        if k >= 0:
            for j, entry in enumerate(entries):
                jac[row, 3 * k + j] += entry

    def _coincide(
        self, c: Coincide, rows: list[int], pose: Any, rate: Any, jac: Any, value: Any, quadratic: Any
    ) -> None:
        for sign, body, local in ((1, c.a, c.pa), (-1, c.b, c.pb)):
            rx, ry = _turned(pose[body][2], local)
            w = rate[body][2]
            value[rows[0]] += sign * (pose[body][0] + rx)
            value[rows[1]] += sign * (pose[body][1] + ry)
            self._put(jac, rows[0], body, (sign, 0, -sign * ry))
            self._put(jac, rows[1], body, (0, sign, sign * rx))
            quadratic[rows[0]] -= sign * w * w * rx
            quadratic[rows[1]] -= sign * w * w * ry

    def _line(self, c: Any, row: int, pose: Any, rate: Any, jac: Number, value: Number, quadratic: Number) -> None:
        (xa, ya, fa), (xb, yb, fb) = pose[c.a], pose[c.b]
        wx, wy = mpmath.cos(fa + c.direction), mpmath.sin(fa + c.direction)
        (tx, ty), (px, py) = _turned(fa, c.through), _turned(fb, c.at)
        dx, dy = xb + px - xa - tx, yb + py - ya - ty
        value[row] += wx * dx + wy * dy - c.value
        self._put(jac, row, c.b, (wx, wy, px * wy - py * wx))
        self._put(jac, row, c.a, (-wx, -wy, wx * dy - wy * dx - tx * wy + ty * wx))
        (vxa, vya, wa), (vxb, vyb, wb) = rate[c.a], rate[c.b]
        rx, ry = vxb - wb * py - vxa + wa * ty, vyb + wb * px - vya - wa * tx
        bend = wx * (wa * wa * tx - wb * wb * px) + wy * (wa * wa * ty - wb * wb * py)
        quadratic[row] = bend + 2 * wa * (wx * ry - wy * rx) - wa * wa * (wx * dx + wy * dy)


def _multipliers(system: Multibody, state: PreciseState, jac: Number, gravity: Vec) -> Number:
    right = mpmath.matrix(3 * len(system.bodies), 1)
    for k, body in enumerate(system.bodies):
        (gx, gy), _, (ax, ay) = state.point(body.name, body.centre)
        fx, fy = body.mass * (gravity[0] - ax), body.mass * (gravity[1] - ay)
        x, y, _ = state.q[body.name]
        right[3 * k], right[3 * k + 1] = fx, fy
        right[3 * k + 2] = (gx - x) * fy - (gy - y) * fx - body.inertia * state.qdd[body.name][2]
    return mpmath.lu_solve(jac.T, right)
