"""How far a curve lies from the wanted one (kernels): lengths, centroid, nearest points both ways.

Nearest points are sought on every segment. Those next to the nearest corner, or the corner of a table's cell, are not
always the nearest: where strokes meet or cross, distances would jump, and descents end at jumps.
"""

from __future__ import annotations

from math import cos, sin, sqrt

from linkwright.formula.kernel import Reals, load, mark_of, marked, maximum, minimum, root, spread, store, total

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
