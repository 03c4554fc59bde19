"""Linkages and candidates from solved numbers, with what a designer must know: type, defects, transmission angle.

All functions take many linkages at once. Positions are complex numbers (x + iy, m): pivots (N,), moving pins at the
n demanded positions (N, n). The input link turns about O1.

Type: Grashof 1883, s + l < p + q. Input range: the diagonal A–O2 of a four-bar lies between |b - c| and b + c, so

    cos θ_min,max = (a² + d² - (b ± c)²) / (2 a d),    θ from the line O1→O2;

of a slider-crank |a sin θ - e| ≤ b, θ from the guide. Positions on one *circuit* can be reached without
dismantling; on one *branch* of it without passing a dead point of the input (sign of the sine of the transmission
angle); they are in *order* where an input that turns one way meets them as they are numbered.
Source: Chase and Mirth 1993, "Circuits and branches of single-degree-of-freedom planar linkages", J. Mech. Des. 115.
"""

from __future__ import annotations

import cmath
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkwright.core.arrays import Complexes, Flags, Floats, Integers
from linkwright.synthesis.linkage import Guide, Linkage
from linkwright.synthesis.result import Candidate

#: Positions this near to a dead point, relative to the lengths, may lie on either branch.
EQUAL = 1e-9
TYPES = (
    "crank_rocker",
    "rocker_crank",
    "double_crank",
    "double_rocker",
    "triple_rocker",
    "change_point",
    "slider_crank",
    "slider_rocker",
)
FULL, NEAR_ZERO, NEAR_PI, PAIR, NOWHERE = range(5)


@dataclass(frozen=True, eq=False)
class Assessment:
    """Facts about N linkages, arrays (N,).

    ``kind``: index into TYPES; ``turns``: the input link turns fully; ``order``, ``branch``, ``circuit``: defects;
    ``transmission``: smallest transmission angle over a turn of the input, or between its first and last position
    where it does not turn (rad); ``ratio``: longest to shortest link; ``longest``: the longest of these links (m);
    ``first``, ``last``: input angles of that range from the line O1→O2 or the guide (rad).
    """

    kind: Integers
    turns: Flags
    order: Flags
    branch: Flags
    circuit: Flags
    transmission: Floats
    ratio: Floats
    longest: Floats
    first: Floats
    last: Floats

    @property
    def sound(self) -> Flags:
        """Linkages without any defect."""
        return np.asarray(~(self.order | self.branch | self.circuit))

    def defects(self, index: int) -> tuple[str, ...]:
        """Words of the defects of one linkage."""
        return tuple(name for name in ("circuit", "branch", "order") if getattr(self, name)[index])


def assess_four_bars(o1: Complexes, a: Complexes, b: Complexes, o2: Complexes) -> Assessment:
    """Facts about four-bars O1 A B O2 whose pins A and B have n positions (N, n)."""
    frame = o2 - o1
    lengths = np.stack([np.abs(a[:, 0] - o1), np.abs(b[:, 0] - a[:, 0]), np.abs(b[:, 0] - o2), np.abs(frame)])
    kind = grashof_types(lengths)
    place = four_bar_range(lengths)[2]
    theta = np.angle((a - o1[:, None]) / frame[:, None])
    to_pivot, along = o2[:, None] - a, b - a
    sine, size = (to_pivot.conj() * along).imag, np.abs(to_pivot) * np.abs(along)
    branch = _sign(sine, size)
    rocking = (place == PAIR)[:, None]
    circuit = np.where(
        (place == FULL)[:, None], branch, np.where(rocking, _sign(np.sin(theta), np.ones_like(theta)), 0)
    )
    first, last, order = _working_range(theta, place)
    extremes = _cosines(first, last, np.pi * np.arange(-3, 4))
    square = lengths[0] ** 2 + lengths[3] ** 2 - 2 * lengths[0] * lengths[3] * extremes
    cosine = (lengths[1] ** 2 + lengths[2] ** 2 - square) / (2 * lengths[1] * lengths[2])
    transmission = np.arccos(np.clip(np.nanmax(np.abs(cosine), 0), 0, 1))
    ends = lengths.min(0), lengths.max(0)
    return _assessment(kind, place, order, branch, circuit, transmission, ends, first, last)


def assess_slider_cranks(
    o1: Complexes, a: Complexes, b: Complexes, direction: Complexes, offset: Floats
) -> Assessment:
    """Facts about slider-cranks O1 A B; the guide of B has a unit ``direction``, ``offset`` (m) left of O1."""
    crank, rod = np.abs(a[:, 0] - o1), np.abs(b[:, 0] - a[:, 0])
    place = slider_range(crank, rod, offset)
    theta = np.angle((a - o1[:, None]) / direction[:, None])
    branch = _sign(((b - a) * direction.conj()[:, None]).real, np.abs(b - a))
    circuit = np.where(
        (place == FULL)[:, None],
        branch,
        np.where((place == PAIR)[:, None], _sign(np.cos(theta), np.ones_like(theta)), 0),
    )
    shifted = np.angle(np.exp(1j * theta) * np.where(offset < 0, 1j, -1j)[:, None])
    upright = np.where(place == PAIR, PAIR, np.where(place == FULL, FULL, NEAR_ZERO))
    first, last, order = _working_range(np.where((place == FULL)[:, None], theta, shifted), upright)
    middle = np.where(place == FULL, 0.0, np.where(offset < 0, -np.pi / 2, np.pi / 2))
    first, last = first + middle, last + middle
    sines = _cosines(first - np.pi / 2, last - np.pi / 2, np.pi * np.arange(-3, 4))
    height = np.abs(crank * sines - offset) / rod
    transmission = np.arccos(np.clip(np.nanmax(height, 0), 0, 1))
    kind = np.where(place == FULL, TYPES.index("slider_crank"), TYPES.index("slider_rocker"))
    ends = np.minimum(crank, rod), np.maximum(crank, rod)
    return _assessment(kind, place, order, branch, circuit, transmission, ends, first, last)


def grashof_types(lengths: Floats) -> Integers:
    """Index into TYPES for lengths (4, N) of input, coupler, output, frame."""
    ordered = np.sort(lengths, axis=0)
    margin = ordered[1] + ordered[2] - ordered[0] - ordered[3]
    names = ("crank_rocker", "double_rocker", "rocker_crank", "double_crank")
    kind = np.array([TYPES.index(name) for name in names])[lengths.argmin(0)]
    kind = np.where(margin < 0, TYPES.index("triple_rocker"), kind)
    return np.where(np.abs(margin) <= 1e-12 * ordered[3], TYPES.index("change_point"), kind)


def four_bar_range(lengths: Floats) -> tuple[Floats, Floats, Integers]:
    """Smallest and largest cosine of the input angle of four-bars (4, N), and where the input's range lies."""
    a, b, c, d = lengths
    low = (a * a + d * d - (b + c) ** 2) / (2 * a * d)
    high = (a * a + d * d - (b - c) ** 2) / (2 * a * d)
    return low, high, _place(low, high)


def slider_range(crank: Floats, rod: Floats, offset: Floats) -> Integers:
    """Where the input's range of slider-cranks lies: the full turn, both sides of the guide, or one side."""
    low, high = (np.abs(offset) - rod) / crank, (np.abs(offset) + rod) / crank
    return _place(low, high)


def _place(low: Floats, high: Floats) -> Integers:
    from_minus, to_plus = low <= -1 + 1e-14, high >= 1 - 1e-14
    place = np.where(from_minus, np.where(to_plus, FULL, NEAR_PI), np.where(to_plus, NEAR_ZERO, PAIR))
    return np.where((low > 1) | (high < -1), NOWHERE, place)


def _working_range(theta: Floats, place: Integers) -> tuple[Floats, Floats, Flags]:
    """First and last input angle, (N,), and whether the positions are not in order, (N,)."""
    near_pi = np.mod(theta, 2 * np.pi)
    signed = np.where((place == NEAR_PI)[:, None], near_pi, theta)
    pair_low = np.where(theta < 0, -theta, theta)
    steps = np.diff(signed, axis=1)
    tiny = 1e-9
    rocking = (steps > -tiny).all(1) | (steps < tiny).all(1)
    forward = np.mod(np.diff(theta, axis=1) + tiny, 2 * np.pi).sum(1)
    backward = np.mod(tiny - np.diff(theta, axis=1), 2 * np.pi).sum(1)
    turning = np.minimum(forward, backward) < 2 * np.pi + theta.shape[1] * tiny
    full = place == FULL
    first = np.where(full, 0.0, np.where(place == PAIR, np.sign(theta[:, 0]) * pair_low.min(1), signed.min(1)))
    last = np.where(full, 2 * np.pi, np.where(place == PAIR, np.sign(theta[:, 0]) * pair_low.max(1), signed.max(1)))
    return np.minimum(first, last), np.maximum(first, last), ~np.where(full, turning, rocking)


def _cosines(first: Floats, last: Floats, special: NDArray[np.floating[Any]]) -> Floats:
    """Cosines at the ends of the ranges and at the special angles inside, (k, N)."""
    inside = (special[:, None] >= first) & (special[:, None] <= last)
    middle = np.where(inside, np.cos(special)[:, None], np.nan)
    return np.concatenate([np.cos(first)[None], np.cos(last)[None], middle])


def _assessment(
    kind: Integers,
    place: Integers,
    order: Flags,
    branch: Integers,
    circuit: Integers,
    transmission: Floats,
    ends: tuple[Floats, Floats],
    first: Floats,
    last: Floats,
) -> Assessment:
    off_circuit, off_branch = _differs(circuit), _differs(branch)
    shortest, longest = ends
    return Assessment(
        kind,
        place == FULL,
        order,
        off_branch & ~off_circuit,
        off_circuit,
        transmission,
        longest / np.maximum(shortest, 1e-300),
        longest,
        first,
        last,
    )


def _differs(sign: Integers) -> Flags:
    """Whether both signs occur; 0 fits both."""
    return np.asarray((sign.max(1) > 0) & (sign.min(1) < 0))


def _sign(value: Floats, size: Floats) -> Integers:
    return np.where(np.abs(value) <= EQUAL * size, 0, np.sign(value)).astype(np.int64)


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
