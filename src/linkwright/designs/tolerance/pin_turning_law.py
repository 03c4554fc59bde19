"""The law by which a pin turns in its hole: through given angles, smooth but for jumps."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.drivers.base import Law
from linkwright.drivers.table import TableLaw
from linkwright.fields.base import TimeTableValues

if TYPE_CHECKING:
    from scipy.interpolate import PPoly

    from linkwright.drivers.base import Array
    from linkwright.fields.base import Field


@dataclass(frozen=True)
class TurnedByReaction(Law):
    """q in rad through ``angles`` at equal times of a ``period`` (s), which repeats: a cubic spline on every arc
    between jumps after the positions ``jumps``. The error of its second derivative falls with the step squared."""

    key: ClassVar[str] = "turned"
    period: float
    angles: tuple[float, ...]
    jumps: tuple[int, ...] = ()
    rotary: bool = True
    spline: PPoly = field(init=False, repr=False, compare=False)
    drift: float = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        from scipy.interpolate import CubicSpline

        count, first = len(self.angles), self.jumps[0] + 1 if self.jumps else 0
        ordered = np.roll(np.array(self.angles), -first)
        turned: Floats = np.unwrap(np.append(ordered, ordered[0]))
        times: Floats = self.period / count * (first + np.arange(count + 1, dtype=np.float64))
        drift = 0.0 if self.jumps else (turned[-1] - turned[0]) / self.period
        if self.jumps:
            ends = [*(jump - first + 1 for jump in self.jumps[1:]), count]
            spline = _arcs(times, turned, ends)
        else:
            level = turned - drift * times
            level[-1] = level[0]
            spline = CubicSpline(times, level, bc_type="periodic")
        object.__setattr__(self, "spline", spline)
        object.__setattr__(self, "drift", drift)

    @classmethod
    def of(cls, angles: Array, jumps: Sequence[int], period: float) -> Self:
        """The law through ``angles`` (n,)."""
        return cls(period, tuple(angles.tolist()), tuple(jumps))

    def coordinate(self, t: Array) -> tuple[Array, Array, Array]:
        return self.spline(t) + self.drift * t, self.spline(t, 1) + self.drift, self.spline(t, 2)

    def natural_duration(self) -> float | None:
        return self.period

    @classmethod
    def fields(cls, rotary: bool) -> Mapping[str, Field]:
        return TableLaw.fields(rotary)

    @classmethod
    def from_values(
        cls, values: Mapping[str, object], rotary: bool, parameters: Mapping[str, float]
    ) -> TurnedByReaction:
        table = values["table"]
        assert isinstance(table, TimeTableValues)
        return cls(table.times[-1], table.positions[:-1])

    def text_values(self) -> Mapping[str, object]:
        times = np.linspace(0.0, self.period, len(self.angles) + 1)
        return {"table": TimeTableValues(tuple(times.tolist()), (*self.angles, self.angles[0]), "linear")}


def _arcs(times: Floats, angles: Floats, ends: Sequence[int]) -> PPoly:
    """Arcs that end before the knots of the numbers ``ends``; each goes on through the interval of the jump."""
    from scipy.interpolate import CubicSpline, PPoly

    pieces, begin = np.zeros((4, len(times) - 1)), 0
    for end in ends:
        pieces[3, end - 1] = angles[end - 1]
        if end - begin > 1:
            arc = CubicSpline(times[begin:end], angles[begin:end])
            pieces[:, begin : end - 1] = arc.c
            last = times[end - 1]
            pieces[1:, end - 1] = 0.5 * arc(last, 2), arc(last, 1), arc(last)
        begin = end
    return PPoly(pieces, times, extrapolate="periodic")
