"""The tracker compiled: eight paths side by side, each with its own place and step (kernels).

The same steps as ``tracker``'s in arrays; a path that has ended makes room for the next one. The 8 × 8 systems are
solved by elimination, the pivot of each path sought in its own column.
"""

from __future__ import annotations

from functools import cache
from math import sqrt

from linkwright.formula.kernel import (
    Kernels,
    Reals,
    choose,
    fetch,
    inverse,
    load,
    maximum,
    minimum,
    put,
    root,
    spread,
    square,
    store,
)

#: Doubles of an entry, eight complex numbers; entries of the systems (8 × 9), of their parts, of solutions and rates.
WIDE, SYSTEM, PARTS, RATES = 16, 72, 96, 16
LOST, ARRIVED, ON_THE_WAY, FIRST_STEP = 0.0, 1.0, 2.0, 0.02
#: Doubles that ``carry`` works in.
ROOM = WIDE * (SYSTEM + PARTS + 10 * RATES)


def eliminate(A: Reals) -> None:
    """Column 8 of the system (8 × 9) becomes its solution."""
    for k in range(8):
        for i in range(k + 1, 8):
            theirs, own = square(fetch(A, 9 * i + k)), square(fetch(A, 9 * k + k))
            for c in range(k, 9):
                low, high = fetch(A, 9 * i + c), fetch(A, 9 * k + c)
                put(A, 9 * k + c, choose(theirs > own, low, high))
                put(A, 9 * i + c, choose(theirs > own, high, low))
        pivot = inverse(fetch(A, 9 * k + k))
        put(A, 9 * k + k, pivot)
        for i in range(k + 1, 8):
            factor = fetch(A, 9 * i + k) * pivot
            for c in range(k + 1, 9):
                put(A, 9 * i + c, fetch(A, 9 * i + c) - factor * fetch(A, 9 * k + c))
    for back in range(8):
        k = 7 - back
        found = fetch(A, 9 * k + 8)
        for c in range(k + 1, 8):
            found = found - fetch(A, 9 * k + c) * fetch(A, 9 * c + 8)
        put(A, 9 * k + 8, found * fetch(A, 9 * k + k))


def linear_step(u: Reals, q: Reals, dq: Reals, moving: int, room: Reals, out: Reals) -> None:
    """du/dt for points q that move by dq, or the Newton correction where they are still."""
    A, P = room, room + WIDE * SYSTEM
    for j in range(8):
        g = fetch(u, 8 + j)
        near = inverse(1.0 + g)
        f = -g * near
        for k in range(2):
            x, xc, w, wc = fetch(u, 4 * k), fetch(u, 4 * k + 1), fetch(u, 4 * k + 2), fetch(u, 4 * k + 3)
            m = fetch(q, j) + x * g
            n = fetch(q, 8 + j) + xc * f
            mw = m - w
            nw = n - wc
            e = 12 * j + 6 * k
            put(P, e, g * nw)
            put(P, e + 1, f * mw)
            put(P, e + 2, -n)
            put(P, e + 3, -m)
            put(P, e + 4, x * nw - xc * mw * near * near)
            right = n * w - m * nw
            if moving == 1:
                right = -(fetch(dq, j) * nw + fetch(dq, 8 + j) * mw)
            put(P, e + 5, right)
        first, second = fetch(P, 12 * j + 4), fetch(P, 12 * j + 10)
        size = 1.0 / root(square(first) + square(second) + 1e-300)
        p, r = second * size, -first * size
        for c in range(4):
            put(A, 9 * j + c, p * fetch(P, 12 * j + c))
            put(A, 9 * j + 4 + c, r * fetch(P, 12 * j + 6 + c))
        put(A, 9 * j + 8, p * fetch(P, 12 * j + 5) + r * fetch(P, 12 * j + 11))
    eliminate(A)
    for c in range(8):
        put(out, c, fetch(A, 9 * c + 8))
    for j in range(8):
        one, two = fetch(P, 12 * j + 5), fetch(P, 12 * j + 11)
        for c in range(4):
            one = one - fetch(P, 12 * j + c) * fetch(out, c)
            two = two - fetch(P, 12 * j + 6 + c) * fetch(out, 4 + c)
        first, second = fetch(P, 12 * j + 4), fetch(P, 12 * j + 10)
        larger = square(first) > square(second)
        put(out, 8 + j, choose(larger, one, two) * inverse(choose(larger, first, second)))


def relative_size(du: Reals, u: Reals, size: Reals) -> None:
    """Squares of the largest relative components of eight corrections: ``tracker.relative_size``."""
    largest, worst = spread(0.0), spread(0.0)
    for j in range(8):
        largest = maximum(largest, square(fetch(u, 8 + j)))
    for c in range(8):
        worst = maximum(worst, square(fetch(du, c)) / (square(fetch(u, c)) + 1e-4))
        g = fetch(u, 8 + c)
        floor = minimum(square(g) + 0.01 * largest, square(1.0 + g))
        worst = maximum(worst, square(fetch(du, 8 + c)) / floor)
    for c in range(16):  # a correction that is no number makes the size none either
        worst = worst + 0.0 * square(fetch(du, c))
    store(size, 0, worst)


def place(q0: Reals, dq: Reals, t: Reals, q: Reals) -> None:
    """The points at eight places of the way."""
    for c in range(16):
        put(q, c, fetch(q0, c) + load(t, 0) * fetch(dq, c))


def ahead(u: Reals, rate: Reals, h: Reals, share: float, out: Reals) -> None:
    """Solutions a share of the steps on."""
    step = share * load(h, 0)
    for c in range(16):
        put(out, c, fetch(u, c) + step * fetch(rate, c))


def fill(lane: int, row: Reals, u: Reals) -> None:
    """A solution into a lane."""
    for c in range(16):
        u[WIDE * c + lane] = row[2 * c]
        u[WIDE * c + 8 + lane] = row[2 * c + 1]


def empty(lane: int, row: Reals, u: Reals) -> None:
    """A solution out of a lane."""
    for c in range(16):
        row[2 * c] = u[WIDE * c + lane]
        row[2 * c + 1] = u[WIDE * c + 8 + lane]


def attempt(u: Reals, t: Reals, h: Reals, q0: Reals, dq: Reals, room: Reals, sizes: Reals, moved: Reals) -> None:
    """A step of eight paths: where it leads, and the squared sizes of its two corrections."""
    S, q, v = room, room + WIDE * (SYSTEM + PARTS), room + WIDE * (SYSTEM + PARTS + 16)
    k1, k2 = v + WIDE * RATES, v + WIDE * 2 * RATES
    k3, k4 = v + WIDE * 3 * RATES, v + WIDE * 4 * RATES
    at = v + WIDE * 5 * RATES
    place(q0, dq, t, q)
    linear_step(u, q, dq, 1, S, k1)
    ahead(u, k1, h, 0.5, v)
    store(at, 0, load(t, 0) + 0.5 * load(h, 0))
    place(q0, dq, at, q)
    linear_step(v, q, dq, 1, S, k2)
    ahead(u, k2, h, 0.5, v)
    linear_step(v, q, dq, 1, S, k3)
    ahead(u, k3, h, 1.0, v)
    store(at, 0, load(t, 0) + load(h, 0))
    place(q0, dq, at, q)
    linear_step(v, q, dq, 1, S, k4)
    sixth = load(h, 0) * (1.0 / 6.0)
    for c in range(16):
        middle = fetch(k2, c) + fetch(k3, c)
        put(moved, c, fetch(u, c) + sixth * (fetch(k1, c) + 2.0 * middle + fetch(k4, c)))
    for k in range(2):
        linear_step(moved, q, dq, 0, S, k1)
        relative_size(k1, moved, sizes + 8 * k)
        for c in range(16):
            put(moved, c, fetch(moved, c) + fetch(k1, c))


def fifth_root(value: float) -> float:
    """The fifth root of a number between 1e-12 and 1e12, to a per cent."""
    x = sqrt(sqrt(value))
    for _ in range(6):
        x = 0.8 * x + 0.2 * value / (x * x * x * x)
    return x


def begin(lane: int, path: int, count: int, rows: Reals, u: Reals, state: Reals) -> int:
    """The next path into a lane, or none where all have begun; gives the number of paths begun.

    ``state``: place, step, path (-1: none) and number of steps of each lane.
    """
    state[lane] = 1.0
    state[8 + lane] = 0.0
    state[16 + lane] = -1.0
    state[24 + lane] = 0.0
    if path == count:
        return path
    fill(lane, rows + 32 * path, u)
    state[lane] = 0.0
    state[8 + lane] = FIRST_STEP
    state[16 + lane] = float(path)
    return path + 1


def proceed(lane: int, good: int, first: float, limits: Reals, state: Reals) -> float:
    """Place and next step of a lane after an attempt; gives ARRIVED, LOST or ON_THE_WAY."""
    tolerance, smallest, largest, most = limits[0], limits[1], limits[2], limits[3]
    growth = 0.0
    if first < 1e3:
        growth = 0.85 * fifth_root(tolerance / (first + 1e-12))
    h = state[8 + lane]
    state[24 + lane] += 1.0
    if good == 1:
        state[lane] += h
        state[8 + lane] = min(largest, h * min(2.0, max(0.4, growth)))
        if state[lane] >= 1.0 - 1e-14:
            return ARRIVED
    else:
        shrink = 0.5
        if first > tolerance and first < 1e3:
            shrink = max(0.2, min(0.6, growth))
        state[8 + lane] = h * shrink
        if h * shrink < smallest:
            return LOST
    return LOST if state[24 + lane] > most else ON_THE_WAY


def carry(count: int, rows: Reals, q0: Reals, dq: Reals, arrived: Reals, limits: Reals, room: Reals) -> None:
    """Paths of the rows (count, 16 complex) carried along; ``arrived``: ARRIVED or LOST of each.

    ``limits``: tolerance, smallest and largest step, most steps, size of the second correction that rounding excuses.
    """
    tolerance = limits[0]
    u, moved, state, sizes = room, room + WIDE * 16, room + WIDE * 32, room + WIDE * 34
    keep, work = sizes + 16, sizes + 24
    begun, active = 0, min(count, 8)
    for lane in range(8):
        fill(lane, rows, u)
        begun = begin(lane, begun, count, rows, u, state)
    while active > 0:
        for lane in range(8):
            state[8 + lane] = min(state[8 + lane], 1.0 - state[lane])
        attempt(u, state, state + 8, q0, dq, work, sizes, moved)
        for lane in range(8):
            first, second = sqrt(sizes[lane]), sqrt(sizes[8 + lane])
            good = first < 8.0 * tolerance and second < 1e-5 and second < max(limits[4], 0.1 * first)
            keep[lane] = 1.0 if good else 0.0
        accepted = load(keep, 0)
        for c in range(16):
            put(u, c, choose(accepted > 0.5, fetch(moved, c), fetch(u, c)))
        for lane in range(8):
            path = int(state[16 + lane])
            if path < 0:
                continue
            outcome = proceed(lane, int(keep[lane]), sqrt(sizes[lane]), limits, state)
            if outcome < ON_THE_WAY:
                empty(lane, rows + 32 * path, u)
                arrived[path] = outcome
                active -= 1
                now = begin(lane, begun, count, rows, u, state)
                active += now - begun
                begun = now


@cache
def kernels() -> Kernels:
    """The compiled functions."""
    return Kernels(
        [eliminate, linear_step, relative_size, place, ahead, fill, empty, attempt, fifth_root, begin, proceed, carry]
    )
