"""Signals of one motion's machine at any time, solved again: with change points and groups without closed form.

They take the place of formulas in the search for events; see :class:`linkwright.events.formula.Pointwise`.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import row_name, row_names
from linkwright.curves.pieces import HIGH, LOW, Columns
from linkwright.events.formula import FEW, Known
from linkwright.joints.base import Kinks
from linkwright.kinematics.between_positions import Between, Reach

#: From rows of a program (names, m) values and slopes by the time of signals, (signals, m) each.
Made = Callable[[Floats], tuple[Floats, Floats]]


class OfTimes:
    """Signals (count, m) that a function gives at times (m,), s; slopes from their values ``step`` these, s."""

    def __init__(self, values: Callable[[Floats], Floats], count: int, step: float) -> None:
        self.values, self._step = values, step
        self.outputs = _numbers(count)

    def run(self, known: Known, columns: Columns, nodes: Floats) -> Floats:
        """The signals, (nodes, signals, pieces)."""
        time = columns[LOW] + (columns[HIGH] - columns[LOW]) * nodes[:, None]
        return self.values(time.ravel()).reshape(-1, *time.shape).swapaxes(0, 1)

    @property
    def with_slope(self) -> _WithSlope:
        """The signals and, behind each, its derivative by the place in the piece."""
        return _WithSlope(self)

    def both(self, time: Floats) -> tuple[Floats, Floats]:
        """Values and slopes by the time, (signals, m) each."""
        value, there = np.split(self.values(np.append(time, time + self._step)), 2, axis=1)
        return value, (there - value) / self._step


class SolvedAgain(OfTimes):
    """Signals ``made`` of rows ``names`` of the program of a motion; ``count``: how many."""

    def __init__(self, between: Between, reach: Reach, names: tuple[str, ...], made: Made, count: int = 1) -> None:
        super().__init__(lambda time: made(solved_at(between, reach, names, time))[0], count, 0.0)
        self.between, self.reach, self.names, self.made = between, reach, names, made

    def both(self, time: Floats) -> tuple[Floats, Floats]:
        return self.made(solved_at(self.between, self.reach, self.names, time))


class _WithSlope:
    """Signals with, behind each, its slope by the place in the piece."""

    def __init__(self, signals: OfTimes) -> None:
        self._signals, self.outputs = signals, _numbers(2 * len(signals.outputs))

    @property
    def with_slope(self) -> _WithSlope:
        raise NotImplementedError

    def run(self, known: Known, columns: Columns, nodes: Floats) -> Floats:
        width = columns[HIGH] - columns[LOW]
        time = columns[LOW] + width * nodes[:, None]
        value, slope = (each.reshape(-1, *time.shape) for each in self._signals.both(time.ravel()))
        both = np.stack([value, slope * width], axis=1)
        return both.reshape(len(self.outputs), *time.shape).swapaxes(0, 1)


def _numbers(count: int) -> tuple[str, ...]:
    return tuple(map(str, range(count)))


def solved_at(between: Between, reach: Reach, names: tuple[str, ...], time: Floats) -> Floats:
    """Rows of a motion's program at some times, s, (names, m); NaN out of reach."""
    if len(time) <= FEW and (plain := between.on_plain_numbers(names)) is not None:
        return np.array([plain(each) for each in time.tolist()]).reshape(len(time), len(names)).T
    states = between.motion.states
    before = reach.before(time) if states else np.zeros(len(time), dtype=np.intp)
    return between.evaluate(names, before, time)


def of_rate(rows: Floats) -> tuple[Floats, Floats]:
    """A rate, of rows that are that and its derivative."""
    return rows[:1], rows[1:2]


def of_bounded_rate(typical: float) -> Made:
    """What has the sign of a rate, and stays within ±1 where that grows without bounds, at ends of what is
    reached."""

    def made(rows: Floats) -> tuple[Floats, Floats]:
        square = 1.0 / (rows[:1] ** 2 + typical**2)
        return rows[:1] * np.sqrt(square), rows[1:2] * typical**2 * square * np.sqrt(square)

    return made


def kink_rows(kinks: Kinks) -> tuple[str, ...]:
    """The rows that tell where a joint goes over from one formula to another."""
    links = [link for link in (kinks.carrier, kinks.link) if link != "frame"]
    return tuple(
        name for link in links for name in (*row_names("direction", link), row_name("angular_velocity", link))
    )


def of_kinks(kinks: Kinks, phase: float, *, cosines: bool = False) -> Made:
    """Sines of the angles that a joint is beyond its bends, or of their cosines, which tell these from the places
    half a turn on."""
    turns = np.array(kinks.angles)[:, None] + phase
    fixed = np.array([[1.0], [0.0], [0.0]])

    def made(rows: Floats) -> tuple[Floats, Floats]:
        rest = iter(np.split(rows, range(3, len(rows), 3)))
        a, b = (fixed if link == "frame" else next(rest) for link in (kinks.carrier, kinks.link))
        along, across = a[0] * b[0] + a[1] * b[1], a[0] * b[1] - a[1] * b[0]
        sine = across * np.cos(turns) - along * np.sin(turns)
        cosine = along * np.cos(turns) + across * np.sin(turns)
        return (cosine, sine) if cosines else (sine, cosine * (b[2] - a[2]))

    return made
