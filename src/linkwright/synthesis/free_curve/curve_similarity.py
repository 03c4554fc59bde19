"""How near parts of an atlas's curves come to a wanted curve, whatever the order in which it is drawn (kernels).

A part is POINTS points of a curve, laid on the target by centroid and rms radius. Its mean distance from the target
is read from a table in polar coordinates, for TURNS turns of the picture at once, because a turn shifts the angle; at
the turn that is best so, the mean distance of LANDMARKS points of the target from the part is added.
"""

from __future__ import annotations

from math import cos, sin, sqrt

from linkwright.formula.kernel import Reals, Wholes, load, maximum, minimum, root, spread, store, total
from linkwright.synthesis.free_curve.kernels import TURN

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
