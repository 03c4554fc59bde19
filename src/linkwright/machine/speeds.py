"""The true speed of many machines or designs, from signals at Gauss points of their cycles, with gradients."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.curves.pieces import MET, Pieces
from linkwright.curves.polynomials import LAST as LAST_ORDERS
from linkwright.curves.polynomials import WEIGHTS, Peak, largest, weights_at
from linkwright.machine.flywheel import ZERO_TOLERANCE

#: Share of the smallest kinetic energy in which a Newton step is the last one: what is left is its square.
LAST = 1e-9
#: Newton's steps for an energy, and for a flywheel; where these change by less than a share, they are found.
STEPS, SIZES, FOUND = 200, 40, 1e-13
#: The error of the slowness' mean as share of its last orders: Gauss points integrate orders twice as high.
OF_SLOWNESS = 0.01


@dataclass(frozen=True, eq=False)
class Speeds:
    """Speeds ω of some machines over their mean, (POINTS, pieces), and what they follow from.

    ``design``: of the pieces; ``kinetic``: 2 E/ω_mean², kg·m², of the kinetic energy E; ``inertia``: all of it,
    flywheels included, kg·m²; ``energy``: 2 E0/ω_mean², (designs,).
    """

    design: Indices
    kinetic: Floats
    inertia: Floats
    energy: Floats

    @cached_property
    def values(self) -> Floats:
        """ω/ω_mean = √(kinetic / inertia)."""
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.sqrt(self.kinetic / self.inertia)

    @property
    def fastest(self) -> Peak:
        """The largest speed over the mean: piece, place in it, value."""
        return self._extremes[0]

    @property
    def slowest(self) -> Peak:
        """The same of the smallest one."""
        return self._extremes[1]

    @cached_property
    def _extremes(self) -> tuple[Peak, Peak]:
        pieces, designs = len(self.design), len(self.energy)
        both = np.concatenate([self.values, -self.values], axis=1)
        owner = np.concatenate([self.design, self.design + designs])
        piece, place, value = largest(both, owner)
        high, low = slice(designs), slice(designs, None)
        return (piece[high], place[high], value[high]), (piece[low] - pieces, place[low], -value[low])

    @property
    def fluctuation(self) -> Floats:
        """(ω_max - ω_min)/ω_mean, (designs,)."""
        return np.asarray(self.fastest[2] - self.slowest[2])

    @property
    def rough(self) -> Floats:
        """How far polynomials are from meeting the speed, as share of the mean one, (designs,).

        Of the slowness, of which the mean alone is taken, a share of that.
        """
        with np.errstate(invalid="ignore", divide="ignore"):
            signals = (self.values, OF_SLOWNESS / self.values)
            off = np.maximum(*(np.abs(LAST_ORDERS @ each).max(axis=0) for each in signals))
        return np.asarray(np.maximum.reduceat(off, _starts(self.design)))

    def weights(self, fastest: float, slowest: float) -> Floats:
        """Weights of the speeds at the Gauss points in a sum of the largest and the smallest one."""
        found = np.zeros_like(self.values)
        for share, (piece, place, _) in ((fastest, self.fastest), (slowest, self.slowest)):
            if share:
                found[:, piece] += share * weights_at(place)
        return found


@dataclass(frozen=True, eq=False)
class Slopes:
    """Derivatives of a number of each design by excess work (as kg·m²), inertia and share of every Gauss point,
    (POINTS, pieces) each, and by the flywheel, (designs,)."""

    excess: Floats
    inertia: Floats
    share: Floats
    flywheel: Floats


class SteadyCycles:
    """Cycles of steady running of some machines, (POINTS, pieces) each: ½ J ω² = E0 + W.

    ``design``: of the pieces, in order; ``share``: a point's share of the angle of the period; ``excess``:
    2 W/ω_mean², kg·m², of the excess work W of the driver; ``inertia``: J without a flywheel, kg·m². E0 follows from
    the mean speed: the mean of ω_mean/ω over the angle is 1.
    """

    def __init__(self, design: Indices, share: Floats, excess: Floats, inertia: Floats) -> None:
        self.design, self.share, self.excess, self.inertia = design, share, excess, inertia
        self._starts = _starts(design)

    def at(self, flywheel: Floats) -> Speeds:
        """The speeds with flywheels (designs,), kg·m²; NaN where there is no inertia somewhere."""
        inertia = self.inertia + flywheel[self.design]
        energy = self._energy(inertia)
        return Speeds(self.design, energy[self.design] + self.excess, inertia, energy)

    def total(self, values: Floats) -> Floats:
        """Sums over the Gauss points, (designs,)."""
        return np.asarray(np.add.reduceat(values.sum(axis=0), self._starts))

    def _minimum(self, values: Floats) -> Floats:
        return np.asarray(np.minimum.reduceat(values.min(axis=0), self._starts))

    def _energy(self, inertia: Floats) -> Floats:
        """2 E0/ω_mean² by safeguarded Newton's steps for the square of the mean speed, (designs,)."""
        lowest, scale = self._minimum(self.excess), -self._minimum(-inertia)
        low, high = -lowest, scale - lowest
        energy = self.total(self.share * (inertia - self.excess))
        energy = np.where((low < energy) & (energy < high), energy, high)
        with np.errstate(invalid="ignore", divide="ignore"):
            for _ in range(STEPS):
                kinetic = energy[self.design] + self.excess
                slowness = self.share * np.sqrt(inertia / kinetic)
                mean, slope = self.total(slowness), self.total(slowness / kinetic)
                low, high = np.where(mean > 1.0, energy, low), np.where(mean > 1.0, high, energy)
                newton = energy + mean * (mean * mean - 1.0) / slope
                inside = (low < newton) & (newton < high)
                before, energy = energy, np.where(inside, newton, 0.5 * (low + high))
                enough = np.maximum(1e-15 * scale, np.where(inside, LAST * (energy + lowest), 0.0))
                if not (np.abs(energy - before) > enough).any():
                    break
        return np.asarray(np.where(self._minimum(inertia) > 0.0, energy, np.nan))

    def flywheel(self, fluctuation: float, first: Floats) -> Floats:
        """Flywheels (designs,), kg·m², with which the speed fluctuates by just a share of the mean.

        Zero where none is needed, NaN where none is found; ``first``: flywheels to begin with.
        By Newton's steps for 1/δ, which is nearly a straight line over the flywheel.
        """
        own = self.total(self.share * self.inertia)
        with np.errstate(invalid="ignore", divide="ignore"):
            needed = ~(self.at(np.zeros(len(own))).fluctuation <= fluctuation)
            size = np.where(needed, np.maximum(first, 0.1 * own), 0.0)
            left = needed
            for _ in range(SIZES):
                found = self.at(size)
                reached, slope = found.fluctuation, self.slopes(found, 1.0, -1.0).flywheel
                next_size = size + reached * (1.0 - reached / fluctuation) / slope
                next_size = np.where(next_size > 0.0, next_size, 1e-3 * size)
                next_size = np.where(left, next_size, size)
                left = left & (np.abs(next_size - size) > FOUND * (size + own))
                size = next_size
                if not left.any():
                    break
        return np.where(left, np.nan, size)

    def slopes(self, found: Speeds, fastest: float, slowest: float) -> Slopes:
        """Derivatives of a sum of the largest and the smallest speed over the mean.

        Their places stay (envelope theorem), the energy follows from the mean speed (implicit function theorem).
        """
        speed, kinetic, inertia = found.values, found.kinetic, found.inertia
        with np.errstate(invalid="ignore", divide="ignore"):
            own = 0.5 * found.weights(fastest, slowest) * speed
            late = 0.5 * self.share / speed
            by_energy = (self.total(own / kinetic) / self.total(late / kinetic))[self.design]
            late = late * by_energy
            excess, weight = (own - late) / kinetic, (late - own) / inertia
            return Slopes(excess, weight, by_energy / speed, self.total(weight))


def _starts(design: Indices) -> Indices:
    """The first piece of every design."""
    return np.flatnonzero(np.diff(design, prepend=-1))


#: Kinds of numbers, with the weights of the largest and the smallest speed in them; the ``size`` is the flywheel with
#: which the speed fluctuates by just what is asked for.
SIDES: Mapping[str, tuple[float, float]] = {
    "fastest": (1.0, 0.0),
    "slowest": (0.0, 1.0),
    "fluctuation": (1.0, -1.0),
    "size": (1.0, -1.0),
}


class SteadyDesigns:
    """Steady running of some designs under the constant torque that does the work of the signal ``effort``.

    ``effort``, N·m at constant speed, the links' inertia in it, and ``inertia``, kg·m² on the driver: numbers of
    signals that the pieces meet everywhere; ``speed``: the mean one, rad/s, its sign the sense of running.
    ``fluctuation``: a flywheel is there by the formula ΔE/(δ ω²) less the mean inertia; None without one.
    """

    def __init__(self, pieces: Pieces, effort: int, inertia: int, speed: Floats) -> None:
        self.pieces, self.effort, self.speed = pieces, effort, speed
        self.mean = pieces.mean(effort)
        self.inertia, self.own = pieces.values(inertia), pieces.mean(inertia)
        self._known: dict[tuple[float | None, bool], tuple[Floats, Speeds]] = {}

    def number(self, kind: str, fluctuation: float | None = None) -> Floats:
        """A number (designs,), rad/s, 1 or kg·m²; NaN where the effort does no work."""
        size, speeds = self._speeds(kind, fluctuation)
        found = {
            "size": size,
            "fluctuation": speeds.fluctuation,
            "fastest": np.abs(self.speed) * speeds.fastest[2],
            "slowest": np.abs(self.speed) * speeds.slowest[2],
        }[kind]
        works = np.abs(self.mean) > ZERO_TOLERANCE * self.pieces.size[self.effort]
        return np.where(works, found, np.nan)

    def met(self, kind: str, fluctuation: float | None = None) -> Flags:
        """Designs whose speed the polynomials meet, (designs,)."""
        return np.asarray(self._speeds(kind, fluctuation)[1].rough <= 2.0 * MET)

    def weights(self, kind: str, fluctuation: float | None, bar: Floats) -> tuple[Floats, Floats, Floats]:
        """Derivatives of the sum of ``bar`` (designs,) times a number: by effort and inertia at the Gauss points,
        (POINTS, pieces), and by the widths of the pieces; the mean speed as it is."""
        pieces, every = self.pieces, self.pieces.each
        size, speeds = self._speeds(kind, fluctuation)
        slopes = self._cycles.slopes(speeds, *SIDES[kind])
        if kind == "size":
            with np.errstate(divide="ignore"):
                bar = np.where(size > 0.0, -bar / slopes.flywheel, 0.0)
        elif kind != "fluctuation":
            bar = bar * np.abs(self.speed)
        gap, inertia, share = (every(bar) * each for each in (slopes.excess, slopes.inertia, slopes.share))
        inertia, excess = inertia + gap, every(self._lift) * gap
        if kind != "size" and fluctuation is not None:
            by_size = np.where(size > 0.0, bar * slopes.flywheel, 0.0)
            for sign, (piece, place, _) in ((1.0, self._highest), (-1.0, self._lowest)):
                excess[:, piece] += sign * weights_at(place) * by_size / (fluctuation * self.speed)
            inertia = inertia - every(by_size) * self._share
            share = share - every(by_size) * self.inertia
        effort, width = pieces.through_excess(self.effort, self.mean, excess)
        by_share = WEIGHTS @ share
        period = every(pieces.period)
        width += (by_share - every(pieces.total(by_share * pieces.width)) / period) / period
        return effort, inertia, width

    @cached_property
    def excess(self) -> Floats:
        """The integral over time of what the effort lacks of its mean, N·m·s."""
        return self.pieces.excess(self.effort, self.mean)

    @property
    def _lift(self) -> Floats:
        """What it adds to the squares of the speed's shares, per kg·m²: 2 W/ω², W its product with the speed."""
        return 2.0 / self.speed

    @cached_property
    def _share(self) -> Floats:
        """Share of the cycle of every Gauss point."""
        return WEIGHTS[:, None] * (self.pieces.width / self.pieces.each(self.pieces.period))

    @cached_property
    def _cycles(self) -> SteadyCycles:
        lack = self.pieces.each(self._lift) * self.excess
        return SteadyCycles(self.pieces.design, self._share, lack + self.inertia, self.inertia)

    def _speeds(self, kind: str, fluctuation: float | None) -> tuple[Floats, Speeds]:
        """The flywheels, and the speeds with them."""
        key = (fluctuation, kind == "size")
        if key not in self._known:
            size = np.zeros(self.pieces.designs) if fluctuation is None else self._by_formula(fluctuation)
            if kind == "size" and fluctuation is not None:
                size = self._cycles.flywheel(fluctuation, size)
            self._known[key] = size, self._cycles.at(size)
        return self._known[key]

    def _by_formula(self, fluctuation: float) -> Floats:
        gap = self._highest[2] + self._lowest[2]
        return np.maximum(gap / (fluctuation * np.abs(self.speed)) - self.own, 0.0)

    @cached_property
    def _highest(self) -> Peak:
        """The largest excess of work, over the size of the speed."""
        return largest(self.pieces.each(np.sign(self.speed)) * self.excess, self.pieces.design)

    @cached_property
    def _lowest(self) -> Peak:
        return largest(-self.pieces.each(np.sign(self.speed)) * self.excess, self.pieces.design)
