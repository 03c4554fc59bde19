"""A coordinate given by a table over time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from linkwright.drivers.base import BEYOND_LAW, LAWS, Law, repeated
from linkwright.errors import LinkwrightError
from linkwright.fields.base import Field, TimeTable, TimeTableValues
from linkwright.words import _

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

    from linkwright.drivers.base import Array


@LAWS.register("table")
@dataclass(frozen=True)
class TableLaw(Law):
    """q interpolated through (times, positions); s and rad (m), times increasing.

    ``cubic``: spline with continuous second derivative, ends "not a knot"; ``periodic``: spline that repeats,
    the difference of last and first position being added each period; ``linear``: piecewise straight, its
    second derivative 0. Outside the table's times only ``periodic`` is defined; the others raise.
    """

    times: tuple[float, ...]
    positions: tuple[float, ...]
    interpolation: str = "cubic"
    rotary: bool = True

    def coordinate(self, t: Array) -> tuple[Array, Array, Array]:
        import numpy as np

        if self.interpolation == "periodic":
            return self._periodic(t)
        first, last = self.span()
        slack = 1e-9 * (last - first)
        if np.any(t < first - slack) or np.any(t > last + slack):
            raise LinkwrightError(BEYOND_LAW.format(first=first, last=last, begin=np.min(t), end=np.max(t)))
        inside = np.clip(t, first, last)
        return self._linear(inside) if self.interpolation == "linear" else self._cubic(inside)

    @cached_property
    def _spline(self) -> CubicSpline:
        from scipy.interpolate import CubicSpline

        if self.interpolation != "periodic":
            return CubicSpline(self.times, self.positions)
        rest = [q - self._drift * t for t, q in zip(self.times, self.positions, strict=True)]
        return CubicSpline(self.times, [*rest[:-1], rest[0]], bc_type="periodic")

    def _cubic(self, t: Array) -> tuple[Array, Array, Array]:
        return self._spline(t), self._spline(t, 1), self._spline(t, 2)

    @property
    def _drift(self) -> float:
        """What the position gains in a period, over its time."""
        return (self.positions[-1] - self.positions[0]) / (self.times[-1] - self.times[0])

    def _periodic(self, t: Array) -> tuple[Array, Array, Array]:
        position, rate, second = self._cubic(t)
        return position + self._drift * t, rate + self._drift, second

    def _linear(self, t: Array) -> tuple[Array, Array, Array]:
        import numpy as np

        slopes = np.diff(self.positions) / np.diff(self.times)
        part = np.clip(np.searchsorted(self.times, t, side="right") - 1, 0, len(slopes) - 1)
        return np.interp(t, self.times, self.positions), slopes[part], 0.0 * t

    def breaks(self, start: float, end: float) -> Array:
        import numpy as np

        times = np.array(self.times)
        if self.interpolation == "periodic":
            return repeated(times[:-1], float(times[-1] - times[0]), start, end)
        return np.asarray(times[(times >= start) & (times <= end)])

    def natural_duration(self) -> float | None:
        return self.times[-1] - self.times[0]

    def span(self) -> tuple[float, float]:
        return super().span() if self.interpolation == "periodic" else (self.times[0], self.times[-1])

    @classmethod
    def fields(cls, rotary: bool) -> Mapping[str, Field]:
        return {"table": TimeTable("angle" if rotary else "length", doc=_("positions over time"))}

    @classmethod
    def from_values(cls, values: Mapping[str, object], rotary: bool, parameters: Mapping[str, float]) -> TableLaw:
        table = values["table"]
        assert isinstance(table, TimeTableValues)
        return cls(table.times, table.positions, table.interpolation, rotary)

    def text_values(self) -> Mapping[str, object]:
        return {"table": TimeTableValues(self.times, self.positions, self.interpolation)}
