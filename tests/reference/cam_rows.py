"""Rows of cams for the reference: the follower's coordinate on its carrier against the lift at the cam's angle.

A guided follower: w . (P - C) - f(psi) = value, w a direction of the carrier; one on a pivot A: side (phi_a -
phi_k) - f(psi) = value; psi the cam's angle on the carrier in the sense in which the program runs. The multiplier of
such a row is no force at the contact. That force has the multiplier's power where the follower alone moves; it goes
through the roller's centre or the edge, across the velocity that the cam sees there, and is normal to a flat face, on
which the cam sees its place move along the face. What of it the row is not stands in `beside`.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
from tests.reference.geared import Geared, Row, Slopes, joined, left
from tests.reference.multibody import Array, Motion, Vec, Wrench


@dataclass(frozen=True)
class Lift:
    """A cycloidal rise over the angle ``rise`` and the same fall over the rest of a turn."""

    height: float
    rise: float

    def curves(self, psi: Array) -> tuple[Array, Array, Array]:
        """The lift and its first two derivatives."""
        x = np.mod(psi, 2 * pi)
        up = x < self.rise
        span = np.where(up, self.rise, 2 * pi - self.rise)
        u = 2 * pi * np.where(up, x, x - self.rise) / span
        s, v, a = (u - np.sin(u)) / (2 * pi), (1 - np.cos(u)) / span, 2 * pi * np.sin(u) / span**2
        h = self.height
        return h * np.where(up, s, 1 - s), h * np.where(up, v, -v), h * np.where(up, a, -a)


@dataclass(frozen=True)
class CamRow(Row):
    """Follower a with its roller's centre, edge or point of the face pa, cam b, their carrier k."""

    carrier: str
    lift: Lift
    phase: float
    sense: float
    flat: bool

    def curves(self, system: Geared, q: Array) -> tuple[Array, Array, Array]:
        """The lift, and its first two derivatives by the cam's angle on the carrier."""
        turned = system.turned(q, self.b) - system.turned(q, self.carrier)
        f, first, second = self.lift.curves(self.sense * (turned - self.phase))
        return f, self.sense * first, second

    def _bend(self, system: Geared, q: Array, qd: Array) -> Array:
        rate = qd[..., system.index[self.b], 2] - qd[..., system.index[self.carrier], 2]
        return np.asarray(-self.curves(system, q)[2] * rate**2)

    def beside(self, motion: Motion, lam: Array) -> list[Wrench]:
        system = motion.system
        assert isinstance(system, Geared)
        force, place, none = *self._contact(motion, lam), np.zeros(len(lam))
        found = [Wrench(self.a, place, force, none), Wrench(self.b, place, -force, none)]
        for body, slope in self.slopes(system, motion.q).items():
            own = slope * lam[:, None]
            found.append(Wrench(body, motion.q[:, system.index[body], :2], own[:, :2], own[:, 2]))
        return found

    def _contact(self, motion: Motion, lam: Array) -> tuple[Array, Array]:
        """The force on the follower, and where it acts."""
        raise NotImplementedError

    def _seen(self, motion: Motion, body: Vec) -> tuple[Array, Array]:
        """Where a point of the follower is, and its velocity as the cam sees it."""
        place, velocity, _ = motion.point(self.a, body)
        cam = motion.system.index[self.b]
        own = motion.qd[:, cam, :2] + motion.qd[:, cam, 2, None] * left(place - motion.q[:, cam, :2])
        return place, velocity - own

    def _spin(self, motion: Motion) -> Array:
        """How fast the follower turns as the cam sees it."""
        a, b = (motion.system.index[body] for body in (self.a, self.b))
        return motion.qd[:, a, 2] - motion.qd[:, b, 2]


@dataclass(frozen=True)
class GuidedCam(CamRow):
    """``way``: the direction of the guide, a vector of the carrier; ``centre``: the cam's, a point of it."""

    way: Vec
    centre: Vec

    def at(self, system: Geared, q: Array) -> Array:
        gap = system.place(q, self.a, self.pa) - system.place(q, self.carrier, self.centre)
        return np.asarray((system.arm(q, self.carrier, self.way) * gap).sum(-1) - self.curves(system, q)[0])

    def slopes(self, system: Geared, q: Array) -> Slopes:
        w, first = system.arm(q, self.carrier, self.way), self.curves(system, q)[1]
        ra, rc = system.arm(q, self.a, self.pa), system.arm(q, self.carrier, self.centre)
        gap = system.place(q, self.a, self.pa) - system.place(q, self.carrier, self.centre)
        turn = (left(w) * gap).sum(-1) - (w * left(rc)).sum(-1) + first
        zero = np.zeros_like(w)
        return {
            self.a: joined(w, (w * left(ra)).sum(-1)),
            self.carrier: joined(-w, turn),
            self.b: joined(zero, -first),
        }

    def quadratic(self, system: Geared, q: Array, qd: Array) -> Array:
        gap, rate, bend = system.gap(q, qd, (self.carrier, self.centre), (self.a, self.pa))
        w, turning = system.arm(q, self.carrier, self.way), qd[..., system.index[self.carrier], 2, None]
        along = (w * bend + 2 * turning * left(w) * rate - turning**2 * w * gap).sum(-1)
        return np.asarray(along + self._bend(system, q, qd))

    def _contact(self, motion: Motion, lam: Array) -> tuple[Array, Array]:
        system = motion.system
        assert isinstance(system, Geared)
        w = system.arm(motion.q, self.carrier, self.way)
        place, seen = self._seen(motion, self.pa)
        if self.flat:
            along = (seen * w).sum(1) / self._spin(motion)
            return -lam[:, None] * w, place + along[:, None] * left(w)
        n = left(seen)
        return n * (-lam / (n * w).sum(1))[:, None], place


@dataclass(frozen=True)
class SwingingCam(CamRow):
    """``pivot``: of the follower, a point of it; ``side``: 1 where the lift turns it counter-clockwise, else -1."""

    pivot: Vec
    side: float

    @property
    def jump(self) -> float:  # type: ignore[override]
        return 2 * pi

    def at(self, system: Geared, q: Array) -> Array:
        turned = system.turned(q, self.a) - system.turned(q, self.carrier)
        return np.asarray(self.side * turned - self.curves(system, q)[0])

    def slopes(self, system: Geared, q: Array) -> Slopes:
        first = self.curves(system, q)[1]
        zero, one = np.zeros((*first.shape, 2)), np.ones_like(first)
        return {
            self.a: joined(zero, self.side * one),
            self.b: joined(zero, -first),
            self.carrier: joined(zero, first - self.side),
        }

    def quadratic(self, system: Geared, q: Array, qd: Array) -> Array:
        return self._bend(system, q, qd)

    def _contact(self, motion: Motion, lam: Array) -> tuple[Array, Array]:
        pivot, turned = self._seen(motion, self.pivot)
        place, seen = self._seen(motion, self.pa)
        arm = place - pivot
        if self.flat:
            u = arm / np.hypot(*arm.T)[:, None]
            along = -(turned * left(u)).sum(1) / self._spin(motion)
            return left(u) * (-lam * self.side / along)[:, None], pivot + along[:, None] * u
        n = left(seen)
        return n * (-lam * self.side / (n * left(arm)).sum(1))[:, None], place
