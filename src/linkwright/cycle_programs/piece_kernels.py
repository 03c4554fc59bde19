"""Signals of one design after another at Gauss points, reduced where they lie in the cache, compiled (kernels).

What ``piece_summaries`` finds with arrays: a signal is (POINTS, pieces) values. ``tables``: doubles that begin
with the matrix to the last orders (POINTS, 3), then at UP_TO the one to integrals (POINTS, POINTS), at LEGENDRE that
from sums or differences of opposite values to the coefficients (POINTS, HALF), at LOOKED from sums and from
differences to the sums and differences of opposite looks (POINTS each), at PLACES the places of these, at FORWARD and
BACKWARD the factors of Clenshaw's recurrence (POINTS each). ``jobs``: six whole numbers of
each: signal (-1: the integral of the lack of the job before), powers, excess, largest, smallest, number of its first
extreme. What is found is one number of all designs after another, ``apart`` each from the next.
"""

from __future__ import annotations

from functools import cache

from linkwright.engine.ir_module import Block
from linkwright.engine.kernel import (
    Kernels,
    Reals,
    Vector,
    Wholes,
    higher,
    invoke,
    least,
    load,
    lower,
    ramp,
    root,
    spread,
    store,
    total,
)
from linkwright.engine.kernel_writer import LANES

POINTS, HALF, HALF_LOOKS = 16, 8, 12
LAST, UP_TO, LEGENDRE = 0, 48, 304
LOOKED = LEGENDRE + POINTS * HALF
PLACES = LOOKED + (HALF_LOOKS + 1) * POINTS
FORWARD = PLACES + HALF_LOOKS + 1
BACKWARD = FORWARD + POINTS
#: Angle between two looks, which are cosines.
GAP = 0.1308996938995747
#: Numbers found by a job, and whole numbers that it is given.
FOUND, GIVEN = 5, 6
PARAMETERS = Block.PARAMETERS
#: As ``core.piecewise.SLACK``.
SLACK = 0.03
#: How much higher it may be where it is not met, as multiple of the size of its last orders.
REACH = 10.0
HUGE, TINY, BELOW_ONE = 1e300, 1e-40, 1.0 - 1e-15
#: As ``core.arrays.EQUAL``.
EQUAL = 1e-12
STEPS = 4


def bounds(row: Reals, pieces: int, tables: Reals, seen: Reals, found: Reals, apart: int) -> None:
    """How high the signal, and its negative, may be in every piece, (2, pieces); of all pieces the largest and the
    smallest value, and the size of the last orders."""
    most, fewest, rough, spoilt = spread(-HUGE), spread(HUGE), spread(0.0), spread(0.0)
    b = 0
    while b < pieces:
        at = min(b, pieces - LANES)
        top = load(row, at)
        bottom = load(row, at)
        c0, c1, c2 = tables[0] * top, tables[1] * top, tables[2] * top
        for i in range(1, POINTS):
            value = load(row, i * pieces + at)
            top = higher(top, value)
            bottom = lower(bottom, value)
            c0 = c0 + tables[3 * i] * value
            c1 = c1 + tables[3 * i + 1] * value
            c2 = c2 + tables[3 * i + 2] * value
        last = higher(higher(c0, -c0), higher(higher(c1, -c1), higher(c2, -c2)))
        beyond = SLACK * (top - bottom) + REACH * last
        store(seen, at, top + beyond)
        store(seen, pieces + at, beyond - bottom)
        most = higher(most, top)
        fewest = lower(fewest, bottom)
        rough = higher(rough, last)
        spoilt = spoilt + 0.0 * c0
        b += LANES
    found[0] = -least(-most)
    found[apart] = least(fewest)
    found[2 * apart] = -least(-rough) + total(spoilt)


def powers(row: Reals, share: Reals, pieces: int, found: Reals, apart: int) -> None:
    """Means of the signal and of its square."""
    mean, square = spread(0.0), spread(0.0)
    b = 0
    while b < pieces:
        at = min(b, pieces - LANES)
        fresh = spread(1.0) if ramp(at) > b - 0.5 else spread(0.0)
        for i in range(POINTS):
            value = load(row, i * pieces + at)
            weight = load(share, i * pieces + at) * fresh
            mean = mean + weight * value
            square = square + weight * value * value
        b += LANES
    found[3 * apart] = total(mean)
    found[4 * apart] = total(square)


def integral(row: Reals, share: Reals, pieces: int, tables: Reals, mean: float, room: Reals) -> None:
    """The integral of mean - signal up to every Gauss point, (POINTS, pieces), in the first part of the room."""
    size = POINTS * pieces
    gained = room + size
    whole = gained + size
    b = 0
    while b < pieces:
        at = min(b, pieces - LANES)
        gains = spread(0.0)
        for i in range(POINTS):
            gain = (mean - load(row, i * pieces + at)) * load(share, i * pieces + at)
            store(gained, i * pieces + at, gain)
            gains = gains + gain
        store(whole, at, gains)
        b += LANES
    before = 0.0
    for p in range(pieces):
        gains_there = whole[p]
        whole[p] = before
        before += gains_there
    b = 0
    while b < pieces:
        at = min(b, pieces - LANES)
        for i in range(POINTS):
            work = load(whole, at)
            for j in range(POINTS):
                work = work + tables[UP_TO + POINTS * i + j] * load(gained, j * pieces + at)
            store(room, i * pieces + at, work)
        b += LANES


def contenders(
    row: Reals, pieces: int, seen: Reals, sign: float, bar: float, size: float, owner: int, rows: Reals,
    capacity: int, ids: Wholes, first: int,
) -> int:  # fmt: skip
    """Puts the values of all pieces that may hold the largest of sign · signal, as ``seen`` says, behind each other,
    with the ``size`` of the signal; how many there are then."""
    at = first
    for p in range(pieces):
        if seen[p] < bar - EQUAL * size:
            continue
        for i in range(POINTS):
            rows[i * capacity + at] = sign * row[i * pieces + p]
        rows[POINTS * capacity + at] = size
        ids[2 * at] = owner
        ids[2 * at + 1] = p
        at += 1
    return at


def reduced(
    designs: int, code: int, block: Wholes, stride: int, fields: Wholes, given: int, signals: Reals, share: Reals,
    pieces: int, jobs: Wholes, count: int, extremes: int, tables: Reals, room: Reals, found: Reals, apart: int,
    rows: Reals, capacity: int, ids: Wholes,
) -> int:  # fmt: skip
    """Signals of one design after another by the compiled program, then its jobs; the number of contenders for
    extremes. Ends early where these may not find room; ``ids[2 · capacity]``: designs done.

    ``stride``: bytes of a design's parameters; ``fields``: the addresses of so many ``given`` fields in the block;
    ``room``: (2 POINTS + 3) · pieces doubles.
    """
    seen = room + (2 * POINTS + 1) * pieces
    at = 0
    for d in range(designs):
        if at + extremes * pieces > capacity:
            break
        ids[2 * capacity] = d + 1
        invoke(code, block)
        block[PARAMETERS] = block[PARAMETERS] + stride
        for f in range(given):
            fields[f] = fields[f] + 8 * POINTS * pieces
        for j in range(count):
            job = jobs + GIVEN * j
            result = found + (FOUND * j * apart + d)
            row = room + 0
            if job[0] >= 0:
                row = signals + POINTS * pieces * job[0]
            bounds(row, pieces, tables, seen, result, apart)
            if job[1] > 0:
                powers(row, share, pieces, result, apart)
            owner = job[5] * apart + d
            size = max(result[0], -result[apart])
            if job[3] > 0:
                at = contenders(row, pieces, seen, 1.0, result[0], size, owner, rows, capacity, ids, at)
                owner += apart
            if job[4] > 0:
                at = contenders(
                    row, pieces, seen + pieces, -1.0, -result[apart], size, owner, rows, capacity, ids, at
                )
            if job[2] > 0:
                integral(row, share, pieces, tables, result[3 * apart], room)
    return at


def derive(of: Reals, slopes: Reals) -> None:
    """Coefficients of the derivative of Legendre's series."""
    even, odd = spread(0.0), spread(0.0)
    for j in range(POINTS):
        k = POINTS - 1 - j
        store(slopes, LANES * k, (2.0 * k + 1.0) * odd)
        following = load(of, LANES * k) + even
        even = odd
        odd = following


def series(of: Reals, x: Vector, tables: Reals) -> Vector:
    """Legendre's series at some places (Clenshaw 1955)."""
    value, before = spread(0.0), spread(0.0)
    for j in range(POINTS):
        k = POINTS - 1 - j
        known = load(of, LANES * k) + tables[BACKWARD + k] * before
        following = known + tables[FORWARD + k] * x * value
        before = value
        value = following
    return value


def peaks(count: int, rows: Reals, capacity: int, tables: Reals, room: Reals, found: Reals) -> None:
    """Largest values of polynomials through ``rows`` (POINTS, capacity), beneath which the sizes of the signals
    stand: of each place, value and size of the last orders, (3, capacity); the capacity is a multiple of LANES.

    From the highest look, of equal ones the first, by Newton's steps between its neighbours, halvings where these
    leave the bracket. ``room``: sums and differences of values at nodes opposite to each other, coefficients of the
    polynomial, its slope and the slope of that, (4, POINTS) vectors.
    """
    orders = room + POINTS * LANES
    slopes = orders + POINTS * LANES
    bends = slopes + POINTS * LANES
    r = 0
    while r < count:
        equal = EQUAL * load(rows, POINTS * capacity + r)
        top_there, bottom_there = load(rows, r), load(rows, r)
        for i in range(HALF):
            left, right = load(rows, i * capacity + r), load(rows, (POINTS - 1 - i) * capacity + r)
            top_there = higher(top_there, higher(left, right))
            bottom_there = lower(bottom_there, lower(left, right))
            store(room, LANES * i, left + right)
            store(room, LANES * (HALF + i), left - right)
        for k in range(POINTS):
            order = spread(0.0)
            for i in range(HALF):
                order = order + tables[LEGENDRE + HALF * k + i] * load(room, LANES * (HALF * (k % 2) + i))
            store(orders, LANES * k, order)
        derive(orders, slopes)
        derive(slopes, bends)
        best, place = spread(-HUGE), spread(-1.0)
        for j in range(HALF_LOOKS + 1):
            even, odd = spread(0.0), spread(0.0)
            for i in range(HALF):
                even = even + tables[LOOKED + POINTS * j + i] * load(room, LANES * i)
                odd = odd + tables[LOOKED + POINTS * j + HALF + i] * load(room, LANES * (HALF + i))
            place = spread(tables[PLACES + j]) if best + equal < even + odd else place
            best = higher(best, even + odd)
            place = spread(-tables[PLACES + j]) if best + equal < even - odd else place
            best = higher(best, even - odd)
        gap = GAP * root(higher(spread(0.0), 1.0 - place * place)) + GAP * GAP
        low, high = higher(spread(-1.0), place - gap), lower(spread(1.0), place + gap)
        rim = spread(0.0) if place * place > BELOW_ONE else spread(1.0)
        x = place
        moved, slope = spread(0.0), spread(0.0)
        for _ in range(STEPS):
            slope = series(slopes, x, tables)
            rising = slope > 0.0
            low = x if rising else low
            high = high if rising else x
            newton = x - slope / series(bends, x, tables)
            middle = 0.5 * (low + high)
            inside = (newton - low) * (high - newton)
            following = newton if inside > -TINY else middle
            moved = following - x
            x = following
        top = series(orders, x, tables)
        doubt = rim * slope * moved
        place = x if top > best else place
        place = place if top_there - bottom_there > equal else spread(-1.0)
        rough = higher(doubt, -doubt)
        for k in range(POINTS - 3, POINTS):
            last = load(orders, LANES * k)
            rough = higher(rough, higher(last, -last))
        store(found, r, place)
        store(found, capacity + r, higher(top, best))
        store(found, 2 * capacity + r, rough)
        r += LANES


def gathered(
    count: int, ids: Wholes, rows: Reals, looked: Reals, capacity: int, extremes: int, found: Reals
) -> None:
    """Of the contenders for every extreme the highest, of equal ones the first: its piece, place and value, and the
    size of the last orders of all that may be higher, (4, extremes), where minus infinity and zero stand before."""
    for r in range(count):
        owner = ids[2 * r]
        value = looked[capacity + r]
        if value <= found[2 * extremes + owner]:
            continue
        found[owner] = float(ids[2 * r + 1])
        found[extremes + owner] = looked[r]
        found[2 * extremes + owner] = value
    for back in range(count):
        r = count - 1 - back
        owner = ids[2 * r]
        if looked[capacity + r] >= found[2 * extremes + owner] - EQUAL * rows[POINTS * capacity + r]:
            found[owner] = float(ids[2 * r + 1])
            found[extremes + owner] = looked[r]
    for r in range(count):
        owner = ids[2 * r]
        rough = looked[2 * capacity + r]
        if looked[capacity + r] + REACH * rough < found[2 * extremes + owner]:
            continue
        found[3 * extremes + owner] = max(found[3 * extremes + owner], rough)


@cache
def kernels() -> Kernels:
    """The compiled functions."""
    return Kernels((bounds, powers, integral, contenders, reduced, derive, series, peaks, gathered))
