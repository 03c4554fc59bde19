"""Loads of the reference: each a plain formula that gives forces and torques on bodies at every position."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from tests.reference.multibody import FRAME, Array, Load, Motion, Vec, Wrench


def _force(motion: Motion, body: str, point: Array, force: ArrayLike) -> Wrench:
    spread = np.broadcast_to(np.asarray(force, dtype=float), point.shape)
    return Wrench(body, point, spread, np.zeros(len(point)))


def _torque(motion: Motion, body: str, torque: ArrayLike) -> Wrench:
    n = len(motion.q)
    return Wrench(body, np.zeros((n, 2)), np.zeros((n, 2)), np.broadcast_to(np.asarray(torque, float), (n,)))


def gravity(g: Vec) -> Load:
    """Weight m g of every moving body at its mass centre."""

    def load(motion: Motion) -> list[Wrench]:
        return [
            _force(motion, body.name, motion.point(body.name, body.centre)[0], body.mass * np.array(g))
            for body in motion.system.bodies
        ]

    return load


def force_in_space(body: str, at: Vec, force: ArrayLike) -> Load:
    """A force (2,) or (n, 2) with components in frame axes, at a point of the body."""
    return lambda motion: [_force(motion, body, motion.point(body, at)[0], force)]


def force_in_link(body: str, at: Vec, force: ArrayLike, axes: str) -> Load:
    """A force whose components (2,) or (n, 2) are given in the axes of the body `axes`."""

    def load(motion: Motion) -> list[Wrench]:
        x = motion.direction(axes)
        y = np.stack([-x[:, 1], x[:, 0]], axis=-1)
        parts = np.broadcast_to(np.asarray(force, dtype=float), x.shape)
        return [_force(motion, body, motion.point(body, at)[0], parts[:, :1] * x + parts[:, 1:] * y)]

    return load


def torque(body: str, value: ArrayLike, reaction_on: str = FRAME) -> Load:
    """A torque on the body, and its opposite on `reaction_on`."""
    return lambda motion: [
        _torque(motion, body, value),
        _torque(motion, reaction_on, -np.asarray(value, dtype=float)),
    ]


def spring(
    a: tuple[str, Vec], b: tuple[str, Vec], stiffness: float, free_length: float, damping: float = 0.0
) -> Load:
    """Spring and damper between two points: tension k (l - l0) + c dl/dt along the line."""

    def load(motion: Motion) -> list[Wrench]:
        (pa, va, _), (pb, vb, _) = motion.point(*a), motion.point(*b)
        length = np.hypot(*(pb - pa).T)
        along = (pb - pa) / length[:, None]
        tension = stiffness * (length - free_length) + damping * ((vb - va) * along).sum(1)
        pull = tension[:, None] * along
        return [_force(motion, a[0], pa, pull), _force(motion, b[0], pb, -pull)]

    return load


def torsion_spring(a: str, b: str, stiffness: float, free_angle: float, damping: float = 0.0) -> Load:
    """Torque on b: -k (phi_b - phi_a - free angle) - c (phi_b - phi_a)'; the opposite on a."""

    def load(motion: Motion) -> list[Wrench]:
        (pa, wa, _), (pb, wb, _) = motion.angle(a), motion.angle(b)
        on_b = -stiffness * (pb - pa - free_angle) - damping * (wb - wa)
        return [_torque(motion, b, on_b), _torque(motion, a, -on_b)]

    return load
