"""Outputs that a model names itself: formulas of places and rates, ``gap: bed_guide - 180 mm*cylinder``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from linkwright.core.expressions import Expression
from linkwright.core.outputs import Output, rate_dimension


@dataclass(frozen=True)
class NamedOutput:
    """An output by a formula of the machine's places and rates, its parameters, and named outputs before it.

    ``dimension``: name of the dimension of its value; ``rates``: how many of its derivatives in time are known, 2 of
    a formula of places, 1 where velocities are in it, 0 where accelerations are.
    """

    name: str
    expression: Expression
    dimension: str
    rates: int

    @property
    def outputs(self) -> tuple[Output, ...]:
        """Its value and its rates as outputs of the machine."""
        found = [Output("named", self.name, measured=self.dimension)]
        while len(found) <= self.rates and rate_dimension(found[-1].dimension):
            found.append(found[-1].rate)
        return tuple(found)


def named_outputs(outputs: Mapping[str, NamedOutput]) -> dict[str, Output]:
    """Values and rates of named outputs as outputs, by the names they go by: ``gap``, ``gap.rate``."""
    return {each.name: each for named in outputs.values() for each in named.outputs}
