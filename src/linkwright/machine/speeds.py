"""The true speed of many machines, from signals at the Gauss points of the pieces of their cycles."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats, Indices
from linkwright.curves.polynomials import LAST as LAST_ORDERS
from linkwright.curves.polynomials import Peak, largest, weights_at

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
