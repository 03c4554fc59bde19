"""The positions of a machine that its sheet works out, with their motion and forces, and the numbered ones."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import significant
from linkwright.errors import LinkwrightError
from linkwright.events.limit_positions import limits_of
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.positions import at_inputs
from linkwright.kinematics.solve import with_times
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.reports.machine_results import ReportContext
from linkwright.reports.settings import settings as report_settings
from linkwright.sheets.settings import Subject, places
from linkwright.words import _

#: Numbered positions of the crank, and the most positions that are worked out.
NUMBERED, MOST = 12, 2
ROMAN = ("I", "II")


@dataclass(frozen=True)
class Shown:
    """A position that is worked out: its ``number`` (I, II) and its ``index`` in the motion."""

    number: str
    index: int


class Positions:
    """A machine over its cycle, with the positions of the sheet among those of its ``motion``."""

    def __init__(self, subject: Subject) -> None:
        assert isinstance(subject.drawn, Mechanism)
        self.subject, self.mechanism = subject, subject.drawn
        settings = report_settings(self.mechanism.report, subject.language)
        self.case = ReportContext(self.mechanism, settings, subject.language)

    @cached_property
    def _passing(self) -> tuple[Motion, list[int], list[int]]:
        """The motion through all positions, with the rows of those worked out and of the limit positions."""
        motion = self.case.motion
        if not self.mechanism.drivers:
            return motion, [int(np.argmax(motion.ok))], []
        limits = self._limit_times()
        found, rows = with_times(motion, [*self._times(), *limits])
        count = len(rows) - len(limits)
        return found, rows[:count], rows[count:]

    def _times(self) -> list[float]:
        """Times of the positions that are asked for; else the report's, and half a cycle on, or half a turn where
        half a cycle is full turns of the driver."""
        asked = self.subject.settings.positions[:MOST]
        if asked:
            return [self._time(place) for place in places(self.mechanism, asked)]
        first, motion = self.case.moment, self.case.motion
        reached = motion.time[motion.ok]
        start, span = float(reached[0]), float(reached[-1] - reached[0])
        period = motion.positions.period
        if period is not None and motion.ok.all():
            return [first, float(motion.time[0]) + (first - float(motion.time[0]) + self._half(period)) % period]
        return [first, start + (2 / 3) * span] if span else [first]

    @cached_property
    def _turn(self) -> float | None:
        """Time of one turn of the first driver where it turns evenly, s."""
        speed = next(iter(self.mechanism.drivers.values())).law.constant_speed
        return 2 * np.pi / abs(speed) if speed and self.case.rotary else None

    def _half(self, period: float) -> float:
        turns = period / 2 / self._turn if self._turn else 0.5
        return self._turn / 2 if self._turn and abs(turns - round(turns)) < 1e-6 else period / 2

    def _time(self, place: float) -> float:
        """The time of an input (rad or m), or a time itself where drivers do not turn evenly, s."""
        return float(at_inputs(self.mechanism, [place]).time[0]) if self.mechanism.steady else place

    def _limit_times(self) -> list[float]:
        try:
            return [each.time for each in limits_of(self.case.motion)]
        except LinkwrightError:
            return []

    @property
    def motion(self) -> Motion:
        """The motion through all positions."""
        return self._passing[0]

    @cached_property
    def shown(self) -> list[Shown]:
        """The positions that are worked out; those that are not reached are noted and left out."""
        motion, rows, _limits = self._passing
        for row in rows:
            if not motion.ok[row]:
                self.subject.note(
                    _("A position of the sheet is not reached: {sentence}", sentence=motion.outcomes[row].sentence)
                )
        reached = [row for row in dict.fromkeys(rows) if motion.ok[row]]
        return [Shown(number, row) for number, row in zip(ROMAN, reached, strict=False)]

    @property
    def limits(self) -> list[int]:
        """Rows of the limit positions of the last output."""
        motion, _positions, rows = self._passing
        return [row for row in rows if motion.ok[row]]

    @cached_property
    def forces(self) -> Forces | None:
        """The forces of the motion, None where nothing acts; what keeps them from being found is noted."""
        if not self.mechanism.has_loads:
            return None
        try:
            return solve_forces(self.motion)
        except LinkwrightError as error:
            self.subject.note(_("No forces on the sheet: {sentence}", sentence=error.sentence))
            return None

    def place(self, shown: Shown) -> str:
        """Where a position is: ``φ = 60°``, ``s = 20 mm``, ``t = 0.5 s``; empty at rest."""
        if not self.mechanism.drivers:
            return ""
        if not self.mechanism.steady:
            return f"t = {float(self.motion.time[shown.index]):.4g} s"
        value = float(self.motion.input[shown.index])
        if self.case.rotary:
            return f"φ = {significant(float(np.round(np.degrees(value), 2)), 6)}°"
        return f"s = {significant(float(np.round(1e3 * value, 2)), 6)} mm"

    @cached_property
    def numbered(self) -> tuple[Motion, list[int]]:
        """Twelve equal steps, as rows of a motion, from the report's first position: of the cycle, or of a shorter
        turn of the first driver."""
        motion = self.motion
        period = motion.positions.period
        if not self.mechanism.drivers or motion.steps < 2:
            return motion, []
        start = float(motion.time[0])
        if period is None:
            reached = motion.time[motion.ok]
            wanted = np.linspace(float(reached[0]), float(reached[-1]), NUMBERED)
        else:
            first, course = self._first(start), min(period, self._turn or period)
            wanted = start + (first - start + course * np.arange(NUMBERED) / NUMBERED) % period
        return with_times(motion, wanted.tolist())

    def _first(self, start: float) -> float:
        """Time of position 1."""
        limit = self.case.numbered.start
        return start if limit is None else limit.time

    def track(self, key: str) -> Floats:
        """The path of a point over the reached positions, (n, 2) m, closed where the cycle is."""
        path = self.motion.point_of(key).position
        return np.vstack([path, path[:1]]) if self.motion.positions.closed and len(path) > 1 else path
