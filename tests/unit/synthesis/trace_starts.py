"""``python -m tests.unit.synthesis.trace_starts``: are the start sets of counted synthesis all there is? (trace test)

A coupler curve is the zero set of F = Σ c_kl d^k e^l, k, l ≤ 3, in the isotropic coordinates of the plane (Roberts
1875). The curves of the four-bars that take M poses are a variety K in the projective space of the coefficients,
the image of pairs of dyads (x, X, w, W), (y, Y, v, V) that take them: irreducible, of dimension N = 10 - 2 M (8 for
M = 1).
A further point is a linear condition on c, and no c satisfies it at all points; so N general points cut K in as many
curves as N general linear forms do: deg K. It is what a start set must have: 1442 for nine points, of four-bars
through one place and eight more points with their cognates; 30, 201 and 1112 for M = 4, 3 and 2 poses.

A start set is carried from its points to a general linear section of K, and from there to two parallel ones, where
the last of the forms l(c) = t λ(c) has moved on. The sum of c/λ(c) over a complete section is linear in t; that of a
part of it is not, because a general section's monodromy exchanges its points freely. So the second difference of the
sum over all is zero where they are complete, and not zero where any are missing.

Nothing of the package's trackers is used, only the start sets that it delivers. With probability one, up to rounding.
Source: Sommese, Verschelde and Wampler 2002, SIAM J. Numer. Anal. 40; Leykin, Rodriguez and Sottile 2018, Arnold
Math. J. 4 (trace test).
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from linkwright.synthesis.motion_generation import mixed_poses as counted
from linkwright.synthesis.motion_generation.mixed_poses import KNOWN
from linkwright.synthesis.path_generation.nine_points import start_set

Floats = NDArray[np.float64]
Complexes = NDArray[np.complexfloating]
Flags = NDArray[np.bool_]

#: Places t of parallel sections, of which two that no path is lost to are taken beside 0; what the residual may be;
#: how near curves of one section are the same.
SECTIONS, ENOUGH, SAME = (0.7 + 0.4j, -0.5 + 0.8j, 0.5 - 0.6j, -0.7 - 0.3j, 0.3j, -0.4), 1e-7, 1e-6
TOLERANCE, SMALLEST, LARGEST, MOST_STEPS, WAYS = 1e-3, 1e-12, 0.2, 2000, 8


@dataclass(frozen=True, eq=False)
class Family:
    """Four-bars that take M poses: their displacements d, partners e and coupler's turns g (M - 1,) after the first.

    ``points`` (2, 15): where F is looked at; the start set's N points come first.
    """

    d: Complexes
    e: Complexes
    g: Complexes
    points: Complexes
    count: int

    def poses(self, z: Complexes) -> tuple[Complexes, Complexes]:
        """What both dyads miss of constant length at the poses (K, 2 M - 2), and its slopes by z (K, 2 M - 2, 8)."""
        f = -self.g / (1 + self.g)
        missed, slopes = [], []
        for o in (0, 4):
            x, xc, w, wc = (z[:, o + i, None] for i in range(4))
            m, n = self.d + x * self.g, self.e + xc * f
            slope = np.zeros((len(z), len(self.d), 8), z.dtype)
            slope[:, :, o : o + 4] = np.stack([self.g * (n - wc), f * (m - w), -n, -m], 2)
            missed.append(m * n - m * wc - n * w)
            slopes.append(slope)
        return np.concatenate(missed, 1), np.concatenate(slopes, 1)


def main(arguments: Sequence[str] | None = None) -> int:
    """Prints for each start set the residual of all of it, and the least and middle one with one left out."""
    parser = argparse.ArgumentParser(prog="python -m tests.unit.synthesis.trace_starts", description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    rng = np.random.default_rng(parser.parse_args(arguments).seed)
    return max(shown(name, *start, rng) for name, start in starts(rng))


def starts(rng: np.random.Generator) -> Iterator[tuple[str, tuple[Family, Complexes]]]:
    """Name, family and solutions z (K, 8) of every start set of the package."""
    for poses in sorted(KNOWN, reverse=True):
        places, u = counted.start_set(poses)
        count = 10 - 2 * poses
        points = np.concatenate([[places.d[poses - 1 :], places.e[poses - 1 :]], _general(rng, 2, 15 - count)], 1)
        given = places.d[: poses - 1], places.e[: poses - 1], places.g
        yield f"{poses} poses, {count} points", (Family(*given, points, count), u[:, :8])
    q, u = start_set()
    none: Complexes = np.empty(0, complex)
    yield "nine points", (Family(none, none, none, np.concatenate([q, _general(rng, 2, 7)], 1), 8), u[:, :8])


def shown(name: str, family: Family, z: Complexes, rng: np.random.Generator) -> int:
    """Prints the line of one start set; 0 where it is complete, else 1."""
    begin = time.process_time()
    section, chart = _section(family.count, rng), _general(rng, 15)
    first = general_section(z, family, section, chart, rng)
    sums = second_differences(first, family, section, chart)
    total, single = np.abs(sums.sum(0)).max(), np.sort(np.abs(sums).max(1))
    print(
        f"{name}: {len(z)} in the start set, {len(first)} different curves on the general section; trace residual of "
        f"all {total:.1e}, with one left out {single[0]:.1e} at least, {np.median(single):.1e} in the middle; "
        f"{time.process_time() - begin:.1f} CPU s",
        flush=True,
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
    z: Complexes, family: Family, section: Complexes, chart: Complexes, rng: np.random.Generator
) -> Complexes:
    """The solutions z of the points carried to the general section; lost ones sought along other ways."""
    start: Complexes = np.eye(family.count, 15, dtype=complex)
    ends, arrived = carried(z, family, start, section)
    found = ends[arrived]
    for _ in range(WAYS):
        if len(found) >= len(z):
            break
        middle = _section(family.count, rng)
        ends, arrived = carried(z, family, start, middle)
        ends, arrived = carried(ends[arrived], family, middle, section)
        known, more = (coordinates(found, family.points, chart), coordinates(ends[arrived], family.points, chart))
        new = [np.abs(known - each).max(1).min() > SAME for each in more]
        found = np.concatenate([found, ends[arrived][np.array(new)]])
    return found


def second_differences(first: Complexes, family: Family, section: Complexes, chart: Complexes) -> Complexes:
    """Divided second difference over the parallel sections of each curve's coordinates, (N, 15)."""
    places, at = [coordinates(first, family.points, chart)], [0j]
    for t in SECTIONS:
        moved = section.copy()
        moved[-1] -= t * chart
        ends, arrived = carried(first, family, section, moved)
        if arrived.all():
            places.append(coordinates(ends, family.points, chart))
            at.append(complex(t))
        if len(at) == 3:
            weights = [1 / np.prod([t - other for other in at if other != t]) for t in at]
            return np.asarray(sum(weight * place for weight, place in zip(weights, places, strict=True)))
    raise ArithmeticError("paths were lost on the way to every parallel section")


def coordinates(z: Complexes, points: Complexes, chart: Complexes) -> Complexes:
    """Values of F at the 15 places, which determine the curve, over the chart's linear form; more digits inside."""
    f, _ = curve(z.astype(np.clongdouble), points.astype(np.clongdouble))
    return np.asarray((f / (f @ chart)[:, None]).astype(complex))


def carried(z: Complexes, family: Family, first: Complexes, last: Complexes) -> tuple[Complexes, Flags]:
    """Solutions z (N, 8) of the section ``first`` (N, 15) carried along a straight way to ``last``; which arrived.

    Runge and Kutta's fourth order, two Newton corrections, the step from the first one.
    """
    change = last - first
    ends, arrived = z.copy(), np.zeros(len(z), bool)
    who, t, h = np.arange(len(z)), np.zeros(len(z)), np.full(len(z), 0.02)

    def step(at: Complexes, place: Floats, moving: bool) -> Complexes:
        f, slopes = curve(at, family.points)
        missed, by_z = family.poses(at)
        matrix = first @ slopes + place[:, None, None] * (change @ slopes)
        right = f @ change.T if moving else f @ first.T + place[:, None] * (f @ change.T)
        rest = 0 * missed if moving else missed
        return _solved(np.concatenate([matrix, by_z], 1), -np.concatenate([right, rest], 1))

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


def _section(count: int, rng: np.random.Generator) -> Complexes:
    """General linear forms (count, 15), the first columns made the unit matrix."""
    return np.concatenate([np.eye(count), _general(rng, count, 15 - count)], 1)


def _general(rng: np.random.Generator, *shape: int) -> Complexes:
    return np.asarray(rng.normal(size=shape) + 1j * rng.normal(size=shape))


if __name__ == "__main__":
    raise SystemExit(main())
