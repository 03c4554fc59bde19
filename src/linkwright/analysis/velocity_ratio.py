"""Velocity ratio and mechanical advantage from the input to an output."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from math import nan
from typing import ClassVar

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Better, Metric, Number
from linkwright.core.outputs import RATIO
from linkwright.cycle.summaries import Summary, SummaryValue
from linkwright.formula.trace import Scalar, absolute, select
from linkwright.words import _

#: Of two sizes as large as each other the positive one counts, whatever rounding leaves.
_BUT_ROUNDING = 1.0 - 1e-12


#: An output is at rest where its ratio, as that of the machine's sizes, is nowhere larger.
_STANDING = 1e-12


def _largest(negligible: float, high: Scalar, low: Scalar) -> Scalar:
    found = select(absolute(high) >= _BUT_ROUNDING * absolute(low), high, low)
    return select(absolute(found) > negligible, found, np.float64(0.0))


def _advantage(negligible: float, high: Scalar, low: Scalar) -> Scalar:
    return 1.0 / absolute(_largest(negligible, high, low))


def _place(negligible: float, high: SummaryValue, low: SummaryValue) -> float:
    if max(abs(high.value), abs(low.value)) <= negligible:
        return nan
    return high.input if abs(high.value) >= _BUT_ROUNDING * abs(low.value) else low.input


@METRICS.register("velocity_ratio")
class VelocityRatio(Metric):
    """The output's rate over the input's where it is largest in size; negative where they turn against each other."""

    label = _("largest velocity ratio")
    meaning = _("Rate of the output over rate of the input where it is largest in size.")

    rank = 3.5
    dimension = "dimensionless"
    source = "Norton, Design of Machinery, sec. 6.4"
    formula = staticmethod(_largest)

    def suits(self, analysis: Analysis) -> bool:
        if len(analysis.motion.mechanism.drivers) != 1 or not analysis.outputs:
            return False
        return bool((np.abs(analysis.input_rate) > 0).all())

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for output in analysis.outputs:
            parts = tuple(Summary(f"velocity_ratio {output.owner}", kind) for kind in ("max", "min"))
            kinds = output.dimension, analysis.input_dimension
            sizes = [analysis.motion.mechanism.size if kind == "length" else 1.0 for kind in kinds]
            negligible = _STANDING * sizes[0] / sizes[1]
            formula, place = partial(self.formula, negligible), partial(_place, negligible)
            yield Number(str(output), parts, formula, self.ratio(*kinds), place)

    def ratio(self, output: str, input_: str) -> str:
        """Name of the dimension."""
        return RATIO[output, input_]


@METRICS.register("mechanical_advantage")
class MechanicalAdvantage(VelocityRatio):
    """Smallest output force (torque) per input torque (force) without losses: 1/|velocity ratio|."""

    label = _("smallest mechanical advantage")
    meaning = _("Output force or torque per input torque or force without losses, where it is smallest.")

    source = "Norton, Design of Machinery, sec. 6.4: power in equals power out"
    better: ClassVar[Better | None] = "higher"
    formula = staticmethod(_advantage)

    def ratio(self, output: str, input_: str) -> str:
        return RATIO[input_, output]
