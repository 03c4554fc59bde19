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
    a: tuple[str, Vec], b: tuple[str, Vec], stiffness: float, free_length: float, preload: float = 0.0
) -> Load:
    """Spring between two points: tension preload + k (l - l0) along the line."""

    def load(motion: Motion) -> list[Wrench]:
        length, _ = _distance(motion, a, b)
        return _pull(motion, a, b, preload + stiffness * (length - free_length))

    return load


def damper(a: tuple[str, Vec], b: tuple[str, Vec], damping: float) -> Load:
    """Damper between two points: tension c dl/dt along the line."""
    return lambda motion: _pull(motion, a, b, damping * _distance(motion, a, b)[1])


def _distance(motion: Motion, a: tuple[str, Vec], b: tuple[str, Vec]) -> tuple[Array, Array]:
    """Distance of two points and its rate."""
    (pa, va, _), (pb, vb, _) = motion.point(*a), motion.point(*b)
    length = np.hypot(*(pb - pa).T)
    return length, ((vb - va) * (pb - pa)).sum(1) / length


def _pull(motion: Motion, a: tuple[str, Vec], b: tuple[str, Vec], tension: Array) -> list[Wrench]:
    pa, pb = motion.point(*a)[0], motion.point(*b)[0]
    pull = (tension / np.hypot(*(pb - pa).T))[:, None] * (pb - pa)
    return [_force(motion, a[0], pa, pull), _force(motion, b[0], pb, -pull)]


def torsion_spring(a: str, b: str, stiffness: float, free_angle: float, preload: float = 0.0) -> Load:
    """Torque on b: -(preload + k (phi - phi0)); the opposite on a; phi within half a turn of phi0 at first."""

    def load(motion: Motion) -> list[Wrench]:
        twist = motion.angle(b)[0] - motion.angle(a)[0] - free_angle
        twist = twist - 2 * np.pi * np.round(twist[0] / (2 * np.pi))
        on_a = preload + stiffness * twist
        return [_torque(motion, a, on_a), _torque(motion, b, -on_a)]

    return load


def torsion_damper(a: str, b: str, damping: float) -> Load:
    """Torque on b: -c (omega_b - omega_a); the opposite on a."""

    def load(motion: Motion) -> list[Wrench]:
        on_a = damping * (motion.angle(b)[1] - motion.angle(a)[1])
        return [_torque(motion, a, on_a), _torque(motion, b, -on_a)]

    return load


def push_along_guide(guide: tuple[str, float], block: tuple[str, Vec], force: ArrayLike) -> Load:
    """A force on the block's point along the guide's direction, and the opposite on the guide there."""

    def load(motion: Motion) -> list[Wrench]:
        place = motion.point(*block)[0]
        push = np.asarray(force, dtype=float)[..., None] * motion.direction(*guide)
        return [_force(motion, block[0], place, push), _force(motion, guide[0], place, -push)]

    return load
