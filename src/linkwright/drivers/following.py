"""Drivers that follow: their coordinates are those at which a point of the machine is on its path."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from linkwright.core.attached import attached
from linkwright.drivers.base import Law, MadeLaw
from linkwright.formula.late_import import numpy as np

if TYPE_CHECKING:
    from linkwright.drivers.base import Array
    from linkwright.drivers.path import Path
    from linkwright.formula.trace import Scalar

#: How near polynomials of the time come to the coordinates, as share of the largest, where the time is traced.
FINE = 1e-11


@dataclass(frozen=True)
class PathPoint(MadeLaw):
    """One coordinate of the point that follows a path, ``axis`` 0 or 1, in m."""

    path: Path
    axis: int
    rotary: bool = False

    key = "path"

    def coordinate(self, t: Array) -> tuple[Array, Array, Array]:
        place, rate, second = self.path.at(np.asarray(t, dtype=float))
        return place[:, self.axis], rate[:, self.axis], second[:, self.axis]

    def natural_duration(self) -> float | None:
        return self.path.natural_duration()

    def span(self) -> tuple[float, float]:
        return self.path.span()

    def breaks(self, start: float, end: float) -> Array:
        return self.path.breaks(start, end)


@dataclass(frozen=True)
class Guidance:
    """A machine, whose drivers without a law are still free, and the path of one of its points.

    The drivers' coordinates are those of the same machine driven at that point, which is exact where its groups are.
    """

    machine: Any = field(repr=False, hash=False)
    path: Path

    @attached
    def coordinates(self, t: Array) -> dict[str, tuple[Array, Array, Array]]:
        """Coordinates with their first and second rates of the drivers without a law, (n,) each, at times t (n,)."""
        raise NotImplementedError

    @attached
    def posed(self) -> Any:
        """The machine with its drawing as it is at the beginning of the path."""
        raise NotImplementedError

    def span(self) -> tuple[float, float]:
        """First and last time, s, at which all laws say something."""
        spans = [self.path.span(), *(each.law.span() for each in self._lawful)]
        return max(first for first, _last in spans), min(last for _first, last in spans)

    def breaks(self, start: float, end: float) -> Array:
        """Times at which a derivative of a coordinate may jump, s."""
        found = self.path.breaks(start, end)
        for each in self._lawful:
            found = np.union1d(found, each.law.breaks(start, end))
        return np.asarray(found)

    @property
    def _lawful(self) -> list[Any]:
        return [each for each in self.machine.drivers.values() if not isinstance(each.law, Following)]


@dataclass(frozen=True)
class Following(MadeLaw):
    """The law of a driver that follows a path: none of its own in the file; ``guidance`` gives its coordinate."""

    rotary: bool = True
    name: str = ""
    guidance: Guidance | None = None

    key = "path"

    @property
    def own(self) -> Law:
        return self if self.guidance is None else Following(self.rotary)

    def coordinate(self, t: Array) -> tuple[Array, Array, Array]:
        if self.guidance is None:  # at rest as drawn, while the machine is read
            none = 0.0 * np.asarray(t, dtype=float)
            return none, none, none
        return self.guidance.coordinates(np.asarray(t, dtype=float))[self.name]

    def traced(self, t: Scalar, start: float, end: float) -> tuple[Scalar, Scalar, Scalar]:
        from linkwright.laws.law_pieces import law_pieces

        return law_pieces(self, start, end, FINE).traced(t)

    def natural_duration(self) -> float | None:
        return None if self.guidance is None else self.guidance.path.natural_duration()

    def span(self) -> tuple[float, float]:
        return super().span() if self.guidance is None else self.guidance.span()

    def breaks(self, start: float, end: float) -> Array:
        return np.empty(0) if self.guidance is None else self.guidance.breaks(start, end)

    def with_dimensions(self, value: Callable[[str], float], parameters: Mapping[str, float]) -> Law:
        """Without the path, which the mechanism gives it again."""
        return self.own
