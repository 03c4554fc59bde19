"""Dyads with a slide: a rod whose pin runs on a fixed guide (RRP), and a rod that slides through a block (RPR).

Each places its node B from a node P and a pivot Q before it, and takes the slopes by B back to P, Q and its own two
numbers (kernels; sin² μ and its penalty are those of ``kernels.py``). Placing returns min sin² μ, negative where
the dyad does not close.
"""

from __future__ import annotations

from math import cos, sin

from linkwright.formula.kernel import Reals, load, maximum, minimum, root, smallest, spread, store, total


def place_slider(
    N: int, r: float, phi: float, side: float, px: Reals, py: Reals, qx: Reals, qy: Reals, x: Reals, y: Reals
) -> float:
    """B at distance r from P on the line through Q in the direction φ; sin² μ = 1 - h²/r², h: distance of P."""
    low, c, s, inverse = spread(1.0), cos(phi), sin(phi), 1.0 / (r * r)
    for t in range(0, N, 8):
        dx = load(px, t) - load(qx, t)
        dy = load(py, t) - load(qy, t)
        h = c * dy - s * dx
        square = r * r - h * h
        low = minimum(low, square * inverse)
        along = c * dx + s * dy + side * root(maximum(square, 0.0))
        store(x, t, load(qx, t) + c * along)
        store(y, t, load(qy, t) + s * along)
    return smallest(low)


def slider_back(
    N: int,
    r: float,
    phi: float,
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
    """With u = (B - P)/r and the guide's direction e and normal n: u·dB = u·dP + dr, n·dB = n·dQ + e·(B - Q) dφ."""
    c, s, inverse = cos(phi), sin(phi), 1.0 / r
    gr, gphi, miss = spread(0.0), spread(0.0), spread(0.0)
    for t in range(0, N, 8):
        hx, hy = load(gX, own + t), load(gY, own + t)
        ux = (load(X, own + t) - load(X, i + t)) * inverse
        uy = (load(Y, own + t) - load(Y, i + t)) * inverse
        along_u = (hx * c + hy * s) / (ux * c + uy * s)
        along_n = c * hy - s * hx - along_u * (c * uy - s * ux)
        dx = load(X, i + t) - load(X, j + t)
        dy = load(Y, i + t) - load(Y, j + t)
        cosine = (c * dy - s * dx) * inverse
        lack = maximum(limit - 1.0 + cosine * cosine, 0.0) * (1.0 / limit)
        miss += lack * lack
        slope = lack * cosine * (4.0 * kappa / (limit * N))
        gr += along_u * r - slope * cosine
        foot = inverse * (c * dx + s * dy)
        gphi += along_n * (foot * r + r * (c * ux + s * uy)) - slope * foot
        pulled = slope * inverse
        store(gX, i + t, load(gX, i + t) + along_u * ux - pulled * s)
        store(gY, i + t, load(gY, i + t) + along_u * uy + pulled * c)
        store(gX, j + t, load(gX, j + t) + s * (pulled - along_n))
        store(gY, j + t, load(gY, j + t) - c * (pulled - along_n))
    g[0] = total(gr)
    g[1] = total(gphi)
    return total(miss) * kappa / N


def place_block(
    N: int, a: float, e: float, side: float, px: Reals, py: Reals, qx: Reals, qy: Reals, x: Reals, y: Reals
) -> float:
    """B at distance a from P on a rod of which a parallel, e to its left, passes Q; sin² μ = 1 - e²/(PQ)²."""
    low = spread(1.0)
    for t in range(0, N, 8):
        dx = load(qx, t) - load(px, t)
        dy = load(qy, t) - load(py, t)
        square = dx * dx + dy * dy
        inverse = 1.0 / square
        low = minimum(low, 1.0 - e * e * inverse)
        along = side * root(maximum(square - e * e, 0.0))
        store(x, t, load(px, t) + a * inverse * (dx * along + dy * e))
        store(y, t, load(py, t) + a * inverse * (dy * along - dx * e))
    return smallest(low)


def block_back(
    N: int,
    a: float,
    e: float,
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
    """With u = (B - P)/a, its normal n and d = Q - P: the rod turns by dψ = (n·(dQ - dP) - de) / u·d."""
    ga, ge, miss, inverse = spread(0.0), spread(0.0), spread(0.0), 1.0 / a
    for t in range(0, N, 8):
        hx, hy = load(gX, own + t), load(gY, own + t)
        ux = (load(X, own + t) - load(X, i + t)) * inverse
        uy = (load(Y, own + t) - load(Y, i + t)) * inverse
        dx = load(X, j + t) - load(X, i + t)
        dy = load(Y, j + t) - load(Y, i + t)
        one = 1.0 / (dx * dx + dy * dy)
        turning = a * (ux * hy - uy * hx) / (ux * dx + uy * dy)
        square = e * e * one
        lack = maximum(limit - 1.0 + square, 0.0) * (1.0 / limit)
        miss += lack * lack
        slope = lack * (4.0 * kappa / (limit * N)) * one
        ga += hx * ux + hy * uy
        ge += slope * e - turning
        wx = 0.0 - turning * uy - slope * square * dx
        wy = turning * ux - slope * square * dy
        store(gX, i + t, load(gX, i + t) + hx - wx)
        store(gY, i + t, load(gY, i + t) + hy - wy)
        store(gX, j + t, load(gX, j + t) + wx)
        store(gY, j + t, load(gY, j + t) + wy)
    g[0] = total(ga) * a
    g[1] = total(ge)
    return total(miss) * kappa / N


SLIDING = (place_slider, slider_back, place_block, block_back)
