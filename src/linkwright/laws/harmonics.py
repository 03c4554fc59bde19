"""Laws of cosines, of a straight line and sines of integer orders, and those that are known by a name."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import pi
from typing import Any, ClassVar

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.fields.base import Quantity, file_key
from linkwright.laws.base import MOTION_LAWS, MeetingLaw, MotionLaw


def sines(u: Any, shares: Sequence[tuple[int, float]]) -> tuple[Any, Any, Any, Any]:
    """s = u - Σ b sin(2πku)/(2πk) with its derivatives, for (k, b) in ``shares``; Σ b = 1 begins and ends at rest."""
    s, v = u + 0.0, 0.0 * u + 1.0
    a, j = 0.0 * u, 0.0 * u
    for order, share in shares:
        w = 2 * pi * order
        sine, cosine = np.sin(w * u), np.cos(w * u)
        s, v = s - share * sine / w, v - share * cosine
        a, j = a + share * w * sine, j + share * w * w * cosine
    return s, v, a, j


def two_sines(first: str, third: str) -> str:
    """The formula of a law with sines of the orders 1 and 3, by their shares."""
    sine = "(sin({0}πu))/({0}π)"
    return f"u-{first}{sine.format(2)}-{third}{sine.format(6)}"


@MOTION_LAWS.register("cycloidal")
@dataclass(frozen=True)
class Cycloidal(MotionLaw):
    """s = u - sin(2πu)/(2π): sine acceleration, from rest to rest; in VDI 2143 the inclined sine of Bestehorn."""

    source: ClassVar[str] = "Rothbart, Cam Design Handbook, ch. 2; VDI 2143-1"
    formula = "u-(sin(2πu))/(2π)"

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        return sines(u, ((1, 1.0),))


@MOTION_LAWS.register("inclined_sine")
@dataclass(frozen=True)
class InclinedSine(MotionLaw):
    """s = u - (1 - v) sin(2πu)/(2π): the inclined sine of Bestehorn between equal velocities v, by default 0."""

    source: ClassVar[str] = "VDI 2143-1"
    velocity: float = file_key(Quantity("dimensionless", doc="velocity at both ends, 0"), 0.0)

    @property
    def formula(self) -> str:
        share = f"{1 - self.velocity:.6g}" if self.velocity else ""
        return f"u-{share}(sin(2πu))/(2π)"

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        return sines(u, ((1, 1.0 - self.velocity),))


@MOTION_LAWS.register("gutman")
@dataclass(frozen=True)
class Gutman(MotionLaw):
    """s = u - (15/16) sin(2πu)/(2π) - (1/16) sin(6πu)/(6π): first and third order."""

    formula = two_sines("15/16", "1/16")
    source: ClassVar[str] = "A. S. Gutman, To avoid vibration try this new cam profile, Product Engineering, 1961"

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        return sines(u, ((1, 15 / 16), (3, 1 / 16)))


@MOTION_LAWS.register("freudenstein")
@dataclass(frozen=True)
class Freudenstein(MotionLaw):
    """s = u - (27/28) sin(2πu)/(2π) - (1/28) sin(6πu)/(6π): of the first and third order, with the minimum
    acceleration."""

    formula = two_sines("27/28", "1/28")
    source: ClassVar[str] = "F. Freudenstein, On the dynamics of high-speed cam profiles, IJMS 1, 1960"

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        return sines(u, ((1, 27 / 28), (3, 1 / 28)))


@MOTION_LAWS.register("freudenstein_135")
@dataclass(frozen=True)
class Freudenstein135(MotionLaw):
    """s = u - (1125/1192)(sin(2πu) + sin(6πu)/54 + sin(10πu)/1250)/(2π): orders 1, 3 and 5."""

    source: ClassVar[str] = "F. Freudenstein, On the dynamics of high-speed cam profiles, IJMS 1, 1960"

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        m = 1125 / 1192
        return sines(u, ((1, m), (3, m / 18), (5, m / 250)))


@MOTION_LAWS.register("triple_harmonic")
@dataclass(frozen=True)
class TripleHarmonic(MotionLaw):
    """Acceleration a = A₁ sin 2πu + A₂ sin 4πu + A₃ sin 6πu from rest to rest, so that A₁ + A₂/2 + A₃/3 = 2π.

    By default A₁ = 9π/4 and A₂ = 0: the jerk is then zero at both ends and in the middle.
    """

    source: ClassVar[str] = "Reeve, Cams for Industry, 1995"
    first: float = file_key(
        Quantity("dimensionless", doc="amplitude A₁ of the acceleration; default 9π/4"), 9 * pi / 4
    )
    second: float = file_key(Quantity("dimensionless", doc="amplitude A₂; default 0; A₃ follows"), 0.0)

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        one, two = self.first / (2 * pi), self.second / (4 * pi)
        return sines(u, ((1, one), (2, two), (3, 1.0 - one - two)))


@MOTION_LAWS.register("simple_harmonic")
@dataclass(frozen=True)
class SimpleHarmonic(MotionLaw):
    """s = (1 - cos πu)/2: turns at both ends; next to a dwell the acceleration jumps."""

    source: ClassVar[str] = "Rothbart, Cam Design Handbook, ch. 2"
    formula = "(1-cos(πu))/2"

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        c, s = np.cos(pi * u), np.sin(pi * u)
        return 0.5 - 0.5 * c, 0.5 * pi * s, 0.5 * pi**2 * c, -0.5 * pi**3 * s


@MOTION_LAWS.register("double_harmonic")
@dataclass(frozen=True)
class DoubleHarmonic(MotionLaw):
    """s = (1 - cos πu)/2 - (1 - cos 2πu)/8: from rest to a turn, for a rise that a fall follows at once."""

    source: ClassVar[str] = "Rothbart, Cam Design Handbook, ch. 3"
    formula = "(1-cos(πu))/2-(1-cos(2πu))/8"

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        c, s = np.cos(pi * u), np.sin(pi * u)
        c2, s2 = np.cos(2 * pi * u), np.sin(2 * pi * u)
        return (
            0.5 * (1 - c) - 0.125 * (1 - c2),
            0.5 * pi * s - 0.25 * pi * s2,
            0.5 * pi**2 * (c - c2),
            0.5 * pi**3 * (-s + 2 * s2),
        )


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
