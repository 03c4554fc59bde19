"""The descent of a linkage's numbers (kernels).

The curve laid on the target, the slopes of all distances by one number, the curvature of Gauss and Newton from them,
and the quasi-Newton descent that begins with it. A mean of distances d is a sum of squares with weights 1/d, so of
the weighted slopes J the curvature is J Jᵀ (Weiszfeld 1937).
"""

from __future__ import annotations

from math import fabs

from linkwright.formula.kernel import Reals, Wholes, load, mark_of, root, spread, store, total
from linkwright.synthesis.free_curve.deviation import (
    WIDE,
    align,
    curve_to_target,
    deviation,
    middle,
    one_after,
    target_to_curve,
    weigh,
)
from linkwright.synthesis.free_curve.placing import FAR, MIN_SINE, TURN, place

#: Step of differences; share of the curvature added to it; steps after which a descent takes it anew.
STEP, DAMPING, FRESH = 1e-5, 0.003, 30


def dot(a: Reals, b: Reals, rows: int) -> float:
    """Sum of products."""
    sum_ = spread(0.0)
    for t in range(0, rows, 8):
        sum_ += load(a, t) * load(b, t)
    return total(sum_)


def lay(
    nodes: Wholes,
    count: int,
    n: int,
    closed: int,
    x: Reals,
    room: Reals,
    steps: Reals,
    w: Reals,
    at: Reals,
    yx: Reals,
    yy: Reals,
) -> float:
    """The drawn curve laid on the target (yx, yy); negative where it does not close."""
    own, e = (count - 1) * n, 2 * (count - 2)
    X, Y = room, room + count * n
    if place(nodes, count, n, n, closed, x, X, Y) < 0.0:
        return -1.0
    weigh(X + own, Y + own, n, closed, steps, w)
    middle(X + own, Y + own, w, n, at)
    if at[2] < 1e-3:
        return -1.0
    align(X + own, Y + own, n, at, x[e], yx, yy)
    return 1.0


def column(n: int, closed: int, m: int, s: Reals, c: Reals) -> None:
    """Slopes of all weighted distances by one number, from the curve after a ``STEP`` of it (blocks 2, 3 of s)."""
    yx, yy, scale, work = s + 2 * WIDE, s + 3 * WIDE, s + 8 * WIDE, s + 11 * WIDE
    for t in range(0, n, 8):
        dx = load(yx, t) - load(s, t)
        dy = load(yy, t) - load(s, WIDE + t)
        moved = load(s, 6 * WIDE + t) * dx + load(s, 7 * WIDE + t) * dy
        store(c, t, load(scale, t) * moved * (1.0 / STEP))
        store(yx, t, dx)
        store(yy, t, dy)
    for j in range(m):
        a = mark_of(work[12 * WIDE + j])
        b = one_after(a, n, closed)
        ra, rb = work[9 * WIDE + j], work[10 * WIDE + j]
        dx_ = ra * yx[a] + rb * yx[b]
        dy_ = ra * yy[a] + rb * yy[b]
        c[n + j] = 0.0 - scale[n + j] * (work[6 * WIDE + j] * dx_ + work[7 * WIDE + j] * dy_) * (1.0 / STEP)


def directions(n: int, closed: int, target: Reals, m: int, soft: float, s: Reals) -> None:
    """Of a laid curve (blocks 0, 1 of s; shares of its length in 5) the ways from the target and the distances.

    Blocks 6, 7: unit vectors at the curve's points; 8: roots of the weights of all distances, of the curve's points,
    then of the target's; 9: the weighted distances; from 11: as :func:`target_to_curve` leaves it.
    """
    w, ux, uy, scale, rest, work = (
        s + 5 * WIDE,
        s + 6 * WIDE,
        s + 7 * WIDE,
        s + 8 * WIDE,
        s + 9 * WIDE,
        s + 11 * WIDE,
    )
    curve_to_target(s, s + WIDE, w, n, closed, target, m, 0.0, work)
    for t in range(0, n, 8):
        far = load(work, 8 * WIDE + t)
        store(ux, t, load(work, 6 * WIDE + t))
        store(uy, t, load(work, 7 * WIDE + t))
        store(scale, t, root(load(w, t) / root(far * far + soft)))
        store(rest, t, load(scale, t) * far)
    target_to_curve(s, s + WIDE, n, closed, target, m, 0.0, work)
    for j in range(0, m, 8):
        far = load(work, 8 * WIDE + j)
        store(scale, n + j, root((1.0 / m) / root(far * far + soft)))
        store(rest, n + j, load(scale, n + j) * far)


def slopes(
    nodes: Wholes, count: int, n: int, closed: int, x: Reals, p: int, m: int, s: Reals, room: Reals, out: Reals
) -> float:
    """Slopes of all weighted distances by x[p]; ``s``: as from :func:`directions`. Negative: none."""
    before, yx, yy = x[p], s + 2 * WIDE, s + 3 * WIDE
    x[p] = before + STEP
    closes = lay(nodes, count, n, closed, x, room, s + 4 * WIDE, s + 5 * WIDE, s + 10 * WIDE + 8, yx, yy)
    x[p] = before
    if closes > 0.0:
        column(n, closed, m, s, out)
    return closes


def invert(H: Reals, d: int) -> None:
    """A positive symmetric matrix becomes its inverse (Gauss and Jordan)."""
    for k in range(d):
        pivot = 1.0 / H[k * d + k]
        for a in range(d):
            if a != k:
                share = H[a * d + k] * pivot
                for b in range(d):
                    H[a * d + b] -= share * H[k * d + b]
                H[a * d + k] = 0.0 - share
        for b in range(d):
            H[k * d + b] = H[k * d + b] * pivot
        H[k * d + k] = pivot


def curvature(
    nodes: Wholes,
    count: int,
    n: int,
    closed: int,
    x: Reals,
    target: Reals,
    m: int,
    soft: float,
    H: Reals,
    d: int,
    room: Reals,
) -> float:
    """The inverse of the damped curvature of the distances; negative where the curve cannot be laid."""
    rows, s, J = n + m, room, room + 24 * WIDE
    free = J + d * rows
    if lay(nodes, count, n, closed, x, free, s + 4 * WIDE, s + 5 * WIDE, s + 10 * WIDE, s, s + WIDE) < 0.0:
        return -1.0
    directions(n, closed, target, m, soft, s)
    for p in range(d):
        one = J + p * rows
        for t in range(0, rows, 8):
            store(one, t, 0.0)
        if closed == 0 or p < d - 2:
            slopes(nodes, count, n, closed, x, p, m, s, free, one)
        for q in range(p + 1):
            v = dot(one, J + q * rows, rows)
            H[p * d + q] = v
            H[q * d + p] = v
    for p in range(d):
        H[p * d + p] = (1.0 + DAMPING) * H[p * d + p] + 0.01 * DAMPING
    invert(H, d)
    return 1.0


def restart(H: Reals, g: Reals, d: int, step: float) -> None:
    """The inverse Hessian of a first step."""
    for a in range(d):
        for b in range(d):
            H[a * d + b] = 0.0
        H[a * d + a] = step / (fabs(g[a]) + 1e-3)


def update(H: Reals, s: Reals, y: Reals, Hy: Reals, d: int) -> int:
    """The update of Broyden, Fletcher, Goldfarb and Shanno; 0 where the curvature is not positive."""
    sy, yHy = 0.0, 0.0
    for a in range(d):
        sy += s[a] * y[a]
    if sy < 1e-14:
        return 0
    for a in range(d):
        v = 0.0
        for b in range(d):
            v += H[a * d + b] * y[b]
        Hy[a] = v
        yHy += v * y[a]
    for a in range(d):
        for b in range(d):
            H[a * d + b] += (1.0 + yHy / sy) * s[a] * s[b] / sy - (Hy[a] * s[b] + s[a] * Hy[b]) / sy
    return 1


def newton(H: Reals, g: Reals, d: int, last: float, s: Reals) -> float:
    """The step s = -H g, with ``last`` for the last entry of g; gives that of s."""
    for a in range(d):
        v = 0.0 - H[a * d + d - 1] * last
        for b in range(d - 1):
            v -= H[a * d + b] * g[b]
        s[a] = v
    return s[d - 1]


def direction(H: Reals, g: Reals, d: int, closed: int, span: float, s: Reals) -> float:
    """The step s of a descent and the slope along it; the crank's range stays where a step would leave its bounds."""
    way = newton(H, g, d, g[d - 1], s)
    if closed == 0 and ((span >= TURN and way > 0.0) or (span <= MIN_SINE and way < 0.0)):
        newton(H, g, d, g[d - 1] + way / H[d * d - 1], s)
        s[d - 1] = 0.0
    slope = 0.0
    for a in range(d):
        slope += s[a] * g[a]
    return slope


def descend(
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
    iterations: int,
) -> float:
    """Quasi-Newton descent that begins again with Gauss and Newton's curvature every ``FRESH`` steps.

    A weak Wolfe bisection suits the kinks of a distance (Lewis and Overton 2013).
    """
    d = 2 * (count - 2) + 3
    H, g = room, room + d * d
    gn, s, xn, y, Hy, rest = g + d, g + 2 * d, g + 3 * d, g + 4 * d, g + 5 * d, g + 8 * d
    f = deviation(nodes, count, n, N, closed, x, target, m, options, rest, g)
    if f >= FAR:
        return f
    for iteration in range(iterations):
        if iteration % FRESH == 0:
            first = 0
            if curvature(nodes, count, n, closed, x, target, m, options[3], H, d, rest) < 0.0:
                restart(H, g, d, 0.02)
                first = 1
        slope = direction(H, g, d, closed, x[d - 1], s)
        big = 0.0
        for a in range(d):
            big = max(big, fabs(s[a]))
        accepted, t, lo, hi, fn = 0, min(1.0, 0.3 / (big + 1e-300)), 0.0, -1.0, FAR
        if slope < -1e-12:
            for trial in range(25):
                for a in range(d):
                    xn[a] = x[a] + t * s[a]
                if closed == 0:
                    xn[d - 1] = min(max(xn[d - 1], MIN_SINE), TURN)
                fn = deviation(nodes, count, n, N, closed, xn, target, m, options, rest, gn)
                accepted = 0
                if fn > f + 1e-4 * t * slope:
                    hi = t
                    t = 0.25 * hi if trial == 0 else 0.5 * (lo + hi)
                else:
                    accepted = 1
                    v = 0.0
                    for a in range(d):
                        v += gn[a] * s[a]
                    if v >= 0.9 * slope or t * big > 0.5 or trial > 12:
                        break
                    lo = t
                    t = 0.5 * (lo + hi) if hi > 0.0 else 2.0 * t
                if t * big < 1e-9:
                    break
        if accepted == 0:
            if first == 1:
                break
            restart(H, g, d, 0.003)
            first = 1
            continue
        for a in range(d):
            y[a] = gn[a] - g[a]
            s[a] = xn[a] - x[a]
            x[a] = xn[a]
            g[a] = gn[a]
        f = fn
        if update(H, s, y, Hy, d) == 1:
            first = 0
    return f


DESCENT = (dot, lay, column, directions, slopes, invert, curvature, restart, update, newton, direction, descend)
