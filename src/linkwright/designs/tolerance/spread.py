"""Spread of summaries and curves among many machines: linear by exact derivatives, Monte Carlo through the engine."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.analysis.by_name import wanted
from linkwright.core.arrays import Floats, Integers
from linkwright.cycle.summaries import Summary
from linkwright.designs.metrics_of_designs import OF_VALUES
from linkwright.designs.sensitivity import CURVE, Sensitivity, sensitivity
from linkwright.designs.sweep import Sweep, sweep, sweep_curves
from linkwright.designs.tolerance.pins import TrackedPins, is_position, require_forces, shifts, track_pins
from linkwright.designs.tolerance.problem import Limit, Tolerances
from linkwright.errors import LinkwrightError
from linkwright.kinetostatics.forces import Forces
from linkwright.mechanism.mechanism import Mechanism

#: Shares of a normal distribution at ±3σ.
QUANTILES = (0.00135, 0.99865)
#: Bins per position in which machines are counted, and how far they reach, in linear standard deviations; values
#: beyond count in the last bins.
BINS, REACH = 2048, 8.0


@dataclass(frozen=True)
class CurveSpread:
    """A curve among machines, (n,) each, SI: mean, standard deviation, minimum and maximum, and the values that
    0.135 % and 99.865 % of the machines stay below (±3σ of a normal distribution), within 1/128 of the linear σ."""

    mean: Floats
    deviation: Floats
    minimum: Floats
    maximum: Floats
    low: Floats
    high: Floats
    machines: int

    def moved(self, shift: Floats) -> CurveSpread:
        """The same about other values."""
        places = (self.mean + shift, self.minimum + shift, self.maximum + shift, self.low + shift, self.high + shift)
        mean, minimum, maximum, low, high = places
        return CurveSpread(mean, self.deviation, minimum, maximum, low, high, self.machines)


class Counted:
    """Machines' values of one curve, counted: sums, extremes and bins per position."""

    def __init__(self, middle: Floats, sigma: Floats) -> None:
        self.middle = middle
        self.width = np.where(sigma > 0.0, sigma, np.abs(middle) + 1.0) * (2.0 * REACH / BINS)
        self.count = 0
        self.sums = np.zeros((2, len(middle)))
        self.minimum, self.maximum = np.full(len(middle), np.inf), np.full(len(middle), -np.inf)
        self.bins: Integers = np.zeros((len(middle), BINS), dtype=np.int64)

    def add(self, values: Floats) -> None:
        """Counts curves of more machines, (machines, n)."""
        away = values - self.middle
        self.count += len(values)
        self.sums += away.sum(axis=0), (away * away).sum(axis=0)
        self.minimum, self.maximum = (
            np.minimum(self.minimum, values.min(axis=0)),
            np.maximum(self.maximum, values.max(axis=0)),
        )
        place = np.clip(away / self.width + BINS / 2, 0, BINS - 1).astype(np.int64)
        place += BINS * np.arange(len(self.middle))
        self.bins += np.bincount(place.ravel(), minlength=self.bins.size).reshape(self.bins.shape)

    def spread(self, shares: tuple[float, float]) -> CurveSpread:
        """What the machines counted so far show."""
        mean = self.sums[0] / self.count
        variance = np.maximum(self.sums[1] - self.count * mean * mean, 0.0) / max(self.count - 1, 1)
        low, high = (self._quantile(share) for share in shares)
        return CurveSpread(self.middle + mean, np.sqrt(variance), self.minimum, self.maximum, low, high, self.count)

    def _quantile(self, share: float) -> Floats:
        """The value that a share of the machines stays below, even within each bin, (n,)."""
        below = np.cumsum(self.bins, axis=1)
        wanted, rows = share * self.count, np.arange(len(self.middle))
        place = (below < wanted).sum(axis=1).clip(0, BINS - 1)
        before = below[rows, place] - self.bins[rows, place]
        part = (wanted - before) / np.maximum(self.bins[rows, place], 1)
        found = self.middle + (place + part - BINS / 2) * self.width
        return np.asarray(np.clip(found, self.minimum, self.maximum))


def curve_spreads(
    mechanism: Mechanism,
    drawn: Mapping[str, Floats],
    expected: Mapping[str, tuple[Floats, Floats]],
    steps: int,
    shares: tuple[float, float],
) -> dict[str, CurveSpread]:
    """Curves of all machines ``drawn`` that pass the cycle; ``expected``: their nominal values and linear σ (n,)."""
    counted = {name: Counted(middle, sigma) for name, (middle, sigma) in expected.items()}
    names: Sequence[str] = tuple(expected)
    for _, values in sweep_curves(mechanism, drawn, outputs=names, steps=steps):
        for name, curves in values.items():
            passed = np.isfinite(curves).all(axis=1)
            if passed.any():
                counted[name].add(curves[passed])
    return {name: each.spread(shares) for name, each in counted.items() if each.count}


@dataclass(frozen=True)
class Share:
    """What a dimension or clearance contributes: derivative, its own standard deviation, part of the variance."""

    name: str
    slope: float
    deviation: float
    share: float


@dataclass(frozen=True, repr=False)
class SpreadNumbers:
    """The numbers of a tolerance study, each computed when it is first asked for, SI."""

    study: Tolerances

    @property
    def _curves(self) -> tuple[str, ...]:
        """Outputs over the positions: the curves, and those whose summaries pressed pins shift."""
        shifted = (s.output for s in self.summaries.values() if self.study.holes("pressed"))
        return tuple(dict.fromkeys([*self.study.curves, *shifted]))

    @cached_property
    def summaries(self) -> dict[str, Summary]:
        """The summaries by their texts."""
        return {text: wanted([text])[0] for text in self.study.of}

    @property
    def addresses(self) -> list[str]:
        """Everything that varies, in the prepared mechanism."""
        holes = [a for kind in ("free", "pressed") for pair in self.study.holes(kind).values() for a in pair]
        return [*self.study.deviating, *(a for a in holes if a not in self.study.deviating)]

    @cached_property
    def gradients(self) -> Sensitivity:
        """Exact derivatives of summaries of the cycle."""
        asked = [summary.name for summary in self.summaries.values()]
        return sensitivity(self.study.prepared, of=asked, by=self.addresses)

    @cached_property
    def derivatives(self) -> Sensitivity:
        """Exact derivatives of curves."""
        curves = [(output, CURVE) for output in self._curves]
        return sensitivity(self.study.prepared, of=curves, by=self.addresses, steps=self.study.steps)

    @cached_property
    def forces(self) -> Forces:
        """Forces of the nominal mechanism, which press the pins."""
        return require_forces(self.study)

    @cached_property
    def tracked_pins(self) -> TrackedPins:
        """The pins led by their own reactions over the cycle, for rates and forces."""
        return track_pins(self.study, self.forces)

    def nominal(self, text: str) -> float:
        """A summary of the nominal mechanism without clearances."""
        return self.gradients.values[self.summaries[text]]

    def dimension(self, text: str) -> str:
        """Name of the dimension of a summary or a curve."""
        summary = self.summaries.get(text)
        if summary is not None and not summary.kind:
            assert self.swept is not None
            return self.swept.dimension(summary)
        if summary is None:
            return self.derivatives.quantities[text].dimension
        return self.gradients.quantities[summary.output].dimension

    def shares(self, text: str) -> list[Share]:
        """What contributes to the linear spread of a summary, the largest first."""
        gradient = self.gradients.by_name(self.summaries[text].name)
        parts = {
            self.study.written(address): (gradient[address], tolerance.deviation)
            for address, tolerance in self.study.deviating.items()
        }
        for pin, pair in self.study.holes("free").items():
            slope = math.hypot(*(gradient[address] for address in pair))
            parts[pin] = (slope, self.study.clearances[pin].clearance / math.sqrt(2))
        total = sum((slope * deviation) ** 2 for slope, deviation in parts.values())
        found = [
            Share(name, slope, deviation, (slope * deviation) ** 2 / total if total else 0.0)
            for name, (slope, deviation) in parts.items()
        ]
        return sorted(found, key=lambda each: -each.share)

    def linear(self, text: str) -> float:
        """Linear standard deviation of a summary."""
        return math.sqrt(sum((each.slope * each.deviation) ** 2 for each in self.shares(text)))

    def worst_case(self, text: str) -> float:
        """Σ |∂y/∂p|·t: the largest deviation if all tolerances are used up at once."""
        gradient = self.gradients.by_name(self.summaries[text].name)
        total = sum(abs(gradient[a]) * t.tolerance for a, t in self.study.deviating.items())
        for pin, pair in self.study.holes("free").items():
            total += math.hypot(*(gradient[a] for a in pair)) * self.study.clearances[pin].clearance
        return total

    def curve(self, output: str) -> tuple[Floats, Floats, Floats]:
        """Input (n,), nominal curve shifted by the pressed pins (n,), its linear standard deviation (n,)."""
        variance = np.zeros(len(self.derivatives.curve(output)))
        for address, tolerance in self.study.deviating.items():
            variance += (self.derivatives.slope(output, address) * tolerance.deviation) ** 2
        for pin, pair in self.study.holes("free").items():
            size = self.study.clearances[pin].clearance / math.sqrt(2)
            for address in pair:
                variance += (self.derivatives.slope(output, address) * size) ** 2
        moved = self.derivatives.curve(output) + self.pressed(output)
        return self.derivatives.input, moved, np.sqrt(variance)

    def pressed(self, output: str) -> Floats:
        """Change (n,) of an output by all pressed pins: of a position to first order; of rates and forces with the
        pins led over the cycle, NaN where they cannot follow. Zero where no pin is pressed."""
        count = len(self.derivatives.input)
        if not self.study.holes("pressed"):
            return np.zeros(count)
        if not is_position(self.study, output):
            return self.tracked_pins.curve(output) - self.derivatives.curve(output)
        return shifts(self.study, lambda address: self.derivatives.slope(output, address), self.forces)

    def shift(self, text: str) -> float:
        """Change of a summary by all pressed pins; NaN where rates and forces cannot follow."""
        summary = self.summaries[text]
        if not self.study.holes("pressed"):
            return 0.0
        curve = self.derivatives.curve(summary.output)
        moved, found = curve + self.pressed(summary.output), OF_VALUES[summary.kind]
        return float(found(moved) - found(curve)) if np.isfinite(moved).all() else math.nan

    @cached_property
    def drawn(self) -> dict[str, Floats]:
        """Values (samples,) of everything that varies, by address in the prepared mechanism."""
        from scipy.stats import qmc

        free, nominal = self.study.holes("free"), self.study.prepared.dimensions()
        dimensions = len(self.study.deviating) + len(free)
        power = max(self.study.samples - 1, 1).bit_length()
        even = qmc.Sobol(max(dimensions, 1), seed=self.study.seed).random_base2(power)[: self.study.samples].T
        even = np.clip(even, 1e-12, 1 - 1e-12)
        found = {
            address: nominal[address] + tolerance.values(share)
            for (address, tolerance), share in zip(self.study.deviating.items(), even, strict=False)
        }
        for (pin, (x, y)), share in zip(free.items(), even[len(self.study.deviating) :], strict=False):
            size = self.study.clearances[pin].clearance
            for address, part in ((x, np.cos(2 * math.pi * share)), (y, np.sin(2 * math.pi * share))):
                found[address] = found.get(address, nominal[address]) + size * part
        return found

    @cached_property
    def swept(self) -> Sweep | None:
        """The drawn machines through the engine; None where nothing spreads or no summary is asked."""
        if not self.drawn or not self.summaries:
            return None
        asked = [summary.name for summary in self.summaries.values()]
        return sweep(self.study.prepared, self.drawn, outputs=asked)

    @cached_property
    def curves(self) -> dict[str, CurveSpread]:
        """Every curve among the drawn machines, shifted by the pressed pins; empty where nothing spreads."""
        if not self.drawn or not self.study.curves:
            return {}
        expected = {}
        for output in self.study.curves:
            expected[output] = self.derivatives.curve(output), self.curve(output)[2]
        found = curve_spreads(self.study.prepared, self.drawn, expected, self.study.steps, QUANTILES)
        return {output: spread.moved(self.pressed(output)) for output, spread in found.items()}

    def values(self, text: str) -> Floats:
        """A summary of the machines that pass the cycle, shifted by pressed pins, (machines,)."""
        if self.swept is None:
            return np.array([self.nominal(text) + self.shift(text)])
        summary, shift = self.summaries[text], self.shift(text)
        passing = self.swept[summary.name][self.swept.ok]
        return np.asarray(passing + (0.0 if math.isnan(shift) else shift))

    def monte_carlo(self, text: str) -> float:
        """Standard deviation of a summary among the machines."""
        values = self.values(text)
        return float(values.std(ddof=1)) if len(values) > 1 else 0.0

    @property
    def failed(self) -> int:
        """Machines that do not pass the cycle."""
        return 0 if self.swept is None else int((~self.swept.ok).sum())

    def ratio(self, text: str) -> float:
        """Monte Carlo over linear standard deviation; NaN where the linear one is zero."""
        linear = self.linear(text)
        return self.monte_carlo(text) / linear if linear else math.nan

    def passed(self, text: str) -> tuple[float, float, float, float]:
        """Yield: share of machines within the limits of a summary, ends of its 95 % interval (Clopper and Pearson),
        and the share of the linear normal distribution."""
        from scipy import stats

        limit = self.study.limits[text]
        values, count = self.values(text), max(len(self.values(text)) + self.failed, 1)
        good = int(((values >= limit.lower) & (values <= limit.upper)).sum())
        low = float(stats.beta.ppf(0.025, good, count - good + 1)) if good else 0.0
        high = float(stats.beta.ppf(0.975, good + 1, count - good)) if good < count else 1.0
        return good / count, low, high, self._normal(text, limit)

    def _normal(self, text: str, limit: Limit) -> float:
        from scipy import stats

        shift = self.shift(text)
        middle, sigma = self.nominal(text) + (0.0 if math.isnan(shift) else shift), self.linear(text)
        if not sigma:
            return float(limit.lower <= middle <= limit.upper)
        return float(stats.norm.cdf((limit.upper - middle) / sigma) - stats.norm.cdf((limit.lower - middle) / sigma))

    @cached_property
    def closeness(self) -> tuple[float, float] | None:
        """Minimum closeness over the nominal cycle (0 at a dead point), and the input there; None if not known."""
        address = self.addresses[0]
        one = {address: np.array([self.study.prepared.dimension(address)])}
        asked = [("closeness", "min"), ("closeness", "argmin")]
        try:
            found = sweep(self.study.prepared, one, outputs=asked)
        except LinkwrightError:
            return None
        return float(found["closeness", "min"][0]), float(found["closeness", "argmin"][0])

    def bend(self, text: str) -> tuple[str, float]:
        """The largest contributor, and how much the summary bends over ±2σ of it: |y₊ + y₋ − 2y₀|/|y₊ − y₋|."""
        summary = self.summaries[text]
        deviations = {
            a: (t.deviation, abs(self.gradients.by_name(summary.name)[a]) * t.deviation)
            for a, t in self.study.deviating.items()
        }
        for pair in self.study.holes("free").values():
            for a in pair:
                size = self.study.clearances[a.split(".")[-2]].clearance / math.sqrt(2)
                deviations[a] = size, abs(self.gradients.by_name(summary.name)[a]) * size
        address = max(deviations, key=lambda a: deviations[a][1])
        at = self.study.prepared.dimension(address) + deviations[address][0] * np.array([-2.0, 0.0, 2.0])
        found = sweep(self.study.prepared, {address: at}, outputs=[summary.name])[summary.name]
        low, middle, high = found.tolist()
        change = abs(high - low)
        return self.study.written(address), abs(high + low - 2 * middle) / change if change else math.inf

    @property
    def turning(self) -> bool:
        """Whether the input is an angle."""
        from linkwright.kinematics.cycle import over_cycle

        return bool(next(iter(over_cycle(self.study.mechanism, 1).rotary.values()), True))
