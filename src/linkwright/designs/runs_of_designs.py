"""Runs of many designs of one mechanism under forces, each with its own steps, side by side in compiled code."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arguments import integer, require
from linkwright.core.arrays import Flags, Floats
from linkwright.core.data import Frozen
from linkwright.core.progress import Progress, current_progress
from linkwright.core.table import MOST, Amount, Cell, Table, Tabular
from linkwright.designs.runs_alone import found_alone
from linkwright.designs.varied_dimensions import design_values
from linkwright.dynamics.conditions import PATIENCE, USUAL, conditions_of
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.loop import Outcome
from linkwright.dynamics.run import run
from linkwright.dynamics.side_by_side import Ends, SideBySide, Starts
from linkwright.errors import LinkwrightError
from linkwright.formula.machine_code import available
from linkwright.formula.threads import chunks, cores
from linkwright.mechanism.mechanism import Mechanism
from linkwright.mechanism.run_conditions import RunConditions, Until
from linkwright.words import Message, _

#: How a design's run ends, in words.
OUTCOMES: Mapping[str, Message] = {
    "ended": _("runs to its end"),
    "turns": _("makes the turns"),
    "steady": _("becomes steady"),
    "late": _("neither steady nor at its turns in the longest time"),
    "no_start": _("does not start: cannot be put together there, or nothing with a mass moves"),
    "no_further": _("comes to where it cannot be put together, or needs steps that are too small"),
    "refused": _("refused by itself"),
}
#: Those of runs that are as they were to be.
THROUGH = ("ended", "turns", "steady")
#: Share of a driver's nominal speed that counts as its speed.
NEARLY = 0.95
#: Designs of one call.
BLOCK = 4096


@dataclass(eq=False)
class RunsOfDesigns(Tabular, Frozen):
    """Runs of many designs; arrays are (designs,), SI, NaN for designs that do not run to their end.

    ``varied``: values of the varied dimensions by address; ``outcomes``: how each run ended, a key of ``OUTCOMES``;
    ``time``: when (s); ``coordinates`` and ``rates`` there by driver (rad, rad/s or m, m/s); ``time_to_speed``: when
    the first driver had ``speed`` (rad/s or m/s) first, NaN where never; ``peaks`` and ``rms`` over the run of the
    actuators' efforts by name, N·m of those that turn a link, N of the others; ``energy_residual``: what the kinetic
    energy less the work of all forces has gained or lost, as share of the larger; ``alone``: designs that were run
    each by itself, as something sticks in them; ``refusals``: why, by number of the design.
    """

    mechanism: Mechanism
    varied: Mapping[str, Floats]
    outcomes: tuple[str, ...]
    time: Floats
    coordinates: Mapping[str, Floats]
    rates: Mapping[str, Floats]
    speed: float
    time_to_speed: Floats
    peaks: Mapping[str, Floats]
    rms: Mapping[str, Floats]
    energy_residual: Floats
    alone: Flags
    refusals: Mapping[int, str] = field(default_factory=dict)

    @property
    def designs(self) -> int:
        """Number of designs."""
        return len(self.outcomes)

    @property
    def ok(self) -> Flags:
        """Which designs run to their end, (designs,)."""
        return np.array([each in THROUGH for each in self.outcomes], dtype=np.bool_)

    def columns(self) -> dict[str, Floats]:
        """Varied dimensions and numbers of the runs by name."""
        found = {**self.varied, "time": self.time, "time_to_speed": self.time_to_speed}
        for name, column in self.coordinates.items():
            found |= {name: column, f"{name}.rate": self.rates[name]}
        for name, column in self.peaks.items():
            found |= {f"{name} peak": column, f"{name} rms": self.rms[name]}
        return found | {"energy_residual": self.energy_residual}

    def tables(self, language: str = "en") -> tuple[Table, ...]:
        """The first designs, SI."""
        columns = self.columns()
        rows: list[list[Cell]] = [
            [i, OUTCOMES[self.outcomes[i]], *(Amount(float(each[i])) for each in columns.values())]
            for i in range(min(self.designs, MOST))
        ]
        notes = [f"{MOST} / {self.designs}"] if self.designs > MOST else []
        return (Table(["", _("outcome"), *columns], rows, title=self.mechanism.name, notes=notes),)

    def data(self) -> dict[str, Any]:
        """Plain data, SI."""
        columns = {name: values.tolist() for name, values in self.columns().items()}
        return {"name": self.mechanism.name, "outcomes": list(self.outcomes), "columns": columns}

    def __repr__(self) -> str:
        return (
            f"RunsOfDesigns({self.mechanism.name!r}: {self.designs} designs, {int(self.ok.sum())} run to their end)"
        )


def run_designs(
    mechanism: Mechanism,
    designs: Mapping[str, ArrayLike],
    *,
    duration: float | None = None,
    turns: float | None = None,
    until: Until | None = None,
    at_most: float | None = None,
    at: float | Mapping[str, float] | None = None,
    speed: float | Mapping[str, float] | None = None,
    reach: float | None = None,
    tolerance: float = 1e-9,
    threads: int | None = None,
    progress: Progress | None = None,
) -> RunsOfDesigns:
    """Runs of many designs of a machine under its loads and actuators (:func:`linkwright.run`), side by side.

    Every design has its own steps and events in one compiled loop. Designs in which friction holds are run each by
    itself, in tenths of a second; so are all of machines with end stops, prescribed drivers or loads between limits
    of outputs, and with ``until="rest"``.

    Args:
        mechanism: the design to start from; its assembly modes hold for all.
        designs: values (designs,), SI, by address of a dimension (``actuators.motor.torque``) or of the run
            (``run.at.driver``, ``run.speed.driver``, ``run.for``), or by name of a parameter.
        duration, turns, until, at_most, at, speed: as for :func:`linkwright.run`, before the file's section ``run``.
        reach: speed of the first driver whose time is found, rad/s or m/s (default: 95 % of its nominal speed).
        tolerance: relative error of a step.
        threads: None for all cores; results do not depend on it.
        progress: called with (designs done, designs); what it raises stops the runs.

    Raises:
        LinkwrightError: unknown addresses, values that no design can have, no coordinate that is free.

    Example:
        >>> import linkwright as lw
        >>> cranks = {"crank.inertia": [0.1, 0.2, 0.4]}
        >>> found = lw.run_designs(lw.load("gallery:crank_rocker"), cranks, duration=0.1)
        >>> found.outcomes
        ('ended', 'ended', 'ended')
    """
    require(mechanism, Mechanism)
    columns = design_values(mechanism, designs)
    threads = cores() if threads is None else integer("threads", threads, 1)
    asked = conditions_of(mechanism, duration, turns, until, at_most, at, speed)
    runs = _Runs(mechanism, columns, asked, _speed(mechanism, reach), tolerance, threads)
    return runs.found(progress or current_progress())


def _speed(mechanism: Mechanism, reach: float | None) -> float:
    if reach is not None or not mechanism.drivers:
        return np.nan if reach is None else float(reach)
    law = next(iter(mechanism.drivers.values())).law.own
    return NEARLY * law.constant_speed if law.constant_speed else np.nan


class _Runs:
    """All runs, and where their numbers go."""

    def __init__(
        self,
        mechanism: Mechanism,
        columns: Mapping[str, Floats],
        asked: RunConditions,
        speed: float,
        tolerance: float,
        threads: int,
    ) -> None:
        self.mechanism, self.columns, self.asked, self.speed = mechanism, columns, asked, speed
        self.tolerance, self.threads = tolerance, threads
        self.count = len(next(iter(columns.values())))
        own = {name: column for name, column in columns.items() if not self._of_run(name)}
        self.side = SideBySide(EquationOfMotion(mechanism, varied=own), tuple(own))
        free, actuators = self.side.equation.free, list(self.side.actuators)
        self.own = own
        self.outcomes = np.full(self.count, "refused", dtype=object)
        self.time, self.residual, self.reached = (np.full(self.count, np.nan) for _k in range(3))
        self.state = {name: np.full((2, self.count), np.nan) for name in free}
        self.efforts = {name: np.full((2, self.count), np.nan) for name in actuators}
        self.alone = np.ones(self.count, dtype=np.bool_)
        self.refusals: dict[int, str] = {}

    def _of_run(self, address: str) -> bool:
        starts = {f"{name}.start" for name in self.mechanism.drivers}
        return address.startswith("run.") or address in starts

    @property
    def _together(self) -> bool:
        """Whether designs can run side by side."""
        return available() and self.side.possible and not self.asked.prescribed and self.asked.until != "rest"

    def found(self, progress: Progress | None) -> RunsOfDesigns:
        """The result."""
        if self._together:
            for first, last in chunks(self.count, BLOCK):
                self._block(slice(first, last))
                if progress is not None:
                    progress(last - int(self.alone[:last].sum()), self.count)
        left = np.flatnonzero(self.alone).tolist()
        for done, number in enumerate(left, self.count - len(left) + 1):
            self._by_itself(number)
            if progress is not None:
                progress(done, self.count)
        self._clear()
        return RunsOfDesigns(
            self.mechanism,
            self.columns,
            tuple(self.outcomes.tolist()),
            self.time,
            {name: each[0] for name, each in self.state.items()},
            {name: each[1] for name, each in self.state.items()},
            self.speed,
            self.reached,
            {name: each[0] for name, each in self.efforts.items()},
            {name: each[1] for name, each in self.efforts.items()},
            self.residual,
            self.alone,
            self.refusals,
        )

    def _clear(self) -> None:
        """No numbers of runs that do not go through."""
        short = ~np.isin(self.outcomes.astype(str), THROUGH)
        for rows in (*self.state.values(), *self.efforts.values()):
            rows[:, short] = np.nan
        self.residual[short] = np.nan

    # side by side ---------------------------------------------------------------------------------------
    def _block(self, part: slice) -> None:
        own = {name: column[part] for name, column in self.own.items()}
        ends = self.side.run(own, self._starts(part), self.tolerance, self.threads)
        for place, name in enumerate(self.state):
            self.state[name][:, part] = ends.coordinates[:, place], ends.rates[:, place]
        for place, name in enumerate(self.efforts):
            self.efforts[name][:, part] = ends.peaks[:, place], np.sqrt(ends.squares[:, place])
        self.time[part], self.residual[part], self.reached[part] = ends.time, ends.residual, ends.reached
        self.outcomes[part], self.alone[part] = self._words(ends), ends.undecided

    def _words(self, ends: Ends) -> list[str]:
        asked = self.asked
        through = "steady" if asked.until == "steady" else "turns"
        to_time = "ended" if asked.until is None and asked.turns is None else "late"
        words = {Outcome.ENDED: to_time, Outcome.STOPPED: through, Outcome.NO_START: "no_start"}
        return [words.get(each, "no_further") for each in ends.outcomes]

    def _starts(self, part: slice) -> Starts:
        equation, asked = self.side.equation, self.asked
        count = len(range(*part.indices(self.count)))
        drawn = dict(zip(equation.names, equation.start.tolist(), strict=True))
        at, rates = np.empty((2, count, len(equation.free)))
        for place, name in enumerate(equation.free):
            at[:, place] = self._column(part, f"run.at.{name}", asked.at.get(name, drawn[name]))
            rates[:, place] = self._column(part, f"run.speed.{name}", asked.speed.get(name, 0.0))
            if name not in asked.at and f"{name}.start" in self.columns:
                at[:, place] = self.columns[f"{name}.start"][part]
        waits = asked.until is not None or asked.turns is not None
        longest = self._column(part, "run.at_most", asked.at_most or PATIENCE)
        until = longest if waits else self._column(part, "run.for", asked.duration or USUAL)
        turns = self._column(part, "run.turns", np.nan if asked.turns is None else asked.turns)
        return Starts(at, rates, until, turns, asked.until == "steady", np.full(count, self.speed))

    def _column(self, part: slice, address: str, otherwise: float) -> Floats:
        count = len(range(*part.indices(self.count)))
        return self.columns[address][part] if address in self.columns else np.full(count, otherwise)

    # one by one -----------------------------------------------------------------------------------------
    def _by_itself(self, number: int) -> None:
        asked, own = self.asked, {name: float(column[number]) for name, column in self.columns.items()}
        known = asked.dimensions() | own
        try:
            design = replace(self.mechanism.with_dimensions(own), run=asked.with_dimensions(known.__getitem__))
            found = run(design, tolerance=self.tolerance)
            alone = found_alone(found, self.speed)
        except LinkwrightError as error:
            self.refusals[number] = str(error)
            return
        through = asked.until or ("turns" if asked.turns is not None else "ended")
        met = found.note is None and (through == "ended" or (found.events and found.events[-1].kind == through))
        self.outcomes[number] = "late" if not met else "ended" if through == "rest" else through
        self.time[number], self.residual[number], self.reached[number] = alone.end, alone.residual, alone.reached
        for name, rows in self.state.items():
            rows[:, number] = alone.coordinates[name], alone.rates[name]
        for name, rows in self.efforts.items():
            rows[:, number] = alone.peaks[name], alone.rms[name]
