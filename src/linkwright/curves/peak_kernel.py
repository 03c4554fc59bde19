"""Largest values of many polynomials through sixteen Gauss points, compiled (kernels).

``tables``: doubles that begin with the matrix from sums and differences of opposite values to Legendre's coefficients
(POINTS, HALF), then at LOOKED the one from these to sums and differences of opposite looks (POINTS each), at PLACES
the places of these, at FORWARD and BACKWARD the factors of Clenshaw's recurrence (POINTS each).
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.polynomial import legendre

from linkwright.core.arrays import Floats
from linkwright.formula.kernel import Kernels, Reals, Vector, load, maximum, minimum, root, spread, store
from linkwright.formula.kernel_writer import LANES
from linkwright.formula.llvm_backend import address_of
from linkwright.formula.machine_code import available

POINTS, HALF, HALF_LOOKS = 16, 8, 12
LOOKED = POINTS * HALF
PLACES = LOOKED + (HALF_LOOKS + 1) * POINTS
FORWARD = PLACES + HALF_LOOKS + 1
BACKWARD = FORWARD + POINTS
#: Angle between two looks, which are cosines.
GAP = 0.1308996938995747
HUGE, TINY, BELOW_ONE = 1e300, 1e-40, 1.0 - 1e-15
STEPS = 4

possible = available


def derive(of: Reals, slopes: Reals) -> None:
    """Coefficients of the derivative of Legendre's series."""
    even, odd = spread(0.0), spread(0.0)
    for j in range(POINTS):
        k = POINTS - 1 - j
        store(slopes, LANES * k, (2.0 * k + 1.0) * odd)
        next_term = load(of, LANES * k) + even
        even = odd
        odd = next_term


def series(of: Reals, x: Vector, tables: Reals) -> Vector:
    """Legendre's series at some places (Clenshaw 1955)."""
    value, before = spread(0.0), spread(0.0)
    for j in range(POINTS):
        k = POINTS - 1 - j
        known = load(of, LANES * k) + tables[BACKWARD + k] * before
        next_value = known + tables[FORWARD + k] * x * value
        before = value
        value = next_value
    return value


def peaks(count: int, rows: Reals, capacity: int, tables: Reals, room: Reals, found: Reals) -> None:
    """Place and value of the largest of polynomials through ``rows`` (POINTS, capacity), (2, capacity); the capacity
    is a multiple of LANES.

    From the highest look, of equal ones the first, by Newton's steps between its neighbours, halvings where these
    leave the bracket. ``room``: sums and differences of values at nodes opposite to each other, coefficients of the
    polynomial, its slope and the slope of that, (4, POINTS) vectors.
    """
    orders = room + POINTS * LANES
    slopes = orders + POINTS * LANES
    bends = slopes + POINTS * LANES
    r = 0
    while r < count:
        for i in range(HALF):
            left, right = load(rows, i * capacity + r), load(rows, (POINTS - 1 - i) * capacity + r)
            store(room, LANES * i, left + right)
            store(room, LANES * (HALF + i), left - right)
        for k in range(POINTS):
            order = spread(0.0)
            for i in range(HALF):
                order = order + tables[HALF * k + i] * load(room, LANES * (HALF * (k % 2) + i))
            store(orders, LANES * k, order)
        derive(orders, slopes)
        derive(slopes, bends)
        best, place = spread(-HUGE), spread(-1.0)
        for j in range(HALF_LOOKS + 1):
            even, odd = spread(0.0), spread(0.0)
            for i in range(HALF):
                even = even + tables[LOOKED + POINTS * j + i] * load(room, LANES * i)
                odd = odd + tables[LOOKED + POINTS * j + HALF + i] * load(room, LANES * (HALF + i))
            place = spread(tables[PLACES + j]) if best < even + odd else place
            best = maximum(best, even + odd)
            place = spread(-tables[PLACES + j]) if best < even - odd else place
            best = maximum(best, even - odd)
        gap = GAP * root(maximum(spread(0.0), 1.0 - place * place)) + GAP * GAP
        low, high = maximum(spread(-1.0), place - gap), minimum(spread(1.0), place + gap)
        x = place
        for _ in range(STEPS):
            slope = series(slopes, x, tables)
            rising = slope > 0.0
            low = x if rising else low
            high = high if rising else x
            newton = x - slope / series(bends, x, tables)
            middle = 0.5 * (low + high)
            inside = (newton - low) * (high - newton)
            x = newton if inside > -TINY else middle
        top = series(orders, x, tables)
        place = x if top > best else place
        store(found, r, place)
        store(found, capacity + r, maximum(top, best))
        r += LANES


@cache
def _kernels() -> Kernels:
    """The compiled functions."""
    return Kernels((derive, series, peaks))


@cache
def _tables() -> Floats:
    """The numbers that the kernels take."""
    nodes, weights = legendre.leggauss(POINTS)
    orders = np.arange(POINTS)
    to_series = ((orders[:, None] + 0.5) * legendre.legvander(nodes, POINTS - 1).T * weights).T
    places = -np.cos(np.pi * np.arange(2 * HALF_LOOKS + 1) / (2 * HALF_LOOKS))[: HALF_LOOKS + 1]
    left = to_series @ legendre.legvander(places, POINTS - 1).T
    opposite = left[::-1][:HALF]
    looked = np.stack([0.5 * (left[:HALF] + opposite), 0.5 * (left[:HALF] - opposite)]).reshape(POINTS, -1).T
    forwards, backwards = (2 * orders + 1) / (orders + 1), -(orders + 1) / (orders + 2)
    parts = (to_series[:HALF].T, looked, places, forwards, backwards)
    return np.concatenate([np.ascontiguousarray(part, dtype=float).ravel() for part in parts])


def climbed(rows: Floats) -> tuple[Floats, Floats]:
    """Place (-1 to 1) and value (k,) of the largest of polynomials through ``rows`` (POINTS, k)."""
    count = rows.shape[1]
    room = -(-count // LANES) * LANES
    padded, found = np.zeros((POINTS, room)), np.empty((2, room))
    padded[:, :count] = rows
    vectors, tables = np.empty((4 * POINTS, LANES)), _tables()
    _kernels()("peaks", count, address_of(padded), room, address_of(tables), address_of(vectors), address_of(found))
    return found[0, :count], found[1, :count]
