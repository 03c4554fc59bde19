"""Motor power from the mean torque of a cycle."""

from __future__ import annotations

from dataclasses import dataclass

from linkwright.core.arguments import real
from linkwright.errors import RequestError
from linkwright.words import _


@dataclass(frozen=True)
class Motor:
    """``mean_torque`` N·m on the input and ``mean_power`` W there; ``power`` W that the motor must have."""

    mean_torque: float
    mean_power: float
    efficiency: float
    margin: float

    @property
    def power(self) -> float:
        """margin · mean power / efficiency, W."""
        return self.margin * self.mean_power / self.efficiency


def motor(mean_torque: float, speed: float, *, efficiency: float = 1.0, margin: float = 1.0) -> Motor:
    """Motor for a mean torque (N·m) at a speed (rad/s) of the input.

    ``efficiency`` of everything between motor and input, above 0 and up to 1; ``margin`` ≥ 1 on the power.
    Raises LinkwrightError for values out of range.
    """
    if not 0 < real("efficiency", efficiency) <= 1:
        raise RequestError(
            _(
                "the efficiency is {efficiency:g}; give a value above 0 and up to 1",
                code="running.bad_efficiency",
                efficiency=efficiency,
            )
        )
    if not real("margin", margin) >= 1:
        raise RequestError(
            _(
                "the margin on the motor's power is {margin:g}; give 1 or more",
                code="running.bad_margin",
                margin=margin,
            )
        )
    return Motor(mean_torque, mean_torque * speed, efficiency, margin)
