"""``python -m tests.nine_point_trace``: are the 1442 classes of the start set all there are? (trace test)

A coupler curve is the zero set of F = Σ c_kl d^k e^l, k, l ≤ 3, in the isotropic coordinates of the plane (Roberts
1875). The curves through the first point are therefore a variety K in the projective space of 15 coefficients, the
image of the dyads (x, X, w, W, y, Y, v, V): irreducible, of dimension 8. A further point is a linear condition on c,
and no c satisfies it at all points; so eight general points cut K in as many curves as eight general linear forms
do: deg K. It is what the start set must have.

The start set is carried from its points to a general linear section of K, and from there to two parallel ones, where
the last of the eight forms l(c) = t λ(c) has moved on. The sum of c/λ(c) over a complete section is linear in t; that
of a part of it is not, because a general section's monodromy exchanges its points freely. So the second difference of
the sum over all 1442 is zero where they are complete, and not zero where any are missing.

Nothing of the package's tracker is used, only the start set that it delivers. With probability one, up to rounding.
Source: Sommese, Verschelde and Wampler 2002, SIAM J. Numer. Anal. 40; Leykin, Rodriguez and Sottile 2018, Arnold
Math. J. 4 (trace test).
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from linkwright.synthesis.nine_points.start import start_set

Floats = NDArray[np.float64]
Complexes = NDArray[np.complexfloating]
Flags = NDArray[np.bool_]

#: Places t of the parallel sections; what the residual may be; how near curves of one section are the same.
SECTIONS, ENOUGH, SAME = (0.0, 0.7 + 0.4j, -0.5 + 0.8j), 1e-7, 1e-6
TOLERANCE, SMALLEST, LARGEST, MOST_STEPS, WAYS = 1e-3, 1e-12, 0.2, 2000, 8


def main(arguments: Sequence[str] | None = None) -> int:
    """Prints the residual with all classes, and the least and middle one with one class left out."""
    parser = argparse.ArgumentParser(prog="python -m tests.nine_point_trace", description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    begin, rng = time.process_time(), np.random.default_rng(parser.parse_args(arguments).seed)
    points, z = _places(rng)
    section = np.concatenate([np.eye(8), _general(rng, 8, 7)], 1)
    chart = _general(rng, 15)
    first = general_section(z, points, section, chart, rng)
    sums = second_differences(first, points, section, chart)
    total, single = np.abs(sums.sum(0)).max(), np.sort(np.abs(sums).max(1))
    print(
        f"{len(z)} classes of the start set: {len(first)} different curves on the general section\n"
        f"trace residual with all of them {total:.1e}; with one left out {single[0]:.1e} at least, "
        f"{np.median(single):.1e} in the middle; {time.process_time() - begin:.1f} CPU s"
    )
    return 0 if len(first) == len(z) and total < ENOUGH < single[0] else 1


def curve(z: Complexes, points: Complexes) -> tuple[Complexes, Complexes]:
    """F (N, k) of dyads z (N, 8) at points (2, k), and its slopes by z (N, k, 8).

    With the rotation θ of the coupler each dyad gives q + p X/θ + P x θ = 0, p = d - x - w, q = p P + x X - w W:
    two linear equations for 1/θ and θ, whose product is 1.
    """
    x, xc, w, wc, y, yc, v, vc = (z[:, i, None] for i in range(8))
    p, pc, r, rc = points[0] - x - w, points[1] - xc - wc, points[0] - y - v, points[1] - yc - vc
    q, s = p * pc + x * xc - w * wc, r * rc + y * yc - v * vc
    back, on = q * rc * y - s * pc * x, p * xc * s - r * yc * q
    both = p * xc * rc * y - pc * x * r * yc
    by_q, by_s = on * rc * y - back * r * yc, back * p * xc - on * pc * x
    by_p = back * xc * s - 2 * both * xc * rc * y + by_q * pc
    by_pc = -on * s * x + 2 * both * x * r * yc + by_q * p
    by_r = -back * yc * q + 2 * both * pc * x * yc + by_s * rc
    by_rc = on * q * y - 2 * both * p * xc * y + by_s * r
    slopes = [
        -on * s * pc + 2 * both * pc * r * yc + by_q * xc - by_p,
        back * p * s - 2 * both * p * rc * y + by_q * x - by_pc,
        -by_q * wc - by_p,
        -by_q * w - by_pc,
        on * q * rc - 2 * both * p * xc * rc + by_s * yc - by_r,
        -back * r * q + 2 * both * pc * x * r + by_s * y - by_rc,
        -by_s * vc - by_r,
        -by_s * v - by_rc,
    ]
    return back * on - both * both, np.stack(slopes, 2)


def general_section(
    z: Complexes, points: Complexes, section: Complexes, chart: Complexes, rng: np.random.Generator
) -> Complexes:
    """The solutions z of the points carried to the general section; lost ones sought along other ways."""
    start: Complexes = np.eye(8, 15, dtype=complex)
    ends, arrived = carried(z, points, start, section)
    found = ends[arrived]
    for _ in range(WAYS):
        if len(found) >= len(z):
            break
        middle = np.concatenate([np.eye(8), _general(rng, 8, 7)], 1)
        ends, arrived = carried(z, points, start, middle)
        ends, arrived = carried(ends[arrived], points, middle, section)
        known, more = coordinates(found, points, chart), coordinates(ends[arrived], points, chart)
        new = [np.abs(known - each).max(1).min() > SAME for each in more]
        found = np.concatenate([found, ends[arrived][np.array(new)]])
    return found


def second_differences(
    first: Complexes, points: Complexes, section: Complexes, chart: Complexes
) -> Complexes:
    """Divided second difference over the parallel sections of each curve's coordinates, (N, 15)."""
    places = [coordinates(first, points, chart)]
    for t in SECTIONS[1:]:
        moved = section.copy()
        moved[7] -= t * chart
        ends, arrived = carried(first, points, section, moved)
        if not arrived.all():
            raise ArithmeticError(f"{int((~arrived).sum())} paths were lost on the way to a parallel section")
        places.append(coordinates(ends, points, chart))
    weights = [1 / np.prod([t - other for other in SECTIONS if other != t]) for t in SECTIONS]
    return np.asarray(sum(weight * place for weight, place in zip(weights, places, strict=True)))


def coordinates(z: Complexes, points: Complexes, chart: Complexes) -> Complexes:
    """Values of F at the 15 places, which determine the curve, over the chart's linear form; more digits inside."""
    f, _ = curve(z.astype(np.clongdouble), points.astype(np.clongdouble))
    return np.asarray((f / (f @ chart)[:, None]).astype(complex))


def carried(z: Complexes, points: Complexes, first: Complexes, last: Complexes) -> tuple[Complexes, Flags]:
    """Solutions z (N, 8) of the section ``first`` (8, 15) carried along a straight way to ``last``; which arrived.

    Runge and Kutta's fourth order, two Newton corrections, the step from the first one.
    """
    change = last - first
    ends, arrived = z.copy(), np.zeros(len(z), bool)
    who, t, h = np.arange(len(z)), np.zeros(len(z)), np.full(len(z), 0.02)

    def step(at: Complexes, place: Floats, moving: bool) -> Complexes:
        f, slopes = curve(at, points)
        matrix = first @ slopes + place[:, None, None] * (change @ slopes)
        right = f @ change.T if moving else f @ first.T + place[:, None] * (f @ change.T)
        return _solved(matrix, -right)

    with np.errstate(all="ignore"):
        for _ in range(MOST_STEPS):
            h = np.minimum(h, 1 - t)
            long = h[:, None]
            k1 = step(z, t, True)
            k2 = step(z + long / 2 * k1, t + h / 2, True)
            k3 = step(z + long / 2 * k2, t + h / 2, True)
            k4 = step(z + long * k3, t + h, True)
            moved = z + long / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            sizes = []
            for _ in range(2):
                correction = step(moved, t + h, False)
                sizes.append(_size(correction, moved))
                moved = moved + correction
            good = (sizes[0] < 8 * TOLERANCE) & (sizes[1] < np.clip(0.1 * sizes[0], 1e-8, 1e-5))
            z, t = np.where(good[:, None], moved, z), np.where(good, t + h, t)
            growth = 0.85 * (TOLERANCE / (np.minimum(sizes[0], 1e3) + 1e-12)) ** 0.2
            h = np.minimum(LARGEST, h * np.where(good, np.clip(growth, 0.4, 2), np.clip(growth, 0.2, 0.6)))
            done = t >= 1 - 1e-14
            ends[who[done]], arrived[who[done]] = z[done], True
            stay = ~done & (h > SMALLEST)
            z, t, h, who = z[stay], t[stay], h[stay], who[stay]
            if not len(who):
                break
        for _ in range(3):
            correction = step(ends, np.ones(len(ends)), False)
            ends = np.where((_size(correction, ends) < 1e-6)[:, None], ends + correction, ends)
    return ends, arrived


def _solved(matrix: Complexes, right: Complexes) -> Complexes:
    bad = ~np.isfinite(matrix.sum((1, 2)) + right.sum(1))
    matrix[bad], right[bad] = np.eye(8), np.nan
    return np.asarray(np.linalg.solve(matrix, right[:, :, None])[:, :, 0])


def _size(correction: Complexes, z: Complexes) -> Floats:
    size = (np.abs(correction) / (np.abs(z) + 0.01)).max(1)
    return np.asarray(np.where(np.isfinite(size), size, np.inf))


def _places(rng: np.random.Generator) -> tuple[Complexes, Complexes]:
    """The start set's eight points with seven general ones (2, 15), and its dyads (1442, 8)."""
    q, u = start_set()
    return np.concatenate([q, _general(rng, 2, 7)], 1), u[:, :8]


def _general(rng: np.random.Generator, *shape: int) -> Complexes:
    return np.asarray(rng.normal(size=shape) + 1j * rng.normal(size=shape))


if __name__ == "__main__":
    raise SystemExit(main())
