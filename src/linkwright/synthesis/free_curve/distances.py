"""How far a curve lies from the wanted one (kernels): lengths, centroid, nearest points both ways."""

from __future__ import annotations

from math import cos, sin, sqrt

from linkwright.engine.kernel import (
    Reals,
    Wholes,
    higher,
    load,
    lower,
    mark_of,
    marked,
    root,
    spread,
    store,
    total,
)

#: Table of nearest target points: GRID x GRID cells over [-HALF, HALF]². Most positions of one curve.
GRID, HALF, WIDE = 256, 3.0, 512


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


def one_before(k: int, count: int, closed: int) -> int:
    """The entry before k of a curve of ``count`` points; an open one ends there."""
    if k > 0:
        return k - 1
    return count - 1 if closed == 1 else 0


def one_after(k: int, count: int, closed: int) -> int:
    """The entry after k."""
    if k < count - 1:
        return k + 1
    return 0 if closed == 1 else count - 1


def ends(k: int, j: int, count: int, closed: int, x: Reals, y: Reals, work: Reals) -> None:
    """Gathers entry k of a curve of ``count`` points and both its neighbours: work[j], blocks 0 to 5."""
    a, b = one_before(k, count, closed), one_after(k, count, closed)
    work[j] = x[a]
    work[WIDE + j] = y[a]
    work[2 * WIDE + j] = x[k]
    work[3 * WIDE + j] = y[k]
    work[4 * WIDE + j] = x[b]
    work[5 * WIDE + j] = y[b]


def feet(px: Reals, py: Reals, count: int, soft: float, work: Reals) -> None:
    """Nearest points on two joined segments each (blocks 0 to 5 of ``work``), from points p.

    Blocks 6, 7: from there to p, over the smoothed distance; 8: that distance; 9 to 11: shares of the three ends.
    """
    for t in range(0, count, 8):
        x, y = load(px, t), load(py, t)
        kx, ky = load(work, 2 * WIDE + t), load(work, 3 * WIDE + t)
        ax, ay = load(work, t), load(work, WIDE + t)
        bx, by = load(work, 4 * WIDE + t), load(work, 5 * WIDE + t)
        ex, ey, fx, fy = kx - ax, ky - ay, bx - kx, by - ky
        s = (ex * (x - ax) + ey * (y - ay)) / (ex * ex + ey * ey + 1e-30)
        r = (fx * (x - kx) + fy * (y - ky)) / (fx * fx + fy * fy + 1e-30)
        s, r = lower(higher(s, 0.0), 1.0), lower(higher(r, 0.0), 1.0)
        qx, qy, ox, oy = x - ax - s * ex, y - ay - s * ey, x - kx - r * fx, y - ky - r * fy
        near, other = qx * qx + qy * qy, ox * ox + oy * oy
        first = near < other
        d = root(lower(near, other) + soft)
        store(work, 6 * WIDE + t, (qx if first else ox) / d)
        store(work, 7 * WIDE + t, (qy if first else oy) / d)
        store(work, 8 * WIDE + t, d)
        store(work, 9 * WIDE + t, (1.0 - s) if first else 0.0 * s)
        store(work, 10 * WIDE + t, s if first else 1.0 - r)
        store(work, 11 * WIDE + t, 0.0 * r if first else r)


def curve_to_target(
    x: Reals, y: Reals, w: Reals, n: int, closed: int, tx: Reals, ty: Reals, m: int, near: Wholes,
    soft: float, work: Reals,
) -> float:  # fmt: skip
    """Mean distance of the curve's points from the target; ``work`` as from :func:`feet`."""
    scale = GRID / (2.0 * HALF)
    for t in range(n):
        ux, uy = min(max(x[t], -2.99), 2.99), min(max(y[t], -2.99), 2.99)
        k = near[int((uy + HALF) * scale) * GRID + int((ux + HALF) * scale)]
        ends(k, t, m, closed, tx, ty, work)
    feet(x, y, n, soft, work)
    mean = spread(0.0)
    for t in range(0, n, 8):
        mean += load(w, t) * load(work, 8 * WIDE + t)
    return total(mean)


def target_to_curve(
    x: Reals, y: Reals, n: int, closed: int, tx: Reals, ty: Reals, m: int, soft: float, work: Reals
) -> float:
    """Mean distance of the target's points from the curve; ``work`` as from :func:`feet`, block 12: nearest point."""
    for j in range(0, m, 8):
        px, py = load(tx, j), load(ty, j)
        low, mark = spread(1e18), spread(0.0)
        for t in range(n):
            ux = px - x[t]
            uy = py - y[t]
            low = lower(low, marked(ux * ux + uy * uy, mark))
            mark += 1.0
        store(work, 12 * WIDE + j, low)
    for j in range(m):
        ends(mark_of(work[12 * WIDE + j]), j, n, closed, x, y, work)
    feet(tx, ty, m, soft, work)
    mean = spread(0.0)
    for j in range(0, m, 8):
        mean += load(work, 8 * WIDE + j)
    return total(mean) / m


def pulled(n: int, closed: int, m: int, work: Reals, gx: Reals, gy: Reals) -> None:
    """Slopes of the mean that :func:`target_to_curve` gives, added by the curve's points."""
    share = 1.0 / m
    for j in range(m):
        k = mark_of(work[12 * WIDE + j])
        a, b = one_before(k, n, closed), one_after(k, n, closed)
        vx, vy = work[6 * WIDE + j] * share, work[7 * WIDE + j] * share
        ra, rk, rb = work[9 * WIDE + j], work[10 * WIDE + j], work[11 * WIDE + j]
        gx[a] -= ra * vx
        gy[a] -= ra * vy
        gx[k] -= rk * vx
        gy[k] -= rk * vy
        gx[b] -= rb * vx
        gy[b] -= rb * vy


DISTANCES = (
    weigh, middle, align, one_before, one_after, ends, feet, curve_to_target, target_to_curve, pulled,
)  # fmt: skip
