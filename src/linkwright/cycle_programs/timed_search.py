"""The time over which corners are sought in many designs whose drivers follow laws."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.cycle_programs.corners import AROUND, REACH, REST
from linkwright.cycle_programs.traced_outputs import Traced
from linkwright.engine.program import Program
from linkwright.engine.replay import inlined
from linkwright.engine.trace import Scalar, Trace, floor
from linkwright.kinematics.bends import law_bends
from linkwright.kinematics.positions import at_times

#: Places at least between two breaks of laws, and how close to these the outermost lie, as share of what is between.
FEW, BESIDE = 6, 1e-7
#: The most stretches between breaks for which laws are traced: as many formulas are chosen from at every time.
MOST = 120


@dataclass(frozen=True)
class TimedSearch:
    """A cycle of the length ``lap`` from the time ``start``, s, which ``closes`` or does not, with ``count`` places;
    see ``corners.Along``."""

    traced: Traced
    start: float
    lap: float
    closes: bool
    count: int

    @cached_property
    def breaks(self) -> Floats:
        """Times, s, at which a driver's law goes over to another formula or turns round, and both ends."""
        end, near = self.start + self.lap, BESIDE * self.lap
        found = law_bends(self.traced.nominal)
        inner = found[(found > self.start + near) & (found < end - near)]
        inner = inner[np.diff(inner, prepend=self.start) > near]
        return np.concatenate([[self.start], inner, [end]])

    @property
    def possible(self) -> bool:
        """Whether there are places for all that lies between breaks, and laws do not break too often."""
        stretches = len(self.breaks) - 1
        return stretches <= MOST and self.count >= 2 * FEW * stretches

    @cached_property
    def joined(self) -> bool:
        """Whether the end goes over into the beginning by the same formulas."""
        ends = self.start + np.array([0.0, self.lap])
        apart = np.abs(law_bends(self.traced.nominal)[:, None] - ends)
        return self.closes and bool((apart > BESIDE * self.lap).all())

    @cached_property
    def positions(self) -> dict[str, Floats]:
        """Inputs (n,) of the programs evenly between the breaks, and close to these."""
        breaks = self.breaks
        widths = np.diff(breaks)
        counts = np.maximum(FEW, np.floor(self.count * widths / self.lap).astype(int))
        counts[np.argmax(counts)] += self.count - counts.sum()
        time, reach = [], []
        for low, width, count in zip(breaks, widths, counts, strict=False):
            share = np.clip(np.linspace(0.0, 1.0, count), BESIDE, 1.0 - BESIDE)
            time.append(low + width * share)
            reach.append(width * np.minimum(REST / (count - 1), share))
        around = np.zeros(self.count)
        around[-1] = reach[-1].max() if self.joined else 0.0
        known = at_times(self.traced.mechanism, np.concatenate(time)).arrays
        found = {_at_place(name): row for name, row in known.items()}
        return {**found, REACH: np.concatenate(reach), AROUND: around}

    def span(self, t: Trace) -> tuple[Scalar, Scalar]:
        """The time, s, at which the cycle begins, and how long it is."""
        return self.start, self.lap

    def inside(self, time: Scalar) -> Scalar:
        """A time within the cycle, s."""
        if not self.joined:
            return time
        share = (time - self.start) / self.lap
        return self.start + self.lap * (share - floor(share))

    def place(self, t: Trace) -> Scalar:
        """The times, s, between which corners are sought."""
        return t.position(_at_place("time"))

    def over_places(self, program: Program) -> Program:
        """A program of the motion over these."""
        t = Trace()
        inputs = {name: t.position(_at_place(name)) for name in program.positions}
        return Program.of(t, inlined(program, t, inputs))

    def there(self, program: Program, t: Trace, x: Scalar) -> dict[str, Any]:
        """The outputs of a program of the motion at a time, s."""
        return self.traced.at_time(program, t, self.inside(x), (self.start, self.start + self.lap))


def _at_place(name: str) -> str:
    return f"{name} at a place"
