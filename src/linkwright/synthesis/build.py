"""From solved numbers to named linkages and candidates."""

from __future__ import annotations

import cmath
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from linkwright.core.arrays import Complexes
from linkwright.synthesis.assessment import TYPES, Assessment
from linkwright.synthesis.linkage import Guide, Linkage
from linkwright.synthesis.result import Candidate

NAMES = {
    "crank_rocker": ("crank", "rocker"),
    "double_crank": ("crank", "follower"),
    "rocker_crank": ("rocker", "crank"),
}


def four_bar(
    o1: complex,
    a: complex,
    b: complex,
    o2: complex,
    p: complex | None = None,
    *,
    kind: str = "",
    span: tuple[float, float] | None = None,
) -> Linkage:
    """A four-bar O1 A B O2 with an optional coupler point P, in the pose of these points; O1A is the input."""
    first, second = NAMES.get(kind, ("input", "output"))
    points = {"O1": o1, "O2": o2, "A": a, "B": b} | ({} if p is None else {"P": p})
    coupler = ("A", "B") if p is None else ("A", "B", "P")
    side = ((o2 - a).conjugate() * (b - a)).imag
    return Linkage(
        "four_bar",
        {name: complex(place) for name, place in points.items()},
        ("O1", "O2"),
        {first: ("O1", "A"), "coupler": coupler, second: ("O2", "B")},
        (first, "O1"),
        assembly={"B": "left" if side > 0 else "right"},
        span=span,
    )


def slider_crank(
    o1: complex,
    a: complex,
    b: complex,
    direction: complex,
    p: complex | None = None,
    *,
    span: tuple[float, float] | None = None,
    turns: bool = True,
) -> Linkage:
    """A slider-crank O1 A B with an optional coupler point P; the guide passes B along ``direction``."""
    unit = direction / abs(direction)
    forward = ((b - a) * unit.conjugate()).real >= 0
    offset = ((b - o1) * unit.conjugate()).imag
    points = {"O1": o1, "A": a, "B": b} | ({} if p is None else {"P": p})
    first = "crank" if turns else "input"
    return Linkage(
        "slider_crank",
        {name: complex(place) for name, place in points.items()},
        ("O1",),
        {first: ("O1", "A"), "rod": ("A", "B") if p is None else ("A", "B", "P"), "slider": ("B",)},
        (first, "O1"),
        guides={"guide": Guide("frame", "O1", cmath.phase(unit), "slider", "B", offset)},
        assembly={"B": "forward" if forward else "backward"},
        span=span,
    )


def working_span(facts: Assessment, index: int, base: float) -> tuple[float, float] | None:
    """First and last input angle in frame axes where the input does not turn fully; ``base``: angle of O1→O2."""
    if facts.turns[index] or facts.last[index] - facts.first[index] < 1e-6:
        return None
    return float(facts.first[index]) + base, float(facts.last[index]) + base


def candidate(
    linkage: Linkage,
    facts: Assessment,
    index: int,
    error: float,
    *,
    worst: float = 0.0,
    curve: NDArray[np.generic] | None = None,
    values: Mapping[str, float] | None = None,
    positions: Mapping[str, Complexes] | None = None,
) -> Candidate:
    """A candidate from one row of an assessment."""
    return Candidate(
        linkage,
        float(error),
        TYPES[int(facts.kind[index])],
        facts.defects(index),
        bool(facts.turns[index]),
        float(facts.transmission[index]),
        float(facts.ratio[index]),
        float(worst),
        curve,
        values or {},
        positions or {},
    )


def four_bar_candidate(
    o1: complex,
    a: Complexes,
    b: Complexes,
    o2: complex,
    facts: Assessment,
    index: int,
    error: float,
    *,
    p: complex | None = None,
    worst: float = 0.0,
    curve: NDArray[np.generic] | None = None,
    values: Mapping[str, float] | None = None,
    path: Complexes | None = None,
) -> Candidate:
    """A candidate from pivots and the positions (n,) of its moving pins; the first position is the pose.

    ``path``: the positions (n,) of the coupler point, where it has one.
    """
    span = working_span(facts, index, cmath.phase(o2 - o1))
    kind = TYPES[int(facts.kind[index])]
    linkage = four_bar(o1, complex(a[0]), complex(b[0]), o2, p, kind=kind, span=span)
    positions = {"A": a, "B": b} | ({} if path is None else {"P": path})
    return candidate(linkage, facts, index, error, worst=worst, curve=curve, values=values, positions=positions)


def path_of_four_bar(o1: complex, a: complex, b: complex, o2: complex, p: complex) -> Complexes:
    """Path of P over a turn of O1A on the circuit of the pose, closed; NaN where it cannot be assembled."""
    theta = np.linspace(0, 2 * np.pi, 361)
    pin = o1 + (a - o1) * np.exp(1j * theta)
    coupler = coupler_unit(pin, abs(b - a), abs(b - o2), o2, ((o2 - a).conjugate() * (b - a)).imag)
    return np.asarray(pin + (p - a) / ((b - a) / abs(b - a)) * coupler)


def coupler_unit(a: Complexes, coupler: float, output: float, o2: complex, side: float) -> Complexes:
    """Unit vector from A to B where B lies ``side`` (sign) of the ray A→O2; NaN where there is none.

    With D = O2 - A and t = D·D + b² - c²: u = D (t + i s √(4 b² D·D - t²)) / (2 b D·D).
    """
    d = o2 - a
    square = d.real**2 + d.imag**2
    t = square + coupler**2 - output**2
    with np.errstate(invalid="ignore"):
        root = np.sqrt(4 * coupler**2 * square - t * t)
    return np.asarray(d * (t + 1j * np.sign(side) * root) / (2 * coupler * square))
