"""The harmonic combination: a line and two orders of sine and cosine that meet any velocity and acceleration."""

from __future__ import annotations

from functools import cached_property
from math import pi
from typing import Any, ClassVar

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.laws.base import MOTION_LAWS, MeetingLaw

#: Angular frequencies of the basis 1, u, cos πu, sin πu, cos 2πu, sin 2πu.
_PI = (pi, 2 * pi)


def _basis(u: Any) -> list[list[Any]]:
    """Derivatives 0 to 3 of the six functions."""
    none = 0.0 * u
    rows: list[list[Any]] = [[none + 1.0, u + none], [none, none + 1.0], [none, none], [none, none]]
    for w in _PI:
        c, s = np.cos(w * u), np.sin(w * u)
        for order, pair in enumerate(((c, s), (-s, c), (-c, -s), (s, -c))):
            rows[order] += [w**order * pair[0], w**order * pair[1]]
    return rows


@MOTION_LAWS.register("harmonic_combination")
@dataclass(frozen=True)
class HarmonicCombination(MeetingLaw):
    """s = c₀ + c₁u + c₂ cos πu + c₃ sin πu + c₄ cos 2πu + c₅ sin 2πu with any velocity and acceleration at the ends.

    From rest to rest it is the cycloidal law, from turn to turn with ±π²/2 simple harmonic, from rest to a turn with
    -π² double harmonic: the harmonic combinations of VDI 2143 for all sixteen pairs of ends.
    """

    source: ClassVar[str] = "VDI 2143-1"

    @cached_property
    def _coefficients(self) -> Floats:
        rows = [np.array(row, dtype=float) for row in _basis(np.array([0.0, 1.0]))[:3]]
        matrix = np.concatenate([row.T for row in rows])
        right = [0.0, self.rise, *self.demanded.velocity, *self.demanded.acceleration]
        return np.asarray(np.linalg.solve(matrix, right))

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        c = self._coefficients
        s, v, a, j = (sum(each * c[k] for k, each in enumerate(row)) for row in _basis(u))
        return s, v, a, j
