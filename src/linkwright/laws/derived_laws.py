"""Laws made from a law: backwards, a portion of it, its turning point moved."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from linkwright.errors import RequestError
from linkwright.laws.base import MotionLaw
from linkwright.words import _


@dataclass(frozen=True)
class Backwards(MotionLaw):
    """s(u) = 1 - S(1 - u): the ends change places."""

    key: ClassVar[str] = "backwards"
    source: ClassVar[str] = ""
    law: MotionLaw

    @property
    def breaks(self) -> tuple[float, ...]:
        return tuple(1.0 - each for each in reversed(self.law.breaks))

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        s, v, a, j = self.law.curves(1.0 - u)
        return 1.0 - s, v, -a, j


@dataclass(frozen=True)
class Portion(MotionLaw):
    """The part of a law from u = ``start`` to ``end`` as a law of its own: the first half of a law from rest to rest
    goes from rest to its velocity in the middle."""

    key: ClassVar[str] = "portion"
    source: ClassVar[str] = ""
    law: MotionLaw
    start: float
    end: float

    def __post_init__(self) -> None:
        if not 0.0 <= self.start < self.end <= 1.0 or abs(self._rise) < 1e-9:
            raise RequestError(
                _(
                    "the portion from u = {start:.6g} to {end:.6g} contains no rise; give two places from 0 "
                    "to 1 between which the law moves",
                    code="laws.portion",
                    start=self.start,
                    end=self.end,
                )
            )

    @property
    def _rise(self) -> float:
        s = np.asarray(self.law.curves(np.array([self.start, self.end]))[0], dtype=float)
        return float(s[1] - s[0])

    @property
    def breaks(self) -> tuple[float, ...]:
        width = self.end - self.start
        return tuple((each - self.start) / width for each in self.law.breaks if self.start < each < self.end)

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        width, scale = self.end - self.start, 1.0 / self._rise
        first = float(np.asarray(self.law.curves(np.array([self.start]))[0], dtype=float)[0])
        s, v, a, j = self.law.curves(self.start + width * u)
        return scale * (s - first), scale * width * v, scale * width**2 * a, scale * width**3 * j


@dataclass(frozen=True)
class Shifted(MotionLaw):
    """A symmetric law whose turning point lies at u = ``crossover`` (VDI 2143: λ): s = 2λ S(u/2λ) up to there."""

    key: ClassVar[str] = "shifted"
    source: ClassVar[str] = "VDI 2143-1"
    law: MotionLaw
    crossover: float

    def __post_init__(self) -> None:
        u = np.linspace(0.0, 0.5, 33)
        near, far = (np.asarray(self.law.curves(x), dtype=float) for x in (u, 1.0 - u))
        size = max(1.0, float(np.abs(near[1]).max()))
        uneven = max(np.abs(near[0] + far[0] - 1.0).max(), np.abs(near[1] - far[1]).max() / size)
        if not 0.05 <= self.crossover <= 0.95 or uneven > 1e-9:
            raise RequestError(
                _(
                    "the turning point cannot be moved to u = {crossover:.6g}; take a symmetric law and "
                    "a place from 0.05 to 0.95",
                    code="laws.crossover",
                    crossover=self.crossover,
                )
            )

    @property
    def breaks(self) -> tuple[float, ...]:
        c = self.crossover
        first = [2 * c * each for each in self.law.breaks if each < 0.5]
        last = [1 - 2 * (1 - c) * (1 - each) for each in self.law.breaks if each > 0.5]
        return (*first, c, *last)

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        u = np.asarray(u)
        late = u.real > self.crossover
        half = np.where(late, 1.0 - self.crossover, self.crossover)
        s, v, a, j = self.law.curves(np.where(late, 1.0 - (1.0 - u) / (2 * half), u / (2 * half)))
        s = np.where(late, 1.0 - 2 * half * (1.0 - s), 2 * half * s)
        return s, v, a / (2 * half), j / (2 * half) ** 2
