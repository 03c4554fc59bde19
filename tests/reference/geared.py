"""Rows of wheels, racks and cams for the reference, written from the places of the wheels' centres alone.

A pair of wheels: k_a phi_a + k_b phi_b - (k_a + k_b) theta = value, theta the direction of the line of centres,
found from the two bodies' own coordinates; no carrier takes part, so that its multiplier is a force at the centres
across that line and a moment on either body. A rack: w . (C - T) + lever (phi_p - phi_r) = value. A cam with an
oscillating follower, theta from its pivot to the cam's centre: phi_f - theta - side f(sense (phi_c - theta) + lead)
= value, f the cycloidal rise.
Source: E. J. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, 1989, sections 3.4 and 6.6.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, pi, sin, tan

import numpy as np
from tests.reference.multibody import Array, Body, Constraint, Forces, Load, Motion, Multibody, Vec, Wrench


@dataclass(frozen=True)
class Wheels:
    """Two wheels with centres pa, pb. ``press``: force along the line of centres per |lam| that pushes a from b;
    ``steady``: the same without load."""

    name: str
    a: str
    pa: Vec
    b: str
    pb: Vec
    ka: float
    kb: float
    value: float
    press: float = 0.0
    steady: float = 0.0


@dataclass(frozen=True)
class Rack:
    """Pinion a with centre pa; line through T of body b at `direction`, lever r for a centre on its left, else -r.
    ``press``: tan of the pressure angle."""

    name: str
    a: str
    pa: Vec
    b: str
    through: Vec
    direction: float
    lever: float
    value: float
    press: float = 0.0


@dataclass(frozen=True)
class Cam:
    """Follower a with its pivot pa and its roller's centre, cam b with centre pb; cycloidal rise of h over beta."""

    name: str
    a: str
    pa: Vec
    b: str
    pb: Vec
    roller: Vec
    side: float
    sense: float
    lead: float
    h: float
    beta: float
    value: float = 0.0

    def lift(self, u: Array) -> tuple[Array, Array, Array]:
        """f with two derivatives."""
        x = 2 * pi * u / self.beta
        rate = self.h / self.beta
        return (
            rate * u - self.h / (2 * pi) * np.sin(x),
            rate * (1 - np.cos(x)),
            rate * 2 * pi / self.beta * np.sin(x),
        )


Row = Wheels | Rack | Cam


class Geared(Multibody):
    """The reference with rows of wheels, racks and cams behind those of the joints and drivers."""

    def __init__(
        self,
        bodies: Sequence[Body],
        constraints: Sequence[Constraint],
        rolling: Sequence[Row],
        drivers: int = 1,
    ) -> None:
        self.rolling = list(rolling)
        super().__init__(bodies, constraints, drivers)
        self.constraints = [*self.constraints, *self.rolling]  # type: ignore[list-item]

    def _arrange(self) -> None:
        super()._arrange()
        self.first = self.rows
        self.rows += len(self.rolling)
        self.pattern = np.concatenate([self.pattern, np.zeros((len(self.rolling), 3 * self.count))])
        self.constant = np.append(self.constant, [c.value for c in self.rolling])
        self.selection = np.concatenate([self.selection, np.zeros((len(self.rolling), self.drivers))])

    def constraint_rows(self, c: Constraint) -> list[int]:
        if isinstance(c, Row):
            return [self.first + self.rolling.index(c)]
        return super().constraint_rows(c)

    def residual(self, q: Array, u: Array) -> Array:
        out = super().residual(q, u)
        for row, c in enumerate(self.rolling, self.first):
            out[..., row] = self.rolled(c, q) - c.value
            if isinstance(c, Cam):
                out[..., row] = np.remainder(out[..., row] + pi, 2 * pi) - pi
            elif isinstance(c, Wheels):
                turn = 2 * pi * (c.ka + c.kb)
                if abs(turn) > 1e-12:
                    out[..., row] -= turn * np.round(out[..., row] / turn)
        return out

    def rolled(self, c: Row, q: Array) -> Array:
        """Value of a row at some coordinates."""
        a, b = (self.index[name] for name in (c.a, c.b))
        if isinstance(c, Cam):
            gap = self._place(q, b, c.pb) - self._place(q, a, c.pa)
            line = np.arctan2(gap[..., 1], gap[..., 0])
            return np.asarray(q[..., a, 2] - line - c.side * c.lift(self._turned_cam(c, q))[0])
        if isinstance(c, Wheels):
            gap = self._place(q, b, c.pb) - self._place(q, a, c.pa)
            line = np.arctan2(gap[..., 1], gap[..., 0])
            return np.asarray(c.ka * q[..., a, 2] + c.kb * q[..., b, 2] - (c.ka + c.kb) * line)
        gap = self._place(q, a, c.pa) - self._place(q, b, c.through)
        along = q[..., b, 2] + c.direction
        turned = c.lever * (q[..., a, 2] - q[..., b, 2])
        return np.asarray(np.cos(along) * gap[..., 0] + np.sin(along) * gap[..., 1] + turned)

    def _factors(self, c: Wheels | Cam, q: Array) -> tuple[Array, Array]:
        """Derivatives of a row by the rotations of its bodies."""
        if isinstance(c, Wheels):
            return np.asarray(c.ka), np.asarray(c.kb)
        slope = c.lift(self._turned_cam(c, q))[1]
        return np.ones_like(slope), -c.side * c.sense * slope

    def _turned_cam(self, c: Cam, q: Array) -> Array:
        """The cam's angle, within a turn."""
        a, b = (self.index[name] for name in (c.a, c.b))
        gap = self._place(q, b, c.pb) - self._place(q, a, c.pa)
        turned = c.sense * (q[..., b, 2] - np.arctan2(gap[..., 1], gap[..., 0])) + c.lead
        return np.asarray(turned % (2 * pi))

    def _arm(self, q: Array, body: int, p: Vec) -> Array:
        c, s = np.cos(q[..., body, 2]), np.sin(q[..., body, 2])
        return _pair(c * p[0] - s * p[1], s * p[0] + c * p[1])

    def _place(self, q: Array, body: int, p: Vec) -> Array:
        return np.asarray(q[..., body, :2] + self._arm(q, body, p))

    def jacobian(self, q: Array) -> Array:
        jac = super().jacobian(q)
        for row, c in enumerate(self.rolling, self.first):
            a, b = (self.index[name] for name in (c.a, c.b))
            if not isinstance(c, Rack):
                ka, kb = self._factors(c, q)
                ra, rb = self._arm(q, a, c.pa), self._arm(q, b, c.pb)
                gap = q[..., b, :2] + rb - q[..., a, :2] - ra
                across = _left(gap) * ((ka + kb) / (gap**2).sum(-1))[..., None]
                jac[..., row, 3 * a : 3 * a + 2] = across
                jac[..., row, 3 * b : 3 * b + 2] = -across
                jac[..., row, 3 * a + 2] = ka + (across * _left(ra)).sum(-1)
                jac[..., row, 3 * b + 2] = kb - (across * _left(rb)).sum(-1)
                continue
            ra, rt = self._arm(q, a, c.pa), self._arm(q, b, c.through)
            gap = q[..., a, :2] + ra - q[..., b, :2] - rt
            w = self._arm(q, b, (cos(c.direction), sin(c.direction)))
            jac[..., row, 3 * a : 3 * a + 2] = w
            jac[..., row, 3 * b : 3 * b + 2] = -w
            jac[..., row, 3 * a + 2] = (w * _left(ra)).sum(-1) + c.lever
            jac[..., row, 3 * b + 2] = (_left(w) * gap).sum(-1) - (w * _left(rt)).sum(-1) - c.lever
        return jac

    def quadratic(self, q: Array, qd: Array) -> Array:
        out = super().quadratic(q, qd)
        for row, c in enumerate(self.rolling, self.first):
            a, b = (self.index[name] for name in (c.a, c.b))
            wa, wb = qd[..., a, 2, None], qd[..., b, 2, None]
            ra = self._arm(q, a, c.pa)
            rb = self._arm(q, b, c.through if isinstance(c, Rack) else c.pb)
            gap = q[..., b, :2] + rb - q[..., a, :2] - ra
            rate = qd[..., b, :2] + wb * _left(rb) - qd[..., a, :2] - wa * _left(ra)
            bend = wa**2 * ra - wb**2 * rb
            if not isinstance(c, Rack):
                ka, kb = self._factors(c, q)
                square = (gap**2).sum(-1)
                along, across = (gap * rate).sum(-1), (_left(gap) * rate).sum(-1)
                theta = (_left(gap) * bend).sum(-1) / square - 2 * along * across / square**2
                out[..., row] = -(ka + kb) * theta
                if isinstance(c, Cam):
                    turning = qd[..., b, 2] - across / square
                    out[..., row] -= c.side * c.lift(self._turned_cam(c, q))[2] * turning**2
                continue
            w = self._arm(q, b, (cos(c.direction), sin(c.direction)))
            out[..., row] = -((w * bend) + 2 * wb * _left(w) * rate - wb**2 * w * gap).sum(-1)
        return out


def pressed_forces(motion: Motion, loads: Sequence[Load]) -> tuple[Forces, dict[str, Array]]:
    """Forces with what presses wheels apart, and what a roller presses along the line of its pivot and its cam: found
    from the multipliers of a first solution, put on as wrenches.

    Also the pressing force on the first wheel of every pair, (n, 2), by name.
    """
    system = motion.system
    assert isinstance(system, Geared)
    first = motion.forces(loads)
    extra: list[Wrench] = []
    pressing: dict[str, Array] = {}
    for c in system.rolling:
        lam = np.abs(first.lam[:, system.constraint_rows(c)[0]])  # type: ignore[arg-type]
        a = motion.point(c.a, c.pa)[0]
        if isinstance(c, Wheels):
            b = motion.point(c.b, c.pb)[0]
            unit = (b - a) / np.hypot(*(b - a).T)[:, None]
            force = -unit * (c.press * lam + c.steady)[:, None]
        elif isinstance(c, Cam):
            b = motion.point(c.b, c.pb)[0]
            unit = (b - a) / np.hypot(*(b - a).T)[:, None]
            across, couple = first.on(c.name, c.a, a)
            arm = motion.point(c.a, c.roller)[0] - a
            moment = arm[:, 0] * across[:, 1] - arm[:, 1] * across[:, 0] - couple
            force = unit * (moment / (_left(unit) * arm).sum(1))[:, None]
        else:
            b = a
            unit = _left(motion.direction(c.b, c.direction)) * np.sign(c.lever)
            force = unit * (c.press * lam)[:, None]
        pressing[c.name] = force
        none = np.zeros(len(lam))
        extra += [Wrench(c.a, a, force, none), Wrench(c.b, b, -force, none)]
    return motion.forces([*loads, lambda _: extra]), pressing


def gear(
    name: str, a: str, pa: Vec, b: str, pb: Vec, d: float, ratio: float, alpha: float, value: float
) -> Wheels:
    """A pair with the centre distance d and the ratio of b's speed to a's, negative for an external one."""
    part = d / (ratio - 1)
    sense = 1.0 if ratio < 0 else -1.0
    return Wheels(name, a, pa, b, pb, part * ratio, -part, value, sense * tan(alpha))


def belt(
    name: str, a: str, pa: Vec, b: str, pb: Vec, d: float, radii: Vec, crossed: bool, value: float
) -> Wheels:
    """Pulleys with an open or crossed belt whose slack strand carries nothing."""
    kb = radii[1] if crossed else -radii[1]
    lean = (radii[0] + kb) / d
    return Wheels(name, a, pa, b, pb, radii[0], kb, value, -np.sqrt(1 - lean**2))


def _left(v: Array) -> Array:
    return _pair(-v[..., 1], v[..., 0])


def _pair(x: Array, y: Array) -> Array:
    found = np.empty((*np.shape(x), 2))
    found[..., 0], found[..., 1] = x, y
    return found
