"""One assembly followed along a way of the drivers, step by step, with a proof where one can be had.

A step is predicted with the exact rates, corrected by Newton's method, and certified
(:mod:`linkwright.kinematics.certificate`); where the certificate fails it is cut. The steps are as long as the proof
allows, whatever positions are asked for: those within a step are read from its cubic and corrected inside its tube.
Below :data:`FLOOR` a step is followed if the determinant keeps its sign, the correction is small against the step
and the exact rates at both ends fit each other; else the way ends there.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import field

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.dataclass import dataclass
from linkwright.drivers.base import Law
from linkwright.kinematics.certificate import REFUSED, Certificate, End, certify, cubic
from linkwright.kinematics.closed_loops import ClosedLoops

Drive = Callable[[Floats], tuple[Floats, Floats, Floats]]

#: Parts of the time of a way at which laws that are no straight lines are compared with their cubics.
CHECKS = 720
#: Longest and shortest step of a driver, rad or share of the mechanism's size.
LONGEST, FLOOR = 0.5, 1e-7
#: A certified step aims at this contraction.
WANTED = 0.5
#: Tries after which the rest of a way is only followed.
PATIENCE = 6000
#: Largest correction, and largest misfit of both ends' rates, as share of the step.
CORRECTION, MISFIT = 0.1, 0.01


@dataclass(frozen=True)
class Way:
    """A way of the drivers: ``drive`` gives their coordinates (m, d) with two derivatives at places x (m,).

    ``places`` (k,), rising: where positions are asked for. ``checks``: further places at which the drivers are
    compared with the step's cubic, for laws that are no straight lines. ``pace``: the largest rate of a driver,
    rad or shares of the size per unit of x.
    """

    drive: Drive
    start: float
    end: float
    places: Floats
    pace: float
    checks: Floats = field(default_factory=lambda: np.zeros(0))


@dataclass(frozen=True)
class Branch:
    """What was found: coordinates (k, n + d) at the places of a way as far as it goes, which of them are certified.

    ``reached``: the place to which it goes; ``last``: the coordinates there; ``complete``: whether that is the end.
    """

    found: Floats
    certified: Flags
    reached: float
    last: Floats
    complete: bool


def follow(loops: ClosedLoops, way: Way, start: Floats) -> Branch:
    """Follows the assembly of the unknowns ``start`` (n,) at the beginning of a way."""
    return _Walk(loops, way, start).branch()


class _Walk:
    def __init__(self, loops: ClosedLoops, way: Way, start: Floats) -> None:
        self.loops, self.way = loops, way
        self.pace = max(way.pace, 1e-12 / max(way.end - way.start, 1e-300))
        self.rows: list[Floats] = []
        self.sure: list[Flags] = []
        self.proved = True
        self.count = 0
        self.tries = 0
        self.here = self._end(way.start, start, None)

    def branch(self) -> Branch:
        complete = self.here is not None and self._along()
        loops, here = self.loops, self.here
        width = loops.n + loops.d
        found = np.concatenate(self.rows) if self.rows else np.zeros((0, width))
        sure = np.concatenate(self.sure) if self.sure else np.zeros(0, dtype=bool)
        last = np.full(width, np.nan) if here is None else here.y
        return Branch(found, sure, self.way.start if here is None else here.x, last, complete)

    def _along(self) -> bool:
        """Steps to the end of the way; False where it cannot be passed."""
        assert self.here is not None
        way, step = self.way, LONGEST / self.pace
        self._keep(np.flatnonzero(way.places <= way.start), self.here.y[None, :])
        shortest = FLOOR / self.pace
        while self.here.x < way.end:
            forced = step <= shortest
            step = min(max(step, shortest), LONGEST / self.pace)
            left = way.end - self.here.x
            full = left <= step * (1.0 + 1e-9)
            taken = left if full else step
            passed, certificate = self._step(taken, way.end if full else self.here.x + taken, forced)
            share = _share(certificate, passed)
            if passed:
                step = max(step, taken) * share if full and share > 1.0 else taken * min(2.0, max(0.3, share))
            elif forced:
                return False
            else:
                step = taken * min(0.5, max(0.1, share))
        return True

    def _step(self, h: float, x: float, forced: bool) -> tuple[bool, Certificate]:
        """Tries one step; if it passes, ``here`` and the positions are beyond it."""
        here = self.here
        assert here is not None
        self.tries += 1
        guess = here.y + here.rate * h + 0.5 * h * h * here.second
        ahead = self._end(x, guess[: self.loops.n], here.sign)
        if ahead is None:
            return False, REFUSED
        inside = np.flatnonzero((self.way.places > here.x) & (self.way.places <= x))
        values, deviation = self._driven(here, ahead, inside)
        hasty = self.tries > PATIENCE
        certificate = REFUSED if hasty else certify(self.loops, here, ahead, deviation)
        allowed = certificate.certified or ((forced or hasty) and self._plausible(here, guess, ahead))
        if not allowed or not self._between(here, ahead, inside, values, certificate):
            return False, certificate
        self.here = ahead
        return True, certificate

    def _end(self, x: float, guess: Floats, sign: float | None) -> End | None:
        """The root near a guess at place x, if the determinant has the given sign."""
        q, first, second = (row[0] for row in self.way.drive(np.array([x])))
        y = self.loops.newton(np.concatenate([guess, q]))
        if y is None:
            return None
        try:
            rate, bend, jacobian = self.loops.rates(y, first, second)
        except np.linalg.LinAlgError:
            return None
        own = float(np.linalg.slogdet(jacobian)[0])
        if not np.isfinite(bend).all() or own == 0.0 or (sign is not None and own != sign):
            return None
        return End(x, y, rate, bend, own)

    def _driven(self, a: End, b: End, inside: Indices) -> tuple[Floats, Floats]:
        """Drivers at the places asked for within a step, and how far they leave the cubic there and at the checks."""
        way, n = self.way, self.loops.n
        if not len(inside) and not len(way.checks):
            return np.zeros((0, self.loops.d)), np.zeros(self.loops.d)
        checks = way.checks[(way.checks > a.x) & (way.checks < b.x)]
        x = np.concatenate([way.places[inside], checks])
        values = way.drive(x)[0]
        gap = np.abs(values - cubic(a, b, x)[:, n:]).max(axis=0, initial=0.0)
        return values[: len(inside)], np.where(gap > 1e-13 * (1.0 + np.abs(b.y[n:])), gap, 0.0)

    def _plausible(self, a: End, guess: Floats, b: End) -> bool:
        """Whether the correction is small against the step, and one quintic fits the rates of both ends."""
        h, largest = b.x - a.x, self.loops.largest
        step = largest(b.y - a.y)
        quintic = h / 2.0 * (a.rate + b.rate) + h * h / 12.0 * (a.second - b.second)
        return (
            largest(b.y - guess) <= CORRECTION * step + 1e-10
            and largest(b.y - a.y - quintic) <= MISFIT * step + 1e-11
        )

    def _between(self, a: End, b: End, inside: Indices, values: Floats, certificate: Certificate) -> bool:
        """Keeps the positions within a step, if all of them lie in its tube."""
        n = self.loops.n
        proved = self.proved and certificate.certified
        if len(inside):
            near = cubic(a, b, self.way.places[inside])
            near[:, n:] = values
            exact, last = self.loops.polished(near)
            moved = np.abs(exact - near)[:, :n]
            if certificate.certified:
                room = certificate.tube
                assert room is not None
            else:
                room = (CORRECTION * self.loops.largest(b.y - a.y) + 1e-10) * self.loops.scale
            if not ((moved <= room + 1e-13 * self.loops.scale).all() and (last < 1e-9).all()):
                return False
            self.proved = proved
            self._keep(inside, exact)
        self.proved = proved
        return True

    def _keep(self, inside: Indices, rows: Floats) -> None:
        self.rows.append(np.repeat(rows, len(inside), axis=0) if len(rows) != len(inside) else rows)
        self.sure.append(np.full(len(inside), self.proved))


def _share(certificate: Certificate, passed: bool) -> float:
    """How much longer the next step may be; without a certificate it is longer after a step that is plausible."""
    contraction = certificate.contraction
    if not np.isfinite(contraction):
        return 1.5 if passed else 0.5
    return 0.8 * float(np.sqrt(WANTED / max(contraction, 1e-9)))


def straight(loops: ClosedLoops, begin: Floats, end: Floats, unit: Floats) -> Way:
    """The straight way of the drivers between two sets of coordinates (d,); ``unit`` (d,): of each, rad or size."""
    count = len(loops.drivers)
    delta = (end - begin)[:count]

    def drive(x: Floats) -> tuple[Floats, Floats, Floats]:
        still = np.zeros((len(x), count))
        return loops.driven(begin[:count] + x[:, None] * delta, still + delta, still)

    checks = np.linspace(0.0, 1.0, CHECKS + 1) if loops.lifts else np.zeros(0)
    samples = np.append(checks, 1.0)
    return Way(drive, 0.0, 1.0, np.array([1.0]), _pace(drive, samples, unit), checks)


def _pace(drive: Drive, samples: Floats, unit: Floats) -> float:
    """The largest rate of a driver or lift at some places."""
    return float(np.abs(drive(samples)[1] / unit).max(initial=0.0))


def lawful(
    loops: ClosedLoops,
    laws: Sequence[Law],
    unit: Floats,
    begin: float,
    end: float,
    times: Floats,
    shift: float = 0.0,
) -> Way:
    """The way of drivers by their laws from one time to another, s, through some between in this order.

    ``unit`` (d,): of each driver or lift, rad or size; ``shift``: of all times, by a period, with coordinates as they
    were before it.
    """
    sense = 1.0 if end >= begin else -1.0
    lap = np.array([float(np.diff(law.coordinate(np.array([begin, begin + shift]))[0])[0]) for law in laws])

    def drive(x: Floats) -> tuple[Floats, Floats, Floats]:
        t = sense * x
        rows = [law.coordinate(t + shift) for law in laws]
        q, first, second = (np.stack([row[k] for row in rows], axis=1) for k in range(3))
        return loops.driven(q - lap, sense * first, second)

    checks: Floats = np.zeros(0)
    samples = times * sense
    if loops.lifts or not all(law.constant_speed is not None for law in laws):
        checks = np.linspace(sense * begin, sense * end, CHECKS + 1)
        samples = np.concatenate([samples, checks])
    return Way(drive, sense * begin, sense * end, sense * times, _pace(drive, samples, unit), checks)
