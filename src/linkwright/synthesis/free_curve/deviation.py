"""How far a linkage's curve lies from a wanted one, with its exact gradient (kernels).

Nearest points are sought on every segment. Those next to the nearest corner, or the corner of a table's cell, are not
always the nearest: where strokes meet or cross, distances would jump, and descents end at jumps.

Objective: mean nearest distance from curve to target plus that from target to curve, each √(d² + ε²), after the
curve has been laid on the target by its centroid and rms radius (weighted by arc length), plus κ times the mean over
the full turn of max(0, 1 - sin² μ / sin² μ₀)² of every dyad's transmission angle μ, and of max(0, (r/r₀)² - 1)² of
every node's distance r from the centroid. Gradient backwards: nearest points (envelope theorem), alignment, weights,
then the nodes. For a dyad with unit vectors u = (X - P)/a, v = (X - Q)/b: u·dX = u·dP + da, v·dX = v·dQ + db, so its
adjoint needs two cross products over u × v.
"""

from __future__ import annotations

from math import cos, exp, sin, sqrt

from linkwright.formula.kernel import (
    Reals,
    Wholes,
    load,
    mark_of,
    marked,
    maximum,
    minimum,
    root,
    spread,
    store,
    total,
)
from linkwright.synthesis.free_curve.placing import (
    BLOCK,
    DYAD,
    FAR,
    GUIDE,
    MIN_SINE,
    POINT,
    SLIDER,
    TURN,
    block_back,
    place,
    slider_back,
)

#: Most positions of one curve.
WIDE = 512


def weigh(x: Reals, y: Reals, n: int, closed: int, steps: Reals, w: Reals) -> float:
    """Lengths of the curve's steps and the shares of its length that belong to its points; gives its length."""
    for t in range(0, n, 8):
        dx = load(x, t + 1) - load(x, t)
        dy = load(y, t + 1) - load(y, t)
        store(steps, t, root(dx * dx + dy * dy) + 1e-12)
    ex, ey = x[0] - x[n - 1], y[0] - y[n - 1]
    steps[n - 1] = closed * (sqrt(ex * ex + ey * ey) + 1e-12)
    sum_ = spread(0.0)
    for t in range(0, n, 8):
        sum_ += load(steps, t)
    length = total(sum_)
    half = 0.5 / length
    for t in range(0, n, 8):
        store(w, t, (load(steps, t - 1) + load(steps, t)) * half)
    w[0] = (steps[n - 1] + steps[0]) * half
    return length


def middle(x: Reals, y: Reals, w: Reals, n: int, out: Reals) -> None:
    """Centroid and rms radius: out[0:3]."""
    sx, sy, square = spread(0.0), spread(0.0), spread(0.0)
    for t in range(0, n, 8):
        sx += load(w, t) * load(x, t)
        sy += load(w, t) * load(y, t)
    cx, cy = total(sx), total(sy)
    for t in range(0, n, 8):
        ux = load(x, t) - cx
        uy = load(y, t) - cy
        square += load(w, t) * (ux * ux + uy * uy)
    out[0] = cx
    out[1] = cy
    out[2] = sqrt(total(square))


def align(x: Reals, y: Reals, n: int, at: Reals, turn: float, yx: Reals, yy: Reals) -> None:
    """The curve moved to the origin, made the target's size and turned."""
    kx, ky = cos(turn) / at[2], sin(turn) / at[2]
    for t in range(0, n, 8):
        dx = load(x, t) - at[0]
        dy = load(y, t) - at[1]
        store(yx, t, kx * dx - ky * dy)
        store(yy, t, kx * dy + ky * dx)


def one_after(k: int, count: int, closed: int) -> int:
    """The entry after k."""
    if k < count - 1:
        return k + 1
    return 0 if closed == 1 else count - 1


def nearest(px: Reals, py: Reals, count: int, x: Reals, y: Reals, n: int, closed: int, work: Reals) -> None:
    """Number of the nearest of a curve's segments to each of ``count`` points p: block 12 of ``work``."""
    ex, ey, inverse, last = work, work + WIDE, work + 2 * WIDE, n - 1
    for t in range(0, n, 8):
        dx, dy = load(x, t + 1) - load(x, t), load(y, t + 1) - load(y, t)
        store(ex, t, dx)
        store(ey, t, dy)
        store(inverse, t, 1.0 / (dx * dx + dy * dy + 1e-30))
    fx, fy = x[0] - x[last], y[0] - y[last]
    ex[last] = fx
    ey[last] = fy
    inverse[last] = 1.0 / (fx * fx + fy * fy + 1e-30)
    for j in range(0, count, 8):
        qx, qy, low, mark = load(px, j), load(py, j), spread(1e18), spread(0.0)
        for t in range(last + closed):
            ux, uy = qx - x[t], qy - y[t]
            s = minimum(maximum((ux * ex[t] + uy * ey[t]) * inverse[t], 0.0), 1.0)
            vx, vy = ux - s * ex[t], uy - s * ey[t]
            low = minimum(low, marked(vx * vx + vy * vy, mark))
            mark += 1.0
        store(work, 12 * WIDE + j, low)


def feet(px: Reals, py: Reals, count: int, x: Reals, y: Reals, n: int, closed: int, soft: float, work: Reals) -> None:
    """Nearest points on a curve of n points from ``count`` points p.

    Blocks of ``work``: 6, 7: from there to p, over the smoothed distance; 8: that distance; 9, 10: shares of the two
    ends of the segment; 12: its number.
    """
    nearest(px, py, count, x, y, n, closed, work)
    for j in range(count):
        a = mark_of(work[12 * WIDE + j])
        b = one_after(a, n, closed)
        work[j] = x[a]
        work[WIDE + j] = y[a]
        work[2 * WIDE + j] = x[b] - x[a]
        work[3 * WIDE + j] = y[b] - y[a]
    for j in range(0, count, 8):
        ex, ey = load(work, 2 * WIDE + j), load(work, 3 * WIDE + j)
        ux, uy = load(px, j) - load(work, j), load(py, j) - load(work, WIDE + j)
        s = minimum(maximum((ux * ex + uy * ey) / (ex * ex + ey * ey + 1e-30), 0.0), 1.0)
        vx, vy = ux - s * ex, uy - s * ey
        d = root(vx * vx + vy * vy + soft)
        store(work, 6 * WIDE + j, vx / d)
        store(work, 7 * WIDE + j, vy / d)
        store(work, 8 * WIDE + j, d)
        store(work, 9 * WIDE + j, 1.0 - s)
        store(work, 10 * WIDE + j, s)


def curve_to_target(
    x: Reals, y: Reals, w: Reals, n: int, closed: int, target: Reals, m: int, soft: float, work: Reals
) -> float:
    """Mean distance of the curve's points from the target; ``work`` as from :func:`feet`."""
    feet(x, y, n, target, target + m, m, closed, soft, work)
    mean = spread(0.0)
    for t in range(0, n, 8):
        mean += load(w, t) * load(work, 8 * WIDE + t)
    return total(mean)


def target_to_curve(
    x: Reals, y: Reals, n: int, closed: int, target: Reals, m: int, soft: float, work: Reals
) -> float:
    """Mean distance of the target's points from the curve; ``work`` as from :func:`feet`."""
    feet(target, target + m, m, x, y, n, closed, soft, work)
    mean = spread(0.0)
    for j in range(0, m, 8):
        mean += load(work, 8 * WIDE + j)
    return total(mean) / m


def pulled(n: int, closed: int, m: int, work: Reals, gx: Reals, gy: Reals) -> None:
    """Slopes of the mean that :func:`target_to_curve` gives, added by the curve's points."""
    share = 1.0 / m
    for j in range(m):
        a = mark_of(work[12 * WIDE + j])
        b = one_after(a, n, closed)
        vx, vy = work[6 * WIDE + j] * share, work[7 * WIDE + j] * share
        ra, rb = work[9 * WIDE + j], work[10 * WIDE + j]
        gx[a] -= ra * vx
        gy[a] -= ra * vy
        gx[b] -= rb * vx
        gy[b] -= rb * vy


DISTANCES = (weigh, middle, align, one_after, nearest, feet, curve_to_target, target_to_curve, pulled)


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


#: Kernels by the order in which they call each other, behind the distances.
DEVIATION = (too_large, lengths_back, align_back, dyad_back, point_back, nodes_back, range_back, deviation)
