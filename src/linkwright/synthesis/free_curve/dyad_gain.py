"""What one more dyad promises before any descent (kernels).

A node k of a linkage becomes k + w (G - k), a point of the new link from k to G, where G = dyad(k, F) and w = 0 at
first: the curve stays, and everything that hung on k hangs on the new point. F is a node before it, a new pivot or a
new point of a link. To first order a change δx of the linkage's numbers and w changes the distances d between curve
and target by J δx + c w. The objective's mean of d is a sum of squares with weights 1/d; of its residual r, the part
outside the columns of J is what the linkage alone cannot mend, and the share of it along c, without what J can do as
well, is the promise (orthogonal matching pursuit: Pati, Rezaiifar and Krishnaprasad 1993).
"""

from __future__ import annotations

from math import cos, log, sin, sqrt

from linkwright.formula.kernel import Reals, Wholes, load, store
from linkwright.synthesis.free_curve.atlas_kernels import spans
from linkwright.synthesis.free_curve.deviation import WIDE, target_to_curve
from linkwright.synthesis.free_curve.local_search import directions, dot, lay, slopes
from linkwright.synthesis.free_curve.placing import (
    BLOCK,
    DYAD,
    GUIDE,
    PIVOT,
    POINT,
    SLIDER,
    TURN,
    place,
    place_dyad,
    place_point,
)

#: Smoothing ε² of the distances; share of the demanded sin² of a transmission angle.
SOFT, SLACK = 4e-4, 0.7
#: Entries of a design with one more dyad.
ROWS, NUMBERS = 64, 32


def take_off(a: Reals, share: float, b: Reals, rows: int) -> None:
    """a - share b."""
    for t in range(0, rows, 8):
        store(a, t, load(a, t) - share * load(b, t))


def remainder(c: Reals, Q: Reals, known: int, rows: int) -> float:
    """Takes the part along Q's unit columns off a column and scales the rest to 1; gives 0 where none is left."""
    before = dot(c, c, rows)
    for k in range(known):
        take_off(c, dot(c, Q + k * rows, rows), Q + k * rows, rows)
    left = dot(c, c, rows)
    inverse = 1.0 / sqrt(left) if left > 1e-8 * before + 1e-30 else 0.0
    for t in range(0, rows, 8):
        store(c, t, inverse * load(c, t))
    return inverse


def first_use(nodes: Wholes, count: int, k: int) -> int:
    """The first row that hangs on a node; ``count`` where none does."""
    for row in range(2, count):
        kind = nodes[4 * row]
        if kind != PIVOT and nodes[4 * row + 1] == k:
            return row
        if kind >= DYAD and kind != SLIDER and nodes[4 * row + 2] == k:
            return row
    return count


def slides(kind: int) -> int:
    """1 where a node is the place of a slide: no pin can be there."""
    if kind == GUIDE:
        return 1
    return 1 if kind == BLOCK else 0


def grow(
    nodes: Wholes,
    count: int,
    x: Reals,
    at: int,
    hung: int,
    far: int,
    new: int,
    side: int,
    more: Reals,
    made: Wholes,
    numbers: Reals,
) -> int:
    """The linkage with the dyad: ``made`` and ``numbers``; gives its count. ``new``: 1 where F (in row ``at`` of
    ``made`` already) is new; ``more``: F's two numbers and the logarithms of both lengths; w = 0."""
    shift = 2 + new
    for row in range(count):
        to = row if row < at else row + shift
        for each in range(4):
            made[4 * to + each] = nodes[4 * row + each]
        if row >= at:
            i, j = nodes[4 * row + 1], nodes[4 * row + 2]
            made[4 * to + 1] = at + shift - 1 if i == hung else i if i < at else i + shift
            made[4 * to + 2] = j if j < at else j + shift
            if nodes[4 * row] >= DYAD and nodes[4 * row] != SLIDER and j == hung:
                made[4 * to + 2] = at + shift - 1
            if nodes[4 * row] == PIVOT:
                made[4 * to + 1] = 0
                made[4 * to + 2] = 0
        if row > 1:
            numbers[2 * to - 4] = x[2 * row - 4]
            numbers[2 * to - 3] = x[2 * row - 3]
    joint = at + new
    if new == 1:
        numbers[2 * at - 4] = more[0]
        numbers[2 * at - 3] = more[1]
    made[4 * joint] = DYAD
    made[4 * joint + 1] = hung
    made[4 * joint + 2] = far
    made[4 * joint + 3] = side
    made[4 * joint + 4] = POINT
    made[4 * joint + 5] = hung
    made[4 * joint + 6] = joint
    made[4 * joint + 7] = 1
    numbers[2 * joint - 4] = more[2]
    numbers[2 * joint - 3] = more[3]
    numbers[2 * joint - 2] = 0.0
    numbers[2 * joint - 1] = 0.0
    for each in range(3):
        numbers[2 * (count + shift - 2) + each] = x[2 * (count - 2) + each]
    return count + shift


def lengths(
    N: int,
    px: Reals,
    py: Reals,
    qx: Reals,
    qy: Reals,
    side: float,
    u: float,
    v: float,
    limit: float,
    room: Reals,
    more: Reals,
) -> float:
    """Lengths of a dyad that closes between two nodes with a good transmission angle, by two uniform numbers."""
    spans(N, px, py, qx, qy, room)
    low, high = room[0], room[1]
    if low < 0.02 * high or high - low < 1e-4 * high:
        return -1.0
    total, difference = high * (1.03 + 1.2 * u * u), low * 0.95 * (2.0 * v - 1.0)
    first, second = 0.5 * (total + difference), 0.5 * (total - difference)
    more[2] = log(first)
    more[3] = log(second)
    found = place_dyad(N, first, second, side, px, py, qx, qy, room, room + N)
    return -1.0 if found < limit else found


def drawn_dyad(
    nodes: Wholes,
    count: int,
    N: int,
    x: Reals,
    X: Reals,
    Y: Reals,
    r: Reals,
    most: int,
    reach: Reals,
    limit: float,
    room: Reals,
    made: Wholes,
    numbers: Reals,
) -> int:
    """One more dyad after nine uniform numbers r: ``made``, ``numbers``; gives the row of its point, -1: none."""
    hung = count - 1 if r[0] < 0.5 else 1 + int((r[0] - 0.5) * 2.0 * (count - 2))
    at = count if hung == count - 1 else first_use(nodes, count, hung)
    if at == count and hung < count - 1:
        return -1
    far, new, side, more = int(r[2] * at), 0, 1, room
    if r[8] < 0.5:
        side = -1
    fx, fy, rest = room + 8, room + 8 + N, room + 8 + 2 * N
    choice = int(r[1] * 4.0) if most - count > 2 else int(r[1] * 2.0)
    if choice == 0:  # a pivot: the next one from a random row on
        for _ in range(count):
            if nodes[4 * far] == PIVOT and far != 1:
                break
            far = far - 1 if far > 0 else at - 1
    if choice > 1:
        new = 1
        made[4 * at] = PIVOT
        made[4 * at + 1] = 0
        made[4 * at + 2] = 0
        made[4 * at + 3] = 1
        size = reach[2] * (0.4 + 4.6 * r[4])
        more[0] = reach[0] + size * cos(TURN * r[5])
        more[1] = reach[1] + size * sin(TURN * r[5])
        i, j = 0, 1
        if choice == 3:
            if nodes[4 * far] == DYAD:
                j = far
                i = nodes[4 * far + 1] if r[3] < 0.5 else nodes[4 * far + 2]
            if nodes[4 * far] > DYAD:
                j = far
                i = nodes[4 * far + 1]
            made[4 * at] = POINT
            made[4 * at + 1] = i
            made[4 * at + 2] = j
            more[0] = (0.2 + 1.8 * r[4]) * cos(TURN * r[5])
            more[1] = (0.2 + 1.8 * r[4]) * sin(TURN * r[5])
            place_point(N, more[0], more[1], X + i * N, Y + i * N, X + j * N, Y + j * N, fx, fy)
        else:
            for t in range(0, N, 8):
                store(fx, t, more[0])
                store(fy, t, more[1])
        far = at
    else:
        for t in range(0, N, 8):
            store(fx, t, load(X, far * N + t))
            store(fy, t, load(Y, far * N + t))
    own = hung * N
    if far == hung or slides(nodes[4 * hung]) == 1 or (new == 0 and slides(nodes[4 * far]) == 1):
        return -1
    if lengths(N, X + own, Y + own, fx, fy, 1.0 * side, r[6], r[7], limit, rest, more) < 0.0:
        return -1
    made[ROWS - 1] = grow(nodes, count, x, at, hung, far, new, side, more, made, numbers)
    return at + new + 1


def own_columns(nodes: Wholes, count: int, n: int, closed: int, x: Reals, m: int, s: Reals, Q: Reals) -> int:
    """The linkage's own columns J, orthonormal, in Q; gives their number. ``s``: as from :func:`directions`."""
    rows, known, d = n + m, 0, 2 * (count - 2) + 1
    if closed == 0:
        d += 2
    for p in range(d):
        one = Q + known * rows
        found = slopes(nodes, count, n, closed, x, p, m, s, Q + 28 * rows, one)
        if found > 0.0 and remainder(one, Q, known, rows) > 0.0:
            known += 1
    return known


def promises(
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
    draws: int,
    r: Reals,
    most: int,
    made: Wholes,
    numbers: Reals,
    counts: Wholes,
    gains: Reals,
) -> float:
    """Draws dyads and says what each promises, as a share of the residual; gives the residual's share outside J.

    ``made`` (draws, ROWS), ``numbers`` (draws, NUMBERS), ``counts``: the linkages with them; ``gains`` -1: none.
    ``n``, ``N``, ``m``: multiples of 8.
    """
    rows = n + m
    X, Y, s = room, room + count * N, room + 2 * count * N + 8
    rest, at, Q = s + 9 * WIDE, s + 10 * WIDE, s + 24 * WIDE
    free = Q + 28 * rows
    for k in range(draws):
        gains[k] = -1.0
    if lay(nodes, count, n, closed, x, free, s + 4 * WIDE, s + 5 * WIDE, at, s, s + WIDE) < 0.0:
        return -1.0
    directions(n, closed, target, m, SOFT, s)
    rest_squared = dot(rest, rest, rows)
    known = own_columns(nodes, count, n, closed, x, m, s, Q)
    for k in range(known):
        take_off(rest, dot(rest, Q + k * rows, rows), Q + k * rows, rows)
    place(nodes, count, n, N, closed, x, X, Y)
    for k in range(draws):
        own, xs = made + k * ROWS, numbers + k * NUMBERS
        joint = drawn_dyad(nodes, count, N, x, X, Y, r + 9 * k, most, at, SLACK * options[0], free, own, xs)
        if joint < 0:
            continue
        size, gain = own[ROWS - 1], 0.0
        for side in range(2):
            one = Q + (known + side) * rows
            if slopes(own, size, n, closed, xs, 2 * joint - 4 + side, m, s, free, one) > 0.0:
                remainder(one, Q, known + side, rows)
                along = dot(one, rest, rows)
                gain += along * along
        counts[k] = size
        gains[k] = gain / rest_squared
    return dot(rest, rest, rows) / rest_squared


def misses(
    nodes: Wholes, count: int, n: int, closed: int, x: Reals, target: Reals, m: int, room: Reals, out: Reals
) -> None:
    """Vectors (2 m) from the drawn curve's nearest points to the target's points."""
    s = room + 2 * count * n + 8
    yx, yy, steps, w, at, work = s, s + WIDE, s + 2 * WIDE, s + 3 * WIDE, s + 4 * WIDE, s + 5 * WIDE
    if lay(nodes, count, n, closed, x, room, steps, w, at, yx, yy) > 0.0:
        target_to_curve(yx, yy, n, closed, target, m, 1e-12, work)
        for j in range(0, m, 8):
            far = load(work, 8 * WIDE + j)
            store(out, j, far * load(work, 6 * WIDE + j))
            store(out, m + j, far * load(work, 7 * WIDE + j))


PROMISES = (take_off, misses, remainder, first_use, slides, grow, lengths, drawn_dyad, own_columns, promises)
