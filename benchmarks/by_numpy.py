"""The same work in vectorised NumPy, as somebody writes it for just these mechanisms."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Values = Any


@dataclass
class Dyad:
    """Two links between P and Q: ``u`` = B - P, ``w`` = B - Q, rates of both links, B with its rates."""

    ux: Values
    uy: Values
    wx: Values
    wy: Values
    w1: Values
    w2: Values
    e1: Values
    e2: Values
    inverse: Values
    b: tuple[Values, ...]


def solve_dyad(p: tuple[Values, ...], qx: Values, qy: Values, r1: Values, r2: Values, side: Values) -> Dyad:
    """Circle intersection, then velocities and accelerations by Cramer's rule."""
    px, py, vx, vy, ax, ay = p
    dx, dy = qx - px, qy - py
    d2 = dx * dx + dy * dy
    t = d2 + (r1 * r1 - r2 * r2)
    root = side * np.sqrt(4.0 * r1 * r1 * d2 - t * t)
    half = 0.5 / d2
    along, across = t * half, root * half
    ux, uy = along * dx - across * dy, along * dy + across * dx
    wx, wy = ux - dx, uy - dy
    inverse = -2.0 / root
    w1, w2 = (vx * wx + vy * wy) * inverse, (vx * ux + vy * uy) * inverse
    s1, s2 = w1 * w1, w2 * w2
    gx, gy = ax - s1 * ux + s2 * wx, ay - s1 * uy + s2 * wy
    e1, e2 = (gx * wx + gy * wy) * inverse, (gx * ux + gy * uy) * inverse
    b = (px + ux, py + uy, -w2 * wy, w2 * wx, -e2 * wy - s2 * wx, e2 * wx - s2 * wy)
    return Dyad(ux, uy, wx, wy, w1, w2, e1, e2, inverse, b)


def crank_pin(cosine: Floats, sine: Floats, length: Values, speed: Values) -> tuple[Values, ...]:
    """Position, velocity, acceleration of the crank's end."""
    x, y = length * cosine, length * sine
    square = speed * speed
    return x, y, -speed * y, speed * x, -square * x, -square * y


def fourbar(cosine: Floats, sine: Floats, design: Values) -> tuple[Values, ...]:
    """22 arrays in the order of the C kernel; ``design``: 8 numbers or columns."""
    crank, speed, ground, coupler, rocker, side, u, v = design
    a = crank_pin(cosine, sine, crank, speed)
    d = solve_dyad(a, ground, 0.0, coupler, rocker, side)
    pu, pv = u / coupler, v / coupler
    rx, ry = pu * d.ux - pv * d.uy, pu * d.uy + pv * d.ux
    s1 = d.w1 * d.w1
    x, y, vx, vy, ax, ay = a
    bx, by, bvx, bvy, bax, bay = d.b
    positions = (x, y, bx, by, x + rx, y + ry)
    velocities = (vx, vy, bvx, bvy, vx - d.w1 * ry, vy + d.w1 * rx)
    accelerations = (ax, ay, bax, bay, ax - d.e1 * ry - s1 * rx, ay + d.e1 * rx - s1 * ry)
    return (*positions, *velocities, *accelerations, d.w1, d.w2, d.e1, d.e2)


def dyad_forces(
    d: Dyad, p: tuple[Values, ...], masses: Values, inertias: Values, gravity: Values, load: tuple[Values, Values]
) -> tuple[tuple[Values, Values], ...]:
    """Forces on the first link at P and B, and on the second at Q; ``load``: on pin B, taken by the second link."""
    (m1, m2), (j1, j2) = masses, inertias
    ax, ay, bx, by = p[4], p[5], d.b[4], d.b[5]
    f1x, f1y = 0.5 * m1 * (ax + bx), m1 * (0.5 * (ay + by) + gravity)
    f2x, f2y = 0.5 * m2 * bx, m2 * (0.5 * by + gravity)
    h1 = j1 * d.e1 - 0.5 * (d.ux * f1y - d.uy * f1x)
    h2 = j2 * d.e2 - 0.5 * (d.wx * f2y - d.wy * f2x)
    tx, ty = f1x + f2x - load[0], f1y + f2y - load[1]
    c = d.wx * ty - d.wy * tx + h2
    px, py = (d.ux * c + d.wx * h1) * d.inverse, (d.uy * c + d.wy * h1) * d.inverse
    return (px, py), (f1x - px, f1y - py), (tx - px, ty - py)


def sixbar(cosine: Floats, sine: Floats, design: Values) -> tuple[Values, ...]:
    """41 arrays in the order of the C kernel; ``design``: 21 numbers or columns."""
    crank, speed, x3, y3, pitman, rocker, side3, x5, y5, toggle, jaw, side5 = design[:12]
    masses, inertias, gravity = design[12:16], design[16:20], design[20]
    a = crank_pin(cosine, sine, crank, speed)
    d = solve_dyad(a, x3, y3, pitman, rocker, side3)
    h = solve_dyad(d.b, x5, y5, toggle, jaw, side5)
    outer_p, outer_b, outer_q = dyad_forces(h, d.b, masses[2:], inertias[2:], gravity, (0.0, 0.0))
    p, b, q = dyad_forces(d, a, masses[:2], inertias[:2], gravity, (-outer_p[0], -outer_p[1]))
    torque = a[0] * p[1] - a[1] * p[0]
    pins = (a, d.b, h.b)
    motion = (*(v for pin in pins for v in pin[:2]), *(v for pin in pins for v in pin[2:4]))
    motion = (*motion, *(v for pin in pins for v in pin[4:]))
    rates = (d.w1, d.w2, h.w1, h.w2, d.e1, d.e2, h.e1, h.e2)
    return (*motion, *rates, *p, *p, *b, *outer_p, *outer_b, *q, *outer_q, torque)


def fourbar_sweep(cosine: Floats, sine: Floats, designs: Floats, block: int) -> Floats:
    """Five metrics per design, (designs, 5), in blocks that stay in the cache."""
    result = np.empty((len(designs), 5))
    for first in range(0, len(designs), block):
        part = designs[first : first + block]
        d = fourbar(cosine, sine, part.T[:, :, None])
        ux, uy, wx, wy = d[2] - d[0], d[3] - d[1], d[2] - part[:, 2, None], d[3]
        into = result[first : first + block]
        into[:, 0] = ((ux * wy - uy * wx) ** 2).min(1)
        into[:, 1] = (d[10] ** 2 + d[11] ** 2).max(1)
        into[:, 2] = (d[16] ** 2 + d[17] ** 2).max(1)
        into[:, 3], into[:, 4] = (d[19] ** 2).max(1), (d[21] ** 2).max(1)
    return result


def sixbar_sweep(cosine: Floats, sine: Floats, designs: Floats, block: int) -> Floats:
    """Six metrics per design, (designs, 6)."""
    result = np.empty((len(designs), 6))
    for first in range(0, len(designs), block):
        d = sixbar(cosine, sine, designs[first : first + block].T[:, :, None])
        into = result[first : first + block]
        into[:, 0] = (d[40] ** 2).max(1)
        for column, at in ((1, 26), (2, 36), (3, 38), (4, 34), (5, 16)):
            into[:, column] = (d[at] ** 2 + d[at + 1] ** 2).max(1)
    return result
