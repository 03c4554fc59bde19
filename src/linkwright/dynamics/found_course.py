"""The course of a coordinate that a run found, as the law of a driver: what shows prescribed motions shows runs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from linkwright.drivers.base import Law
from linkwright.drivers.table import TableLaw
from linkwright.errors import LinkwrightError
from linkwright.fields.base import Field
from linkwright.mechanism.cycle import Cycle
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.drivers.base import Array
    from linkwright.dynamics.result import Run

#: Times of the table that stands for a course in a file.
TABLED = 721


@dataclass(frozen=True, eq=False)
class FoundCourse(Law):
    """The coordinate of a driver in a run; in a file a table of it."""

    key: ClassVar[str] = "table"
    run: Run
    driver: str
    rotary: bool

    def coordinate(self, t: Array) -> tuple[Array, Array, Array]:
        order = np.argsort(t, kind="stable")
        rows = self.run.samples(np.clip(t[order], 0.0, self.run.end)).course[self.driver]
        found = np.empty((3, len(t)))
        found[:, order] = rows
        return found[0], found[1], found[2]

    def natural_duration(self) -> float | None:
        return self.run.end

    def span(self) -> tuple[float, float]:
        return 0.0, self.run.end

    def breaks(self, start: float, end: float) -> Array:
        times = np.unique([each.time for each in self.run.events])
        return np.asarray(times[(times >= start) & (times <= end)])

    @classmethod
    def fields(cls, rotary: bool) -> Mapping[str, Field]:
        return TableLaw.fields(rotary)

    @classmethod
    def from_values(cls, values: Mapping[str, object], rotary: bool, parameters: Mapping[str, float]) -> Law:
        return TableLaw.from_values(values, rotary, parameters)

    def text_values(self) -> Mapping[str, object]:
        times = np.linspace(0.0, self.run.end, TABLED)
        rows = self.coordinate(times)[0]
        return TableLaw(tuple(times.tolist()), tuple(rows.tolist()), "cubic", self.rotary).text_values()


def as_driven(run: Run) -> Mechanism:
    """The mechanism whose drivers move as in a run, and supply what its actuators and stops did: so everything that
    shows a prescribed motion, living pages and reports among it, shows the run.

    Raises:
        LinkwrightError: the run goes through positions beyond which a driver does not lead, where links change sides.
    """
    mechanism = run.mechanism
    if any(piece.system is not run.pieces[0].system for piece in run.pieces):
        raise LinkwrightError(
            _(
                "the run goes through dead points of its drivers, which no course of theirs passes; show it by "
                "animate",
                code="dynamics.beyond_drivers",
            )
        )
    free = set(run.equation.free)
    drivers = {
        name: replace(each, law=FoundCourse(run, name, each.law.rotary)) if name in free else each
        for name, each in mechanism.drivers.items()
    }
    return replace(mechanism, drivers=drivers, cycle=Cycle(duration=run.end), run=None)
