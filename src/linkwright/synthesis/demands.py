"""What every task checks of its demands."""

from __future__ import annotations

import math

from linkwright.synthesis.result import refuse


def whole(*, least: int = 1, **values: float) -> None:
    """Raises SynthesisError for the first value that is no whole number of ``least`` or more."""
    for name, value in values.items():
        if not (value == value and value >= least and float(value).is_integer()):
            raise refuse("not_whole", name=name, given=f"{value:g}", least=least)


def allowed_transmission(angle: float) -> None:
    """Raises SynthesisError for a smallest transmission angle (rad) outside [0, 90°)."""
    if not 0.0 <= angle < math.pi / 2 - 1e-6:
        raise refuse("transmission", given=f"{math.degrees(angle):g}")
