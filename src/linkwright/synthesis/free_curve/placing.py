"""Positions of a linkage's nodes (kernels): crank, points of links, dyads with pins, and dyads with a slide.

A linkage is a list of nodes, four integers each: kind, two earlier nodes i and j, branch. Node 0 is the crank's
pivot in the origin, node 1 its pin at distance 1; every further node has two numbers of x: PIVOT (its place), DYAD
(logarithms of its lengths to i and j, on the side ``branch``), POINT (complex w: Pi + w (Pj - Pi), a point of a
link), SLIDER (logarithm of its distance from i, direction of the guide through j, which is a GUIDE: like a pivot, but
no pin), BLOCK (logarithm of its distance from i along the rod that slides through the block at j, distance of that
line from i). The last node draws. Every node is one joint: of a SLIDER the GUIDE represents the slide, of a BLOCK the
node itself. After the nodes x holds the turn of the picture, the first crank angle and the range of the crank (the
last two for open curves only).

A dyad with a slide is a rod whose pin runs on a fixed guide (RRP), or a rod that slides through a block (RPR). Each
places its node B from a node P and a pivot Q before it, and takes the slopes by B back to P, Q and its own two
numbers (sin² μ and its penalty are those of ``deviation.py``). Placing returns min sin² μ, negative where the dyad
does not close.
"""

from __future__ import annotations

from math import cos, exp, sin

from linkwright.formula.kernel import Reals, Wholes, load, maximum, minimum, root, smallest, spread, store, total

PIVOT, GUIDE, POINT, DYAD, SLIDER, BLOCK = 0, 1, 2, 3, 4, 5
TURN, FAR = 6.283185307179586, 1e9
#: Minimum range of the crank on an open curve, rad.
MIN_SINE = 0.3


def turn_crank(begin: int, end: int, first: float, step: float, x: Reals, y: Reals) -> None:
    """Unit vectors at even angles, by rotation."""
    c, s, cs, sn = cos(first), sin(first), cos(step), sin(step)
    for t in range(begin, end):
        x[t] = c
        y[t] = s
        onward = c * cs - s * sn
        s = c * sn + s * cs
        c = onward


def place_crank(n: int, N: int, first: float, span: float, closed: int, x: Reals, y: Reals) -> None:
    """Pin of the crank: n positions over the drawn range, N - n over the rest of the turn."""
    step = span / n if closed == 1 else span / (n - 1)
    turn_crank(0, n, first, step, x, y)
    if n < N:
        step = (TURN - span) / (N - n + 1)
        turn_crank(n, N, first + span + step, step, x, y)


def place_dyad(
    N: int, a: float, b: float, side: float, px: Reals, py: Reals, qx: Reals, qy: Reals, x: Reals, y: Reals
) -> float:
    """Common points of two circles; returns the minimum sin² of the transmission angle, negative where they miss."""
    low = spread(1.0)
    scale, difference = 1.0 / (4.0 * a * a * b * b), a * a - b * b
    for t in range(0, N, 8):
        ux = load(qx, t) - load(px, t)
        uy = load(qy, t) - load(py, t)
        square = ux * ux + uy * uy
        along = square + difference
        across = 4.0 * a * a * square - along * along
        low = minimum(low, across * scale)
        h = side * root(maximum(across, 0.0))
        half = 0.5 / square
        store(x, t, load(px, t) + (ux * along - uy * h) * half)
        store(y, t, load(py, t) + (uy * along + ux * h) * half)
    return smallest(low)


def place_point(N: int, a: float, b: float, px: Reals, py: Reals, qx: Reals, qy: Reals, x: Reals, y: Reals) -> None:
    """A point of a link."""
    for t in range(0, N, 8):
        ux = load(qx, t) - load(px, t)
        uy = load(qy, t) - load(py, t)
        store(x, t, load(px, t) + a * ux - b * uy)
        store(y, t, load(py, t) + a * uy + b * ux)


def place_slider(
    N: int, r: float, phi: float, side: float, px: Reals, py: Reals, qx: Reals, qy: Reals, x: Reals, y: Reals
) -> float:
    """B at distance r from P on the line through Q in the direction φ; sin² μ = 1 - h²/r², h: distance of P."""
    low, c, s, inverse = spread(1.0), cos(phi), sin(phi), 1.0 / (r * r)
    for t in range(0, N, 8):
        dx = load(px, t) - load(qx, t)
        dy = load(py, t) - load(qy, t)
        h = c * dy - s * dx
        square = r * r - h * h
        low = minimum(low, square * inverse)
        along = c * dx + s * dy + side * root(maximum(square, 0.0))
        store(x, t, load(qx, t) + c * along)
        store(y, t, load(qy, t) + s * along)
    return smallest(low)


def slider_back(
    N: int,
    r: float,
    phi: float,
    kappa: float,
    limit: float,
    X: Reals,
    Y: Reals,
    gX: Reals,
    gY: Reals,
    i: int,
    j: int,
    own: int,
    g: Reals,
) -> float:
    """With u = (B - P)/r and the guide's direction e and normal n: u·dB = u·dP + dr, n·dB = n·dQ + e·(B - Q) dφ."""
    c, s, inverse = cos(phi), sin(phi), 1.0 / r
    gr, gphi, miss = spread(0.0), spread(0.0), spread(0.0)
    for t in range(0, N, 8):
        hx, hy = load(gX, own + t), load(gY, own + t)
        ux = (load(X, own + t) - load(X, i + t)) * inverse
        uy = (load(Y, own + t) - load(Y, i + t)) * inverse
        along_u = (hx * c + hy * s) / (ux * c + uy * s)
        along_n = c * hy - s * hx - along_u * (c * uy - s * ux)
        dx = load(X, i + t) - load(X, j + t)
        dy = load(Y, i + t) - load(Y, j + t)
        cosine = (c * dy - s * dx) * inverse
        lack = maximum(limit - 1.0 + cosine * cosine, 0.0) * (1.0 / limit)
        miss += lack * lack
        slope = lack * cosine * (4.0 * kappa / (limit * N))
        gr += along_u * r - slope * cosine
        foot = inverse * (c * dx + s * dy)
        gphi += along_n * (foot * r + r * (c * ux + s * uy)) - slope * foot
        pulled = slope * inverse
        store(gX, i + t, load(gX, i + t) + along_u * ux - pulled * s)
        store(gY, i + t, load(gY, i + t) + along_u * uy + pulled * c)
        store(gX, j + t, load(gX, j + t) + s * (pulled - along_n))
        store(gY, j + t, load(gY, j + t) - c * (pulled - along_n))
    g[0] = total(gr)
    g[1] = total(gphi)
    return total(miss) * kappa / N


def place_block(
    N: int, a: float, e: float, side: float, px: Reals, py: Reals, qx: Reals, qy: Reals, x: Reals, y: Reals
) -> float:
    """B at distance a from P on a rod of which a parallel, e to its left, passes Q; sin² μ = 1 - e²/(PQ)²."""
    low = spread(1.0)
    for t in range(0, N, 8):
        dx = load(qx, t) - load(px, t)
        dy = load(qy, t) - load(py, t)
        square = dx * dx + dy * dy
        inverse = 1.0 / square
        low = minimum(low, 1.0 - e * e * inverse)
        along = side * root(maximum(square - e * e, 0.0))
        store(x, t, load(px, t) + a * inverse * (dx * along + dy * e))
        store(y, t, load(py, t) + a * inverse * (dy * along - dx * e))
    return smallest(low)


def block_back(
    N: int,
    a: float,
    e: float,
    kappa: float,
    limit: float,
    X: Reals,
    Y: Reals,
    gX: Reals,
    gY: Reals,
    i: int,
    j: int,
    own: int,
    g: Reals,
) -> float:
    """With u = (B - P)/a, its normal n and d = Q - P: the rod turns by dψ = (n·(dQ - dP) - de) / u·d."""
    ga, ge, miss, inverse = spread(0.0), spread(0.0), spread(0.0), 1.0 / a
    for t in range(0, N, 8):
        hx, hy = load(gX, own + t), load(gY, own + t)
        ux = (load(X, own + t) - load(X, i + t)) * inverse
        uy = (load(Y, own + t) - load(Y, i + t)) * inverse
        dx = load(X, j + t) - load(X, i + t)
        dy = load(Y, j + t) - load(Y, i + t)
        one = 1.0 / (dx * dx + dy * dy)
        turning = a * (ux * hy - uy * hx) / (ux * dx + uy * dy)
        square = e * e * one
        lack = maximum(limit - 1.0 + square, 0.0) * (1.0 / limit)
        miss += lack * lack
        slope = lack * (4.0 * kappa / (limit * N)) * one
        ga += hx * ux + hy * uy
        ge += slope * e - turning
        wx = 0.0 - turning * uy - slope * square * dx
        wy = turning * ux - slope * square * dy
        store(gX, i + t, load(gX, i + t) + hx - wx)
        store(gY, i + t, load(gY, i + t) + hy - wy)
        store(gX, j + t, load(gX, j + t) + wx)
        store(gY, j + t, load(gY, j + t) + wy)
    g[0] = total(ga) * a
    g[1] = total(ge)
    return total(miss) * kappa / N


def place(nodes: Wholes, count: int, n: int, N: int, closed: int, x: Reals, X: Reals, Y: Reals) -> float:
    """Positions (count, N) of all nodes; returns the minimum sin² of a transmission angle, negative where open."""
    e = 2 * (count - 2)
    first, span = x[e + 1], x[e + 2]
    if closed == 1:
        first = 0.0
        span = TURN
    for t in range(0, N, 8):
        store(X, t, 0.0)
        store(Y, t, 0.0)
    place_crank(n, N, first, span, closed, X + N, Y + N)
    low = 1.0
    for k in range(2, count):
        kind, a, b = nodes[4 * k], x[2 * k - 4], x[2 * k - 3]
        i, j, own = nodes[4 * k + 1] * N, nodes[4 * k + 2] * N, k * N
        if kind <= GUIDE:
            for t in range(0, N, 8):
                store(X + own, t, a)
                store(Y + own, t, b)
        if kind == POINT:
            place_point(N, a, b, X + i, Y + i, X + j, Y + j, X + own, Y + own)
        side = 1.0 * nodes[4 * k + 3]
        if kind == DYAD:
            found = place_dyad(N, exp(a), exp(b), side, X + i, Y + i, X + j, Y + j, X + own, Y + own)
            low = min(low, found)
        if kind == SLIDER:
            found = place_slider(N, exp(a), b, side, X + i, Y + i, X + j, Y + j, X + own, Y + own)
            low = min(low, found)
        if kind == BLOCK:
            found = place_block(N, exp(a), b, side, X + i, Y + i, X + j, Y + j, X + own, Y + own)
            low = min(low, found)
        if low < 1e-4:
            return -1.0
    return low


#: Kernels by the order in which they call each other.
PLACING = (
    turn_crank,
    place_crank,
    place_dyad,
    place_point,
    place_slider,
    slider_back,
    place_block,
    block_back,
    place,
)
