"""One assembly tracked along a path of the drivers, and what each of its steps must fulfil.

A step leads from the drivers' coordinates at one place of the way to those at another in a straight line, since
groups are where their drivers are, whatever the laws of time: corners of laws are passed like any other place. The
steps are as long as the rule allows, whatever positions are asked for; those within a step are read from its quintic
and corrected by Newton's method. The way ends where a step would have to be shorter than :data:`FLOOR`.

One rule of steps serves one machine, many designs, and pages. A step is predicted with the exact rates of two
orders and corrected by Newton's method. It counts if the determinants keep their signs, the correction, of third
order small, is small against the step, and both ends' exact rates fit one quintic. Where a step can be halved,
doubt halves it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import Any

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.drivers.base import Law
from linkwright.formula.trace import Scalar, maximum, reciprocal
from linkwright.kinematics.tracking_formula import Root, TrackedGroups

#: Longest and shortest step of the drivers, rad or share of the mechanism's size.
LONGEST, FLOOR = 0.5, 2e-8
#: A way does not begin where a group's smallest singular value is below this one (lengths over the size).
SINGULAR = 1e-7
#: A step aims at this doubt.
WANTED = 0.3
#: Attempts after which a path is abandoned.
PATIENCE = 50_000
#: How far, beyond this share of a step, laws may leave its straight line: rad or share of the size.
DEVIATION = 0.02
#: Places of a law at which its largest rate is looked for.
LOOKS = 720


@dataclass(frozen=True)
class Way:
    """A way of the drivers: ``drive`` gives their coordinates (m, d) at places x (m,).

    ``pace``: the largest rate of a driver, rad or shares of the size per unit of x; ``unit`` (d,): of each driver, 1
    rad or the size; ``breaks``: places at which the drivers may turn corners, in order; ``lap`` (d,): by how much the
    laws are ahead of it.
    """

    drive: Callable[[Floats], Floats]
    start: float
    end: float
    pace: float
    unit: Floats
    breaks: Floats = field(default_factory=lambda: np.zeros(0))
    lap: Floats | float = 0.0


def straight(begin: Floats, end: Floats, unit: Floats) -> Way:
    """The straight way of the drivers between two sets of coordinates (d,), from 0 to 1."""
    delta = end - begin
    pace = float(np.abs(delta / unit).max(initial=0.0))
    return Way(partial(_on_line, begin, delta), 0.0, 1.0, pace, unit)


def _on_line(begin: Floats, delta: Floats, x: Floats) -> Floats:
    return np.asarray(begin + x[:, None] * delta)


def lawful(laws: Sequence[Law], unit: Floats, begin: float, end: float, shift: float = 0.0) -> Way:
    """The way of drivers by their laws from one time to another, s.

    ``shift``: of all times, by a period, with coordinates as they were before it. Places are times, those of a way
    back with the other sign.
    """
    sense = 1.0 if end >= begin else -1.0
    lap = np.array([law.at(begin + shift) - law.at(begin) for law in laws])

    low, high = min(begin, end) + shift, max(begin, end) + shift
    pace, breaks = 0.0, [np.zeros(0)]
    for law, one in zip(laws, unit, strict=True):
        times = np.linspace(low, high, 2 if law.constant_speed is not None else LOOKS + 1)
        pace = max(pace, float(np.abs(law.coordinate(times)[1]).max()) / one)
        breaks.append(law.breaks(low, high))
    corners = np.unique(np.concatenate(breaks))
    inner = np.sort(sense * (corners[(corners > low) & (corners < high)] - shift))
    drive = partial(_by_laws, laws, lap, sense, shift)
    return Way(drive, sense * begin, sense * end, pace, unit, inner, lap)


def _by_laws(laws: Sequence[Law], lap: Floats, sense: float, shift: float, x: Floats) -> Floats:
    rows = [law.coordinate(sense * x + shift)[0] - gained for law, gained in zip(laws, lap, strict=True)]
    return np.stack(rows, axis=1) if rows else np.zeros((len(x), 0))


@dataclass(frozen=True)
class Node:
    """A place of a way: the drivers there, and the assembly with its rates along ``ahead`` (d,)."""

    x: float
    q: Floats
    ahead: Floats
    root: Root


@dataclass(frozen=True)
class Branch:
    """The tracked part of a path: its steps, each with both ends and their rates along it.

    ``end``: how far it goes, None where it does not begin; ``complete``: whether that is the end of the way.
    """

    way: Way
    steps: list[tuple[Node, Node]]
    end: Node | None
    complete: bool

    @property
    def reached(self) -> float:
        """The place to which it goes."""
        return self.way.start if self.end is None else self.end.x

    @property
    def last(self) -> Floats | None:
        """Coordinates (n,) there; None where it does not begin."""
        return None if self.end is None else np.array(self.end.root.z)

    @cached_property
    def _rows(self) -> tuple[Floats, ...]:
        """Of all steps: ends of places, drivers, and coordinates with two derivatives."""
        ends = [(np.array([each.x for each in side]), np.array([each.q for each in side])) for side in self._sides]
        roots = [np.array([[each.root.z, each.root.rate, each.root.second] for each in side]) for side in self._sides]
        return (*ends[0], *ends[1], *roots)

    @property
    def _sides(self) -> list[list[Node]]:
        return [[step[k] for step in self.steps] for k in (0, 1)]

    def read(self, x: Floats, q: Floats) -> tuple[Floats, Floats, Flags]:
        """Expected coordinates (m, n) at places x (m,) with the drivers at q (m, d); the largest change (m, n) in
        their steps; which of the places the branch reaches."""
        beyond = 1e-12 * (1.0 + abs(self.reached))
        assert self.end is not None
        known = (x >= self.way.start - beyond) & (x <= self.reached + beyond)
        if not self.steps:
            still = np.tile(self.end.root.z, (len(x), 1))
            return still, np.zeros(still.shape), known
        x0, q0, x1, q1, a, b = self._rows
        k = np.clip(np.searchsorted(x1, x), 0, len(x1) - 1)
        gone = (q1 - q0) / self.way.unit
        square = (gone * gone).sum(axis=1)
        with np.errstate(all="ignore"):
            along = ((q - q0[k]) / self.way.unit * gone[k]).sum(axis=1) / square[k]
            t = np.where(square[k] > 0.0, along, (x - x0[k]) / (x1 - x0)[k])[:, None]
        z, v, s = (a[k, i] for i in range(3))
        rise = b[k, 0] - z
        cubic, fourth, fifth = quintic(rise, v, s, b[k, 1], b[k, 2])
        near = z + t * (v + t * (0.5 * s + t * (cubic + t * (fourth + t * fifth))))
        return near, np.abs(rise), known


def follow(groups: TrackedGroups, way: Way, start: Sequence[float]) -> Branch:
    """Follows the assembly with the coordinates ``start`` (n,) at the beginning of a way."""
    return _Walk(groups, way, start).branch()


class _Walk:
    def __init__(self, groups: TrackedGroups, way: Way, start: Sequence[float]) -> None:
        self.groups, self.way = groups, way
        self.share = (1.0 / groups.scale).tolist()
        self.slides = [k for k, turns in enumerate(groups.turns) if not turns]
        self.pace = max(way.pace, 1e-12 / max(way.end - way.start, 1e-300))
        self.steps: list[tuple[Node, Node]] = []
        q = way.drive(np.array([way.start]))[0]
        root = groups.solve(start, q.tolist(), [0.0] * len(q))
        if root is not None and min(groups.regularity(root.z, q.tolist()).values()) < SINGULAR:
            root = None
        self.here = None if root is None else Node(way.start, q, np.zeros(len(q)), root)

    def branch(self) -> Branch:
        complete = self.here is not None and self._along()
        return Branch(self.way, self.steps, self.here, complete)

    def _along(self) -> bool:
        """Steps to the end of the way; False where it cannot be passed."""
        way, longest, shortest = self.way, LONGEST / self.pace, FLOOR / self.pace
        goals, step = [*way.breaks.tolist(), way.end], longest
        for goal in goals:
            for _ in range(PATIENCE):
                assert self.here is not None
                left = goal - self.here.x
                if left <= 0.0:
                    break
                full = left <= step * (1.0 + 1e-9)
                share = self._step(goal if full else self.here.x + step)
                taken = left if full else step
                if share >= 1.0:
                    if taken <= shortest:
                        return False
                    step = max(taken * 0.5 if share == math.inf else taken * _share(share), shortest)
                elif not full or taken * _share(share) > step:
                    step = min(taken * _share(share), longest)
            else:
                return False
        return True

    def _step(self, x: float) -> float:
        """Tries one step; with less than 1 it is made. How doubtful it is."""
        here = self.here
        assert here is not None
        places = here.x + (x - here.x) * _WITHIN
        rows = self.way.drive(places)
        q = rows[-1]
        ahead = q - here.q
        deviation = self._deviation(rows[:-1], here.q, ahead)
        if deviation > 1.0:
            return math.inf
        here = self._towards(here, ahead)
        if here is None:
            return math.inf
        a = here.root
        guess = [z + v + 0.5 * s for z, v, s in zip(a.z, a.rate, a.second, strict=True)]
        b = self.groups.solve(guess, q.tolist(), ahead.tolist())
        if b is None or b.signs != a.signs:
            return math.inf
        off = self._off(a, guess, b)
        if off < 1.0:
            end = Node(x, q, ahead, b)
            self.steps.append((here, end))
            self.here = end
        return off

    def _deviation(self, rows: Floats, q: Floats, ahead: Floats) -> float:
        """How far the drivers leave the straight line of a step between its ends, as share of what they may."""
        unit = self.way.unit
        off, gone = (rows - q) / unit, ahead / unit
        square = float(gone @ gone)
        if square > 0.0:
            share = np.clip(off @ gone / square, 0.0, 1.0)
            off = off - share[:, None] * gone
        return float(np.abs(off).max(initial=0.0)) / (DEVIATION * math.sqrt(square) + FLOOR)

    def _towards(self, node: Node, ahead: Floats) -> Node | None:
        """The same node with its rates in another direction of the drivers."""
        old = node.ahead
        lead = int(np.argmax(np.abs(old))) if len(old) else 0
        if len(old) and old[lead] != 0.0:
            factor = float(ahead[lead] / old[lead])
            if np.abs(ahead - factor * old).max() <= 1e-12 * np.abs(ahead).max():
                root = node.root
                rate, second = [factor * v for v in root.rate], [factor * factor * s for s in root.second]
                return Node(node.x, node.q, ahead, replace(root, rate=rate, second=second))
        if not ahead.any():
            still = [0.0] * len(self.share)
            return Node(node.x, node.q, ahead, replace(node.root, rate=still, second=still))
        found = self.groups.solve(node.root.z, node.q.tolist(), ahead.tolist())
        return None if found is None else Node(node.x, node.q, ahead, found)

    def _off(self, a: Root, guess: list[float], b: Root) -> float:
        """The rule's doubt of a step; infinite where a coordinate changes too much."""
        change = correction = gap = 0.0
        share = self.share
        if self.slides:
            share = list(share)
            for k in self.slides:
                share[k] = min(share[k], 1.0 / max(abs(a.z[k]), 1e-300))
        for k, (z0, v0, s0, near, z1, v1, s1) in enumerate(
            zip(a.z, a.rate, a.second, guess, b.z, b.rate, b.second, strict=True)
        ):
            gone, one = z1 - z0, share[k]
            change = max(change, abs(gone) * one)
            correction = max(correction, abs(z1 - near) * one)
            gap = max(gap, abs(misfit(gone, v0, s0, v1, s1)) * one)
        if not change < LARGEST:
            return math.inf
        return float(doubt(change, correction, gap, ROUNDING))  # type: ignore[arg-type]


#: Shares of a step at which laws are compared with its straight line, and its end.
_WITHIN = np.array([0.25, 0.5, 0.75, 1.0])


def _share(off: float) -> float:
    """How much longer the next step may be: doubt grows with the second power of the step."""
    return min(2.0, max(0.3, 0.9 * math.sqrt(WANTED / max(off, 1e-9))))


def near_enough(moved: Floats, change: Floats) -> Flags:
    """Which corrections (m,) of places within steps are small against the changes (m,) in these."""
    return np.asarray(moved <= CORRECTION * change + ROUNDING)


#: Largest correction, and largest misfit of both ends' rates, as share of the step.
CORRECTION, MISFIT = 0.1, 0.01
#: Largest change of a coordinate in one step, rad or share of the size.
LARGEST = 0.3
#: What a correction and a misfit may be in addition to these shares: rounding; and where steps cannot be halved, as
#: where a cam's rise begins behind a dwell: no other assembly of the same sign of the determinant is so near.
ROUNDING, ROOM = 1e-10, 1e-4


def doubt(change: Scalar, correction: Scalar, misfit: Scalar, room: Scalar) -> Scalar:
    """Of a step's largest change, correction and misfit: below 1 the step counts."""
    return maximum(correction * reciprocal(CORRECTION * change + room), misfit * reciprocal(MISFIT * change + room))


def misfit(rise: Any, rate: Any, second: Any, rate_there: Any, second_there: Any) -> Any:
    """How far a coordinate's rise in a step is from what one quintic of the rates at both ends gives; these times the
    step, and times its square."""
    return rise - 0.5 * (rate + rate_there) - (1.0 / 12.0) * (second - second_there)


def quintic(rise: Any, rate: Any, second: Any, rate_there: Any, second_there: Any) -> tuple[Any, Any, Any]:
    """The coefficients of the third to the fifth power, over shares of the step, of the quintic with the values and
    rates of both ends, see :func:`misfit`."""
    d, dv, ds = rise - rate - 0.5 * second, rate_there - rate - second, 0.5 * (second_there - second)
    return 10.0 * d - 4.0 * dv + ds, 7.0 * dv - 15.0 * d - 2.0 * ds, 6.0 * d - 3.0 * dv + ds
