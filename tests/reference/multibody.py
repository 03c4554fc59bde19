"""Whole-mechanism multibody code, the independent reference of the tests.

Every moving body has three coordinates (x, y, phi) of its own axes. All bodies are solved together:
positions by Newton's method on all constraints C(q, u) = 0, u the driver coordinates, followed from one
position to the next; velocities and accelerations from C_q q' = ... with the exact quadratic terms;
reactions from the Newton-Euler equations with Lagrange multipliers, M q'' + C_q^T lam = Q.
Only three kinds of rows are needed: two points coincide, an angle between two bodies is prescribed, and
a point lies at a prescribed distance along a direction of another body.
Source: E. J. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, 1989, chapters 3 to 6.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import cos, pi, sin

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Vec = tuple[float, float]
FRAME = "frame"


class Unreachable(Exception):
    """The positions could not be followed to the wanted driver coordinates."""


@dataclass(frozen=True)
class Body:
    name: str
    mass: float = 0.0
    inertia: float = 0.0
    centre: Vec = (0.0, 0.0)


@dataclass(frozen=True)
class Coincide:
    """Point pa of body a coincides with point pb of body b (two rows)."""

    name: str
    a: str
    pa: Vec
    b: str
    pb: Vec


@dataclass(frozen=True)
class Angle:
    """phi_b - phi_a = value + u[driver] (one row)."""

    name: str
    a: str
    b: str
    value: float
    driver: int | None = None


@dataclass(frozen=True)
class Line:
    """w . (P - T) = value + u[driver]; w a unit vector of body a at `direction`, T on a, P on b (one row)."""

    name: str
    a: str
    through: Vec
    direction: float
    b: str
    at: Vec
    value: float
    driver: int | None = None


Constraint = Coincide | Angle | Line


def revolute(name: str, ends: Sequence[tuple[str, Vec]]) -> list[Constraint]:
    """A pin through all `ends` (body, point): a chain of pairs."""
    return [Coincide(name, a, pa, b, pb) for (a, pa), (b, pb) in pairwise(ends)]


def prismatic(
    name: str, guide: tuple[str, Vec, float], block: tuple[str, Vec, float], offset: float = 0.0
) -> list[Constraint]:
    """guide = (body, point, direction), block = (body, point, direction of the guide in the block's axes)."""
    (g, through, direction), (b, at, block_angle) = guide, block
    return [Angle(name, g, b, direction - block_angle), Line(name, g, through, direction + pi / 2, b, at, offset)]


def weld(name: str, a: tuple[str, Vec], b: tuple[str, Vec], angle: float) -> list[Constraint]:
    return [Coincide(name, a[0], a[1], b[0], b[1]), Angle(name, a[0], b[0], angle)]


def turn(name: str, relative_to: str, link: str, driver: int) -> list[Constraint]:
    return [Angle(name, relative_to, link, 0.0, driver)]


def slide(name: str, guide: tuple[str, Vec, float], block: tuple[str, Vec], driver: int) -> list[Constraint]:
    return [Line(name, guide[0], guide[1], guide[2], block[0], block[1], 0.0, driver)]


@dataclass(frozen=True)
class Wrench:
    """A force at a point of the plane and a torque, on one body, at every position."""

    body: str
    point: Array
    force: Array
    torque: Array


Load = Callable[["Motion"], list[Wrench]]


class Multibody:
    """Constraints of all bodies with their Jacobian and quadratic terms; q has the shape (..., bodies, 3)."""

    def __init__(self, bodies: Sequence[Body], constraints: Sequence[Constraint], drivers: int = 1) -> None:
        self.bodies = list(bodies)
        self.constraints = list(constraints)
        self.drivers = drivers
        self.index = {FRAME: 0} | {body.name: k + 1 for k, body in enumerate(self.bodies)}
        self.count = len(self.bodies) + 1
        self._arrange()
        self.redundant = False

    def part(self, bodies: Collection[str]) -> Multibody:
        """The system of these bodies alone, with the constraints between them and the frame."""
        kept = {FRAME, *bodies}
        among = [c for c in self.constraints if {c.a, c.b} <= kept]
        return Multibody([body for body in self.bodies if body.name in kept], among, self.drivers)

    def places(self, bodies: Collection[str]) -> list[int]:
        """Rows of the poses q that belong to the frame and to `bodies`, in the order of `part`."""
        return [k for name, k in self.index.items() if name == FRAME or name in bodies]

    def _arrange(self) -> None:
        pins = [c for c in self.constraints if isinstance(c, Coincide)]
        angles = [c for c in self.constraints if isinstance(c, Angle)]
        lines = [c for c in self.constraints if isinstance(c, Line)]
        at = self.index
        self.pin_a = np.array([at[c.a] for c in pins], dtype=int)
        self.pin_b = np.array([at[c.b] for c in pins], dtype=int)
        self.pin_pa = np.array([c.pa for c in pins], dtype=float).reshape(-1, 2)
        self.pin_pb = np.array([c.pb for c in pins], dtype=float).reshape(-1, 2)
        self.angle_a = np.array([at[c.a] for c in angles], dtype=int)
        self.angle_b = np.array([at[c.b] for c in angles], dtype=int)
        self.line_a = np.array([at[c.a] for c in lines], dtype=int)
        self.line_b = np.array([at[c.b] for c in lines], dtype=int)
        self.line_t = np.array([c.through for c in lines], dtype=float).reshape(-1, 2)
        self.line_p = np.array([c.at for c in lines], dtype=float).reshape(-1, 2)
        self.line_w = np.array([(cos(c.direction), sin(c.direction)) for c in lines]).reshape(-1, 2)
        self.np, self.na, self.nl = len(pins), len(angles), len(lines)
        self.rows = 2 * self.np + self.na + self.nl
        self.row_x = np.arange(self.np) * 2
        self.row_angle = 2 * self.np + np.arange(self.na)
        self.row_line = 2 * self.np + self.na + np.arange(self.nl)
        single: list[Angle | Line] = [*angles, *lines]
        self._arrange_vectors()
        self.constant: Array = np.array([0.0] * (2 * self.np) + [c.value for c in single])
        self.selection = np.zeros((self.rows, self.drivers))
        for row, c in zip([*self.row_angle, *self.row_line], single, strict=True):
            if c.driver is not None:
                self.selection[row, c.driver] = 1.0
        self.order = {id(c): k for group in (pins, angles, lines) for k, c in enumerate(group)}

    def _arrange_vectors(self) -> None:
        """What turns with the bodies, one after the other, and where its parts stand in the Jacobian."""
        a, b, (x, y) = self.line_a, self.line_b, (self.row_x, self.row_x + 1)
        locals_ = (self.pin_pa, self.pin_pb, self.line_w, self.line_t, self.line_p)
        self.local = np.concatenate(locals_)
        self.body = np.concatenate([self.pin_a, self.pin_b, a, a, b])
        ends = np.cumsum([0, *map(len, locals_)]).tolist()
        self.parts = [slice(*ends[k : k + 2]) for k in range(len(locals_))]
        self.pattern = np.zeros((self.rows, 3 * self.count))
        for sign, body in ((1.0, self.pin_a), (-1.0, self.pin_b)):
            self.pattern[x, 3 * body] = sign
            self.pattern[y, 3 * body + 1] = sign
        self.pattern[self.row_angle, 3 * self.angle_b + 2] = 1.0
        self.pattern[self.row_angle, 3 * self.angle_a + 2] = -1.0
        turning = [3 * self.pin_a + 2, 3 * self.pin_a + 2, 3 * self.pin_b + 2, 3 * self.pin_b + 2]
        sliding = [3 * b, 3 * b + 1, 3 * a, 3 * a + 1, 3 * b + 2, 3 * a + 2]
        self.moving = np.concatenate([x, y, x, y, *[self.row_line] * 6]), np.concatenate([*turning, *sliding])

    def _turned(self, q: Array) -> list[Array]:
        """Arms of the pins' two points, directions, and arms of the lines' two points, in the frame's axes."""
        c, s = np.cos(q[..., 2])[..., self.body], np.sin(q[..., 2])[..., self.body]
        x, y = self.local.T
        turned = np.empty((*c.shape, 2))
        turned[..., 0] = c * x - s * y
        turned[..., 1] = s * x + c * y
        return [turned[..., part, :] for part in self.parts]

    def constraint_rows(self, c: Constraint) -> list[int]:
        k = self.order[id(c)]
        if isinstance(c, Coincide):
            return [2 * k, 2 * k + 1]
        return [int(self.row_angle[k] if isinstance(c, Angle) else self.row_line[k])]

    def residual(self, q: Array, u: Array) -> Array:
        ra, rb, w, t, p = self._turned(q)
        out = np.empty((*q.shape[:-2], self.rows))
        gap = q[..., self.pin_a, :2] + ra - q[..., self.pin_b, :2] - rb
        out[..., : 2 * self.np] = gap.reshape(*gap.shape[:-2], 2 * self.np)
        out[..., self.row_angle] = q[..., self.angle_b, 2] - q[..., self.angle_a, 2]
        out[..., self.row_line] = (w * self._along_lines(q, t, p)).sum(-1)
        out -= self.constant + u @ self.selection.T
        turns = out[..., self.row_angle]
        out[..., self.row_angle] = turns - 2 * pi * np.round(turns / (2 * pi))
        return out

    def _along_lines(self, q: Array, t: Array, p: Array) -> Array:
        """P - T of every line."""
        along: Array = q[..., self.line_b, :2] + p - q[..., self.line_a, :2] - t
        return along

    def jacobian(self, q: Array) -> Array:
        """C_q of all bodies, the frame first, shape (..., rows, 3 * bodies)."""
        ra, rb, w, t, p = self._turned(q)
        turning = [-ra[..., 1], ra[..., 0], rb[..., 1], -rb[..., 0]]
        arm = _cross(w, self._along_lines(q, t, p)) - _cross(t, w)
        sliding = [w[..., 0], w[..., 1], -w[..., 0], -w[..., 1], _cross(p, w), arm]
        jac = np.empty((*q.shape[:-2], self.rows, 3 * self.count))
        jac[...] = self.pattern
        rows, columns = self.moving
        jac[..., rows, columns] = np.concatenate([*turning, *sliding], axis=-1)
        return jac

    def quadratic(self, q: Array, qd: Array) -> Array:
        """The part of d2C/dt2 that is quadratic in the velocities, shape (..., rows)."""
        ra, rb, w, t, p = self._turned(q)
        square = qd[..., 2, None] ** 2
        out = np.zeros((*q.shape[:-2], self.rows))
        gap = square[..., self.pin_b, :] * rb - square[..., self.pin_a, :] * ra
        out[..., : 2 * self.np] = gap.reshape(*gap.shape[:-2], 2 * self.np)
        d, a, b = self._along_lines(q, t, p), self.line_a, self.line_b
        wa, wb = qd[..., a, 2, None], qd[..., b, 2, None]
        rate = qd[..., b, :2] + wb * _left(p) - qd[..., a, :2] - wa * _left(t)
        bend = wa**2 * t - wb**2 * p
        parts = (w * bend + 2 * wa * _left(w) * rate - wa**2 * w * d).sum(-1)
        out[..., self.row_line] = parts
        return out

    def solve(self, jac: Array, right: Array) -> Array:
        """Solve jac x = right at every position; least squares where constraints are redundant."""
        if self.redundant or jac.shape[-1] != jac.shape[-2]:
            inverse: Array = np.asarray(np.linalg.pinv(jac, rcond=1e-11), dtype=np.float64)
            least: Array = np.einsum("...ij,...j->...i", inverse, right)
            return least
        solution: Array = np.asarray(np.linalg.solve(jac, right[..., None])[..., 0], dtype=np.float64)
        return solution

    def check_rank(self, q: Array) -> int:
        """Rank of C_q at q; sets `redundant`, and refuses a mechanism that is not fully driven."""
        singular = np.linalg.svd(self.jacobian(q)[:, 3:], compute_uv=False)
        rank = int((singular > 1e-9 * singular[0]).sum())
        if rank < 3 * len(self.bodies):
            raise Unreachable(f"the drivers leave {3 * len(self.bodies) - rank} freedoms")
        self.redundant = rank < self.rows
        return rank

    def assemble(self, guess: Array, u: Array, tolerance: float = 1e-13, limit: float = np.inf) -> Array:
        """Newton's method on all coordinates together from `guess` (bodies with the frame first, 3)."""
        q = guess.copy()
        size = 1.0 + float(np.abs(q[:, :2]).max())
        before, last = np.inf, False
        for _ in range(30):
            try:
                step = self.solve(self.jacobian(q)[:, 3:], -self.residual(q, u))
            except np.linalg.LinAlgError:
                break
            length = float(np.abs(step).max())
            if not length < limit or (before < np.inf and length > 0.5 * before and length > 1e-9 * size):
                break
            q[1:] += step.reshape(-1, 3)
            if last:
                return q
            last = length < 1e3 * tolerance * size
            before = length if limit < np.inf else np.inf
        raise Unreachable("Newton's method does not converge")

    def follow(self, q: Array, start: Array, end: Array, depth: int = 0) -> Array:
        """From the solution q at the driver coordinates `start` to that at `end`, halving steps."""
        if depth > 14:
            raise Unreachable(f"no way from {start} to {end}")
        if np.abs(end - start).max(initial=0.0) < 0.15 or depth > 4:
            try:
                return self.assemble(q, end, limit=0.4 * (1.0 + float(np.abs(q[:, :2]).max())))
            except Unreachable:
                pass
        middle = (start + end) / 2
        return self.follow(self.follow(q, start, middle, depth + 1), middle, end, depth + 1)

    def motion(self, start: Array, u0: Array, u: Array, ud: Array, udd: Array) -> Motion:
        """Positions and their rates at the driver coordinates u (n, drivers), from `start` at u0."""
        q = self.assemble(start, u0)
        self.check_rank(q)
        positions = np.empty((len(u), self.count, 3))
        before = u0
        for k, now in enumerate(u):
            q = positions[k] = self.follow(q, before, now)
            before = now
        return self.rates(positions, u, ud, udd)

    def rates(self, q: Array, u: Array, ud: Array, udd: Array) -> Motion:
        """Velocities and accelerations at known positions."""
        jac = self.jacobian(q)
        qd = np.zeros_like(q)
        qd[:, 1:] = self.solve(jac[..., 3:], ud @ self.selection.T).reshape(len(q), -1, 3)
        qdd = np.zeros_like(q)
        right = udd @ self.selection.T - self.quadratic(q, qd)
        qdd[:, 1:] = self.solve(jac[..., 3:], right).reshape(len(q), -1, 3)
        return Motion(self, q, qd, qdd, jac)


@dataclass(frozen=True)
class Motion:
    system: Multibody
    q: Array
    qd: Array
    qdd: Array
    jac: Array

    def point(self, body: str, local: Vec) -> tuple[Array, Array, Array]:
        """Position, velocity, acceleration (n, 2) of a point given in the body's axes."""
        k = self.system.index[body]
        c, s = np.cos(self.q[:, k, 2]), np.sin(self.q[:, k, 2])
        r = np.stack([c * local[0] - s * local[1], s * local[0] + c * local[1]], axis=-1)
        w, e = self.qd[:, k, 2, None], self.qdd[:, k, 2, None]
        position = self.q[:, k, :2] + r
        velocity = self.qd[:, k, :2] + w * _left(r)
        return position, velocity, self.qdd[:, k, :2] + e * _left(r) - w**2 * r

    def angle(self, body: str) -> tuple[Array, Array, Array]:
        k = self.system.index[body]
        return self.q[:, k, 2], self.qd[:, k, 2], self.qdd[:, k, 2]

    def direction(self, body: str, local_angle: float = 0.0) -> Array:
        turned = self.angle(body)[0] + local_angle
        return np.stack([np.cos(turned), np.sin(turned)], axis=-1)

    def condition(self) -> Array:
        """Condition number of the constraint Jacobian at every position."""
        singular = np.linalg.svd(self.jac[..., 3:], compute_uv=False)
        ratio: Array = singular[:, 0] / singular[:, -1]
        return ratio

    def forces(self, loads: Sequence[Load] = (), static: bool = False) -> Forces:
        """Newton-Euler equations of all bodies: M q'' + C_q^T lam = Q."""
        wrenches = [wrench for load in loads for wrench in load(self)]
        applied = np.zeros_like(self.q)
        for wrench in wrenches:
            k = self.system.index[wrench.body]
            applied[:, k, :2] += wrench.force
            applied[:, k, 2] += wrench.torque + _cross(wrench.point - self.q[:, k, :2], wrench.force)
        inertial = np.zeros_like(self.q) if static else self.inertia_terms()
        right = (applied - inertial)[:, 1:].reshape(len(self.q), -1)
        lam = self.system.solve(np.swapaxes(self.jac[..., 3:], -1, -2), right)
        return Forces(self, lam, wrenches, inertial)

    def inertia_terms(self) -> Array:
        """Rates of momentum and of moment of momentum about each body's origin, (n, bodies, 3)."""
        out = np.zeros_like(self.q)
        for body in self.system.bodies:
            k = self.system.index[body.name]
            centre, _, acceleration = self.point(body.name, body.centre)
            out[:, k, :2] = body.mass * acceleration
            arm = _cross(centre - self.q[:, k, :2], body.mass * acceleration)
            out[:, k, 2] = body.inertia * self.qdd[:, k, 2] + arm
        return out


@dataclass(frozen=True)
class Forces:
    motion: Motion
    lam: Array
    wrenches: list[Wrench]
    inertial: Array

    def on(self, name: str, body: str, point: Array | None = None) -> tuple[Array, Array]:
        """Force (n, 2) and couple (n,) about `point` (default: origin of the body) of constraints `name`."""
        system, n = self.motion.system, len(self.lam)
        total = np.zeros((n, 3))
        for c in system.constraints:
            if c.name == name and body in (c.a, c.b):
                total += self._part(c, body)
        reference = self.motion.q[:, system.index[body], :2]
        arm = _cross(reference - point, total[:, :2]) if point is not None else 0.0
        return total[:, :2], total[:, 2] + arm

    def _part(self, c: Constraint, body: str) -> Array:
        """Generalised force of one constraint on a body (moment about the body's origin)."""
        system = self.motion.system
        k = system.index[body]
        rows = system.constraint_rows(c)
        block = self.motion.jac[:, rows, 3 * k : 3 * k + 3]
        part: Array = -np.einsum("nri,nr->ni", block, self.lam[:, rows])
        return part

    def effort(self, name: str) -> Array:
        """Torque or force of the driver `name` on the driven body (reaction on the other)."""
        system = self.motion.system
        c = next(c for c in system.constraints if c.name == name)
        return -self.lam[:, system.constraint_rows(c)[0]]


def _left(v: Array) -> Array:
    out = np.empty_like(v)
    out[..., 0], out[..., 1] = -v[..., 1], v[..., 0]
    return out


def _cross(a: Array, b: Array) -> Array:
    out: Array = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return out
