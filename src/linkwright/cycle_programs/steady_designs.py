"""Numbers of the true speed of many designs, and their derivatives by the signals at the Gauss points."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.core.piecewise import POINTS, TO_LAST, Peak, largest, weights_at
from linkwright.cycle.summary import Summary
from linkwright.cycle_programs.gauss_cycle import SHARE
from linkwright.cycle_programs.piece_summaries import UP_TO, integral
from linkwright.engine.cycle import Known
from linkwright.engine.program import Program
from linkwright.engine.stage import Run, Stage
from linkwright.machine.speeds import Slopes, Speeds, SteadyCycles
from linkwright.metrics.flywheel import NOTHING
from linkwright.metrics.true_speed import EFFORT, INERTIA, required

#: Polynomials whose last orders are below this share of a signal's size meet it.
SMOOTH = 2e-11
#: What a number's derivatives are taken by, and what is left of it.
SIGNALS, REST = (EFFORT, INERTIA, SHARE), "rest"
#: Weights of the largest and the smallest speed in a number.
_SIDES = {"fastest": (1.0, 0.0), "slowest": (0.0, 1.0), "fluctuation": (1.0, -1.0), "size": (1.0, -1.0)}


class SteadyDesigns:
    """Steady running of some designs, whose signals (designs, POINTS, pieces) are found when they are wanted.

    ``program`` gives the driver's effort, the equivalent inertia and the shares of the Gauss points; ``speed``: the
    driver's, rad/s; ``way``: what it turns in the cycle, rad.
    """

    def __init__(
        self, program: Program, known: Known, run: Run, pieces: int, speed: float, way: float
    ) -> None:
        self._stage, self._given, self._run = Stage(program, keep=SIGNALS), known, run
        self.pieces, self.sense, self.speed = pieces, (1.0 if speed > 0.0 else -1.0), abs(speed)
        self.way = way
        self._known: dict[Summary, tuple[Floats, Speeds]] = {}

    @property
    def lift(self) -> float:
        """What work adds to the squares of the speed's shares, per kg·m²; of a driver that never stands still."""
        return 2.0 / self.speed**2

    @cached_property
    def _signals(self) -> tuple[Floats, Floats, Floats]:
        """Torque in the sense of running, N·m, inertia, kg·m², and share of the cycle."""
        table = self._given.table(self._stage.kept.parameters)
        stored = self._stage.fields(table, self._given.fields, None, self._run)
        effort, inertia, share = (stored[name].reshape(len(table), POINTS, self.pieces) for name in SIGNALS)
        return self.sense * effort, inertia, share

    @property
    def torque(self) -> Floats:
        """Torque of the driver in the sense in which it runs, N·m."""
        return self._signals[0]

    @property
    def inertia(self) -> Floats:
        """Equivalent inertia, kg·m²."""
        return self._signals[1]

    @property
    def share(self) -> Floats:
        """Share of the cycle."""
        return self._signals[2]

    @cached_property
    def mean(self) -> Floats:
        """Mean torque (designs,), N·m."""
        return np.asarray(np.einsum("dip,dip->d", self.share, self.torque))

    @cached_property
    def work(self) -> Floats:
        """Excess of the work of the mean torque, J."""
        return self.way * integral(self.torque, self.share, self.mean)

    @cached_property
    def cycles(self) -> SteadyCycles:
        """Their cycles of steady running."""
        signals = (self.share, self.lift * self.work + self.inertia, self.inertia)
        design = np.repeat(np.arange(len(self.share)), self.pieces)
        return SteadyCycles(design, *(each.transpose(1, 0, 2).reshape(POINTS, -1) for each in signals))

    def _uniform(self, values: Floats) -> Floats:
        """Values on pieces (POINTS, designs · pieces) as those of designs with as many each."""
        return values.reshape(POINTS, -1, self.pieces).transpose(1, 0, 2)

    def number(self, part: Summary) -> tuple[Floats, Flags]:
        """A number (designs,), and of which designs it is certain; NaN where the driver does no work."""
        size, speeds = self._speeds(part)
        largest_torque = np.abs(self.torque).max(axis=(1, 2))
        with np.errstate(invalid="ignore"):
            value = np.where(
                np.abs(self.mean) > NOTHING * largest_torque, self._value(part, size, speeds), np.nan
            )
            met = speeds.rough <= SMOOTH
            for signal, most in (
                (self.torque, largest_torque),
                (self.inertia, self.inertia.max(axis=(1, 2))),
            ):
                met &= np.abs(TO_LAST.T @ signal).max(axis=(1, 2)) <= SMOOTH * most
        return value, met

    def weights(self, part: Summary) -> dict[str, Floats]:
        """Weights (designs, n) of the signals at the Gauss points in a number, by the names of their fields, and what
        the number is beside their sum; they change the number by what is of second order."""
        size, speeds = self._speeds(part)
        slopes = self.cycles.slopes(speeds, *_SIDES[part.kind])
        if part.kind == "size":
            with np.errstate(divide="ignore"):
                scale = np.where(size > 0.0, -1.0 / slopes.flywheel, 0.0)
        else:
            scale = np.full(len(size), 1.0 if part.kind == "fluctuation" else self.speed)
        found = self._by_signals(part, slopes, size, scale)
        signals = (self.sense * self.torque, self.inertia, self.share)
        rest = self._value(part, size, speeds)
        for weight, signal in zip(found.values(), signals, strict=True):
            rest = rest - np.einsum("dip,dip->d", weight, signal)
        found[REST] = np.zeros_like(self.share)
        found[REST][:, 0, 0] = rest
        return {f"{part.name} {name}": weight.reshape(len(size), -1) for name, weight in found.items()}

    def _value(self, part: Summary, size: Floats, speeds: Speeds) -> Floats:
        if part.kind == "size":
            return size
        if part.kind == "fluctuation":
            return speeds.fluctuation
        return np.asarray(self.speed * (speeds.fastest if part.kind == "fastest" else speeds.slowest)[2])

    def _speeds(self, part: Summary) -> tuple[Floats, Speeds]:
        """The flywheels, and the speeds with them."""
        key = Summary(part.output, "size" if part.kind == "size" else "")
        if key not in self._known:
            fluctuation = required(part)
            size = np.zeros(len(self.mean)) if fluctuation is None else self._by_formula(fluctuation)
            if part.kind == "size" and fluctuation is not None:
                size = self.cycles.flywheel(fluctuation, size)
            self._known[key] = size, self.cycles.at(size)
        return self._known[key]

    def _by_formula(self, fluctuation: float) -> Floats:
        own = np.einsum("dip,dip->d", self.share, self.inertia)
        energy = self._highest[2] + self._lowest[2]
        return np.asarray(np.maximum(energy / (fluctuation * self.speed**2) - own, 0.0))

    @cached_property
    def _highest(self) -> Peak:
        return largest(self.work, self.work.max(axis=1))

    @cached_property
    def _lowest(self) -> Peak:
        return largest(-self.work, -self.work.min(axis=1))

    def _by_signals(self, part: Summary, slopes: Slopes, size: Floats, scale: Floats) -> dict[str, Floats]:
        """Derivatives by the effort, the inertia and the share of every Gauss point."""
        excess, inertia, share = (
            scale[:, None, None] * self._uniform(each)
            for each in (slopes.excess, slopes.inertia, slopes.share)
        )
        work, inertia = self.lift * excess, inertia + excess
        fluctuation = required(part)
        if part.kind != "size" and fluctuation is not None:
            by_size = np.where(size > 0.0, scale * slopes.flywheel, 0.0)
            rows, scale = np.arange(len(size)), by_size / (fluctuation * self.speed**2)
            for sign, (piece, place, _, _) in ((1.0, self._highest), (-1.0, self._lowest)):
                work[rows, :, piece] += sign * scale[:, None] * weights_at(place)
            inertia = inertia - by_size[:, None, None] * self.share
            share = share - by_size[:, None, None] * self.inertia
        gained = UP_TO.T @ work
        whole = work.sum(axis=1)
        gained += (whole.sum(axis=1, keepdims=True) - np.cumsum(whole, axis=1))[:, None, :]
        mean = np.einsum("dip,dip->d", gained, self.share)[:, None, None]
        torque = self.way * self.share * (mean - gained)
        share = share + self.way * (gained * (self.mean[:, None, None] - self.torque) + mean * self.torque)
        return {EFFORT: self.sense * torque, INERTIA: inertia, SHARE: share}
