"""The family of accelerations that rise as a sine, stay constant, fall as a cosine and may rest at zero."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from functools import cached_property
from math import pi
from typing import Any, ClassVar

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.errors import RequestError
from linkwright.fields.base import Quantity, file_key
from linkwright.laws.base import MOTION_LAWS, MotionLaw
from linkwright.words import _

_SHARE = "dimensionless"


class Family(MotionLaw):
    """In each half the acceleration is A sin(πx/b), A, A cos(πx/d), 0 over b/2, c/2, d/2, p/2; b + c + d + p = 1."""

    source: ClassVar[str] = "Norton, Cam Design and Manufacturing Handbook, ch. 3 (SCCA)"

    @property
    @abstractmethod
    def shares(self) -> tuple[float, float, float, float]:
        """b, c, d, p."""

    @property
    def breaks(self) -> tuple[float, ...]:
        half = [float(each) for each in self._edges if 0.0 < each < 0.5]
        return tuple(sorted({*half, 0.5, *(1.0 - each for each in half)}))

    @cached_property
    def _edges(self) -> Floats:
        """Where the zones of the first half end, (4,)."""
        return np.minimum(0.5 * np.cumsum(self.shares), 0.5)

    @cached_property
    def _starts(self) -> tuple[list[float], list[float], float]:
        """Velocity and displacement at the beginnings of the zones for A = 1, and A."""
        b, c, d, p = self.shares
        v = [0.0, b / pi]
        s = [0.0, b / pi * (b / 2 - b / pi)]
        v.append(v[1] + c / 2)
        s.append(s[1] + v[1] * c / 2 + c * c / 8)
        v.append(v[2] + d / pi)
        s.append(s[2] + v[2] * d / 2 + (d / pi) ** 2)
        return v, s, 0.5 / (s[3] + v[3] * p / 2)

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        u = np.asarray(u)
        late = u.real > 0.5
        s, v, a, j = self._half(np.where(late, 1.0 - u, u))
        return np.where(late, 1.0 - s, s), v, np.where(late, -a, a), j

    def _half(self, x: Any) -> tuple[Any, Any, Any, Any]:
        b, _unused, d, _unused2 = self.shares
        v, s, size = self._starts
        last = int(np.flatnonzero(self.shares)[-1])
        zone = np.minimum(np.searchsorted(self._edges[:3], x.real, side="right"), last)
        y = x - np.concatenate([[0.0], self._edges[:3]])[zone]
        zones = [
            (b / pi * (y - b / pi * _sin(y, b)), b / pi * (1 - _cos(y, b)), _sin(y, b), _cos(y, b, 1)),
            (s[1] + v[1] * y + 0.5 * y * y, v[1] + y, 1.0 + 0.0 * y, 0.0 * y),
            (
                s[2] + v[2] * y + (d / pi) ** 2 * (1 - _cos(y, d)),
                v[2] + d / pi * _sin(y, d),
                _cos(y, d),
                -_sin(y, d, 1),
            ),
            (s[3] + v[3] * y, v[3] + 0.0 * y, 0.0 * y, 0.0 * y),
        ]
        found = (size * np.choose(zone, [each[order] for each in zones]) for order in range(4))
        return next(found), next(found), next(found), next(found)


def _sin(y: Any, share: float, order: int = 0) -> Any:
    return np.sin(pi * y / share) * (pi / share) ** order if share else 0.0 * y


def _cos(y: Any, share: float, order: int = 0) -> Any:
    return np.cos(pi * y / share) * (pi / share) ** order if share else 0.0 * y


@MOTION_LAWS.register("sine_constant_cosine")
@dataclass(frozen=True)
class SineConstantCosine(Family):
    """The law of shares b (``sine``), c (``constant``), d (``cosine``); what is left is p, of constant velocity.

    (1/4, 0, 3/4) is the modified sine, (1/4, 1/2, 1/4) the modified trapezoid, (1/2, 0, 1/2) the cycloidal law,
    (0, 0, 1) simple harmonic, (0, 1, 0) constant acceleration.
    """

    sine: float = file_key(Quantity(_SHARE, minimum=0.0, doc="share in which the acceleration builds up"))
    constant: float = file_key(Quantity(_SHARE, minimum=0.0, doc="share of constant acceleration"))
    cosine: float = file_key(Quantity(_SHARE, minimum=0.0, doc="share in which it fades"))

    def __post_init__(self) -> None:
        used = self.sine + self.constant + self.cosine
        if min(self.sine, self.constant, self.cosine) < 0 or not 0 < used <= 1 + 1e-12:
            raise RequestError(
                _(
                    "the shares of sine, constant and cosine add up to {total:.6g}; give shares of zero "
                    "or more with a sum of at most 1",
                    code="laws.shares",
                    total=used,
                )
            )

    @property
    def shares(self) -> tuple[float, float, float, float]:
        used = self.sine + self.constant + self.cosine
        return self.sine, self.constant, self.cosine, max(0.0, 1.0 - used)


@MOTION_LAWS.register("constant_acceleration")
@dataclass(frozen=True)
class ConstantAcceleration(Family):
    """Two parabolas, s = 2u² up to the middle: the minimum acceleration; it jumps."""

    shares = (0.0, 1.0, 0.0, 0.0)


@MOTION_LAWS.register("modified_sine")
@dataclass(frozen=True)
class ModifiedSine(Family):
    """The modified sine of Neklutin: little velocity and torque."""

    shares = (0.25, 0.0, 0.75, 0.0)


@MOTION_LAWS.register("modified_trapezoidal")
@dataclass(frozen=True)
class ModifiedTrapezoidal(Family):
    """The modified trapezoid of Neklutin: little acceleration."""

    shares = (0.25, 0.5, 0.25, 0.0)


def _between(p: float) -> tuple[float, float, float, float]:
    """Shares of a modified sine with a share p of constant velocity between its halves."""
    return 0.25 * (1 - p), 0.0, 0.75 * (1 - p), p


@MOTION_LAWS.register("modified_sine_cv20")
@dataclass(frozen=True)
class ModifiedSineCV20(Family):
    """A modified sine with one fifth of constant velocity in the middle."""

    shares = _between(1 / 5)


@MOTION_LAWS.register("modified_sine_cv33")
@dataclass(frozen=True)
class ModifiedSineCV33(Family):
    """A modified sine with one third of constant velocity in the middle."""

    shares = _between(1 / 3)


@MOTION_LAWS.register("modified_sine_cv50")
@dataclass(frozen=True)
class ModifiedSineCV50(Family):
    """A modified sine with one half of constant velocity in the middle."""

    shares = _between(1 / 2)


@MOTION_LAWS.register("modified_sine_cv66")
@dataclass(frozen=True)
class ModifiedSineCV66(Family):
    """A modified sine with two thirds of constant velocity in the middle."""

    shares = _between(2 / 3)
