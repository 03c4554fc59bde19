"""Function generators of least structural error, from many random starts at once.

The structural error is what the output deviates from the demand at each input. A free zero of the output is its best
constant, a free scale its best factor: both by linear regression inside the residual, so that the iteration knows
only the linkage's own numbers.
"""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Floats, Whole
from linkwright.core.dataclass import dataclass
from linkwright.synthesis.function_generation.generators import Generator
from linkwright.synthesis.least_squares import minimise, with_differences

TRIED, KEPT, LEFT, STEPS = 12_000, 240, 24, 120
#: Residual per unit of what is missing to assemble a position.
PENALTY = 3.0


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


def fit(
    generator: Generator, demand: FunctionDemand, rng: np.random.Generator
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
        return np.asarray(off + PENALTY * demand.size * run.missing)

    first = residual_of(x, signs)
    best = np.argsort(np.einsum("ki,ki->k", first, first))[:KEPT]
    x, signs = x[best], signs[best]

    def residual(part: Floats, who: Whole) -> Floats:
        values = x[who].copy()
        values[:, free] = part
        return residual_of(values, signs[who])

    found, f, who = minimise(with_differences(residual), x[:, free], steps=STEPS, keep=LEFT, halve=15)
    values = x[who].copy()
    values[:, free] = found
    return values, signs[who], f


def column_of_zero(generator: Generator) -> int:
    """Column of the input's zero angle among a generator's numbers."""
    return 4 if generator.name == "geared_five_bar" else 3
