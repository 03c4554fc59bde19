"""Numbers of the true speed of many designs, with weights for their gradients."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.curves.pieces import MET, Pieces
from linkwright.curves.polynomials import WEIGHTS, Peak, largest, weights_at
from linkwright.machine.flywheel import ZERO_TOLERANCE
from linkwright.machine.speeds import Speeds, SteadyCycles

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
