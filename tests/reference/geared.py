"""Rows of wheels, racks and cams for the reference, written from the places of the wheels' centres alone.

A pair of wheels: k_a phi_a + k_b phi_b - (k_a + k_b) theta = value, theta the direction of the line of centres,
found from the two bodies' own coordinates; no carrier takes part, so that its multiplier is a force at the centres
across that line and a moment on either body. A rack: w . (C - T) + lever (phi_p - phi_r) = value. Cams: ``cam_rows``.
Source: E. J. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, 1989, sections 3.4 and 6.6.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, pi, sin, tan

import numpy as np
from tests.reference.multibody import Array, Body, Constraint, Forces, Load, Motion, Multibody, Vec, Wrench

#: Derivatives of a row by the coordinates of bodies, (..., 3) by their names.
Slopes = dict[str, Array]


@dataclass(frozen=True)
class Row(ABC):
    """One row between the bodies a and b; what it is, less ``value``, is zero."""

    name: str
    a: str
    pa: Vec
    b: str

    value: float
    #: What the row may jump by where an angle of it is taken anew.
    jump = 0.0

    @abstractmethod
    def at(self, system: Geared, q: Array) -> Array:
        """What it is at some coordinates."""

    @abstractmethod
    def slopes(self, system: Geared, q: Array) -> Slopes:
        """Its Jacobian."""

    @abstractmethod
    def quadratic(self, system: Geared, q: Array, qd: Array) -> Array:
        """The part of its second derivative in time that is quadratic in the rates."""

    @abstractmethod
    def beside(self, motion: Motion, lam: Array) -> list[Wrench]:
        """What the pair exerts beside the force that its multiplier is."""


@dataclass(frozen=True)
class Wheels(Row):
    """Two wheels with centres pa, pb. ``press``: force along the line of centres per |lam| that pushes a from b;
    ``steady``: the same without load."""

    pb: Vec
    ka: float
    kb: float
    press: float = 0.0
    steady: float = 0.0

    @property
    def jump(self) -> float:  # type: ignore[override]
        return 2 * pi * (self.ka + self.kb)

    def at(self, system: Geared, q: Array) -> Array:
        gap = system.place(q, self.b, self.pb) - system.place(q, self.a, self.pa)
        line = np.arctan2(gap[..., 1], gap[..., 0])
        turned = self.ka * system.turned(q, self.a) + self.kb * system.turned(q, self.b)
        return np.asarray(turned - (self.ka + self.kb) * line)

    def slopes(self, system: Geared, q: Array) -> Slopes:
        ra, rb = system.arm(q, self.a, self.pa), system.arm(q, self.b, self.pb)
        gap = system.place(q, self.b, self.pb) - system.place(q, self.a, self.pa)
        across = left(gap) / (gap**2).sum(-1)[..., None] * (self.ka + self.kb)
        turns = self.ka + (across * left(ra)).sum(-1), self.kb - (across * left(rb)).sum(-1)
        return {self.a: joined(across, turns[0]), self.b: joined(-across, turns[1])}

    def quadratic(self, system: Geared, q: Array, qd: Array) -> Array:
        gap, rate, bend = system.gap(q, qd, (self.a, self.pa), (self.b, self.pb))
        square = (gap**2).sum(-1)
        along, across = (gap * rate).sum(-1), (left(gap) * rate).sum(-1)
        theta = (left(gap) * bend).sum(-1) / square - 2 * along * across / square**2
        return np.asarray(-(self.ka + self.kb) * theta)

    def beside(self, motion: Motion, lam: Array) -> list[Wrench]:
        a, b = motion.point(self.a, self.pa)[0], motion.point(self.b, self.pb)[0]
        unit = (b - a) / np.hypot(*(b - a).T)[:, None]
        force = -unit * (self.press * np.abs(lam) + self.steady)[:, None]
        return opposed((self.a, a), (self.b, b), force)


@dataclass(frozen=True)
class Rack(Row):
    """Pinion a with centre pa; line through T of body b at `direction`, lever r for a centre on its left, else -r.
    ``press``: tan of the pressure angle."""

    through: Vec
    direction: float
    lever: float
    press: float = 0.0

    def at(self, system: Geared, q: Array) -> Array:
        gap = system.place(q, self.a, self.pa) - system.place(q, self.b, self.through)
        along = self._line(system, q)
        return np.asarray((along * gap).sum(-1) + self.lever * (system.turned(q, self.a) - system.turned(q, self.b)))

    def _line(self, system: Geared, q: Array) -> Array:
        return system.arm(q, self.b, (cos(self.direction), sin(self.direction)))

    def slopes(self, system: Geared, q: Array) -> Slopes:
        ra, rt = system.arm(q, self.a, self.pa), system.arm(q, self.b, self.through)
        gap = system.place(q, self.a, self.pa) - system.place(q, self.b, self.through)
        w = self._line(system, q)
        turn = (left(w) * gap).sum(-1) - (w * left(rt)).sum(-1) - self.lever
        return {self.a: joined(w, (w * left(ra)).sum(-1) + self.lever), self.b: joined(-w, turn)}

    def quadratic(self, system: Geared, q: Array, qd: Array) -> Array:
        gap, rate, bend = system.gap(q, qd, (self.a, self.pa), (self.b, self.through))
        w, turning = self._line(system, q), qd[..., system.index[self.b], 2, None]
        return np.asarray(-((w * bend) + 2 * turning * left(w) * rate - turning**2 * w * gap).sum(-1))

    def beside(self, motion: Motion, lam: Array) -> list[Wrench]:
        a = motion.point(self.a, self.pa)[0]
        unit = left(motion.direction(self.b, self.direction)) * np.sign(self.lever)
        return opposed((self.a, a), (self.b, a), unit * (self.press * np.abs(lam))[:, None])


class Geared(Multibody):
    """The reference with rows of wheels, racks and cams behind those of the joints and drivers."""

    def __init__(
        self, bodies: Sequence[Body], constraints: Sequence[Constraint], rolling: Sequence[Row], drivers: int = 1
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
            out[..., row] = c.at(self, q) - c.value
            if abs(c.jump) > 1e-12:
                out[..., row] -= c.jump * np.round(out[..., row] / c.jump)
        return out

    def jacobian(self, q: Array) -> Array:
        jac = super().jacobian(q)
        for row, c in enumerate(self.rolling, self.first):
            for body, slope in c.slopes(self, q).items():
                at = 3 * self.index[body]
                jac[..., row, at : at + 3] += slope
        return jac

    def quadratic(self, q: Array, qd: Array) -> Array:
        out = super().quadratic(q, qd)
        for row, c in enumerate(self.rolling, self.first):
            out[..., row] = c.quadratic(self, q, qd)
        return out

    # what rows are made of ------------------------------------------------------------------
    def turned(self, q: Array, body: str) -> Array:
        """The angle of a body."""
        return np.asarray(q[..., self.index[body], 2])

    def arm(self, q: Array, body: str, p: Vec) -> Array:
        """A vector of a body in the frame's axes."""
        c, s = np.cos(self.turned(q, body)), np.sin(self.turned(q, body))
        return pair(c * p[0] - s * p[1], s * p[0] + c * p[1])

    def place(self, q: Array, body: str, p: Vec) -> Array:
        """Where a point of a body is."""
        return np.asarray(q[..., self.index[body], :2] + self.arm(q, body, p))

    def gap(self, q: Array, qd: Array, a: tuple[str, Vec], b: tuple[str, Vec]) -> tuple[Array, Array, Array]:
        """From a point of one body to one of another, its rate, and what the turning of both bends it, minus."""
        (ia, wa, ra), (ib, wb, rb) = (
            (self.index[body], qd[..., self.index[body], 2, None], self.arm(q, body, p)) for body, p in (a, b)
        )
        gap = q[..., ib, :2] + rb - q[..., ia, :2] - ra
        rate = qd[..., ib, :2] + wb * left(rb) - qd[..., ia, :2] - wa * left(ra)
        return gap, rate, wa**2 * ra - wb**2 * rb


def pressed_forces(motion: Motion, loads: Sequence[Load]) -> tuple[Forces, dict[str, list[Wrench]]]:
    """Forces with what pairs exert beside their rows: found from the multipliers of a first solution, put on as
    wrenches. Also these by the names of the pairs."""
    system = motion.system
    assert isinstance(system, Geared)
    first = motion.forces(loads)
    beside = {
        c.name: c.beside(motion, first.lam[:, system.constraint_rows(c)[0]])  # type: ignore[arg-type]
        for c in system.rolling
    }
    return motion.forces([*loads, *(lambda _, own=own: own for own in beside.values())]), beside  # type: ignore[misc]


def gear(name: str, a: str, pa: Vec, b: str, pb: Vec, d: float, ratio: float, alpha: float, value: float) -> Wheels:
    """A pair with the centre distance d and the ratio of b's speed to a's, negative for an external one."""
    part = d / (ratio - 1)
    sense = 1.0 if ratio < 0 else -1.0
    return Wheels(name, a, pa, b, value, pb, part * ratio, -part, sense * tan(alpha))


def belt(
    name: str, a: str, pa: Vec, b: str, pb: Vec, d: float, radii: Vec, crossed: bool, value: float, pull: float = 0.0
) -> Wheels:
    """Pulleys with an open or crossed belt whose strands have a tension ``pull``, or whose slack one has none."""
    kb = radii[1] if crossed else -radii[1]
    cosine = float(np.sqrt(1 - ((radii[0] + kb) / d) ** 2))
    return Wheels(name, a, pa, b, value, pb, radii[0], kb, 0.0 if pull else -cosine, -2 * pull * cosine)


def opposed(a: tuple[str, Array], b: tuple[str, Array], force: Array) -> list[Wrench]:
    """A force on one body at a place and its opposite on another."""
    none = np.zeros(len(force))
    return [Wrench(*a, force, none), Wrench(*b, -force, none)]


def left(v: Array) -> Array:
    """Vectors turned left."""
    return pair(-v[..., 1], v[..., 0])


def joined(v: Array, third: Array) -> Array:
    """Vectors with a third component."""
    return np.concatenate([v, np.asarray(third)[..., None]], axis=-1)


def pair(x: Array, y: Array) -> Array:
    """Vectors of two components."""
    found = np.empty((*np.shape(x), 2))
    found[..., 0], found[..., 1] = x, y
    return found
