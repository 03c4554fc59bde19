"""The elastic line of a straight beam: exact polynomials between all points where something changes.

Stiffness method with the exact nodal loads of polynomial line loads, so that nodal values are exact for piecewise
constant EI (Przemieniecki, Theory of Matrix Structural Analysis, ch. 5); between nodes V, M, slope and deflection
follow by integration of the load. At the end: its equations and polynomials as they are written on a line.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.core.search import first_largest
from linkwright.core.table import ROUNDING
from linkwright.equations.steps import Step
from linkwright.parts.base import signed

#: A value below this share of the largest along the beam is zero but for rounding.
NEGLIGIBLE = 1e-13


@dataclass(frozen=True)
class SupportCondition:
    """What holds the beam at ``x``: the deflection and the slope, rigidly (``settlement`` m) or by springs."""

    x: float
    deflection: bool = False
    slope: bool = False
    settlement: float = 0.0
    stiffness: float = 0.0
    torsional_stiffness: float = 0.0


@dataclass(frozen=True)
class Point:
    """A force (N, up) and a couple (N·m, counter-clockwise) at ``x``."""

    x: float
    force: float = 0.0
    couple: float = 0.0


@dataclass(frozen=True)
class DistributedLoad:
    """A line load (N/m, up) from ``start`` to ``end``, linear from ``first`` to ``last``."""

    start: float
    end: float
    first: float
    last: float


@dataclass(frozen=True)
class Segment:
    """The elastic line from ``start`` to ``end``, each quantity a polynomial in ξ = x − start, SI."""

    start: float
    end: float
    rigidity: float
    load: Polynomial
    shear: Polynomial
    moment: Polynomial
    slope: Polynomial
    deflection: Polynomial


@dataclass(frozen=True)
class ElasticLine:
    """Segments from left to right, and the reaction (N, N·m) of every support in their order."""

    segments: tuple[Segment, ...]
    reactions: tuple[tuple[float, float], ...]

    def value(self, quantity: str, x: ArrayLike, side: str = "right") -> Floats:
        """``load``, ``shear``, ``moment``, ``slope`` or ``deflection`` at places x (n,), on one side of jumps."""
        places = np.atleast_1d(np.asarray(x, dtype=float))
        starts = np.array([segment.start for segment in self.segments])
        indices = np.searchsorted(starts, places, side="right" if side == "right" else "left") - 1
        indices = np.clip(indices, 0, len(self.segments) - 1)
        found = np.empty(len(places))
        for i, segment in enumerate(self.segments):
            here = indices == i
            found[here] = getattr(segment, quantity)(places[here] - segment.start)
        largest = max(abs(value) for _, value in self.extremes(quantity))
        return np.where(np.abs(found) <= NEGLIGIBLE * largest, 0.0, found)

    def extremes(self, quantity: str) -> tuple[tuple[float, float], tuple[float, float]]:
        """Place and value of the minimum and of the maximum of a quantity, exact."""
        places, values = [], []
        for segment in self.segments:
            polynomial: Polynomial = getattr(segment, quantity)
            length = segment.end - segment.start
            candidates = sorted([0.0, length, *_roots_within(polynomial.deriv(), length)])
            places += [segment.start + xi for xi in candidates]
            values += [float(polynomial(xi)) for xi in candidates]
        rounding = NEGLIGIBLE * max(abs(value) for value in values)
        values = [0.0 if abs(value) <= rounding else value for value in values]
        low, high = first_largest(-np.array(values)), first_largest(np.array(values))
        return (places[low], values[low]), (places[high], values[high])


def _roots_within(polynomial: Polynomial, length: float) -> list[float]:
    """Real roots between 0 and a length."""
    coefficients = polynomial(Polynomial([0.0, length])).coef if polynomial.degree() else polynomial.coef
    size = np.abs(coefficients).max()
    if size == 0.0 or len(coefficients) < 2:
        return []
    trimmed = np.trim_zeros(np.where(np.abs(coefficients) < 1e-14 * size, 0.0, coefficients), "b")
    roots = np.polynomial.polynomial.polyroots(trimmed) if len(trimmed) > 1 else np.zeros(0)
    real = roots.real[np.abs(roots.imag) < 1e-7]
    return [float(u) * length for u in real if 0.0 < u < 1.0]


def free_motions(length: float, holds: Sequence[SupportCondition], hinges: Sequence[float]) -> Floats:
    """Motions without bending that the holds leave: rows of (w at 0 over length, slope at 0, kink of every hinge)."""
    rows = []
    for hold in holds:
        kinks = [max(hold.x - hinge, 0.0) / length for hinge in hinges]
        if hold.deflection or hold.stiffness:
            rows.append([1.0, hold.x / length, *kinks])
        if hold.slope or hold.torsional_stiffness:
            rows.append([0.0, 1.0, *[float(hold.x > hinge) for hinge in hinges]])
    if not rows:
        return np.eye(2 + len(hinges))
    _, values, space = np.linalg.svd(np.array(rows))
    return np.asarray(space[int((values > 1e-10 * values[0]).sum()) :])


def solve_line(
    length: float,
    rigidity: Sequence[tuple[float, float]],
    holds: Sequence[SupportCondition],
    points: Sequence[Point],
    spreads: Sequence[DistributedLoad],
    hinges: Sequence[float] = (),
) -> ElasticLine:
    """The elastic line of a beam that cannot move (:func:`free_motions` has no rows).

    ``rigidity``: pairs (from, EI N·m²), the first from 0. Works in units of the length and of the largest EI.
    """
    unit = max(each for _, each in rigidity)
    force = unit / length**2
    nodes = _nodes(length, rigidity, holds, points, spreads, hinges)
    pieces = []
    for a, b in pairwise(nodes):
        stiffness = next(value for start, value in reversed(list(rigidity)) if start <= a + 1e-12 * length)
        pieces.append((stiffness / unit, _load_on(a, b, spreads, length) * (length / force), (b - a) / length))
    dofs, count = _numbering(nodes, hinges, length)
    matrix, right = np.zeros((count, count)), np.zeros(count)
    for e, (stiffness, load, h) in enumerate(pieces):
        index = [dofs[e][0], dofs[e][2], dofs[e + 1][0], dofs[e + 1][1]]
        matrix[np.ix_(index, index)] += _element(stiffness, h)
        right[index] += _nodal(load, h)
    where = {x: i for i, x in enumerate(nodes)}
    for point in points:
        i = where[_nearest(nodes, point.x)]
        right[dofs[i][0]] += point.force / force
        right[dofs[i][1]] += point.couple / (force * length)
    held: dict[int, float] = {}
    places = [where[_nearest(nodes, hold.x)] for hold in holds]
    for hold, i in zip(holds, places, strict=True):
        matrix[dofs[i][0], dofs[i][0]] += hold.stiffness * length / force
        matrix[dofs[i][1], dofs[i][1]] += hold.torsional_stiffness / (force * length)
        if hold.deflection:
            held[dofs[i][0]] = hold.settlement / length
        if hold.slope:
            held |= dict.fromkeys((dofs[i][1], dofs[i][2]), 0.0)
    moved = _solved(matrix, right, held)
    reactions = matrix @ moved - right
    found = [_reaction(hold, dofs[i], reactions, moved, force, length) for hold, i in zip(holds, places, strict=True)]
    segments = [
        _segment(
            nodes[e],
            nodes[e + 1],
            piece,
            moved[[dofs[e][0], dofs[e][2], dofs[e + 1][0], dofs[e + 1][1]]],
            length,
            unit,
        )
        for e, piece in enumerate(pieces)
    ]
    return ElasticLine(tuple(segments), tuple(found))


def _reaction(
    hold: SupportCondition, dofs: Sequence[int], rigid: Floats, moved: Floats, force: float, length: float
) -> tuple[float, float]:
    """Force, N, and couple, N·m, of a hold: those of what is held rigidly, else of its springs."""
    deflection, left, right = dofs
    up = rigid[deflection] if hold.deflection else -hold.stiffness * moved[deflection] * length / force
    if not hold.slope:
        turn = -hold.torsional_stiffness * moved[left] / force / length
    else:
        turn = rigid[left] + (rigid[right] if left != right else 0.0)
    return float(up) * force, float(turn) * force * length


def _nodes(
    length: float,
    rigidity: Sequence[tuple[float, float]],
    holds: Sequence[SupportCondition],
    points: Sequence[Point],
    spreads: Sequence[DistributedLoad],
    hinges: Sequence[float],
) -> list[float]:
    places = [0.0, length, *hinges, *(start for start, _ in rigidity), *(each.x for each in holds)]
    places += [each.x for each in points] + [x for each in spreads for x in (each.start, each.end)]
    found: list[float] = []
    for x in sorted(places):
        if not found or x - found[-1] > 1e-9 * length:
            found.append(x)
    return found


def _nearest(nodes: Sequence[float], x: float) -> float:
    return min(nodes, key=lambda node: abs(node - x))


def _numbering(nodes: Sequence[float], hinges: Sequence[float], length: float) -> tuple[list[list[int]], int]:
    """Numbers of w, slope on the left and slope on the right at every node; the slopes differ at hinges."""
    found, count = [], 0
    for x in nodes:
        split = any(abs(x - hinge) <= 1e-9 * length for hinge in hinges)
        found.append([count, count + 1, count + 1 + split])
        count += 2 + split
    return found, count


def _load_on(a: float, b: float, spreads: Sequence[DistributedLoad], length: float) -> Polynomial:
    """Line load over ξ/length from a to b, N/m."""
    total = Polynomial([0.0])
    for each in spreads:
        if each.start < (a + b) / 2 < each.end:
            rate = (each.last - each.first) / (each.end - each.start)
            total = total + Polynomial([each.first + rate * (a - each.start), rate * length])
    return total


def _element(stiffness: float, h: float) -> Floats:
    """Stiffness of a piece for w and slope at both ends."""
    k = stiffness / h**3
    rows = [
        [12, 6 * h, -12, 6 * h],
        [6 * h, 4 * h * h, -6 * h, 2 * h * h],
        [-12, -6 * h, 12, -6 * h],
        [6 * h, 2 * h * h, -6 * h, 4 * h * h],
    ]
    return k * np.array(rows)


def _nodal(load: Polynomial, h: float) -> Floats:
    """Nodal loads of equal work: ∫ N q dξ with the cubic shape functions."""
    u = Polynomial([0.0, 1.0 / h])
    shapes = (1 - 3 * u**2 + 2 * u**3, h * (u - 2 * u**2 + u**3), 3 * u**2 - 2 * u**3, h * (u**3 - u**2))
    return np.array([float((shape * load).integ()(h)) for shape in shapes])


def _solved(matrix: Floats, right: Floats, held: dict[int, float]) -> Floats:
    moved = np.zeros(len(right))
    for index, value in held.items():
        moved[index] = value
    free = [i for i in range(len(right)) if i not in held]
    if free:
        inner = matrix[np.ix_(free, free)]
        moved[free] = np.linalg.solve(inner, right[free] - matrix[free] @ moved)
    return moved


def _segment(
    a: float, b: float, piece: tuple[float, Polynomial, float], ends: Floats, length: float, unit: float
) -> Segment:
    """Polynomials of one piece from its end displacements, back in SI."""
    stiffness, load, h = piece
    forces = _element(stiffness, h) @ ends - _nodal(load, h)
    shear = load.integ(k=forces[0])
    moment = shear.integ(k=-forces[1])
    slope = (moment / stiffness).integ(k=ends[1])
    deflection = slope.integ(k=ends[0])
    force = unit / length**2
    scale = Polynomial([0.0, 1.0 / length])
    return Segment(
        a,
        b,
        stiffness * unit,
        load(scale) * (force / length),
        shear(scale) * force,
        moment(scale) * (force * length),
        slope(scale),
        deflection(scale) * length,
    )


def balance_laws(
    step: Step,
    supports: Mapping[str, SupportCondition],
    length: float,
    points: Sequence[Point],
    spreads: Sequence[DistributedLoad],
) -> None:
    """ΣF = 0 and ΣM = 0 about the first support, the reactions as unknowns."""
    own = supports.items()
    about = next(iter(supports.values())).x
    bearing = [(name, each) for name, each in own if each.deflection or not each.slope]
    forces = [(1.0, f"{name}.F") for name, _ in bearing]
    moments = [(each.x - about, f"{name}.F") for name, each in bearing if abs(each.x - about) > ROUNDING * length]
    moments += [(1.0, f"{name}.M") for name, each in own if each.slope or each.torsional_stiffness]
    known = [p.force for p in points] + [(s.first + s.last) / 2 * (s.end - s.start) for s in spreads]
    turning = [p.couple + p.force * (p.x - about) for p in points]
    turning += [line_moment(s) - about * (s.first + s.last) / 2 * (s.end - s.start) for s in spreads]
    for name, unknown, parts in (("ΣF", forces, known), ("ΣM", moments, turning)):
        left = " ".join(
            f"{'+' if c > 0 else '−'} {'' if abs(c) == 1.0 else f'{abs(c):.6g}·'}{each}" for c, each in unknown
        ).removeprefix("+ ")
        rest = signed(parts)
        rest = "" if rest == "0" else f" − {rest[1:]}" if rest[0] == "−" else f" + {rest}"
        if left:
            step.law(f"{name} = {left}{rest} = 0")


def polynomial_text(coefficients: Sequence[float] | Floats, largest: float, length: float) -> str:
    """A polynomial in ξ, terms that are nothing but rounding left out."""
    text = ""
    for power, c in enumerate(coefficients):
        if abs(c) * length**power <= 1e-12 * largest or c == 0.0:
            continue
        mark = (" − " if c < 0 else " + ") if text else ("−" if c < 0 else "")
        unknown = "" if power == 0 else "·ξ" if power == 1 else f"·ξ{'²³⁴⁵'[power - 2]}"
        text += f"{mark}{abs(c):.6g}{unknown}"
    return text or "0"


def line_moment(spread: DistributedLoad) -> float:
    """Moment of a line load about x = 0."""
    a, b = spread.start, spread.end
    rate = (spread.last - spread.first) / (b - a)
    return (spread.first - rate * a) * (b * b - a * a) / 2 + rate * (b**3 - a**3) / 3


def rounded(parts: Sequence[float]) -> float:
    total = math.fsum(parts)
    return 0.0 if abs(total) < 1e-9 * max((abs(p) for p in parts), default=0.0) else total
