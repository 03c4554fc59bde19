"""A load on a trough that moves to and fro: rest, sliding, flight, found exactly for accelerations that are linear
between positions."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Floats

REST, FORWARD, BACKWARD, FLIGHT = "rest", "forward", "backward", "flight"
MODES = (REST, FORWARD, BACKWARD, FLIGHT)
#: Cycles until the motion repeats at most, and those over which a motion that does not repeat is averaged.
MOST, AVERAGED = 120, 40
#: Velocities and times below this share of their scale are zero.
TINY = 1e-12


@dataclass(frozen=True)
class Trough:
    """Accelerations of the trough along and across its surface at even times of a cycle, (n,) m/s², the ``period`` s,
    gravity along and across (m/s², across negative), coefficients of friction at rest and in motion."""

    along: Floats
    across: Floats
    period: float
    gravity: tuple[float, float]
    static: float
    kinetic: float


@dataclass(frozen=True)
class Phase:
    """A stretch of the cycle, times from its start in s."""

    mode: str
    start: float
    end: float


@dataclass(frozen=True)
class Transported:
    """Steady motion of the load over the trough: displacement per cycle m, phases of one cycle, whether it repeats;
    times (k,) and relative displacement, velocity and height (k,) of that cycle."""

    displacement: float
    phases: tuple[Phase, ...]
    repeats: bool
    time: Floats
    position: Floats
    velocity: Floats
    height: Floats


class _Load:
    """The load's state relative to the trough, and its steps from event to event."""

    def __init__(self, trough: Trough) -> None:
        self.trough = trough
        self.mode = REST
        self.s = self.v = self.n = self.w = 0.0

    def key(self) -> tuple[str, float, float, float]:
        """What must come again after a cycle."""
        return self.mode, self.v, self.n, self.w

    def hasten(self, velocities: list[float]) -> None:
        """Goes to the limit that velocities at the ends of cycles approach (Aitken), if the load slides that way."""
        first, second, third = velocities
        step, bend = third - second, third - 2 * second + first
        evenly = abs(bend) > TINY * abs(step) and 0 < step / (second - first or step) < 1
        limit = third - step * step / bend if evenly else third
        if self.n == self.w == 0.0 and limit * self.v > 0:
            self.v = limit

    def over(self, h: float, f: tuple[float, float], normal: tuple[float, float]) -> list[tuple[str, float]]:
        """Goes over a step of length h; ``f`` and ``normal``: needed friction and normal force per mass at its ends.

        Gives the modes with the times that they took.
        """
        done, parts = 0.0, []
        for _ in range(50):
            left = h - done
            if left <= TINY * h:
                break
            now = self._between(f, done / h), self._between(normal, done / h)
            rates = ((f[1] - f[0]) / h, (normal[1] - normal[0]) / h)
            self._settle(*now, *rates)
            mode = self.mode
            taken = self._advance(left, now, rates)
            parts.append((mode, taken))
            done += taken
        return parts

    @staticmethod
    def _between(ends: tuple[float, float], share: float) -> float:
        return ends[0] + share * (ends[1] - ends[0])

    def _settle(self, f: float, normal: float, df: float, dn: float) -> None:
        """The mode that begins here."""
        if self.mode == FLIGHT:
            return
        if normal < 0 or (normal <= 0 and dn < 0):
            self.mode, self.n, self.w = FLIGHT, 0.0, 0.0
        elif self.mode == REST:
            hold = self.trough.static * normal
            over = abs(f) - hold
            grows = math.copysign(1.0, f) * df - self.trough.static * dn
            if over > TINY * max(abs(f), hold) or (abs(over) <= TINY * max(abs(f), hold) and grows > 0):
                self.mode = BACKWARD if f > 0 else FORWARD

    def _advance(self, left: float, now: tuple[float, float], rates: tuple[float, float]) -> float:
        f, normal = now
        df, dn = rates
        if self.mode == REST:
            time = min(self._time_to_sliding(left, f, normal, df, dn), self._lift(left, normal, dn))
            if time < left:
                ends = f + df * time
                self.mode = FLIGHT if normal + dn * time <= TINY * abs(normal) else BACKWARD if ends > 0 else FORWARD
            return time
        if self.mode == FLIGHT:
            return self._fly(left, f, normal, df, dn)
        sense = 1.0 if self.mode == FORWARD else -1.0
        a, da = -f - sense * self.trough.kinetic * normal, -df - sense * self.trough.kinetic * dn
        stop = _first_root((self.v, a, da / 2), left, sense)
        time = min(stop, self._lift(left, normal, dn))
        self._move(time, a, da)
        if time == stop and stop < left:
            self.v, self.mode = 0.0, REST
        return time

    def _move(self, time: float, a: float, da: float) -> None:
        self.s += time * (self.v + time * (a / 2 + time * da / 6))
        self.v += time * (a + time * da / 2)

    def _time_to_sliding(self, left: float, f: float, normal: float, df: float, dn: float) -> float:
        """When the needed friction reaches what friction can hold."""
        times = [left]
        for sense in (1.0, -1.0):
            gap, rate = self.trough.static * normal - sense * f, self.trough.static * dn - sense * df
            if rate < 0 and 0.0 < -gap / rate < left:
                times.append(-gap / rate)
        return min(times)

    @staticmethod
    def _lift(left: float, normal: float, dn: float) -> float:
        """When the normal force becomes zero."""
        return -normal / dn if dn < 0 and 0.0 < -normal / dn < left else left

    def _fly(self, left: float, f: float, normal: float, df: float, dn: float) -> float:
        """Free flight until the end of the step or the landing, whose blow takes friction with it."""
        land = _landing((self.n, self.w, -normal / 2, -dn / 6), left)
        time = min(land, left)
        self._move(time, -f, -df)
        self.n += time * (self.w + time * (-normal / 2 - time * dn / 6))
        self.w += time * (-normal - time * dn / 2)
        if land < left:
            blow = self.trough.kinetic * abs(self.w)
            self.v = math.copysign(max(abs(self.v) - blow, 0.0), self.v)
            self.n = self.w = 0.0
            self.mode = REST if self.v == 0.0 else FORWARD if self.v > 0 else BACKWARD
        return time


def _first_root(c: tuple[float, float, float], end: float, sense: float) -> float:
    """When c0 + c1 t + c2 t² falls to zero from the side of ``sense``; ``end`` where it does not before."""
    low, best = TINY * end, end
    for root in _roots(*c):
        if low < root < best and sense * (c[1] + 2 * c[2] * root) <= 0:
            best = root
    return best


def _roots(c: float, b: float, a: float) -> tuple[float, ...]:
    """Real roots of c + b t + a t², without cancellation."""
    if a == 0.0:
        return (-c / b,) if b else ()
    inside = b * b - 4 * a * c
    if inside < 0:
        return ()
    half = -0.5 * (b + math.copysign(math.sqrt(inside), b))
    return (half / a, c / half) if half else (0.0,)


def _landing(c: tuple[float, float, float, float], end: float) -> float:
    """First time after 0 at which a height c0 + c1 t + c2 t² + c3 t³ comes down to zero; infinity if not by then."""
    value = c[0] + end * (c[1] + end * (c[2] + end * c[3]))
    if value > 0 and c[0] > 0 and c[1] >= 0:
        return math.inf
    roots = np.roots(c[::-1]) if any(c[1:]) else np.zeros(0)
    good = [
        float(r.real)
        for r in roots
        if abs(r.imag) <= 1e-9 * max(abs(r), end)
        and TINY * end < r.real < end
        and c[1] + r.real * (2 * c[2] + 3 * r.real * c[3]) <= 0
    ]
    return min(good, default=math.inf)


def transport(trough: Trough) -> Transported:
    """The steady motion of a load laid at rest on the trough."""
    count = len(trough.along)
    h = trough.period / count
    f = trough.along - trough.gravity[0]
    normal = trough.across - trough.gravity[1]
    load, starts, keys = _Load(trough), [0.0], [("", 0.0, 0.0, 0.0)]
    scale = float(np.abs(f).max() + np.abs(normal).max()) * trough.period
    phases: list[Phase] = []
    record: list[tuple[float, float, float, float]] = []
    repeats = False
    for cycle in range(MOST):
        phases, record = [], [(0.0, load.s, load.v, load.n)]
        time = 0.0
        for i in range(count):
            j = (i + 1) % count
            for mode, taken in load.over(h, (f[i], f[j]), (normal[i], normal[j])):
                if phases and phases[-1].mode == mode:
                    phases[-1] = Phase(mode, phases[-1].start, time + taken)
                elif taken > 0:
                    phases.append(Phase(mode, time, time + taken))
                time += taken
            record.append(((i + 1) * h, load.s, load.v, load.n))
        starts.append(load.s)
        keys.append(load.key())
        repeats = _same(keys[-2], keys[-1], scale)
        if repeats:
            break
        if cycle % 4 == 3:
            load.hasten([key[1] for key in keys[-3:]])
    span = 1 if repeats else min(AVERAGED, len(starts) - 1)
    table = np.array(record).T
    return Transported(
        (starts[-1] - starts[-1 - span]) / span,
        tuple(phases),
        repeats,
        table[0],
        table[1] - table[1, 0],
        table[2],
        table[3],
    )


def _same(a: tuple[str, float, float, float], b: tuple[str, float, float, float], scale: float) -> bool:
    return a[0] == b[0] and all(abs(x - y) <= 1e-9 * scale for x, y in zip(a[1:], b[1:], strict=True))
