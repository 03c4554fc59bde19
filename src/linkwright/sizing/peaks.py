"""Largest values over a cycle of what forces give, found between the positions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.analysis import Analysis
from linkwright.analysis.reachable_intervals import Ways
from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.kinetostatics.forces import Forces
from linkwright.words import pgettext

#: Signals (k, n) of forces, none negative.
Signals = Callable[[Forces], Floats]
#: How often the neighbourhood of a largest value is looked at more closely, and at how many places; the last look
#: has them (2/8)³ of a step apart.
LOOKS, PLACES = 3, 9
#: Share of the cycle by which a look is on one side of a jump.
SIDE = 1e-9


@dataclass(frozen=True)
class Largest:
    """A largest ``value``, and where it is in the cycle, to go behind a sentence: empty without drivers."""

    value: float
    at: str


@dataclass(frozen=True, eq=False)
class Peak:
    """The largest value of a signal: at position ``index`` of ``forces``."""

    value: float
    forces: Forces
    index: int

    @property
    def largest(self) -> Largest:
        """The value with its place."""
        return Largest(self.value, self._at())

    def _at(self) -> str:
        motion = self.forces.motion
        if not motion.mechanism.drivers:
            return ""
        turning = next(iter(motion.positions.rotary.values()), True)
        place = shown(float(motion.input[self.index]), "angle" if turning else "length")
        return pgettext("sizing", ", at {place} of the input").format(place=place)


def peaks(forces: Forces, signals: Signals) -> list[Peak]:
    """The largest value of each signal.

    Values are taken at all positions, on both sides of every jump, and ever nearer around the largest one.
    """
    analysis = Analysis.of(forces)
    known = analysis.forces or forces
    found = _best(known, signals(known))
    if not found or analysis.cycle is None:
        return found
    between = _Between(analysis, analysis.cycle)
    for look in range(LOOKS + 1):
        solved = between.around(found, look) if look else between.beside_jumps()
        if solved is not None:
            better = _best(solved, signals(solved))
            found = [max(pair, key=_size) for pair in zip(found, better, strict=True)]
    return found


def _size(peak: Peak) -> float:
    return -1.0 if np.isnan(peak.value) else peak.value


def _best(forces: Forces, values: Floats) -> list[Peak]:
    places = np.where(np.isnan(values), -1.0, values).argmax(axis=1)
    return [Peak(float(row[i]), forces, int(i)) for row, i in zip(values, places, strict=True)]


@dataclass(frozen=True, eq=False)
class _Between:
    """Forces between the positions of a cycle."""

    analysis: Analysis
    ways: Ways

    def beside_jumps(self) -> Forces | None:
        """On both sides of every jump and bend of the loads; None without any."""
        cuts = self.ways.stretches(np.empty(0), 1.0).begin
        side = SIDE * self.ways.course.duration
        return self._at(np.concatenate([cuts - side, cuts + side])) if len(cuts) else None

    def around(self, found: Sequence[Peak], look: int) -> Forces:
        """Next to the largest values, the nearer the later the ``look``."""
        reach = self.ways.course.duration / self.analysis.motion.steps * (2.0 / (PLACES - 1)) ** (look - 1)
        places = np.array([float(each.forces.motion.time[each.index]) for each in found])
        return self._at((places[:, None] + reach * np.linspace(-1.0, 1.0, PLACES)).ravel())

    def _at(self, times: Floats) -> Forces:
        course = self.ways.course
        since = times - course.begin
        inside = since % course.duration if course.closed else np.clip(since, 0.0, course.duration)
        solved: Forces = self.analysis.resolver.at(np.unique(course.begin + inside), "forces")
        return solved
