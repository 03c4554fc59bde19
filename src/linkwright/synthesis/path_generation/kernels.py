"""Least squares of one path after another, compiled: Levenberg and Marquardt's steps (kernels).

From |b U - D| = c follow the rates of the coupler's unit vector U: with D = d - A and V = b U - D, dU = i U dψ,
dψ = (c dc - Re(V* U) db + Re(V* dD)) / Re(i V* b U), dD = dd - i A dθ.

Unknown in this order: the linear numbers (z where the pivot is free; α, or its length where the frame's direction is
given; β), the three free numbers of the shape, and a common phase. A free crank angle belongs to one point alone and
is eliminated there. A step is damped in what is left when the linear numbers have been eliminated as well; then they
are found anew. With a bound they are not: lengths and coordinates beyond it count as further deviations, √ρ (c + s)
of each c + s > 0, c = value/bound - 1, with shifts s that bring the end to the bound itself (augmented Lagrangian,
Powell 1969).

``layout``: points n, timed, phase given as unknown, pivot free, direction free, unknowns, numbers of a start.
``data``: bound (0: none), ρ, κ of the transmission angle, direction, then x, y, weight, crank angle of each point.
A start: shape 3, phase, ``double`` (0, 1; 2: any lengths), ``mirrored`` (1, -1), damping, deviation, linear numbers 6
as z, α, β, shifts 8, crank angles n.
"""

from __future__ import annotations

from functools import cache
from math import cos, exp, fabs, sin, sqrt

from linkwright.formula.kernel import Kernels, Reals, Wholes

HEAD, SHIFTS, ANGLES, POINTS = 8, 14, 22, 4
#: Places in the room, after lengths and their rates: system of at most 10 unknowns, limits, step, points.
SYSTEM, LIMITS, STEP, PER_POINT = 16, 130, 220, 360
#: Doubles of the room for each point: A, U, deviation, then what its own crank angle takes with it.
EACH = 24
#: The deviation of what cannot be assembled; ``double`` of a shape that is three logarithms of lengths.
FAR, ANY_LENGTHS = 1e300, 2.0


def spread_lengths(x: float, y: float, z: float, double: float, kappa: float, out: Reals) -> None:
    """Coupler, output and frame of a crank of length 1: ``crank_family.CrankFamily.lengths``."""
    if double == ANY_LENGTHS:
        out[0] = exp(x)
        out[1] = exp(y)
        out[2] = exp(z)
        return
    slope = sqrt((1.0 - kappa) / (1.0 + kappa))
    d = (1.0 + slope) / (1.0 - slope) + exp(max(-30.0, min(12.0, x)))
    if double > 0.5:
        d = 1.0 / d
    inner, outer = (d - 1.0) * (d - 1.0), (d + 1.0) * (d + 1.0)
    room = max(0.0, inner * (1.0 + kappa) - outer * (1.0 - kappa))
    m = sin(z) * sqrt(room / (2.0 * kappa))
    low = (2.0 * outer - m * m * (1.0 - kappa)) / (1.0 + kappa)
    s = sqrt(low) + y * y
    if kappa < 1.0:
        high = (2.0 * inner - m * m * (1.0 + kappa)) / (1.0 - kappa)
        s = sqrt(low + max(0.0, high - low) * sin(y) * sin(y))
    out[0] = 0.5 * (s + m)
    out[1] = 0.5 * (s - m)
    out[2] = d


def shape_of(start: Reals, kappa: float, room: Reals) -> None:
    """Lengths (3) of a start, and their derivatives by its three numbers (3 x 3) by central differences."""
    h = 1e-6
    spread_lengths(start[0], start[1], start[2], start[4], kappa, room)
    for k in range(3):
        dx = h if k == 0 else 0.0
        dy = h if k == 1 else 0.0
        dz = h if k == 2 else 0.0
        up, down = room + (3 + 3 * k), room + 12
        spread_lengths(start[0] + dx, start[1] + dy, start[2] + dz, start[4], kappa, up)
        spread_lengths(start[0] - dx, start[1] - dy, start[2] - dz, start[4], kappa, down)
        for i in range(3):
            up[i] = (up[i] - down[i]) / (2.0 * h)


def place_points(layout: Wholes, data: Reals, start: Reals, room: Reals) -> int:
    """A and U of every point of a start (4 numbers each); 0 where it cannot be assembled."""
    spread_lengths(start[0], start[1], start[2], start[4], data[2], room)
    b, c, d = room[0], room[1], room[2]
    for j in range(layout[0]):
        angle = start[ANGLES + j]
        if layout[1] == 1:
            angle = start[5] * data[POINTS + 4 * j + 3] + start[3]
        own = room + (PER_POINT + EACH * j)
        own[0] = cos(angle)
        own[1] = sin(angle)
        x, y = d - own[0], -own[1]
        square = x * x + y * y
        t = square + b * b - c * c
        left = 4.0 * b * b * square - t * t
        if start[4] == ANY_LENGTHS and left < 0.0:
            return 0
        root = sqrt(max(0.0, left))
        scale = 1.0 / (2.0 * b * square)
        own[2] = (x * t - y * root) * scale
        own[3] = (y * t + x * root) * scale
    return 1


def columns(layout: Wholes, data: Reals, start: Reals, own: Reals, out: Reals) -> int:
    """The columns (real, imaginary) of the linear numbers at a point; gives how many there are."""
    k = 0
    if layout[3] == 1:
        out[0] = 1.0
        out[1] = 0.0
        out[2] = 0.0
        out[3] = 1.0
        k = 2
    if layout[4] == 1:
        out[2 * k] = own[0]
        out[2 * k + 1] = own[1]
        out[2 * k + 2] = -own[1]
        out[2 * k + 3] = own[0]
        k += 2
    else:
        tc, ts = cos(data[3]), start[5] * sin(data[3])
        out[2 * k] = own[0] * tc - own[1] * ts
        out[2 * k + 1] = own[0] * ts + own[1] * tc
        k += 1
    out[2 * k] = own[2]
    out[2 * k + 1] = own[3]
    out[2 * k + 2] = -own[3]
    out[2 * k + 3] = own[2]
    return k + 2


def add_linear(layout: Wholes, data: Reals, start: Reals, step: Reals) -> None:
    """Adds changes of the linear numbers to z, α, β of a start."""
    k, linear = 0, start + HEAD
    if layout[3] == 1:
        linear[0] += step[0]
        linear[1] += step[1]
        k = 2
    if layout[4] == 1:
        linear[2] += step[k]
        linear[3] += step[k + 1]
        k += 2
    else:
        linear[2] += step[k] * cos(data[3])
        linear[3] += step[k] * start[5] * sin(data[3])
        k += 1
    linear[4] += step[k]
    linear[5] += step[k + 1]


def solve(N: Reals, m: int, linear: int, damping: float, floor: Reals) -> None:
    """The symmetric system (m, m + 1): its last column becomes the solution; what has no weight becomes 0."""
    w = m + 1
    for k in range(m):
        floor[k] = 1e-14 * N[w * k + k] + 1e-280
    for k in range(m):
        if k == linear:
            for i in range(k, m):
                floor[i] = max(floor[i], 1e-14 * N[w * i + i])
                N[w * i + i] = N[w * i + i] * (1.0 + damping) + floor[i]
        pivot = N[w * k + k]
        share = 0.0
        if pivot > floor[k]:
            share = 1.0 / pivot
        N[w * k + k] = share
        for i in range(k + 1, m):
            factor = N[w * k + i] * share
            for c in range(i, m + 1):
                N[w * i + c] -= factor * N[w * k + c]
    for back in range(m):
        k = m - 1 - back
        value = N[w * k + m]
        for c in range(k + 1, m):
            value -= N[w * k + c] * N[w * c + m]
        N[w * k + m] = value * N[w * k + k]


def deviate(layout: Wholes, data: Reals, start: Reals, room: Reals) -> float:
    """Deviations of all points (numbers 4, 5 of each) and the weighted sum of their squares."""
    total = 0.0
    linear = start + HEAD
    for j in range(layout[0]):
        own, to = room + (PER_POINT + EACH * j), data + (POINTS + 4 * j)
        own[4] = linear[0] + linear[2] * own[0] - linear[3] * own[1] - to[0]
        own[5] = linear[1] + linear[2] * own[1] + linear[3] * own[0] - start[5] * to[1]
        own[4] += linear[4] * own[2] - linear[5] * own[3]
        own[5] += linear[4] * own[3] + linear[5] * own[2]
        total += to[2] * (own[4] * own[4] + own[5] * own[5])
    return total


def project(layout: Wholes, data: Reals, start: Reals, room: Reals) -> float:
    """Finds the linear numbers, in three passes (each removes what rounding left); gives the sum of squares."""
    N, row = room + SYSTEM, room + STEP
    for k in range(6):
        start[HEAD + k] = 0.0
    for _ in range(3):
        deviate(layout, data, start, room)
        count = columns(layout, data, start, room + PER_POINT, row)
        for i in range(count * (count + 1)):
            N[i] = 0.0
        for j in range(layout[0]):
            own, weight = room + (PER_POINT + EACH * j), data[POINTS + 4 * j + 2]
            columns(layout, data, start, own, row)
            for i in range(count):
                for c in range(i, count):
                    N[(count + 1) * i + c] += weight * (row[2 * i] * row[2 * c] + row[2 * i + 1] * row[2 * c + 1])
                N[(count + 1) * i + count] -= weight * (row[2 * i] * own[4] + row[2 * i + 1] * own[5])
        solve(N, count, count, 0.0, row + 40)
        for i in range(count):
            row[i] = N[(count + 1) * i + count]
        add_linear(layout, data, start, row)
    return deviate(layout, data, start, room)


def limits(layout: Wholes, data: Reals, start: Reals, room: Reals) -> float:
    """Values and gradients (by z, α, β and the lengths) of the eight limits; gives their weighted sum of squares."""
    G, linear = room + LIMITS, start + HEAD
    share = 1.0 / data[0]
    ax, ay, bx, by = linear[2], linear[3], linear[4], linear[5]
    size = sqrt(ax * ax + ay * ay) + 1e-300
    cx, cy = ax / size, ay / size
    for i in range(8 * 11):
        G[i] = 0.0
    for k in range(4):
        own = G + 11 * k
        length = 1.0
        if k < 3:
            length = room[k]
            own[7 + k] = size * share
        own[0] = size * length * share - 1.0
        own[3] = cx * length * share
        own[4] = cy * length * share
    for k in range(2):
        own = G + 11 * (4 + k)
        u, v = bx * cx + by * cy, by * cx - bx * cy
        if k == 0:
            side = share if u > 0.0 else -share
            own[0] = u * side - 1.0
            own[3] = -v * cy / size * side
            own[4] = v * cx / size * side
            own[5] = cx * side
            own[6] = cy * side
        else:
            side = share if v > 0.0 else -share
            own[0] = v * side - 1.0
            own[3] = u * cy / size * side
            own[4] = -u * cx / size * side
            own[5] = -cy * side
            own[6] = cx * side
        own = G + 11 * (6 + k)
        side = share if linear[k] > 0.0 else -share
        own[0] = linear[k] * side - 1.0
        own[1 + k] = side
    total = 0.0
    for k in range(8):
        beyond = max(0.0, G[11 * k] + start[SHIFTS + k])
        total += data[1] * beyond * beyond
    return total


def measure(layout: Wholes, data: Reals, start: Reals, room: Reals, anew: int) -> float:
    """The sum of squares of a start, linear numbers found ``anew`` or reused; FAR where it cannot be assembled."""
    if place_points(layout, data, start, room) == 0:
        return FAR
    if anew == 1:
        return project(layout, data, start, room)
    total = deviate(layout, data, start, room)
    if data[0] > 0.0:
        total += limits(layout, data, start, room)
    return total


def limit_rows(layout: Wholes, data: Reals, start: Reals, room: Reals, linear: int) -> None:
    """The limits' share of the system."""
    N, row, m = room + SYSTEM, room + STEP, layout[5]
    for k in range(8):
        own = room + (LIMITS + 11 * k)
        beyond = own[0] + start[SHIFTS + k]
        if beyond <= 0.0:
            continue
        i = 0
        if layout[3] == 1:
            row[0] = own[1]
            row[1] = own[2]
            i = 2
        if layout[4] == 1:
            row[i] = own[3]
            row[i + 1] = own[4]
            i += 2
        else:
            row[i] = own[3] * cos(data[3]) + own[4] * start[5] * sin(data[3])
            i += 1
        row[i] = own[5]
        row[i + 1] = own[6]
        for s in range(3):
            row[linear + s] = own[7] * room[3 + 3 * s] + own[8] * room[4 + 3 * s] + own[9] * room[5 + 3 * s]
        if m > linear + 3:
            row[linear + 3] = 0.0
        for i in range(m):
            for c in range(i, m):
                N[(m + 1) * i + c] += data[1] * row[i] * row[c]
            N[(m + 1) * i + m] -= data[1] * row[i] * beyond


def point_rows(layout: Wholes, data: Reals, start: Reals, room: Reals, damping: float) -> int:
    """The system of a step, free crank angles eliminated; gives the number of linear numbers."""
    N, row, m, linear = room + SYSTEM, room + STEP, layout[5], start + HEAD
    b, d, count = room[0], room[2], 0
    for i in range(m * (m + 1)):
        N[i] = 0.0
    for j in range(layout[0]):
        own, weight = room + (PER_POINT + EACH * j), data[POINTS + 4 * j + 2]
        count = columns(layout, data, start, own, row)
        ax, ay, ux, uy = own[0], own[1], own[2], own[3]
        vx, vy = b * ux - (d - ax), b * uy + ay
        across, toward = b * (vy * ux - vx * uy), vx * ux + vy * uy
        if fabs(across) < 1e-9:
            across = 1e-9 if across > 0.0 else -1e-9
        tx, ty = -(linear[4] * uy + linear[5] * ux), linear[4] * ux - linear[5] * uy
        for s in range(3):
            rate = room + (3 + 3 * s)
            turned = (room[1] * rate[1] - toward * rate[0] + vx * rate[2]) / across
            row[2 * (count + s)] = tx * turned
            row[2 * (count + s) + 1] = ty * turned
        turned = (vx * ay - vy * ax) / across
        gx = tx * turned - linear[2] * ay - linear[3] * ax
        gy = ty * turned + linear[2] * ax - linear[3] * ay
        if m > count + 3:
            row[2 * count + 6] = gx
            row[2 * count + 7] = gy
        square, pull = FAR, 0.0
        if layout[1] == 0:
            square = (gx * gx + gy * gy) * (1.0 + damping) + 1e-30
            pull = gx * own[4] + gy * own[5]
        own[6] = square
        own[7] = pull
        for i in range(m):
            own[8 + i] = row[2 * i] * gx + row[2 * i + 1] * gy
        for i in range(m):
            for c in range(i, m):
                both = row[2 * i] * row[2 * c] + row[2 * i + 1] * row[2 * c + 1] - own[8 + i] * own[8 + c] / square
                N[(m + 1) * i + c] += weight * both
            pulled = row[2 * i] * own[4] + row[2 * i + 1] * own[5] - own[8 + i] * pull / square
            N[(m + 1) * i + m] -= weight * pulled
    return count


def attempt(layout: Wholes, data: Reals, start: Reals, trial: Reals, room: Reals) -> float:
    """One damped step from a start whose points are in the room; gives the deviation of the trial."""
    m, damping = layout[5], start[6]
    shape_of(start, data[2], room)
    linear = point_rows(layout, data, start, room, damping)
    if data[0] > 0.0:
        limit_rows(layout, data, start, room, linear)
    N, step = room + SYSTEM, room + STEP
    solve(N, m, linear, damping, step)
    for i in range(m):
        step[i] = N[(m + 1) * i + m]
    for i in range(layout[6]):
        trial[i] = start[i]
    add_linear(layout, data, trial, step)
    for s in range(3):
        trial[s] += step[linear + s]
    if m > linear + 3:
        trial[3] += step[linear + 3]
    if layout[1] == 0:
        for j in range(layout[0]):
            own = room + (PER_POINT + EACH * j)
            change = own[7]
            for i in range(m):
                change += own[8 + i] * step[i]
            trial[ANGLES + j] -= change / own[6]
    return measure(layout, data, trial, room, 0 if data[0] > 0.0 else 1)


def judge(layout: Wholes, data: Reals, starts: Reals, count: int, room: Reals) -> None:
    """Deviations of starts, linear numbers found for each."""
    for i in range(count):
        start = starts + layout[6] * i
        start[7] = measure(layout, data, start, room, 1)


def iterate(layout: Wholes, data: Reals, starts: Reals, count: int, steps: int, room: Reals) -> None:
    """Steps of each start, until one gains no more than 1e-13 of its deviation."""
    trial = room + (PER_POINT + EACH * layout[0])
    for i in range(count):
        start = starts + layout[6] * i
        start[7] = measure(layout, data, start, room, 0)
        for _ in range(steps):
            if start[7] < 1e-32 or start[6] > 1e12 or start[7] >= FAR:
                break
            found = attempt(layout, data, start, trial, room)
            if found < start[7]:
                gain = start[7] - found
                trial[6] = max(1e-15, 0.2 * start[6])
                trial[7] = found
                for k in range(layout[6]):
                    start[k] = trial[k]
                if gain < 1e-13 * found:
                    start[6] = 1e13
            else:
                start[6] = 6.0 * start[6]
                measure(layout, data, start, room, 0)


def shift(layout: Wholes, data: Reals, starts: Reals, count: int, room: Reals) -> None:
    """New shifts of starts at the end of their steps, and their damping anew."""
    for i in range(count):
        start = starts + layout[6] * i
        measure(layout, data, start, room, 0)
        start[6] = 1e-3
        for k in range(8):
            start[SHIFTS + k] = max(0.0, start[SHIFTS + k] + room[LIMITS + 11 * k])


def bring_inside(layout: Wholes, data: Reals, starts: Reals, count: int, share: float, room: Reals) -> None:
    """Lengths and coordinates of starts brought within a share of the bound; their deviations."""
    inside = share * data[0]
    for i in range(count):
        start = starts + layout[6] * i
        if place_points(layout, data, start, room) == 0:
            continue
        linear = start + HEAD
        ax, ay, bx, by = linear[2], linear[3], linear[4], linear[5]
        size = sqrt(ax * ax + ay * ay) + 1e-300
        cx, cy = ax / size, ay / size
        longest = max(max(room[0], room[1]), max(room[2], 1.0))  # noqa: PLW3301 - of two each
        now = max(0.03 * inside / longest, min(size, inside / longest))
        u = max(-inside, min(inside, bx * cx + by * cy))
        v = max(-inside, min(inside, by * cx - bx * cy))
        linear[2] = now * cx
        linear[3] = now * cy
        linear[4] = u * cx - v * cy
        linear[5] = u * cy + v * cx
        linear[0] = max(-inside, min(inside, linear[0]))
        linear[1] = max(-inside, min(inside, linear[1]))
        start[7] = measure(layout, data, start, room, 0)


@cache
def kernels() -> Kernels:
    """The compiled functions."""
    return Kernels(
        [
            spread_lengths,
            shape_of,
            place_points,
            columns,
            add_linear,
            solve,
            deviate,
            project,
            limits,
            measure,
            limit_rows,
            point_rows,
            attempt,
            judge,
            iterate,
            shift,
            bring_inside,
        ]
    )
