"""Random linkages that turn fully, and their curves (kernels)."""

from __future__ import annotations

from math import cos, exp, log, sin, sqrt

from linkwright.formula.kernel import Reals, Wholes
from linkwright.synthesis.free_curve.kernels import BLOCK, DYAD, POINT, TURN, place_dyad, place_point
from linkwright.synthesis.free_curve.sliding import place_block, place_slider


def spans(N: int, px: Reals, py: Reals, qx: Reals, qy: Reals, out: Reals) -> None:
    """Smallest and largest distance of two nodes, out[0:2]."""
    low, high = 1e18, 0.0
    for t in range(N):
        ux, uy = qx[t] - px[t], qy[t] - py[t]
        square = ux * ux + uy * uy
        low = min(low, square)
        high = max(high, square)
    out[0] = sqrt(low)
    out[1] = sqrt(high)


def even_points(zx: Reals, zy: Reals, N: int, M: int, Z: Reals) -> float:
    """M points even in arc length on a closed curve, centred, rms radius 1, as complex numbers; gives the radius."""
    length = 0.0
    for t in range(N):
        u = t + 1 if t + 1 < N else 0
        length += sqrt((zx[u] - zx[t]) * (zx[u] - zx[t]) + (zy[u] - zy[t]) * (zy[u] - zy[t]))
    if length < 0.3:
        return -1.0
    t, at, step, cx, cy, square = -1, 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(M):
        goal = length * k / M
        while goal >= at + step and t < N - 1:
            at += step
            t += 1
            u = t + 1 if t + 1 < N else 0
            step = sqrt((zx[u] - zx[t]) * (zx[u] - zx[t]) + (zy[u] - zy[t]) * (zy[u] - zy[t])) + 1e-12
        u = t + 1 if t + 1 < N else 0
        s = (goal - at) / step
        Z[2 * k] = zx[t] + s * (zx[u] - zx[t])
        Z[2 * k + 1] = zy[t] + s * (zy[u] - zy[t])
        cx += Z[2 * k] / M
        cy += Z[2 * k + 1] / M
    for k in range(M):
        Z[2 * k] -= cx
        Z[2 * k + 1] -= cy
        square += (Z[2 * k] * Z[2 * k] + Z[2 * k + 1] * Z[2 * k + 1]) / M
    radius = sqrt(square)
    for k in range(2 * M):
        Z[k] = Z[k] / radius
    return radius


def draw_slide(
    kind: int,
    N: int,
    a: float,
    b: float,
    px: Reals,
    py: Reals,
    qx: Reals,
    qy: Reals,
    x: Reals,
    y: Reals,
    out: Reals,
    own: Reals,
) -> float:
    """A sliding dyad from two uniform numbers, its own numbers, drawn after the range that it must span."""
    if kind == BLOCK:
        spans(N, px, py, qx, qy, out)
        if out[0] < 0.02 * out[1]:
            return -1.0
        own[0] = log(out[1])
        own[1] = out[0] * 0.98 * (2.0 * b - 1.0)
        return place_block(N, out[1], own[1], 1.0, px, py, qx, qy, x, y)
    c, s, far = cos(TURN * b), sin(TURN * b), 0.0
    for t in range(N):
        h = c * (py[t] - qy[t]) - s * (px[t] - qx[t])
        far = max(far, h * h)
    r = sqrt(far) * (1.02 + 1.5 * a * a)
    own[0] = log(r)
    own[1] = TURN * b
    return place_slider(N, r, own[1], 1.0, px, py, qx, qy, x, y)


def draw_linkage(nodes: Wholes, count: int, N: int, x: Reals, r: Reals, limit: float, room: Reals) -> float:
    """From uniform numbers r a linkage x that turns fully with sin² μ ≥ ``limit``, placed in ``room``; -1: none.

    The lengths of a dyad are drawn after the range of the distance that it must span, so nearly every draw closes.
    """
    X, Y, out = room, room + count * N, room + 2 * count * N
    for t in range(N):
        X[t] = 0.0
        Y[t] = 0.0
        X[N + t] = cos(TURN * t / N)
        Y[N + t] = sin(TURN * t / N)
    for k in range(2, count):
        kind, a, b = nodes[4 * k], r[2 * k - 4], r[2 * k - 3]
        i, j, own = nodes[4 * k + 1] * N, nodes[4 * k + 2] * N, k * N
        if kind == DYAD:
            spans(N, X + i, Y + i, X + j, Y + j, out)
            if out[0] < 0.02 * out[1]:
                return -1.0
            total, difference = out[1] * (1.02 + 1.5 * a * a), out[0] * 0.98 * (2.0 * b - 1.0)
            if total - sqrt(difference * difference) < 0.16:
                return -1.0
            first, second, side = (0.5 * (total + difference), 0.5 * (total - difference), 1.0 * nodes[4 * k + 3])
            x[2 * k - 4] = log(first)
            x[2 * k - 3] = log(second)
            found = place_dyad(N, first, second, side, X + i, Y + i, X + j, Y + j, X + own, Y + own)
            if found < limit:
                return -1.0
        elif kind > DYAD:
            found = draw_slide(kind, N, a, b, X + i, Y + i, X + j, Y + j, X + own, Y + own, out, x + (2 * k - 4))
            if found < limit:
                return -1.0
        else:
            size = 0.15 * exp(2.9 * a) if kind == POINT else 0.3 * exp(3.0 * a)
            px, py = size * cos(TURN * b), size * sin(TURN * b)
            x[2 * k - 4] = px
            x[2 * k - 3] = py
            if kind == POINT:
                place_point(N, px, py, X + i, Y + i, X + j, Y + j, X + own, Y + own)
            else:
                for t in range(N):
                    X[own + t] = px
                    Y[own + t] = py
    return 1.0


def draw_linkages(
    nodes: Wholes,
    count: int,
    N: int,
    x: Reals,
    r: Reals,
    limit: float,
    M: int,
    Z: Reals,
    room: Reals,
    draws: int,
    radius: Reals,
) -> None:
    """Many of one structure with their curves; ``radius`` is negative where there is none."""
    size, own = 2 * (count - 2), (count - 1) * N
    for c in range(draws):
        radius[c] = draw_linkage(nodes, count, N, x + c * size, r + c * size, limit, room)
        if radius[c] > 0.0:
            radius[c] = even_points(room + own, room + count * N + own, N, M, Z + 2 * c * M)


SAMPLING = (spans, even_points, draw_slide, draw_linkage, draw_linkages)
