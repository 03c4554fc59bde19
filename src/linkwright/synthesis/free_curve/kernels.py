"""How far a linkage's curve lies from a wanted one, with its exact gradient, and the descent along it (kernels).

A linkage is a list of nodes, four integers each: kind, two earlier nodes i and j, branch. Node 0 is the crank's
pivot in the origin, node 1 its pin at distance 1; every further node has two numbers of x: PIVOT (its place), DYAD
(logarithms of its lengths to i and j, on the side ``branch``), POINT (complex w: Pi + w (Pj - Pi), a point of a
link), SLIDER (logarithm of its distance from i, direction of the guide through j, which is a GUIDE: like a pivot, but
no pin), BLOCK (logarithm of its distance from i along the rod that slides through the block at j, distance of that
line from i). The last node draws. Every node is one joint: of a SLIDER the GUIDE represents the slide, of a BLOCK the
node itself. After the nodes x holds the turn of the picture, the first crank angle and the range of the crank (the
last two for open curves only).

Objective: mean nearest distance from curve to target plus that from target to curve, each √(d² + ε²), after the
curve has been laid on the target by its centroid and rms radius (weighted by arc length), plus κ times the mean over
the full turn of max(0, 1 - sin² μ / sin² μ₀)² of every dyad's transmission angle μ, and of max(0, (r/r₀)² - 1)² of
every node's distance r from the centroid. Gradient backwards: nearest points (envelope theorem), alignment, weights,
then the nodes. For a dyad with unit vectors u = (X - P)/a, v = (X - Q)/b: u·dX = u·dP + da, v·dX = v·dQ + db, so its
adjoint needs two cross products over u × v.
"""

from __future__ import annotations

from math import cos, exp, sin

from linkwright.formula.kernel import Reals, Wholes, load, maximum, minimum, root, smallest, spread, store, total
from linkwright.synthesis.free_curve.distances import (
    WIDE,
    align,
    curve_to_target,
    middle,
    pulled,
    target_to_curve,
    weigh,
)
from linkwright.synthesis.free_curve.sliding import block_back, place_block, place_slider, slider_back

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


def too_large(
    X: Reals, Y: Reals, entries: int, at: Reals, limit: float, share: float, gX: Reals, gY: Reals, g: Reals
) -> float:
    """Penalty of nodes beyond ``limit`` rms radii; slopes by nodes, and by centroid and radius in g[0:3]."""
    cx, cy, rho = at[0], at[1], at[2]
    scale = 1.0 / (limit * limit * rho * rho)
    sx, sy, sr, sum_ = spread(0.0), spread(0.0), spread(0.0), spread(0.0)
    for t in range(0, entries, 8):
        ax = load(X, t) - cx
        ay = load(Y, t) - cy
        ratio = (ax * ax + ay * ay) * scale
        over = maximum(ratio - 1.0, 0.0)
        sum_ += over * over
        slope = 4.0 * share * scale * over
        store(gX, t, slope * ax)
        store(gY, t, slope * ay)
        sx += slope * ax
        sy += slope * ay
        sr += over * ratio
    g[0] = 0.0 - total(sx)
    g[1] = 0.0 - total(sy)
    g[2] = -4.0 * share * total(sr) / rho
    return total(sum_) * share


def align_back(
    zx: Reals,
    zy: Reals,
    yx: Reals,
    yy: Reals,
    n: int,
    closed: int,
    at: Reals,
    w: Reals,
    steps: Reals,
    angle: float,
    length: float,
    gx: Reals,
    gy: Reals,
    gw: Reals,
    g: Reals,
    room: Reals,
) -> float:
    """Slopes by the aligned curve become slopes by the curve itself; gives the slope by the picture's turn."""
    rho = at[2]
    kx, ky = cos(angle) / rho, sin(angle) / rho
    turn, wide, sx, sy, even = spread(0.0), spread(0.0), spread(0.0), spread(0.0), spread(0.0)
    for t in range(0, n, 8):
        hx, hy = load(gx, t), load(gy, t)
        turn += hy * load(yx, t) - hx * load(yy, t)
        wide += hx * load(yx, t) + hy * load(yy, t)
        vx, vy = kx * hx + ky * hy, kx * hy - ky * hx
        store(gx, t, vx)
        store(gy, t, vy)
        sx += vx
        sy += vy
    gr, gcx, gcy = g[2] - total(wide) / rho, g[0] - total(sx), g[1] - total(sy)
    for t in range(0, n, 8):
        dx, dy = load(zx, t) - at[0], load(zy, t) - at[1]
        store(gx, t, load(gx, t) + load(w, t) * ((gr / rho) * dx + gcx))
        store(gy, t, load(gy, t) + load(w, t) * ((gr / rho) * dy + gcy))
        own = load(gw, t) + (gr * 0.5 / rho) * (dx * dx + dy * dy) + gcx * load(zx, t) + gcy * load(zy, t)
        store(gw, t, own)
        even += own * load(w, t)
    lengths_back(zx, zy, n, closed, steps, length, total(even), gx, gy, gw, room)
    return total(turn)


def lengths_back(
    zx: Reals,
    zy: Reals,
    n: int,
    closed: int,
    steps: Reals,
    length: float,
    even: float,
    gx: Reals,
    gy: Reals,
    gw: Reals,
    room: Reals,
) -> None:
    """Slopes by the points' shares of the length become slopes by the points."""
    ex, ey, inverse, last = room, room + WIDE, 1.0 / length, n - 1
    for t in range(0, n, 8):
        v = ((load(gw, t) + load(gw, t + 1)) * 0.5 - even) * inverse / load(steps, t)
        store(ex, t, v * (load(zx, t + 1) - load(zx, t)))
        store(ey, t, v * (load(zy, t + 1) - load(zy, t)))
    ex[last] = 0.0
    ey[last] = 0.0
    if closed == 1:
        v_ = ((gw[last] + gw[0]) * 0.5 - even) * inverse / steps[last]
        ex[last] = v_ * (zx[0] - zx[last])
        ey[last] = v_ * (zy[0] - zy[last])
    fx, fy, sx, sy = gx[0], gy[0], ex[last] - ex[0], ey[last] - ey[0]
    for t in range(0, n, 8):
        store(gx, t, load(gx, t) + load(ex, t - 1) - load(ex, t))
        store(gy, t, load(gy, t) + load(ey, t - 1) - load(ey, t))
    gx[0] = fx + sx
    gy[0] = fy + sy


def dyad_back(
    N: int,
    a: float,
    b: float,
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
    """Slopes by a dyad's point become slopes by its two ends and lengths; gives the transmission's penalty."""
    ia, ib = 1.0 / a, 1.0 / b
    ga, gb, miss = spread(0.0), spread(0.0), spread(0.0)
    for t in range(0, N, 8):
        hx = load(gX, own + t)
        hy = load(gY, own + t)
        ux = (load(X, own + t) - load(X, i + t)) * ia
        uy = (load(Y, own + t) - load(Y, i + t)) * ia
        vx = (load(X, own + t) - load(X, j + t)) * ib
        vy = (load(Y, own + t) - load(Y, j + t)) * ib
        over = 1.0 / (ux * vy - uy * vx)
        along_u = (vy * hx - vx * hy) * over
        along_v = (ux * hy - uy * hx) * over
        cosine = ux * vx + uy * vy
        lack = maximum(limit - 1.0 + cosine * cosine, 0.0) * (1.0 / limit)
        miss += lack * lack
        slope = lack * cosine * (4.0 * kappa / (limit * N))
        dx = load(X, j + t) - load(X, i + t)
        dy = load(Y, j + t) - load(Y, i + t)
        ends = slope * (ia * ib)
        ga += along_u + slope * (ib - cosine * ia)
        gb += along_v + slope * (ia - cosine * ib)
        store(gX, i + t, load(gX, i + t) + along_u * ux + ends * dx)
        store(gY, i + t, load(gY, i + t) + along_u * uy + ends * dy)
        store(gX, j + t, load(gX, j + t) + along_v * vx - ends * dx)
        store(gY, j + t, load(gY, j + t) + along_v * vy - ends * dy)
    g[0] = total(ga) * a
    g[1] = total(gb) * b
    return total(miss) * kappa / N


def point_back(
    N: int, a: float, b: float, X: Reals, Y: Reals, gX: Reals, gY: Reals, i: int, j: int, own: int, g: Reals
) -> None:
    """Slopes by a point of a link become slopes by its two nodes and by its place on the link."""
    ga, gb = spread(0.0), spread(0.0)
    for t in range(0, N, 8):
        hx = load(gX, own + t)
        hy = load(gY, own + t)
        dx = load(X, j + t) - load(X, i + t)
        dy = load(Y, j + t) - load(Y, i + t)
        ga += dx * hx + dy * hy
        gb += dx * hy - dy * hx
        rx = a * hx + b * hy
        ry = a * hy - b * hx
        store(gX, j + t, load(gX, j + t) + rx)
        store(gY, j + t, load(gY, j + t) + ry)
        store(gX, i + t, load(gX, i + t) + hx - rx)
        store(gY, i + t, load(gY, i + t) + hy - ry)
    g[0] = total(ga)
    g[1] = total(gb)


def nodes_back(
    nodes: Wholes,
    count: int,
    N: int,
    x: Reals,
    X: Reals,
    Y: Reals,
    gX: Reals,
    gY: Reals,
    kappa: float,
    limit: float,
    g: Reals,
) -> float:
    """Slopes by the nodes' positions become slopes by x; gives the transmission's penalty."""
    lack = 0.0
    for back in range(2, count):
        k = count + 1 - back
        kind, a, b = nodes[4 * k], x[2 * k - 4], x[2 * k - 3]
        i, j, own = nodes[4 * k + 1] * N, nodes[4 * k + 2] * N, k * N
        if kind <= GUIDE:
            ga, gb = spread(0.0), spread(0.0)
            for t in range(0, N, 8):
                ga += load(gX, own + t)
                gb += load(gY, own + t)
            g[2 * k - 4] = total(ga)
            g[2 * k - 3] = total(gb)
        if kind == POINT:
            point_back(N, a, b, X, Y, gX, gY, i, j, own, g + (2 * k - 4))
        if kind == DYAD:
            lack += dyad_back(N, exp(a), exp(b), kappa, limit, X, Y, gX, gY, i, j, own, g + (2 * k - 4))
        if kind == SLIDER:
            lack += slider_back(N, exp(a), b, kappa, limit, X, Y, gX, gY, i, j, own, g + (2 * k - 4))
        if kind == BLOCK:
            lack += block_back(N, exp(a), b, kappa, limit, X, Y, gX, gY, i, j, own, g + (2 * k - 4))
    return lack


def range_back(n: int, N: int, closed: int, X: Reals, Y: Reals, gX: Reals, gY: Reals, g: Reals) -> None:
    """Slopes by first angle and range of the crank, g[0:2]."""
    first, span = 0.0, 0.0
    if closed == 0:
        for t in range(N):
            v = gY[N + t] * X[N + t] - gX[N + t] * Y[N + t]
            first += v
            span += v * t / (n - 1) if t < n else v * (1.0 - (t - n + 1.0) / (N - n + 1.0))
    g[0] = first
    g[1] = span


def deviation(
    nodes: Wholes,
    count: int,
    n: int,
    N: int,
    closed: int,
    x: Reals,
    target: Reals,
    m: int,
    options: Reals,
    room: Reals,
    g: Reals,
) -> float:
    """The objective and its gradient g; ``options``: sin² μ₀, r₀, κ, ε². FAR where the linkage does not turn."""
    e = 2 * (count - 2)
    if closed == 0 and (x[e + 2] < MIN_SINE or x[e + 2] > TURN):
        return FAR
    X, Y, gX, gY = room, room + count * N, room + 2 * count * N, room + 3 * count * N
    if place(nodes, count, n, N, closed, x, X, Y) < 0.0:
        return FAR
    s = room + 4 * count * N + 8
    steps, w, gw, yx, yy = s, s + WIDE, s + 2 * WIDE, s + 3 * WIDE, s + 4 * WIDE
    gx, gy, at, gat, work = s + 5 * WIDE, s + 6 * WIDE, s + 7 * WIDE, s + 7 * WIDE + 8, s + 8 * WIDE
    own = (count - 1) * N
    zx, zy = X + own, Y + own
    length = weigh(zx, zy, n, closed, steps, w)
    middle(zx, zy, w, n, at)
    if at[2] < 1e-3:
        return FAR
    align(zx, zy, n, at, x[e], yx, yy)
    found = curve_to_target(yx, yy, w, n, closed, target, m, options[3], work)
    for t in range(0, n, 8):
        store(gx, t, load(w, t) * load(work, 6 * WIDE + t))
        store(gy, t, load(w, t) * load(work, 7 * WIDE + t))
        store(gw, t, load(work, 8 * WIDE + t))
    found += target_to_curve(yx, yy, n, closed, target, m, options[3], work)
    pulled(n, closed, m, work, gx, gy)
    found += too_large(X, Y, count * N, at, options[1], options[2] / (count * N), gX, gY, gat)
    g[e] = align_back(zx, zy, yx, yy, n, closed, at, w, steps, x[e], length, gx, gy, gw, gat, work)
    for t in range(0, n, 8):
        store(gX, own + t, load(gX, own + t) + load(gx, t))
        store(gY, own + t, load(gY, own + t) + load(gy, t))
    found += nodes_back(nodes, count, N, x, X, Y, gX, gY, options[2], options[0], g)
    range_back(n, N, closed, X, Y, gX, gY, g + (e + 1))
    return found


#: Kernels by the order in which they call each other: those before :func:`place`, and those behind the distances.
PLACING = (turn_crank, place_crank, place_dyad, place_point)
DEVIATION = (too_large, lengths_back, align_back, dyad_back, point_back, nodes_back, range_back, deviation)
