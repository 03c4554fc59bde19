"""Function generators of minimum structural error, from many random starts at once.

The structural error is what the output deviates from the demand at each input. A free zero of the output is its best
constant, a free scale its best factor: both by linear regression inside the residual, so that the iteration knows
only the linkage's own numbers.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Flags, Floats, Integers
from linkwright.core.progress import Progress
from linkwright.synthesis.function_generation.generators import Generator, TurningFourBar
from linkwright.synthesis.least_squares import minimise, with_differences
from linkwright.synthesis.result import Candidate

TRIED, SELECTED, LEFT, STEPS = 12_000, 240, 24, 120
#: Residual per unit of what is missing to assemble a position.
PENALTY = 3.0
#: Inputs of a range at which the demanded transmission angle is held, and by how much more of its sin² is aimed at:
#: the optimum, which yields a little, then has it.
HELD, MARGIN = 48, 1e-3
#: Residual per unit of sin² that is missing: the next one where no optimum has the angle with the one before.
HOLDS = (5.0, 40.0, 300.0)


@dataclass(frozen=True, eq=False)
class FunctionDemand:
    """Inputs (n,) rad and outputs (n,) rad or m.

    ``input_zero``, ``output_zero``: given, or None where free; ``scale``: whether the output may be scaled.
    """

    inputs: Floats
    outputs: Floats
    input_zero: float | None
    output_zero: float | None
    scale: bool = False

    @property
    def size(self) -> float:
        """Range of the outputs."""
        return float(np.ptp(self.outputs)) or 1.0

    def matched(self, output: Floats) -> tuple[Floats, Floats, Floats]:
        """Deviations (K, n) of outputs from the demand in its units, and the constant and factor (K,) taken out.

        demanded ≈ constant + factor · output.
        """
        y = self.outputs
        factor = np.ones(len(output))
        if self.scale:
            mean = output.mean(1, keepdims=True)
            spread = ((output - mean) ** 2).sum(1) + 1e-300
            factor = ((output - mean) * (y - y.mean())).sum(1) / spread
        if self.output_zero is None:
            constant = y.mean() - factor * output.mean(1)
        else:
            turn = np.round((y.mean() + self.output_zero - output.mean(1)) / (2 * np.pi)) * 2 * np.pi
            constant = turn - self.output_zero
        return constant[:, None] + factor[:, None] * output - y, constant, factor


@dataclass(frozen=True)
class Quality:
    """Demands besides a small error: an input that turns fully, a smallest transmission angle (rad)."""

    turning: bool = False
    transmission: float = 0.0

    def met(self, turns: Flags, transmission: Floats) -> Flags:
        """Which linkages have it."""
        return np.asarray((turns | (not self.turning)) & (transmission >= self.transmission - 1e-9))

    def reached(self, turns: Flags, transmission: Floats) -> Floats:
        """The transmission angle, less half a turn where the input should turn and does not."""
        return np.asarray(np.where(turns | (not self.turning), transmission, transmission - np.pi))

    def of(self, each: Candidate) -> tuple[bool, float]:
        """Whether a candidate has it, and its ``reached``."""
        facts = np.array([each.turns]), np.array([each.transmission_angle])
        return bool(self.met(*facts)[0]), float(self.reached(*facts)[0])

    def missing(self, generator: Generator, x: Floats, signs: Floats, inputs: Floats) -> Floats:
        """By how much sin² of the angle is too small over the demanded range and, of a linkage that turns, over its
        full turn (K, r); (K, 0) where nothing is demanded, or all have it."""
        if isinstance(generator, TurningFourBar) or not (self.turning or self.transmission):
            return np.empty((len(x), 0))
        aim = min(np.sin(self.transmission) ** 2 + MARGIN, 1.0)
        turn = _square_sines(generator, x, signs, float(inputs.min()), generator.turn())
        lacking = np.maximum(aim - turn, 0.0)
        if self.turning:
            return np.asarray(lacking)
        within = _square_sines(generator, x, signs, float(inputs.min()), float(np.ptp(inputs)))
        turns = turn.min(1, keepdims=True) > 0
        return np.concatenate([np.maximum(aim - within, 0.0), np.where(turns, lacking, 0.0)], 1)


def _square_sines(generator: Generator, x: Floats, signs: Floats, first: float, length: float) -> Floats:
    """sin² of the smallest angle at HELD inputs of a range (K, HELD), at its dips at their bottom; below 0 where the
    linkage is not assembled."""
    run = generator.run(x, signs, first + np.linspace(0.0, length, HELD))
    square = run.sine**2 - run.missing**2 / 4
    before, after = square[:, :-2], square[:, 2:]
    bend, rise = before + after - 2 * square[:, 1:-1], after - before
    dip = np.abs(rise) < 2 * bend
    square[:, 1:-1] -= np.where(dip, rise**2 / np.where(dip, 8 * bend, 1.0), 0.0)
    return np.asarray(square)


def fit(
    generator: Generator,
    demand: FunctionDemand,
    quality: Quality,
    hold: float,
    rng: np.random.Generator,
    progress: Progress | None = None,
) -> tuple[Floats, Floats, Floats]:
    """Free numbers (K, m), signs (K, modes) and sums of squares (K,) of local optima, best first."""
    angle = column_of_zero(generator)
    x = generator.sample(rng, TRIED)
    if demand.input_zero is not None:
        x[:, angle] = demand.input_zero
    signs = rng.choice([-1.0, 1.0], (TRIED, generator.modes))
    scale = 1.0 if generator.output_is_angle else demand.size
    free = np.array([j for j in range(x.shape[1]) if demand.input_zero is None or j != angle])

    def residual_of(values: Floats, chosen: Floats) -> Floats:
        run = generator.run(values, chosen, demand.inputs)
        off = demand.matched(run.output * scale)[0]
        off = off + PENALTY * demand.size * run.missing
        held = quality.missing(generator, values, chosen, demand.inputs)
        return np.concatenate([off, hold * demand.size * held], 1)

    first = residual_of(x, signs)
    best = np.argsort(np.einsum("ki,ki->k", first, first))[:SELECTED]
    x, signs = x[best], signs[best]

    def residual(part: Floats, who: Integers) -> Floats:
        values = x[who].copy()
        values[:, free] = part
        return residual_of(values, signs[who])

    found, f, who = minimise(
        with_differences(residual), x[:, free], steps=STEPS, keep=LEFT, halve=15, progress=progress
    )
    values = x[who].copy()
    values[:, free] = found
    return values, signs[who], f


def column_of_zero(generator: Generator) -> int:
    """Column of the input's zero angle among a generator's numbers."""
    return 4 if generator.name == "geared_five_bar" else 3
