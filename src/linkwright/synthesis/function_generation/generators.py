"""Function generators as formulas: the output of K linkages over n inputs, their points and proven extremes.

A generator has free numbers (K, m) and signs of its assembly modes (K, modes); lengths are in units of the frame's,
which a slider-crank has not: there in units of the demanded travel. Every dyad is the intersection of two circles:
B = A + b U with U = D (t + i s √(4 b² D·D - t²)) / (2 b D·D), D = C - A, t = D·D + b² - c².
Where it cannot be assembled the root's negative square measures by how much.

A function that changes by at most L per unit of its argument lies, over an interval of half width h, within L h of
its value in the middle. Intervals that could hold a new extreme are halved until none is left. A dyad of the lengths
b and r can be assembled over a range just where the distance of its ends stays between |b - r| and b + r; its angle,
cos μ = (b² + r² - D²)/(2 b r), is then worst at an extreme of the distance D.
Source: Piyavskii 1972, USSR Comp. Math. Math. Phys. 12.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import ClassVar

import numpy as np

from linkwright.core.arrays import Complexes, Floats
from linkwright.synthesis.linkage import Guide, Linkage
from linkwright.synthesis.path_generation.crank_family import CrankFamily

Points = dict[str, Complexes]

#: Denominator of a gear ratio up to which a geared linkage is tracked until it repeats itself.
MOST_TEETH = 100


@dataclass(frozen=True, eq=False)
class Run:
    """Points of K linkages over n inputs, their outputs, sines of the smallest transmission angle, all (K, n).

    ``missing`` (K, n): how far each position is from being assembled, 0 where it is.
    """

    points: Points
    output: Floats
    sine: Floats
    missing: Floats


class Generator(ABC):
    """A kind of function generator."""

    name: ClassVar[str]
    modes: ClassVar[int] = 1
    output_is_angle: ClassVar[bool] = True

    @abstractmethod
    def sample(self, rng: np.random.Generator, count: int) -> Floats:
        """Random free numbers (count, m)."""

    @abstractmethod
    def run(self, x: Floats, signs: Floats, angles: Floats) -> Run:
        """Points and outputs at input angles (n,)."""

    @abstractmethod
    def sines(self, x: Floats, signs: Floats, low: float, high: float) -> tuple[float, ...]:
        """Minimum sine of every dyad's angle for one linkage (1, m) over an input range, proved; 0: not assembled
        everywhere. Signs never change where none is 0: the linkage stays on its circuit and branch.
        """

    def _distance_squared(self, x: Floats, signs: Floats, first: str, second: str) -> Callable[[Floats], Floats]:
        """Distance of two points as a function of the input angle."""

        def distance(angles: Floats) -> Floats:
            points = self.run(x, signs, angles).points
            return np.asarray(np.abs(points[first][0] - points[second][0]))

        return distance

    def turn(self) -> float:
        """Input angle after which every driven link is back where it was."""
        return 2 * np.pi

    @abstractmethod
    def linkage(self, points: dict[str, complex], turns: bool) -> Linkage:
        """The named linkage in one pose."""


def dyad(a: Complexes, c: Complexes, b: Floats, r: Floats, sign: Floats) -> tuple[Complexes, Floats, Floats]:
    """Joint B (K, n) at b from A and r from C on the ``sign`` side of A→C, sine of its angle, and what is missing."""
    d = c - a
    square = d.real**2 + d.imag**2 + 1e-300
    b, r = b[:, None], r[:, None]
    t = square + b * b - r * r
    inner = 4 * b * b * square - t * t
    root = np.sqrt(np.maximum(inner, 0.0))
    place = a + d * (t + 1j * sign[:, None] * root) / (2 * square)
    missing = np.sqrt(np.maximum(-inner, 0.0)) / (b * r)
    return place, root / (2 * b * r), missing


def _clipped(logarithms: Floats) -> Floats:
    """Lengths from their logarithms."""
    return np.exp(np.clip(logarithms, -9, 9))


def unwrapped(angle: Floats) -> Floats:
    """Angles (K, n) without jumps along n."""
    return np.asarray(np.unwrap(angle, axis=1))


def _cosines(low: float, high: float) -> Floats:
    """Smallest and largest cosine of angles from low to high."""
    turns = np.pi * np.arange(np.ceil(low / np.pi), np.floor(high / np.pi) + 1)
    values = np.cos(np.concatenate([[low, high], turns]))
    return np.array([values.min(), values.max()])


def _of_extremes(distances: Floats, b: float, r: float) -> float:
    """Minimum sine of a dyad's angle whose ends are between these two distances; 0 where it cannot be assembled."""
    cosines = (b * b + r * r - distances**2) / (2 * b * r)
    return float(np.sqrt(np.maximum(1 - cosines**2, 0.0)).min())


class FourBar(Generator):
    """Free numbers: log a, log b, log c, zero angle of the input."""

    name = "four_bar"

    def sample(self, rng: np.random.Generator, count: int) -> Floats:
        return np.column_stack([rng.uniform(-1.6, 1.6, (count, 3)), rng.uniform(0, 2 * np.pi, count)])

    def run(self, x: Floats, signs: Floats, angles: Floats) -> Run:
        a, b, c = np.exp(np.clip(x[:, :3].T, -9, 9))
        pin = a[:, None] * np.exp(1j * (angles + x[:, 3:4]))
        o2 = np.ones_like(pin)
        joint, sine, missing = dyad(pin, o2, b, c, signs[:, 0])
        points = {"O1": 0 * o2, "O2": o2, "A": pin, "B": joint}
        return Run(points, unwrapped(np.angle(joint - o2)), sine, missing)

    def sines(self, x: Floats, signs: Floats, low: float, high: float) -> tuple[float, ...]:
        a, b, c = (float(each) for each in _clipped(x[0, :3]))
        cosines = _cosines(low + x[0, 3], high + x[0, 3])
        return (_of_extremes(np.sqrt(np.maximum(1 + a * a - 2 * a * cosines, 0.0)), b, c),)

    def linkage(self, points: dict[str, complex], turns: bool) -> Linkage:
        links = {"input": ("O1", "A"), "coupler": ("A", "B"), "output": ("O2", "B")}
        return Linkage("four_bar", points, ("O1", "O2"), links, ("input", "O1"))


class TurningFourBar(FourBar):
    """A four-bar whose input turns fully. Free numbers: those of its family (three), zero angle of the input.

    The second sign is positive for double cranks.
    """

    modes = 2

    def __init__(self, transmission: float = 0.0) -> None:
        self.transmission = transmission

    def sample(self, rng: np.random.Generator, count: int) -> Floats:
        free = CrankFamily.random(rng, count, self.transmission)[1]
        return np.column_stack([free, rng.uniform(0, 2 * np.pi, count)])

    def run(self, x: Floats, signs: Floats, angles: Floats) -> Run:
        return super().run(self._plain(x, signs), signs, angles)

    def sines(self, x: Floats, signs: Floats, low: float, high: float) -> tuple[float, ...]:
        return super().sines(self._plain(x, signs), signs, low, high)

    def _plain(self, x: Floats, signs: Floats) -> Floats:
        b, c, d = CrankFamily(signs[:, 1] > 0, self.transmission).lengths(x)
        return np.column_stack([np.log(np.stack([1 / d, b / d, c / d], 1)), x[:, 3]])


class SliderCrank(Generator):
    """Free numbers: log r, log l, offset e, zero angle of the input; the guide along x, output the slider's place."""

    name = "slider_crank"
    output_is_angle = False

    def sample(self, rng: np.random.Generator, count: int) -> Floats:
        lengths = rng.uniform(-1.5, 1.5, (count, 2))
        return np.column_stack([lengths, rng.uniform(-2, 2, count), rng.uniform(0, 2 * np.pi, count)])

    def run(self, x: Floats, signs: Floats, angles: Floats) -> Run:
        r, rod = np.exp(np.clip(x[:, :2].T, -9, 9))
        pin = r[:, None] * np.exp(1j * (angles + x[:, 3:4]))
        height = x[:, 2:3] - pin.imag
        inner = rod[:, None] ** 2 - height**2
        root = np.sqrt(np.maximum(inner, 0.0))
        slide = pin.real + signs[:, :1] * root
        missing = np.sqrt(np.maximum(-inner, 0.0)) / rod[:, None]
        points = {"O1": 0 * pin, "A": pin, "B": slide + 1j * x[:, 2:3]}
        return Run(points, slide, root / rod[:, None], missing)

    def sines(self, x: Floats, signs: Floats, low: float, high: float) -> tuple[float, ...]:
        r, rod = (float(each) for each in _clipped(x[0, :2]))
        start = x[0, 3] - np.pi / 2
        height = np.abs(x[0, 2] - r * _cosines(low + start, high + start)).max() / rod
        return (float(np.sqrt(max(0.0, 1 - height**2))),)

    def linkage(self, points: dict[str, complex], turns: bool) -> Linkage:
        links = {"crank" if turns else "input": ("O1", "A"), "rod": ("A", "B"), "slider": ("B",)}
        guide = Guide("frame", "O1", 0.0, "slider", "B", points["B"].imag - points["O1"].imag)
        forward = "forward" if points["B"].real > points["A"].real else "backward"
        return Linkage(
            "slider_crank",
            points,
            ("O1",),
            links,
            (next(iter(links)), "O1"),
            guides={"guide": guide},
            assembly={"B": forward},
        )


class Watt(Generator):
    """Two four-bars in series; the frame O2–O3 of the second has length 1.

    Free numbers: those of the first, then log of the second's input arm, coupler and output, and the angles of that
    arm on the ternary link and of O2–O3.
    """

    name = "watt"
    modes = 2

    def sample(self, rng: np.random.Generator, count: int) -> Floats:
        first = FourBar().sample(rng, count)
        return np.column_stack([first, rng.uniform(-1.4, 1.4, (count, 3)), rng.uniform(0, 2 * np.pi, (count, 2))])

    def run(self, x: Floats, signs: Floats, angles: Floats) -> Run:
        first = FourBar().run(x[:, :4], signs, angles)
        arm, coupler, output = np.exp(np.clip(x[:, 4:7].T, -9, 9))
        o2, b = first.points["O2"], first.points["B"]
        along = (b - o2) / np.abs(b - o2)
        c = o2 + (arm * np.exp(1j * x[:, 7]))[:, None] * along
        o3 = o2 + np.exp(1j * x[:, 8:9])
        d, sine, missing = dyad(c, o3, coupler, output, signs[:, 1])
        points = first.points | {"O3": o3, "C": c, "D": d}
        both = np.minimum(sine, first.sine)
        return Run(points, unwrapped(np.angle(d - o3)), both, missing + first.missing)

    def sines(self, x: Floats, signs: Floats, low: float, high: float) -> tuple[float, ...]:
        (first,) = FourBar().sines(x, signs, low, high)
        a, _, c, _, arm, coupler, output = (float(each) for each in _clipped(x[0, :7]))
        rate = arm * a / c / max(first, 1e-12)
        distance = self._distance_squared(x, signs, "C", "O3")
        return first, first and minimum_sine(distance, rate, (coupler, output), low, high)

    def linkage(self, points: dict[str, complex], turns: bool) -> Linkage:
        links = {
            "input": ("O1", "A"),
            "coupler": ("A", "B"),
            "ternary": ("O2", "B", "C"),
            "second_coupler": ("C", "D"),
            "output": ("O3", "D"),
        }
        return Linkage("watt", points, ("O1", "O2", "O3"), links, ("input", "O1"))


class Stephenson(Generator):
    """A dyad hung on a coupler point.

    Free numbers: those of the four-bar, then the coupler point (u, v), the pivot O3 (x, y), log of the link P Q and
    of the output O3 Q.
    """

    name = "stephenson"
    modes = 2

    def sample(self, rng: np.random.Generator, count: int) -> Floats:
        first = FourBar().sample(rng, count)
        places = rng.uniform(-2, 2, (count, 4))
        return np.column_stack([first, places, rng.uniform(-1.4, 1.4, (count, 2))])

    def run(self, x: Floats, signs: Floats, angles: Floats) -> Run:
        first = FourBar().run(x[:, :4], signs, angles)
        a, b = first.points["A"], first.points["B"]
        link, output = np.exp(np.clip(x[:, 8:10].T, -9, 9))
        p = a + (x[:, 4] + 1j * x[:, 5])[:, None] * (b - a) / np.abs(b - a)
        o3 = (x[:, 6:7] + 1j * x[:, 7:8]) * np.ones_like(p)
        q, sine, missing = dyad(p, o3, link, output, signs[:, 1])
        points = first.points | {"O3": o3, "P": p, "Q": q}
        both = np.minimum(sine, first.sine)
        return Run(points, unwrapped(np.angle(q - o3)), both, missing + first.missing)

    def sines(self, x: Floats, signs: Floats, low: float, high: float) -> tuple[float, ...]:
        (first,) = FourBar().sines(x, signs, low, high)
        a, b = (float(each) for each in _clipped(x[0, :2]))
        rate = a + float(np.hypot(*x[0, 4:6])) * a / b / max(first, 1e-12)
        link, output = (float(each) for each in _clipped(x[0, 8:10]))
        return first, first and minimum_sine(
            self._distance_squared(x, signs, "P", "O3"), rate, (link, output), low, high
        )

    def linkage(self, points: dict[str, complex], turns: bool) -> Linkage:
        links = {
            "input": ("O1", "A"),
            "coupler": ("A", "B", "P"),
            "rocker": ("O2", "B"),
            "link": ("P", "Q"),
            "output": ("O3", "Q"),
        }
        return Linkage("stephenson", points, ("O1", "O2", "O3"), links, ("input", "O1"))


class GearedFiveBar(Generator):
    """A five-bar O1 A B C O2 whose cranks are geared (ratio given); output is the turn of the link A B.

    Free numbers: log of input crank, link A B, link B C and geared crank, zero angles of both cranks.
    """

    name = "geared_five_bar"

    def __init__(self, ratio: float = -1.0) -> None:
        self.ratio = ratio

    def sample(self, rng: np.random.Generator, count: int) -> Floats:
        return np.column_stack([rng.uniform(-1.6, 1.0, (count, 4)), rng.uniform(0, 2 * np.pi, (count, 2))])

    def run(self, x: Floats, signs: Floats, angles: Floats) -> Run:
        crank, first, second, geared = np.exp(np.clip(x[:, :4].T, -9, 9))
        a = crank[:, None] * np.exp(1j * (angles + x[:, 4:5]))
        o2 = np.ones_like(a)
        c = o2 + geared[:, None] * np.exp(1j * (self.ratio * angles + x[:, 5:6]))
        b, sine, missing = dyad(a, c, first, second, signs[:, 0])
        points = {"O1": 0 * o2, "O2": o2, "A": a, "B": b, "C": c}
        return Run(points, unwrapped(np.angle(b - a)), sine, missing)

    def sines(self, x: Floats, signs: Floats, low: float, high: float) -> tuple[float, ...]:
        crank, first, second, geared = (float(each) for each in _clipped(x[0, :4]))
        rate = crank + abs(self.ratio) * geared
        return (minimum_sine(self._distance_squared(x, signs, "A", "C"), rate, (first, second), low, high),)

    def turn(self) -> float:
        return 2 * np.pi * Fraction(self.ratio).limit_denominator(MOST_TEETH).denominator

    def linkage(self, points: dict[str, complex], turns: bool) -> Linkage:
        links = {"crank": ("O1", "A"), "output": ("A", "B"), "link": ("B", "C"), "geared_crank": ("O2", "C")}
        second = ("geared_crank", "O2", self.ratio)
        return Linkage("geared_five_bar", points, ("O1", "O2"), links, ("crank", "O1"), second=second)


KINDS: dict[str, type[Generator]] = {
    each.name: each for each in (FourBar, SliderCrank, Watt, Stephenson, GearedFiveBar)
}


#: Intervals at first, and evaluations after which a range is abandoned.
FIRST, MOST = 256, 400_000
#: What is shown of a distance, in units of the dyad's lengths.
WITHIN = 1e-7


def extremes(
    function: Callable[[Floats], Floats], rate: float, low: float, high: float, within: float
) -> tuple[float, float] | None:
    """Smallest and largest value over [low, high], no value beyond them by more than ``within``; None: not proved.

    ``rate``: a bound of the function's derivative; ``function`` takes and gives (n,).
    """
    edges = np.linspace(low, high, FIRST + 1)
    middle, half = 0.5 * (edges[1:] + edges[:-1]), 0.5 * (high - low) / FIRST
    ends = function(np.array([low, high]))
    smallest, largest, count = float(ends.min()), float(ends.max()), 0
    while len(middle):
        value = function(middle)
        count += len(value)
        if not np.isfinite(value).all() or count > MOST:
            return None
        smallest, largest = min(smallest, float(value.min())), max(largest, float(value.max()))
        open_ = (value - rate * half < smallest - within) | (value + rate * half > largest + within)
        half = 0.5 * half
        middle = np.concatenate([middle[open_] - half, middle[open_] + half])
    return smallest, largest


def minimum_sine(
    distance: Callable[[Floats], Floats], rate: float, lengths: tuple[float, float], low: float, high: float
) -> float:
    """Minimum sine of a dyad's angle over a range of the input; 0 where it is not shown to be assembled everywhere.

    ``distance``: of its two ends (m) at inputs (n,), which changes by at most ``rate``; ``lengths``: b and r.
    """
    b, r = lengths
    within = WITHIN * (b + r)
    found = extremes(distance, rate, low, high, within)
    if found is None or found[0] - within <= abs(b - r) or found[1] + within >= b + r:
        return 0.0
    cosines = [(b * b + r * r - each * each) / (2 * b * r) for each in found]
    return min(math.sqrt(max(0.0, 1 - each * each)) for each in cosines)
