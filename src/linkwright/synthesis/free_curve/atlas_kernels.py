"""The atlas's kernels: random linkages that turn fully, and how near parts of their curves come to a wanted one.

A part is POINTS points of a curve, laid on the target by centroid and rms radius. Its mean distance from the target
is read from a table in polar coordinates, for TURNS turns of the picture at once, because a turn shifts the angle; at
the turn that is best so, the mean distance of LANDMARKS points of the target from the part is added.
"""

from __future__ import annotations

from math import cos, exp, log, sin, sqrt

from linkwright.formula.kernel import Reals, Wholes, load, maximum, minimum, root, spread, store, total
from linkwright.synthesis.free_curve.placing import (
    BLOCK,
    DYAD,
    POINT,
    TURN,
    place_block,
    place_dyad,
    place_point,
    place_slider,
)


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


#: Points of a part, turns tried, points of the target; angles and rings of the table, radius that it reaches to.
POINTS, TURNS, LANDMARKS, ANGLES, RINGS, REACH = 24, 16, 24, 64, 48, 3.0
#: Entries of the table's row of one ring and of one table; π/2 and π.
ROW, TABLE, QUARTER, HALF_TURN = 128, 6144, 1.5707963267948966, 3.141592653589793


def laid(z: Reals, places: Wholes, x: Reals, y: Reals) -> float:
    """Points of a curve z (complex), centred and with rms radius 1; gives the radius that they had."""
    for k in range(POINTS):
        x[k] = z[2 * places[k]]
        y[k] = z[2 * places[k] + 1]
    sx, sy, square = spread(0.0), spread(0.0), spread(0.0)
    for t in range(0, POINTS, 8):
        sx += load(x, t)
        sy += load(y, t)
    cx, cy = total(sx) / POINTS, total(sy) / POINTS
    for t in range(0, POINTS, 8):
        ux = load(x, t) - cx
        uy = load(y, t) - cy
        store(x, t, ux)
        store(y, t, uy)
        square += ux * ux + uy * uy
    radius = sqrt(total(square) / POINTS + 1e-12)
    for t in range(0, POINTS, 8):
        store(x, t, load(x, t) / radius)
        store(y, t, load(y, t) / radius)
    return radius


def polar(x: Reals, y: Reals, out: Reals) -> None:
    """Angles of points, in steps of the table (within 0.04), and their rings after them."""
    for t in range(0, POINTS, 8):
        ux, uy = load(x, t), load(y, t)
        ax, ay = maximum(ux, 0.0 - ux), maximum(uy, 0.0 - uy)
        q = minimum(ax, ay) / (maximum(ax, ay) + 1e-30)
        angle = q * (1.0584 - 0.273 * q)
        angle = angle if ay < ax else QUARTER - angle
        angle = HALF_TURN - angle if ux < 0.0 else angle
        angle = TURN - angle if uy < 0.0 else angle
        store(out, t, angle * (ANGLES / TURN) + 0.5)
        store(out, POINTS + t, minimum(root(ux * ux + uy * uy) * (RINGS / REACH), RINGS - 1.0))


def distances_turned(x: Reals, y: Reals, tables: Reals, room: Reals, sums: Reals) -> None:
    """Sums of the points' distances from the target at all turns, then from its mirror image."""
    polar(x, y, room)
    a, b, c, d = spread(0.0), spread(0.0), spread(0.0), spread(0.0)
    for k in range(POINTS):
        angle = int(room[k]) % ANGLES
        at = int(room[POINTS + k]) * ROW + angle % 4 * 32 + angle // 4
        a += load(tables, at)
        b += load(tables, at + 8)
        c += load(tables, TABLE + at)
        d += load(tables, TABLE + at + 8)
    store(sums, 0, a)
    store(sums, 8, b)
    store(sums, 16, c)
    store(sums, 24, d)


def distance_back(x: Reals, y: Reals, turn: int, mx: Reals, my: Reals, room: Reals) -> float:
    """Mean distance of the target's points from the nearest point of a part at a turn."""
    c, s = cos(turn * TURN / TURNS), sin(turn * TURN / TURNS)
    for t in range(0, POINTS, 8):
        store(room, t, c * load(x, t) - s * load(y, t))
        store(room, POINTS + t, s * load(x, t) + c * load(y, t))
    sum_ = spread(0.0)
    for t in range(0, LANDMARKS, 8):
        px, py, low = load(mx, t), load(my, t), spread(1e18)
        for k in range(POINTS):
            ux = px - room[k]
            uy = py - room[POINTS + k]
            low = minimum(low, ux * ux + uy * uy)
        sum_ += root(low)
    return total(sum_) / LANDMARKS


def likeness(
    curves: Reals,
    count: int,
    points: int,
    parts: Wholes,
    number: int,
    tables: Reals,
    landmarks: Reals,
    room: Reals,
    out: Reals,
) -> None:
    """Minimum distance over all parts, turns and both images of each curve, and (part · 2 + image) · TURNS + turn."""
    x, y, sums, work = room, room + POINTS, room + 2 * POINTS, room + 2 * POINTS + 4 * TURNS
    for each in range(count):
        best, which = 1e9, 0
        for part in range(number):
            if laid(curves + 2 * points * each, parts + part * POINTS, x, y) < 1e-3:
                continue
            distances_turned(x, y, tables, work, sums)
            for image in range(2):
                turn = 0
                for r in range(TURNS):
                    if sums[image * TURNS + r] < sums[image * TURNS + turn]:
                        turn = r
                there = sums[image * TURNS + turn] / POINTS
                if there < best:
                    both = there + distance_back(
                        x, y, turn, landmarks + 2 * image * LANDMARKS, landmarks + (2 * image + 1) * LANDMARKS, work
                    )
                    if both < best:
                        best = both
                        which = (part * 2 + image) * TURNS + turn
        out[2 * each] = best
        out[2 * each + 1] = which


LIKENESS = (laid, polar, distances_turned, distance_back, likeness)
