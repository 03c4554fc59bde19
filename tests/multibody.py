"""Motion under forces by an independent multibody code, with the forces in the joints: witness of `linkwright.run`.

Every link has three coordinates (x, y, phi), every joint is a constraint (`tests/reference/multibody.py`), nothing
prescribes the drivers but those that are named. Of all accelerations that the joints allow, the true ones deviate
least from those of the free links, measured by the masses (Gauss): with a basis N of what the Jacobian J leaves,

    a = p + N z,   J p = -C'',   (N' M N) z = N' (Q - M p),

so that neither massless links nor redundant joints do harm. Positions and velocities are brought back onto the joints
after every step of DOP853. Of the package only the mechanism's data are read; a start is found from drawing and
assembly words by the reference, that of geared mechanisms from the links as `linkwright.solve_motion` puts them.
Sources: F. E. Udwadia, R. E. Kalaba, Analytical Dynamics, 1996; E. J. Haug, Computer Aided Kinematics and Dynamics of
Mechanical Systems, 1989, chapter 11.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from math import cos, sin
from typing import Any

import numpy as np
from scipy.integrate import DOP853
from scipy.linalg import qr, solve_triangular
from tests.reference.adapted_loads import KINDS, Course, friction_loads
from tests.reference.adapter import link_points, starting_position
from tests.reference.geared import Geared, Row, pressed_forces
from tests.reference.geared_adapter import driven_system, like
from tests.reference.laws import law_values
from tests.reference.multibody import Array, Forces, Motion, Wrench

import linkwright as lw

#: Forces and torques on links at the states of a motion and at its times (n,).
Loading = Callable[[Motion, Array], list[Wrench]]
#: A rotor: the link that turns it, the link that carries it, its moment of inertia as that link feels it, kg·m².
Rotor = tuple[str, str, float]
#: Singular values of the joints' Jacobian below this share of the largest are taken for zero.
RANK = 1e-10
#: How often friction and joint forces are found from each other at most.
REPEATED = 100


@dataclass(frozen=True)
class FreeMotion:
    """Positions, velocities and accelerations at ``time``; ``gap``: by how much a step left the joints at most."""

    owner: FreeMultibody
    time: Array
    motion: Motion
    gap: float

    @property
    def kinetic(self) -> Array:
        """Kinetic energy (n,), J."""
        rates = self.motion.qd[:, 1:].reshape(len(self.time), -1)
        return np.array([0.5 * v @ self.owner.masses(q) @ v for q, v in zip(self.motion.q, rates, strict=True)])

    @cached_property
    def forces(self) -> Forces:
        """Forces in the joints, from the multipliers; without what the teeth press apart with."""
        return self.owner.forces(self.motion, self.time)

    @cached_property
    def pressed(self) -> tuple[Forces, dict[str, list[Wrench]]]:
        """The same of geared mechanisms, with what the teeth press apart with by the names of the pairs."""
        wrenches = self.owner.wrenches(self.motion, self.time)
        return pressed_forces(self.motion, [lambda _motion: wrenches])


class FreeMultibody:
    """A mechanism whose drivers are free; ``prescribed`` names those that keep their laws.

    ``loading`` acts beside gravity and the loads of the mechanism; ``rotors`` turn with the links.
    """

    def __init__(
        self,
        mechanism: Any,
        *,
        prescribed: Collection[str] = (),
        loading: Sequence[Loading] = (),
        rotors: Sequence[Rotor] = (),
    ) -> None:
        self.mechanism, self.loading, self.rotors = mechanism, loading, rotors
        self.driven = driven_system(mechanism)
        self.assembled = self._assembled()
        self.free = [name for name in mechanism.drivers if name not in prescribed]
        released = {f"driver {name}" for name in self.free}
        kept = [c for c in self.driven.constraints if c.name not in released and not isinstance(c, Row)]
        self.system = like(self.driven, kept, getattr(self.driven, "rolling", []))
        size = max(map(float, np.abs(self.driven.local).ravel()), default=1.0)
        self.scale = np.tile([1.0, 1.0, 1.0 / (size or 1.0)], len(self.system.bodies))
        self.rubs = any(getattr(joint, "friction", 0.0) for joint in mechanism.joints.values())
        self._locals = np.array([body.centre for body in self.system.bodies])
        self._mass = np.array([body.mass for body in self.system.bodies])
        self._inertia = np.array([body.inertia for body in self.system.bodies])

    # start --------------------------------------------------------------------------------------
    def start(self, at: Mapping[str, float] | None = None, rates: Mapping[str, float] | None = None) -> Array:
        """State (2, links and frame, 3) with the drivers' coordinates and rates: those of their laws, and at rest."""
        laws = {name: _law_at(driver.law) for name, driver in self.mechanism.drivers.items()}
        u = np.array([(at or {}).get(name, laws[name][0]) for name in laws])
        own = {name: 0.0 if name in self.free else laws[name][1] for name in laws}
        ud = np.array([(rates or {}).get(name, own[name]) for name in laws])
        q, u0 = self.assembled
        q = self.driven.follow(q, u0, u)
        self.driven.check_rank(q)
        return np.array([q, self.driven.rates(q[None], u[None], ud[None], np.zeros((1, len(u)))).qd[0]])

    def _assembled(self) -> tuple[Array, Array]:
        """An assembled position (links and frame, 3) with its driver coordinates; wheels mesh as they are in it."""
        u = np.array([_law_at(driver.law)[0] for driver in self.mechanism.drivers.values()])
        if not isinstance(self.driven, Geared):
            return starting_position(self.mechanism, self.driven, u)
        q, found = np.zeros((self.driven.count, 3)), lw.solve_motion(self.mechanism, times=[0.0])
        for name, k in list(self.driven.index.items())[1:]:
            first, (x, y) = next(iter(link_points(self.mechanism, name).items()))
            phi = float(found.link(name).angle[0])
            turned = cos(phi) * x - sin(phi) * y, sin(phi) * x + cos(phi) * y
            q[k] = *(found.point(f"{name}.{first}").position[0] - turned), phi
        meshing = [replace(c, value=float(c.at(self.driven, q))) for c in self.driven.rolling]
        plain = [c for c in self.driven.constraints if not isinstance(c, Row)]
        self.driven = like(self.driven, plain, meshing)
        return self.driven.assemble(q, u), u

    # equation of motion -------------------------------------------------------------------------
    def masses(self, q: Array) -> Array:
        """The mass matrix of all links in the coordinates of their axes."""
        n, phi = len(self._mass), q[1:, 2]
        c, s, (x, y) = np.cos(phi), np.sin(phi), self._locals.T
        rx, ry, at, found = c * x - s * y, s * x + c * y, 3 * np.arange(n), np.zeros((3 * n, 3 * n))
        found[at, at] = found[at + 1, at + 1] = self._mass
        found[at, at + 2] = found[at + 2, at] = -self._mass * ry
        found[at + 1, at + 2] = found[at + 2, at + 1] = self._mass * rx
        found[at + 2, at + 2] = self._inertia + self._mass * (rx**2 + ry**2)
        for link, against, inertia in self.rotors:
            turn = np.zeros(3 * n)
            turn[3 * self.system.index[link] - 1] = 1.0
            if self.system.index.get(against):
                turn[3 * self.system.index[against] - 1] -= 1.0
            found += inertia * np.outer(turn, turn)
        return found

    def wrenches(self, motion: Motion, time: Array, *, inertia: bool = True) -> list[Wrench]:
        """Gravity, the loads of the mechanism, and what was given beside them; rotors where ``inertia`` is asked."""
        found, none = [], np.zeros((len(time), 2))
        gravity = np.broadcast_to(self.mechanism.gravity, none.shape)
        for body in self.system.bodies:
            place = motion.point(body.name, body.centre)[0]
            found.append(Wrench(body.name, place, body.mass * gravity, none[:, 0]))
        course = _Measured(self, motion, time)
        for load in self.mechanism.loads.values():
            found += KINDS[load.kind](self.mechanism, load, course)(motion)
        for each in self.loading:
            found += each(motion, time)
        for link, against, own in self.rotors if inertia else ():
            alpha = motion.angle(link)[2] - motion.angle(against)[2]
            found += couple(link, -own * alpha, against)
        return found

    def forces(self, motion: Motion, time: Array) -> Forces:
        """Forces in the joints of a motion; friction from their own sizes, found again until they agree."""
        wrenches = self.wrenches(motion, time)
        found = motion.forces([lambda _motion: wrenches])
        for _ in range(REPEATED if self.rubs else 0):
            friction, before = friction_loads(self.mechanism, motion, found).values(), found.lam
            found = motion.forces([lambda _motion: wrenches, *friction])
            if np.abs(found.lam - before).max() <= 1e-14 * np.abs(before).max():
                break
        return found

    def coordinates(self, motion: Motion) -> tuple[Array, Array]:
        """Coordinates and rates of the drivers (n, drivers) as the links are."""
        rows = [int(np.flatnonzero(self.driven.selection[:, k])[0]) for k in range(self.driven.drivers)]
        values = self.driven.residual(motion.q, np.zeros((len(motion.q), self.driven.drivers)))[:, rows]
        rates = motion.qd[:, 1:].reshape(len(motion.q), -1, 1)
        return values, (self.driven.jacobian(motion.q)[:, rows, 3:] @ rates)[..., 0]

    def acceleration(self, t: float, q: Array, qd: Array) -> Array:
        """Accelerations (links and frame, 3) in a state; friction from the joint forces, until they agree."""
        motion = Motion(self.system, q[None], qd[None], 0.0 * q[None], self.system.jacobian(q)[None])
        time, rubbing = np.array([t]), list[Wrench]()
        applied = self.wrenches(motion, time, inertia=False)
        found = self._under(motion, applied)
        for _ in range(REPEATED if self.rubs else 0):
            before, moved = found, replace(motion, qdd=found[None])
            known = [*self.wrenches(moved, time), *rubbing]
            forces = moved.forces([lambda _motion, known=known: known])  # type: ignore[misc]
            rubs = friction_loads(self.mechanism, moved, forces).values()
            rubbing = [wrench for load in rubs for wrench in load(moved)]
            found = self._under(motion, applied + rubbing)
            if np.abs(found - before).max() <= 1e-13 * np.abs(before).max():
                break
        return found

    def _under(self, motion: Motion, wrenches: Sequence[Wrench]) -> Array:
        """Accelerations in the one state of a motion under forces and torques."""
        system, q, qd, jac = self.system, motion.q[0], motion.qd[0], motion.jac[0]
        out, applied = np.zeros_like(q), np.zeros_like(q)
        for wrench in wrenches:
            k, force = system.index[wrench.body], wrench.force[0]
            arm = wrench.point[0] - q[k, :2]
            applied[k] += *force, wrench.torque[0] + arm[0] * force[1] - arm[1] * force[0]
        applied -= motion.inertia_terms()[0]  # of no accelerations: what turning about the axes' origins asks for
        particular, basis = self._allowed(jac[:, 3:], -system.quadratic(q, qd))
        mass, right = self.masses(q), applied[1:].ravel()
        reduced = basis.T @ mass @ basis
        free = np.linalg.solve(reduced, basis.T @ (right - mass @ particular)) if basis.size else np.zeros(0)
        out[1:] = (particular + basis @ free).reshape(-1, 3)
        return out

    def _allowed(self, jac: Array, right: Array) -> tuple[Array, Array]:
        """A solution of jac x = right, and a basis of what jac leaves open."""
        scaled = jac * self.scale
        spread, r, order = qr(scaled.T, pivoting=True, check_finite=False)
        size = np.abs(np.diag(r))
        rank = int((size > RANK * size[0]).sum()) if size.size else 0
        head = solve_triangular(r[:rank, :rank], right[order[:rank]], trans="T", check_finite=False)
        return self.scale * (spread[:, :rank] @ head), self.scale[:, None] * spread[:, rank:]

    # integration --------------------------------------------------------------------------------
    def run(self, start: Array, times: Array, *, rtol: float = 1e-12) -> FreeMotion:
        """The motion from a state of :meth:`start` at the first of the times, s, at all of them."""
        half, states, gap = start[0].size, [start], 0.0
        for begin, end in pairwise(times):
            solver = DOP853(self._rate, begin, states[-1].ravel(), end, rtol=rtol, atol=0.1 * rtol)
            while solver.status == "running":
                message = solver.step()
                assert solver.status != "failed", message
                gap = max(gap, self._back(solver.t, solver.y[:half], solver.y[half:]))
                solver.f = self._rate(solver.t, solver.y)
            states.append(solver.y.reshape(start.shape).copy())
        q, qd = np.array(states)[:, 0], np.array(states)[:, 1]
        qdd = np.array([self.acceleration(t, a, b) for t, a, b in zip(times, q, qd, strict=True)])
        return FreeMotion(self, times, Motion(self.system, q, qd, qdd, self.system.jacobian(q)), gap)

    def _rate(self, t: float, y: Array) -> Array:
        q, qd = y.reshape(2, -1, 3)
        return np.concatenate([qd.ravel(), self.acceleration(t, q, qd).ravel()])

    def _back(self, t: float, q: Array, qd: Array) -> float:
        """Brings a state back onto the joints, in place; by how much it was off."""
        q, qd, off = q.reshape(-1, 3), qd.reshape(-1, 3), 0.0
        u, ud = self._prescribed(t)
        for _ in range(2):
            gap = self.system.residual(q, u)
            off = max(off, float(np.abs(gap).max(initial=0.0)))
            q[1:] -= self._allowed(self.system.jacobian(q)[:, 3:], gap)[0].reshape(-1, 3)
        jac = self.system.jacobian(q)[:, 3:]
        qd[1:] -= self._allowed(jac, jac @ qd[1:].ravel() - self.system.selection @ ud)[0].reshape(-1, 3)
        return off

    def _prescribed(self, t: float) -> tuple[Array, Array]:
        laws = [_law_at(driver.law, t) for driver in self.mechanism.drivers.values()]
        u, ud = np.array(laws).reshape(-1, 2).T
        return u, ud


class _Measured(Course):
    """The motion as magnitudes see it, with the input as the links have it."""

    def __init__(self, owner: FreeMultibody, motion: Motion, time: Array) -> None:
        self.mechanism, self.motion, self.time, self._owner = owner.mechanism, motion, time, owner

    @cached_property
    def input(self) -> Array:  # type: ignore[override]
        return self._owner.coordinates(self.motion)[0][:, 0]

    @cached_property
    def rate(self) -> Array:  # type: ignore[override]
        return self._owner.coordinates(self.motion)[1][:, 0]


def couple(link: str, torque: Array, against: str = "frame") -> list[Wrench]:
    """A torque (n,) on a link, and its opposite on the one that takes it."""
    none = np.zeros((len(torque), 2))
    return [Wrench(link, none, none, torque), Wrench(against, none, none, -torque)]


def motor(link: str, torque: Callable[[Array, Array], Array], against: str = "frame") -> Loading:
    """A motor between two links: its torque on the first from the speed, rad/s, and the time, s."""
    return lambda motion, time: couple(link, torque(motion.angle(link)[1] - motion.angle(against)[1], time), against)


def _law_at(law: Any, t: float = 0.0) -> tuple[float, float]:
    """Coordinate and rate of a law; a free one begins at its start."""
    if not any(hasattr(law, each) for each in ("speed", "times", "expression")):
        return law.start, 0.0
    value = law_values(law, np.array([t]))
    return float(value.f[0]), float(value.d[0])
